//! Tangents for normal maps.
//!
//! Where a file gives none, bevy_mikktspace makes them as MikkTSpace does (Mikkelsen, *Simulation of Wrinkled Surfaces
//! Revisited*, 2008), which glTF 2.0 section 3.7.2.1 asks for.

use bevy_mikktspace::TangentSpace;
use glam::{Vec2, Vec3};

use super::mesh::Mesh;
use super::{TextureRef, Vertex};

impl Mesh {
    /// Gives every vertex a tangent that is orthonormal to its normal: enough where no normal map is read.
    pub fn set_any_tangents(&mut self) {
        for vertex in &mut self.vertices {
            vertex.tangent = any_tangent(vertex.normal);
        }
    }

    /// Makes given tangents orthonormal to the normals, and their signs 1 or -1; those without direction
    /// become any.
    pub fn mend_tangents(&mut self) {
        for vertex in &mut self.vertices {
            vertex.tangent = orthonormal(Some(vertex.tangent), vertex.normal);
        }
    }

    /// Generates tangents from the coordinates that `normal_map` reads, its texture transform applied. Vertices whose
    /// corners disagree (mirrored coordinates, faces that meet in a vertex alone) are split.
    pub fn generate_tangents(&mut self, normal_map: &TextureRef) {
        let uvs = transformed_uvs(&self.vertices, normal_map);
        let mut corners = Corners { mesh: self, uvs, tangents: vec![None; self.indices.len()] };
        let made = bevy_mikktspace::generate_tangents(&mut corners);
        let tangents = if made.is_ok() { corners.tangents } else { vec![None; self.indices.len()] };
        self.give_tangents(&tangents);
    }

    /// Gives each corner its tangent; a vertex of several is copied.
    fn give_tangents(&mut self, tangents: &[Option<[f32; 4]>]) {
        // Of each vertex the copy made last, and of that the one made before it.
        let mut copies: Vec<Option<u32>> = vec![None; self.vertices.len()];
        let mut given = vec![false; self.vertices.len()];
        for (index, &tangent) in self.indices.iter_mut().zip(tangents) {
            let vertex = *index as usize;
            let tangent = orthonormal(tangent, self.vertices[vertex].normal);
            let known = std::iter::successors(Some(*index), |&copy| copies[copy as usize])
                .find(|&copy| !given[copy as usize] || self.vertices[copy as usize].tangent == tangent);
            *index = known.unwrap_or_else(|| {
                let copy = self.vertices.len() as u32;
                self.vertices.push(self.vertices[vertex]);
                given.push(true);
                let earlier = copies[vertex].replace(copy);
                copies.push(earlier);
                copy
            });
            given[*index as usize] = true;
            self.vertices[*index as usize].tangent = tangent;
        }
        for (vertex, _) in self.vertices.iter_mut().zip(given).filter(|(_, given)| !given) {
            vertex.tangent = any_tangent(vertex.normal);
        }
    }
}

/// A mesh as the tangent generator asks for it.
struct Corners<'a> {
    mesh: &'a Mesh,
    uvs: Vec<Vec2>,
    /// By corner; `None` where no face with an area says anything.
    tangents: Vec<Option<[f32; 4]>>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.indices[3 * face + corner] as usize
    }
}

impl bevy_mikktspace::Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.vertices[self.vertex(face, corner)].position
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.vertices[self.vertex(face, corner)].normal
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs[self.vertex(face, corner)].to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        // The bitangent of glTF points up the image, and v down it.
        let encoded = space.map(|space| space.tangent_encoded()).map(|[x, y, z, sign]| [x, y, z, -sign]);
        self.tangents[3 * face + corner] = encoded;
    }
}

fn transformed_uvs(vertices: &[Vertex], texture: &TextureRef) -> Vec<Vec2> {
    let rows = texture.uv_transform.map(Vec3::from);
    let uv = |vertex: &Vertex| {
        let uv = Vec2::from(vertex.uv[texture.uv_set as usize]).extend(1.0);
        Vec2::from(rows.map(|row| row.dot(uv)))
    };
    vertices.iter().map(uv).collect()
}

/// `tangent` across a normal, with a sign of 1 or -1; any where it has no direction there.
fn orthonormal(tangent: Option<[f32; 4]>, normal: [f32; 3]) -> [f32; 4] {
    tangent
        .and_then(|[x, y, z, sign]| {
            let sign = if sign < 0.0 { -1.0 } else { 1.0 };
            across(Vec3::new(x, y, z), normal).map(|tangent| tangent.extend(sign).to_array())
        })
        .unwrap_or_else(|| any_tangent(normal))
}

fn any_tangent(normal: [f32; 3]) -> [f32; 4] {
    Vec3::from(normal).any_orthonormal_vector().extend(1.0).to_array()
}

/// The unit vector along the part of `tangent` across a normal, unless what is left is mostly rounding.
fn across(tangent: Vec3, normal: [f32; 3]) -> Option<Vec3> {
    let across = tangent.try_normalize()?.reject_from_normalized(Vec3::from(normal));
    across.try_normalize().filter(|_| across.length_squared() > 1e-6)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::mesh::{PLAIN_VERTEX, tests::quad};
    use super::super::{Sampler, Wrap};
    use super::*;

    fn reading(uv_transform: [[f32; 3]; 2]) -> TextureRef {
        let sampler = Sampler { wrap: [Wrap::Repeat; 2], nearest: false };
        TextureRef { image: 0, sampler, uv_set: 0, uv_transform }
    }

    #[test]
    fn upright_texture_has_tangent_x_and_positive_sign() {
        let mut mesh = quad();
        mesh.generate_tangents(&reading(TextureRef::IDENTITY));
        assert_eq!(mesh.vertices.len(), 4);
        for vertex in &mesh.vertices {
            assert_eq!(vertex.tangent, [1.0, 0.0, 0.0, 1.0]);
        }
    }

    #[test]
    fn texture_transform_turns_the_tangent() {
        let mut mesh = quad();
        // u grows up the image (down v) and v along u: the picture is turned by a quarter.
        mesh.generate_tangents(&reading([[0.0, -1.0, 1.0], [1.0, 0.0, 0.0]]));
        for vertex in &mesh.vertices {
            assert_eq!(vertex.tangent, [0.0, 1.0, 0.0, 1.0]);
        }
    }

    #[test]
    fn mirrored_seam_splits_its_vertices() {
        let mut mesh = quad();
        let far = |y: f32| Vertex { position: [2.0, y, 0.0], uv: [[0.0, 1.0 - y]; 2], ..mesh.vertices[0] };
        let [low, high] = [far(0.0), far(1.0)];
        mesh.vertices.extend([low, high]);
        mesh.indices.extend([1, 4, 5, 1, 5, 2]);
        mesh.generate_tangents(&reading(TextureRef::IDENTITY));
        assert_eq!(mesh.vertices.len(), 8, "two seam vertices doubled");
        for (corner, &index) in mesh.indices.iter().enumerate() {
            let expected = if corner < 6 { [1.0, 0.0, 0.0, 1.0] } else { [-1.0, 0.0, 0.0, -1.0] };
            assert_eq!(mesh.vertices[index as usize].tangent, expected, "corner {corner}");
        }
    }

    #[test]
    fn fans_of_large_meshes_have_one_tangent() {
        let count = 2500_u32;
        let rim = |i: u32| {
            let (y, x) = (i as f32 / count as f32 * 6.0).sin_cos();
            Vertex { position: [x, y, 0.0], normal: [0.0, 0.0, 1.0], uv: [[x, -y]; 2], ..PLAIN_VERTEX }
        };
        let hub = Vertex { normal: [0.0, 0.0, 1.0], ..PLAIN_VERTEX };
        let vertices = std::iter::once(hub).chain((0..=count).map(rim)).collect();
        let indices = (1..=count).flat_map(|i| [0, i, i + 1]).collect();
        let mut mesh = Mesh { vertices, indices, material: 0 };
        mesh.generate_tangents(&reading(TextureRef::IDENTITY));
        assert!(Vec3::from_slice(&mesh.vertices[0].tangent).abs_diff_eq(Vec3::X, 1e-3));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Whatever the geometry, degenerate or folded: every vertex ends with a unit tangent across its normal.
        #[test]
        fn tangents_are_orthonormal(
            points in prop::collection::vec((0..3i8, 0..3i8, 0..3i8, 0..3i8, 0..3i8), 3..20),
            corners in prop::collection::vec(0..1000usize, 3..60),
        ) {
            let vertices: Vec<_> = points.iter().map(|&(x, y, z, u, v)| Vertex {
                position: [x, y, z].map(f32::from),
                normal: [f32::from(z), f32::from(x) - 1.0, f32::from(y)],
                uv: [[u, v].map(f32::from); 2],
                ..PLAIN_VERTEX
            }).collect();
            let whole = corners.len() / 3 * 3;
            let indices = corners[..whole].iter().map(|c| (c % vertices.len()) as u32).collect();
            let mut mesh = Mesh { vertices, indices, material: 0 };
            mesh.normalize_normals();
            let before = mesh.clone();
            mesh.generate_tangents(&reading(TextureRef::IDENTITY));
            for vertex in &mesh.vertices {
                let (n, t) = (Vec3::from(vertex.normal), Vec3::from_slice(&vertex.tangent));
                prop_assert!((t.length() - 1.0).abs() < 1e-4 && n.dot(t).abs() < 1e-3, "{vertex:?}");
                prop_assert!(vertex.tangent[3].abs() == 1.0);
            }
            for (&old, &new) in before.indices.iter().zip(&mesh.indices) {
                let (old, new) = (before.vertices[old as usize], mesh.vertices[new as usize]);
                prop_assert_eq!(Vertex { tangent: old.tangent, ..new }, old);
            }
        }
    }
}
