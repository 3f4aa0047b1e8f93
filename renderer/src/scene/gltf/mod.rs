//! glTF 2.0 (.gltf, .glb).
//!
//! Objects of the JSON are read one by one through the `gltf` crate's types as the walk through the scene reaches
//! them (`document`); everything they point to is range-checked here before it is used, because that crate trusts
//! (and panics on) what it has not validated, and its validation knows no extensions.
//!
//! Read: node hierarchies of the default scene, instances, skins and morph targets at rest, triangle lists, strips and
//! fans, vertex colours, two texture coordinate sets a material, sparse, quantized and meshopt-compressed accessors,
//! metallic-roughness and unlit materials, point and spot lights. Ignored: animation, cameras. What else changes the picture is
//! left out with a warning (`left_out`), or refused where the file requires it.

mod accessor;
mod attributes;
mod choice;
mod container;
mod document;
mod extensions;
mod instancing;
mod left_out;
mod material;
mod meshopt;
mod nodes;
mod primitive;
mod skin;
#[cfg(test)]
mod tests;
mod topology;
mod uri;

use std::path::Path;

use rayon::prelude::*;

use self::document::Document;
use self::left_out::LeftOut;
use self::material::Materials;
use self::nodes::Placed;
use self::primitive::{Builder, Job};
use super::source::SourceFiles;
use super::{Instance, Scene, file_stem};
use crate::Result;

/// Instances, more than which are refused: a small file can ask for any number of them.
const MAX_INSTANCES: usize = 1 << 22;

/// Reads a .gltf or .glb file (told apart by content) and all it refers to.
///
/// # Errors
/// One line that names the file and the object that is missing, corrupt or not supported.
pub fn load(path: &Path) -> Result<Scene> {
    let mut files = SourceFiles::default();
    let document = Document::open(path, &mut files)?;
    let mut left_out = LeftOut::default();
    extensions::note_unknown(document.field("extensionsUsed"), &mut left_out);
    let placed = nodes::place(&document, &mut left_out)?;
    let jobs = primitive::jobs(&document, &placed, &mut left_out)?;
    let materials = Materials::read(&document, jobs.iter().map(Job::material), &mut left_out)?;

    let mut scene = Scene::empty(file_stem(path));
    scene.images = materials.load_images(&document, &mut files)?;
    let primitives_of_shape =
        add_primitives(&mut scene, &jobs, (&document, &materials, &placed), &mut left_out)?;
    add_instances(&mut scene, &placed, &primitives_of_shape).map_err(|message| document.error(message))?;
    scene.materials = materials.list;
    scene.lights = placed.lights;
    scene.sha256 = files.sha256();
    scene.warnings = left_out.into_warnings();
    Ok(scene)
}

/// Builds primitives, all on all cores; returns those of each shape.
fn add_primitives(
    scene: &mut Scene,
    jobs: &[Job],
    (document, materials, placed): (&Document, &Materials, &Placed),
    left_out: &mut LeftOut,
) -> Result<Vec<Vec<u32>>> {
    let builder = Builder { document, materials, placed };
    // By primitive: their sizes differ by orders of magnitude.
    let built: Vec<_> = jobs.par_iter().with_max_len(1).map(|job| builder.build(job)).collect();
    let mut primitives_of_shape = vec![Vec::new(); placed.shapes.len()];
    for (job, built) in jobs.iter().zip(built) {
        let primitive::Built { mesh, lacks_uv } = built?;
        left_out
            .add("textured primitives without texture coordinates, which are taken as 0, 0", lacks_uv.into());
        if !mesh.indices.is_empty() {
            primitives_of_shape[job.shape].push(scene.primitives.len() as u32);
            scene.add_mesh(mesh).map_err(|message| document.error(message))?;
        }
    }
    Ok(primitives_of_shape)
}

/// Places the primitives of each shape wherever it stands.
fn add_instances(scene: &mut Scene, placed: &Placed, primitives_of_shape: &[Vec<u32>]) -> Result<(), String> {
    let count: usize = placed.meshes.iter().map(|mesh| primitives_of_shape[mesh.shape].len()).sum();
    if count > MAX_INSTANCES {
        return Err(format!("places {count} primitives; at most {MAX_INSTANCES} are"));
    }
    for mesh in &placed.meshes {
        let world_from_object = mesh.world_from_object;
        let primitives = &primitives_of_shape[mesh.shape];
        scene.instances.extend(primitives.iter().map(|&primitive| Instance { primitive, world_from_object }));
    }
    Ok(())
}
