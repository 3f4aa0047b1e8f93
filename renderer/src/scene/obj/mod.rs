//! Wavefront OBJ with MTL.
//!
//! Parsed by `tobj` from text that `text` and `mtl` have checked line by line, because tobj's errors give
//! no line and some input makes it panic or misplace coordinates. Polygons become fans. OBJ says nothing of
//! back faces, so all are drawn; colours are taken as linear, images as sRGB.

mod material;
mod mtl;
#[cfg(test)]
mod tests;
mod text;

use std::collections::BTreeSet;
use std::path::Path;

use glam::DMat4;
use rayon::prelude::*;

use self::material::Materials;
use self::mtl::Library;
use super::mesh::{Mesh, PLAIN_VERTEX};
use super::source::SourceFiles;
use super::{Instance, Scene, TextureSlot, Vertex, file_stem};
use crate::{Error, Result};

/// Reads an .obj file, its material libraries and their images. A missing library is a warning, a missing
/// image an error.
///
/// # Errors
/// One line that names the file, the line and what is wrong with it.
pub fn load(path: &Path) -> Result<Scene> {
    let mut files = SourceFiles::default();
    let source = text::clean(&files.read(path)?).map_err(|e| Error::file(path, e))?;
    let library = Library::read(path, &source.libraries, &mut files)?;
    let (mut models, parsed) = parse(path, &source.text, &library)?;
    drop(source.text);
    models.retain(|model| !model.mesh.indices.is_empty());
    warn_of_missing(path, &source.materials, &parsed);

    let mut materials = Materials::new(&library, &parsed);
    let mut scene = Scene::empty(file_stem(path));
    scene.images = materials.load_images(&mut files)?;
    if models.iter().any(|model| model.mesh.material_id.is_none()) {
        materials.add_default();
    }
    add_models(&mut scene, path, models, &materials)?;
    scene.materials = materials.list;
    scene.sha256 = files.sha256();
    Ok(scene)
}

fn parse(path: &Path, text: &str, library: &Library) -> Result<(Vec<tobj::Model>, Vec<tobj::Material>)> {
    let load_library = |_: &Path| tobj::load_mtl_buf(&mut library.text.as_bytes());
    tobj::load_obj_buf(&mut text.as_bytes(), &tobj::GPU_LOAD_OPTIONS, load_library)
        .and_then(|(models, materials)| Ok((models, materials?)))
        .map_err(|e| Error::file(path, format!("cannot be read: {e}")))
}

fn warn_of_missing(path: &Path, used: &BTreeSet<String>, materials: &[tobj::Material]) {
    let missing: Vec<_> =
        used.iter().filter(|name| materials.iter().all(|m| m.name != **name)).cloned().collect();
    if !missing.is_empty() {
        tracing::warn!("{}: no MTL defines {}; a default stands in", path.display(), missing.join(", "));
    }
}

fn add_models(scene: &mut Scene, path: &Path, models: Vec<tobj::Model>, materials: &Materials) -> Result<()> {
    let meshes: Vec<_> = models.into_par_iter().map(|model| build(model, materials)).collect();
    for mesh in meshes {
        if let Some(vertex) = mesh.first_bad_position() {
            let position = mesh.vertices[vertex].position;
            return Err(Error::file(path, format!("has a position that is not finite: {position:?}")));
        }
        let primitive = scene.primitives.len() as u32;
        scene.add_mesh(mesh).map_err(|message| Error::file(path, message))?;
        scene.instances.push(Instance { primitive, world_from_object: DMat4::IDENTITY });
    }
    Ok(())
}

fn build(model: tobj::Model, materials: &Materials) -> Mesh {
    let tobj::Model { mesh, .. } = model;
    let material = mesh.material_id.unwrap_or(materials.list.len() - 1);
    let normal_map = materials.list[material].textures[TextureSlot::Normal as usize];
    let has_normals = !mesh.normals.is_empty();
    let mut built = Mesh { vertices: vertices(&mesh), indices: mesh.indices, material: material as u32 };
    if has_normals {
        built.normalize_normals();
    } else {
        built.flatten_normals();
    }
    match normal_map {
        Some(normal_map) if built.first_bad_position().is_none() => built.generate_tangents(&normal_map),
        _ => built.set_any_tangents(),
    }
    built
}

/// Vertices with what the model has of normals, coordinates (turned to have v down the image) and colours.
fn vertices(mesh: &tobj::Mesh) -> Vec<Vertex> {
    let positions = mesh.positions.as_chunks::<3>().0.iter();
    let mut vertices: Vec<_> = positions.map(|&position| Vertex { position, ..PLAIN_VERTEX }).collect();
    for (vertex, &normal) in vertices.iter_mut().zip(mesh.normals.as_chunks::<3>().0) {
        vertex.normal = normal;
    }
    for (vertex, &[u, v]) in vertices.iter_mut().zip(mesh.texcoords.as_chunks::<2>().0) {
        let uv = [u, 1.0 - v].map(|x| if x.is_finite() { x } else { 0.0 });
        vertex.uv = [uv, [0.0; 2]];
    }
    for (vertex, &[r, g, b]) in vertices.iter_mut().zip(mesh.vertex_color.as_chunks::<3>().0) {
        let [r, g, b] = [r, g, b].map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8);
        vertex.color = [r, g, b, 255];
    }
    vertices
}
