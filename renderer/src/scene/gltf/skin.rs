//! Skins at rest (glTF 2.0, section 3.7.3.3): vertices follow the joints as the scene places them.

use glam::{DMat3, DMat4, DVec3, Mat4, Vec3};
use gltf::json;

use super::super::Vertex;
use super::super::mesh::Mesh;
use super::accessor::Accessor;
use super::document::Document;

/// The joints of a skin, as they stand.
pub(super) struct Skin {
    /// What each joint does to a vertex in its bind pose; metres from `origin`.
    joints: Vec<DMat4>,
    /// World position near the joints. Vertices are kept relative to it, so that 32 bits hold them far out too.
    pub origin: Vec3,
}

/// Four joints of a vertex and their weights: one of its JOINTS_n and WEIGHTS_n.
pub(super) type Influences = [(f32, f32); 4];

impl Skin {
    /// Reads a skin; `world_from_node` gives the joints' transforms.
    pub fn read(
        document: &Document,
        index: json::Index<json::Skin>,
        world_from_node: impl Fn(json::Index<json::Node>) -> Result<DMat4, String>,
    ) -> Result<Self, String> {
        let skin = document.get(index)?;
        let joints =
            skin.joints.iter().map(|&joint| world_from_node(joint)).collect::<Result<Vec<_>, _>>()?;
        let origin = joints.first().ok_or("has no joints")?.w_axis.truncate().as_vec3();
        let from_origin = DMat4::from_translation(-origin.as_dvec3());
        let binds = inverse_binds(document, skin.inverse_bind_matrices, joints.len())?;
        let joints: Vec<_> =
            joints.iter().zip(binds).map(|(joint, bind)| from_origin * *joint * bind).collect();
        match joints.iter().position(|joint| !joint.is_finite()) {
            Some(joint) => Err(format!("has a joint {joint} whose transform is not finite")),
            None => Ok(Self { joints, origin }),
        }
    }

    /// Moves the vertices of a mesh with their joints. `influences` has one list a set, each by vertex.
    pub fn deform(&self, mesh: &mut Mesh, influences: &[Vec<Influences>]) -> Result<(), String> {
        let mut mirrored = vec![false; mesh.vertices.len()];
        for (i, vertex) in mesh.vertices.iter_mut().enumerate() {
            let of_vertex = influences.iter().flat_map(|set| set[i]);
            let blended = self.blended(of_vertex).map_err(|message| format!("vertex {i} {message}"))?;
            mirrored[i] = move_vertex(vertex, blended);
        }
        for triangle in mesh.indices.as_chunks_mut::<3>().0 {
            if triangle.iter().filter(|&&corner| mirrored[corner as usize]).count() > 1 {
                triangle.swap(1, 2);
            }
        }
        Ok(())
    }

    /// The mean of joints by weight; a vertex that has no weights follows the first joint.
    fn blended(&self, influences: impl Iterator<Item = (f32, f32)>) -> Result<DMat4, String> {
        let (mut sum, mut total) = (DMat4::ZERO, 0.0);
        for (joint, weight) in influences.filter(|&(_, weight)| weight > 0.0 && weight.is_finite()) {
            let transform = self.joints.get(joint as usize);
            let transform =
                transform.ok_or_else(|| format!("follows joint {joint} of {}", self.joints.len()))?;
            sum += *transform * f64::from(weight);
            total += f64::from(weight);
        }
        Ok(if total > 0.0 { sum * (1.0 / total) } else { self.joints[0] })
    }
}

/// Moves position, normal and tangent; true where handedness changes.
fn move_vertex(vertex: &mut Vertex, transform: DMat4) -> bool {
    let moved = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    let linear = DMat3::from_mat4(transform);
    let mirrored = linear.determinant() < 0.0;
    let sign = if mirrored { -1.0 } else { 1.0 };
    // The cofactor matrix carries normals through any affine map.
    let cofactor = DMat3::from_cols(
        linear.y_axis.cross(linear.z_axis),
        linear.z_axis.cross(linear.x_axis),
        linear.x_axis.cross(linear.y_axis),
    );
    let [x, y, z, w] = vertex.tangent;
    vertex.position = transform.transform_point3(moved(vertex.position)).as_vec3().to_array();
    vertex.normal = unit_or_zero(sign * (cofactor * moved(vertex.normal)));
    let [x, y, z] = unit_or_zero(linear * moved([x, y, z]));
    vertex.tangent = [x, y, z, w * sign as f32];
    mirrored
}

fn unit_or_zero(v: DVec3) -> [f32; 3] {
    v.normalize_or_zero().as_vec3().to_array()
}

/// One matrix a joint: the identity where the file gives none.
fn inverse_binds(
    document: &Document,
    index: Option<json::Index<json::Accessor>>,
    joints: usize,
) -> Result<Vec<DMat4>, String> {
    let Some(index) = index else { return Ok(vec![DMat4::IDENTITY; joints]) };
    let accessor = Accessor::new(document, index)?;
    accessor.expect_lanes(16)?;
    if accessor.count < joints {
        return Err(format!("has {joints} joints and {} inverse bind matrices", accessor.count));
    }
    let mut matrices = vec![DMat4::IDENTITY; joints];
    accessor.floats(0..joints, |i, columns| matrices[i] = Mat4::from_cols_array(&columns).as_dmat4());
    Ok(matrices)
}
