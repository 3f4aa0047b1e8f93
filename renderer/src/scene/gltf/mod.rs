//! glTF 2.0 (.gltf, .glb).
//!
//! The JSON is read through the `gltf` crate's types; everything they point to is range-checked here before
//! it is used, because that crate trusts (and panics on) what it has not validated, and its validation knows
//! no KHR_mesh_quantization.
//!
//! Read: node hierarchies of the default scene, triangle lists, strips and fans, vertex colours, two texture
//! coordinate sets a material, sparse and quantized accessors, metallic-roughness materials, point lights.
//! Ignored: animation, skins, morph targets, cameras; skipped with a warning: points, lines, spot and
//! directional lights.

mod accessor;
mod choice;
mod document;
mod material;
mod nodes;
mod primitive;
#[cfg(test)]
mod tests;
mod uri;

use std::path::Path;

use rayon::prelude::*;

use self::document::Document;
use self::material::Materials;
use self::nodes::Placed;
use self::primitive::Builder;
use super::mesh::Mesh;
use super::source::SourceFiles;
use super::{Instance, Scene, file_stem};
use crate::Result;

/// Reads a .gltf or .glb file (told apart by content) and all it refers to.
///
/// # Errors
/// One line that names the file and the object that is missing, corrupt or not supported.
pub fn load(path: &Path) -> Result<Scene> {
    let mut files = SourceFiles::default();
    let document = Document::open(path, &mut files)?;
    let mut materials = Materials::read(&document)?;
    let placed = nodes::place(&document)?;

    let mut scene = Scene::empty(file_stem(path));
    scene.images = materials.load_images(&document, &mut files)?;
    add_meshes(&mut scene, &document, &mut materials, &placed)?;
    scene.materials = materials.list;
    scene.lights = placed.lights;
    scene.sha256 = files.sha256();
    Ok(scene)
}

/// Builds each placed mesh once, all on all cores, and instances it at every node.
fn add_meshes(
    scene: &mut Scene,
    document: &Document,
    materials: &mut Materials,
    placed: &Placed,
) -> Result<()> {
    let jobs = primitive::jobs(document, materials, placed)?;
    let builder = Builder { document, materials };
    // By primitive: their sizes differ by orders of magnitude.
    let built: Vec<_> = jobs.par_iter().with_max_len(1).map(|job| builder.build(job)).collect();

    let mut primitives_of_mesh = vec![Vec::new(); document.root.meshes.len()];
    let mut without_uv = 0;
    for (job, mesh) in jobs.iter().zip(built) {
        let primitive::Built { mesh, lacks_uv } = mesh?;
        without_uv += u32::from(lacks_uv);
        if !mesh.indices.is_empty() {
            primitives_of_mesh[job.mesh].push(scene.primitives.len() as u32);
            add_mesh(scene, document, mesh)?;
        }
    }
    if without_uv > 0 {
        let file = document.path.display();
        tracing::warn!("{file}: {without_uv} textured primitives lack texture coordinates; 0, 0 is used");
    }
    for node in &placed.meshes {
        let world_from_object = node.world_from_object;
        let primitives = &primitives_of_mesh[node.mesh];
        scene.instances.extend(primitives.iter().map(|&primitive| Instance { primitive, world_from_object }));
    }
    Ok(())
}

fn add_mesh(scene: &mut Scene, document: &Document, mesh: Mesh) -> Result<()> {
    scene.add_mesh(mesh).map_err(|message| document.error(message))
}
