//! Wavefront OBJ with MTL.
//!
//! Text becomes statements (`lines`), statements become faces (`parse`) and definitions of materials (`mtl`), polygons
//! become triangles (`polygon`), groups become meshes (`build`). No line that exporters write refuses a file: each kind
//! of oddity is told once (`oddities`), unless it is to be refused.
//!
//! OBJ says nothing of back faces, so all are drawn; which side is the front is told by the given normals and, without
//! them, by the winding. Colours of vertices and images are sRGB, those of MTL linear.

mod build;
mod lines;
mod material;
mod mtl;
mod oddities;
mod parse;
mod polygon;
#[cfg(test)]
mod tests;
mod texture_line;

use std::collections::BTreeMap;
use std::path::Path;

use glam::DMat4;
use rayon::prelude::*;

use self::build::Built;
use self::material::Materials;
use self::mtl::Library;
use self::oddities::{Kind, Oddities, shown};
use self::parse::Geometry;
use super::source::SourceFiles;
use super::{Instance, Scene, TextureSlot, file_stem};
use crate::{Error, Result, text};

/// Reads an .obj file, its material libraries and the images of the materials that faces use. `strict` refuses the first
/// line that would else be a warning; a missing image is an error either way.
///
/// # Errors
/// One line that names the file, the line and what is wrong with it.
pub fn load(path: &Path, strict: bool) -> Result<Scene> {
    let mut oddities = Oddities::new(path, strict);
    let mut files = SourceFiles::default();
    let geometry = read(path, &mut files, &mut oddities)?;
    let library = Library::read(path, &geometry.libraries, &mut files, &mut oddities)?;
    let definitions = library.find(&geometry.materials);
    note_missing(&geometry, &definitions, &mut oddities)?;

    let (materials, material_of_group) = materials(&geometry, &library, &definitions);
    let mut scene = Scene::empty(file_stem(path));
    scene.images = materials.load_images(&mut files)?;
    let built = build_all(&geometry, &materials, &material_of_group);
    note_odd_polygons(path, &built, &mut oddities)?;
    scene.warnings = oddities.warnings(path);
    scene.warnings.extend(library.warnings(path));
    for Built { mesh, .. } in built.into_iter().filter(|built| !built.mesh.indices.is_empty()) {
        let primitive = scene.primitives.len() as u32;
        scene.add_mesh(mesh).map_err(|message| Error::file(path, message))?;
        scene.instances.push(Instance { primitive, world_from_object: DMat4::IDENTITY });
    }
    scene.materials = materials.list;
    scene.sha256 = files.sha256();
    Ok(scene)
}

fn read(path: &Path, files: &mut SourceFiles, oddities: &mut Oddities) -> Result<Geometry> {
    let bytes = files.read(path)?;
    let (text, odd_line) = text::decode_any(&bytes).map_err(|message| Error::file(path, message))?;
    if let Some(line) = odd_line {
        oddities.note(line, Kind::Encoding, "the text is not UTF-8")?;
    }
    parse::parse(&text, oddities)
}

/// Notes names after `usemtl` that mean no definition.
fn note_missing(geometry: &Geometry, definitions: &[Option<usize>], oddities: &mut Oddities) -> Result<()> {
    for ((name, line), _) in geometry.materials.iter().zip(definitions).filter(|(_, found)| found.is_none()) {
        if name.is_empty() {
            oddities.note(*line, Kind::EmptyName, "usemtl without a name")?;
        } else {
            let name = shown(name);
            oddities.note_named(*line, Kind::NoMaterial, &name, format_args!("no MTL defines {name}"))?;
        }
    }
    Ok(())
}

/// The materials that groups use, in the order of their first use, and which of them each group has.
fn materials(geometry: &Geometry, library: &Library, definitions: &[Option<usize>]) -> (Materials, Vec<u32>) {
    let mut materials = Materials::default();
    let mut place = BTreeMap::new();
    let material_of_group = geometry.groups.iter().map(|group| {
        let definition = group.material.and_then(|material| definitions[material]);
        *place
            .entry(definition)
            .or_insert_with(|| materials.add(definition.map(|definition| &library.definitions[definition])))
    });
    let material_of_group = material_of_group.collect();
    (materials, material_of_group)
}

/// Builds the mesh of each group, on all cores.
fn build_all(geometry: &Geometry, materials: &Materials, material_of_group: &[u32]) -> Vec<Built> {
    let groups = geometry.groups.par_iter().zip(material_of_group);
    let normal_map =
        |material: u32| materials.list[material as usize].textures[TextureSlot::Normal as usize].as_ref();
    groups.map(|(group, &material)| build::build(geometry, group, material, normal_map(material))).collect()
}

fn note_odd_polygons(path: &Path, built: &[Built], oddities: &mut Oddities) -> Result<()> {
    for &(line, kind, what) in built.iter().flat_map(|built| &built.odd) {
        oddities.note(line, kind, what)?;
    }
    let turned: usize = built.iter().map(|built| built.turned).sum();
    if turned > 0 {
        tracing::info!("{}: {turned} triangles wind against their normals and were turned", path.display());
    }
    Ok(())
}
