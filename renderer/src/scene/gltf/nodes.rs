//! The node hierarchy of the default scene, flattened.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use glam::{DMat4, DQuat, DVec3, Mat3, Mat4, Quat, Vec3};
use gltf::json;
use json::extensions::scene::khr_lights_punctual::{Light, Type};
use json::validation::Checked;
use serde::Deserialize;
use serde_json::Value;

use super::super::SceneLight;
use super::document::Document;
use super::instancing;
use super::left_out::LeftOut;
use super::skin::Skin;
use crate::Result;
use crate::lights::Spot;
use std::f32::consts::FRAC_PI_4;

/// Most meshes at nodes; more are refused: a small file can ask for any number of them.
pub(super) const MAX_PLACED: usize = 1 << 22;

type Node = json::Index<json::Node>;

/// What the default scene places in the world.
pub(super) struct Placed {
    /// What is built once; without repetition.
    pub shapes: Vec<Shape>,
    /// Placed meshes in the order of a depth-first walk.
    pub meshes: Vec<PlacedMesh>,
    /// Skins of shapes, by place in the document.
    pub skins: BTreeMap<usize, Skin>,
    /// Point and spot lights of the scene.
    pub lights: Vec<SceneLight>,
}

/// A mesh as it stands: its morph targets weighted, and skinned.
pub(super) struct Shape {
    pub mesh: json::Index<json::Mesh>,
    /// Weights by morph target; targets beyond weigh nothing.
    pub weights: Vec<f32>,
    /// Index of the skin in the document.
    pub skin: Option<usize>,
}

/// A shape at a node.
pub(super) struct PlacedMesh {
    /// Index into [`Placed::shapes`].
    pub shape: usize,
    pub world_from_object: DMat4,
}

/// Walks the default scene: the one the file names, else its first, else all nodes without a parent.
pub(super) fn place(document: &Document, left_out: &mut LeftOut) -> Result<Placed> {
    let nothing =
        Placed { shapes: Vec::new(), meshes: Vec::new(), skins: BTreeMap::new(), lights: Vec::new() };
    let mut walk = Walk { document, left_out, placed: nothing, shape_of: BTreeMap::new() };
    let roots = roots(document).map_err(|message| document.error(message))?;
    let mut world_from_node = vec![None; document.count::<json::Node>()];
    let mut pending: Vec<_> = roots.into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    while let Some((index, world_from_parent)) = pending.pop() {
        let fail = |message: String| document.error(format!("nodes[{}] {message}", index.value()));
        let node = document.get(index).map_err(|m| document.error(format!("the scene {m}")))?;
        let world = world_from_parent * local_transform(&node).map_err(fail)?;
        if world_from_node[index.value()].replace(world).is_some() {
            return Err(fail("has two parents, or is its own ancestor".into()));
        }
        if !is_visible(&node) {
            continue;
        }
        walk.visit(&node, world).map_err(fail)?;
        let children = node.children.as_deref().unwrap_or_default();
        pending.extend(children.iter().rev().map(|&child| (child, world)));
    }
    let mut placed = walk.placed;
    placed.pose(document, &world_from_node).map_err(|message| document.error(message))?;
    Ok(placed)
}

impl Placed {
    /// Reads the skins of what was placed, and places it where they stand.
    fn pose(&mut self, document: &Document, world_from_node: &[Option<DMat4>]) -> Result<(), String> {
        let world = |node: Node| match world_from_node.get(node.value()) {
            Some(Some(world)) => Ok(*world),
            _ => world_outside_scene(document, node),
        };
        for skin in self.shapes.iter().filter_map(|shape| shape.skin) {
            if let Entry::Vacant(place) = self.skins.entry(skin) {
                let posed = Skin::read(document, json::Index::new(skin as u32), world);
                place.insert(posed.map_err(|message| format!("skins[{skin}] {message}"))?);
            }
        }
        for placed in &mut self.meshes {
            if let Some(skin) = self.shapes[placed.shape].skin {
                placed.world_from_object = DMat4::from_translation(self.skins[&skin].origin.as_dvec3());
            }
        }
        Ok(())
    }
}

/// The transform of a joint that the scene does not hold, through its parents.
fn world_outside_scene(document: &Document, node: Node) -> Result<DMat4, String> {
    let parents = parents(document)?;
    let mut world = local_transform(&document.get(node)?)?;
    let mut at = node.value();
    for _ in 0..parents.len() {
        let Some(parent) = parents[at] else { return Ok(world) };
        world = local_transform(&document.get(parent)?)? * world;
        at = parent.value();
    }
    Err(format!("has the joint nodes[{}], which is its own ancestor", node.value()))
}

/// The parent of every node that has one.
fn parents(document: &Document) -> Result<Vec<Option<Node>>, String> {
    let count = document.count::<json::Node>();
    let mut parents = vec![None; count];
    for parent in (0..count as u32).map(Node::new) {
        for child in node_list(document.value(parent)?.get("children"))? {
            document.value(child)?;
            parents[child.value()] = Some(parent);
        }
    }
    Ok(parents)
}

fn roots(document: &Document) -> Result<Vec<Node>, String> {
    let scenes = document.field("scenes").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let index = document.field("scene").filter(|scene| !scene.is_null());
    let scene = match index.map(|index| (index, index.as_u64().and_then(|i| scenes.get(i as usize)))) {
        Some((index, None)) => {
            return Err(format!("refers to scenes[{index}], which is not there ({} are)", scenes.len()));
        }
        Some((_, found)) => found,
        None => scenes.first(),
    };
    match scene {
        Some(scene) => node_list(scene.get("nodes")),
        None => {
            let parents = parents(document)?;
            Ok((0..parents.len()).filter(|&i| parents[i].is_none()).map(|i| Node::new(i as u32)).collect())
        }
    }
}

/// Nodes by place; none where the field is not there.
fn node_list(field: Option<&Value>) -> Result<Vec<Node>, String> {
    let list = field.filter(|list| !list.is_null()).map(Vec::<Node>::deserialize).transpose();
    Ok(list.map_err(|e| format!("has a list of nodes that is not valid: {e}"))?.unwrap_or_default())
}

/// KHR_node_visibility hides a node with all below it.
fn is_visible(node: &json::Node) -> bool {
    let others = node.extensions.as_ref().map(|e| &e.others);
    let visibility = others.and_then(|others| others.get("KHR_node_visibility"));
    visibility.and_then(|visibility| visibility.get("visible")) != Some(&Value::Bool(false))
}

struct Walk<'a> {
    document: &'a Document,
    left_out: &'a mut LeftOut,
    placed: Placed,
    /// By mesh, skin and the bits of the weights.
    shape_of: BTreeMap<(usize, Option<usize>, Vec<u32>), usize>,
}

impl Walk<'_> {
    fn visit(&mut self, node: &json::Node, world_from_node: DMat4) -> Result<(), String> {
        if !world_from_node.as_mat4().is_finite() {
            return Err("has a transform that is not finite".into());
        }
        if let Some(mesh) = node.mesh {
            let shape = self.shape(node, mesh)?;
            self.place_mesh(node, shape, world_from_node)?;
        }
        let light = node.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
        if let Some(light) = light {
            let light = self.document.get(light.light)?;
            self.light(&light, world_from_node);
        }
        Ok(())
    }

    fn shape(&mut self, node: &json::Node, mesh: json::Index<json::Mesh>) -> Result<usize, String> {
        let weights = match &node.weights {
            Some(weights) => weights.clone(),
            None => mesh_weights(self.document.value(mesh)?)?,
        };
        let skin = node.skin.map(|skin| skin.value());
        let bits = weights.iter().map(|weight| weight.to_bits()).collect();
        let shapes = &mut self.placed.shapes;
        Ok(*self.shape_of.entry((mesh.value(), skin, bits)).or_insert_with(|| {
            shapes.push(Shape { mesh, weights, skin });
            shapes.len() - 1
        }))
    }

    /// Places a shape once, or at each of the node's instances. A skin places its mesh alone (glTF 2.0, section
    /// 3.7.3.3).
    fn place_mesh(&mut self, node: &json::Node, shape: usize, world_from_node: DMat4) -> Result<(), String> {
        let instances = instancing::instances(self.document, node)?;
        if node.skin.is_some() {
            let kind = "skinned nodes with instances (EXT_mesh_gpu_instancing), drawn once";
            self.left_out.add(kind, u64::from(instances.is_some()));
            return self.push(PlacedMesh { shape, world_from_object: DMat4::IDENTITY });
        }
        for node_from_instance in instances.unwrap_or_else(|| vec![DMat4::IDENTITY]) {
            let world_from_object = world_from_node * node_from_instance;
            if !world_from_object.as_mat4().is_finite() {
                return Err("has an instance whose transform is not finite".into());
            }
            if has_extent(world_from_object.as_mat4()) {
                self.push(PlacedMesh { shape, world_from_object })?;
            } else {
                self.left_out.add("nodes scaled to nothing and left out", 1);
            }
        }
        Ok(())
    }

    fn push(&mut self, placed: PlacedMesh) -> Result<(), String> {
        if self.placed.meshes.len() == MAX_PLACED {
            return Err(format!("brings the meshes placed in the scene to more than {MAX_PLACED}"));
        }
        self.placed.meshes.push(placed);
        Ok(())
    }

    fn light(&mut self, light: &Light, world_from_node: DMat4) {
        let spot = match light.type_ {
            Checked::Valid(Type::Point) => None,
            Checked::Valid(Type::Spot) => Some(cone(light, world_from_node)),
            // They reach everything, so that no list would leave any out.
            _ => return self.left_out.add("directional lights left out", 1),
        };
        let found = SceneLight {
            position: world_from_node.w_axis.truncate().as_vec3(),
            spot,
            color: light.color,
            intensity: light.intensity,
            range: light.range,
        };
        if found.is_finite() {
            self.placed.lights.push(found);
        } else {
            self.left_out.add("lights with a number that is not finite, left out", 1);
        }
    }
}

/// The cone of a spot light, which shines along its node's -Z.
fn cone(light: &Light, world_from_node: DMat4) -> Spot {
    let [inner, outer] = match &light.spot {
        Some(spot) => [spot.inner_cone_angle, spot.outer_cone_angle],
        None => [0.0, FRAC_PI_4],
    };
    Spot::new((-world_from_node.z_axis.truncate()).normalize_or_zero().as_vec3().to_array(), inner, outer)
}

fn mesh_weights(mesh: &Value) -> Result<Vec<f32>, String> {
    let weights = mesh.get("weights").filter(|weights| !weights.is_null()).map(Vec::<f32>::deserialize);
    let weights = weights.transpose().map_err(|e| format!("has a mesh whose weights are not valid: {e}"))?;
    Ok(weights.unwrap_or_default())
}

/// Whether something can be left of a surface: scaled to nothing along one axis it is flat, along two it is gone.
/// What is so small that its normals vanish is gone too.
fn has_extent(world_from_object: Mat4) -> bool {
    let Mat3 { x_axis, y_axis, z_axis } = Mat3::from_mat4(world_from_object);
    let normals = [y_axis.cross(z_axis), z_axis.cross(x_axis), x_axis.cross(y_axis)];
    normals.iter().any(|normal: &Vec3| normal.length_squared() >= f32::MIN_POSITIVE)
}

/// A node's matrix, or translation * rotation * scale (glTF 2.0, section 3.5.3).
fn local_transform(node: &json::Node) -> Result<DMat4, String> {
    if let Some(columns) = node.matrix {
        let matrix = Mat4::from_cols_array(&columns).as_dmat4();
        let affine = matrix.row(3).abs_diff_eq(glam::DVec4::W, 1e-6);
        return if affine { Ok(matrix) } else { Err("has a matrix that is not affine".into()) };
    }
    let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let scale = vector(node.scale.unwrap_or([1.0; 3]));
    let rotation = unit_rotation(node.rotation.unwrap_or_default().0)?;
    Ok(DMat4::from_scale_rotation_translation(scale, rotation, vector(node.translation.unwrap_or_default())))
}

/// A quaternion of any length, normalised.
pub(super) fn unit_rotation(xyzw: [f32; 4]) -> Result<DQuat, String> {
    let rotation = Quat::from_array(xyzw).as_dquat();
    if rotation.length_squared() > 0.0 && rotation.is_finite() {
        return Ok(rotation.normalize());
    }
    Err("has a rotation that is not a quaternion".into())
}
