//! Instances of a node's mesh (EXT_mesh_gpu_instancing).

use std::collections::BTreeMap;

use glam::{DMat4, DQuat, DVec3};
use gltf::json;
use serde::Deserialize;

use super::accessor::Accessor;
use super::document::Document;
use super::nodes::{MAX_PLACED, unit_rotation};

/// The instances' attributes: accessors by name. Those of other names mean nothing to a picture.
#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, json::Index<json::Accessor>>,
}

/// Where the instances of a node's mesh stand, seen from the node; `None` for a node without.
pub(super) fn instances(document: &Document, node: &json::Node) -> Result<Option<Vec<DMat4>>, String> {
    let extensions = node.extensions.as_ref().map(|extensions| &extensions.others);
    let Some(json) = extensions.and_then(|others| others.get("EXT_mesh_gpu_instancing")) else {
        return Ok(None);
    };
    let Instancing { attributes } = Instancing::deserialize(json)
        .map_err(|e| format!("has instances (EXT_mesh_gpu_instancing) that are not valid: {e}"))?;
    let transforms = transforms(document, &attributes);
    transforms.map(Some).map_err(|message| format!("has instances (EXT_mesh_gpu_instancing): {message}"))
}

fn transforms(
    document: &Document,
    attributes: &BTreeMap<String, json::Index<json::Accessor>>,
) -> Result<Vec<DMat4>, String> {
    let named = attributes.iter().map(|(name, &index)| Ok((name.as_str(), Accessor::new(document, index)?)));
    let accessors = named.collect::<Result<BTreeMap<&str, Accessor>, String>>()?;
    let count = accessors.values().next().ok_or("no attributes")?.count;
    if let Some((name, other)) = accessors.iter().find(|(_, accessor)| accessor.count != count) {
        return Err(format!("{name} has {} elements, another attribute {count}", other.count));
    }
    if count > MAX_PLACED {
        return Err(format!("{count} of them; at most {MAX_PLACED} meshes are placed"));
    }
    let attribute = |name: &str| accessors.get(name);
    let translations = vectors(attribute("TRANSLATION"), [0.0; 3], count)?;
    let rotations = vectors(attribute("ROTATION"), [0.0, 0.0, 0.0, 1.0], count)?;
    let scales = vectors(attribute("SCALE"), [1.0; 3], count)?;
    let transform = |((translation, rotation), scale): (([f32; 3], [f32; 4]), [f32; 3])| {
        let [translation, scale] = [translation, scale].map(|v| DVec3::from(v.map(f64::from)));
        let rotation: DQuat = unit_rotation(rotation)?;
        Ok(DMat4::from_scale_rotation_translation(scale, rotation, translation))
    };
    translations.into_iter().zip(rotations).zip(scales).map(transform).collect()
}

/// The values of an attribute, integers as fractions, or `count` times what stands for a missing one.
fn vectors<const N: usize>(
    accessor: Option<&Accessor>,
    missing: [f32; N],
    count: usize,
) -> Result<Vec<[f32; N]>, String> {
    let mut values = vec![missing; count];
    if let Some(accessor) = accessor {
        accessor.expect_lanes(N)?;
        accessor.normalized_floats(0..count, |i, value| values[i] = value);
    }
    Ok(values)
}
