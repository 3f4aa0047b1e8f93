//! The node hierarchy of the default scene, flattened.

use glam::{DAffine3, DMat4, DQuat, DVec3, Mat4, Quat};
use gltf::json;
use json::extensions::scene::khr_lights_punctual::{Light, Type};
use json::validation::Checked;

use super::super::SceneLight;
use super::document::Document;
use crate::Result;

/// What the default scene places in the world.
pub(super) struct Placed {
    /// In the order of a depth-first walk.
    pub meshes: Vec<PlacedMesh>,
    /// Point lights.
    pub lights: Vec<SceneLight>,
}

/// A mesh at a node.
pub(super) struct PlacedMesh {
    /// Into the document's meshes; checked.
    pub mesh: usize,
    pub world_from_object: DMat4,
}

/// Walks the default scene: the one the file names, else its first, else all nodes without a parent.
pub(super) fn place(document: &Document) -> Result<Placed> {
    let mut walk = Walk {
        document,
        placed: Placed { meshes: Vec::new(), lights: Vec::new() },
        flat: 0,
        skinned: 0,
        other_lights: 0,
    };
    let roots = roots(document).map_err(|message| document.error(message))?;
    let nodes = &document.root.nodes;
    let mut visited = vec![false; nodes.len()];
    let mut pending: Vec<_> = roots.into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    while let Some((index, world_from_parent)) = pending.pop() {
        let fail = |message: String| document.error(format!("nodes[{}] {message}", index.value()));
        let node =
            document.get(nodes, "nodes", index).map_err(|m| document.error(format!("the scene {m}")))?;
        if std::mem::replace(&mut visited[index.value()], true) {
            return Err(fail("has two parents, or is its own ancestor".into()));
        }
        let world_from_node = world_from_parent * local_transform(node).map_err(fail)?;
        walk.visit(node, world_from_node).map_err(fail)?;
        let children = node.children.as_deref().unwrap_or_default();
        pending.extend(children.iter().rev().map(|&child| (child, world_from_node)));
    }
    walk.warn();
    Ok(walk.placed)
}

fn roots(document: &Document) -> Result<Vec<json::Index<json::Node>>, String> {
    let root = &document.root;
    if let Some(scene) = root.scene {
        return Ok(document.get(&root.scenes, "scenes", scene)?.nodes.clone());
    }
    if let Some(scene) = root.scenes.first() {
        return Ok(scene.nodes.clone());
    }
    let mut has_parent = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        document.get(&root.nodes, "nodes", *child)?;
        has_parent[child.value()] = true;
    }
    let orphans = (0..root.nodes.len()).filter(|&i| !has_parent[i]);
    Ok(orphans.map(|i| json::Index::new(i as u32)).collect())
}

struct Walk<'a> {
    document: &'a Document,
    placed: Placed,
    flat: u32,
    skinned: u32,
    other_lights: u32,
}

impl Walk<'_> {
    fn visit(&mut self, node: &json::Node, world_from_node: DMat4) -> Result<(), String> {
        let world_from_object = world_from_node;
        if !world_from_object.as_mat4().is_finite() {
            return Err("has a transform that is not finite".into());
        }
        self.skinned += u32::from(node.skin.is_some());
        if let Some(mesh) = node.mesh {
            self.document.get(&self.document.root.meshes, "meshes", mesh)?;
            if DAffine3::from_mat4(world_from_node).matrix3.determinant() == 0.0 {
                self.flat += 1;
            } else {
                self.placed.meshes.push(PlacedMesh { mesh: mesh.value(), world_from_object });
            }
        }
        let light = node.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
        if let Some(light) = light {
            let lights: &[Light] = self.document.root.as_ref();
            let light = self.document.get(lights, "extensions.KHR_lights_punctual.lights", light.light)?;
            self.light(light, world_from_node.w_axis.truncate());
        }
        Ok(())
    }

    fn light(&mut self, light: &Light, position: DVec3) {
        if light.type_ != Checked::Valid(Type::Point) {
            self.other_lights += 1;
            return;
        }
        self.placed.lights.push(SceneLight {
            position: position.as_vec3(),
            color: light.color,
            intensity: light.intensity,
            range: light.range,
        });
    }

    fn warn(&self) {
        let file = self.document.path.display();
        if self.flat > 0 {
            tracing::warn!("{file}: {} nodes that are scaled to nothing are left out", self.flat);
        }
        if self.skinned > 0 {
            tracing::warn!("{file}: {} skinned nodes stand in their bind pose", self.skinned);
        }
        if self.other_lights > 0 {
            tracing::warn!("{file}: {} spot or directional lights are left out", self.other_lights);
        }
    }
}

/// A node's matrix, or translation * rotation * scale (glTF 2.0, section 3.5.3).
fn local_transform(node: &json::Node) -> Result<DMat4, String> {
    if let Some(columns) = node.matrix {
        let matrix = Mat4::from_cols_array(&columns).as_dmat4();
        let affine = matrix.row(3).abs_diff_eq(glam::DVec4::W, 1e-6);
        return if affine { Ok(matrix) } else { Err("has a matrix that is not affine".into()) };
    }
    let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let rotation = node.rotation.unwrap_or_default().0;
    let rotation: DQuat = Quat::from_array(rotation).as_dquat();
    if !(rotation.length_squared() > 0.0 && rotation.is_finite()) {
        return Err("has a rotation that is not a quaternion".into());
    }
    Ok(DMat4::from_scale_rotation_translation(
        vector(node.scale.unwrap_or([1.0; 3])),
        rotation.normalize(),
        vector(node.translation.unwrap_or_default()),
    ))
}
