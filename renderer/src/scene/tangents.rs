//! Tangents for normal maps.

use std::thread;

use glam::{Vec2, Vec3};

use super::TextureRef;
use super::mesh::Mesh;

/// Above this many triangles mikktspace gets a thread of its own.
const SMALL_MESH: usize = 2048;
/// Mikktspace walks the triangles around a vertex recursively; no frame of that walk is larger.
const STACK_BYTES_PER_TRIANGLE: usize = 512;

/// No next copy of a vertex.
const NONE: u32 = u32::MAX;

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
            let [x, y, z, sign] = vertex.tangent;
            vertex.tangent = match across(Vec3::new(x, y, z), vertex.normal) {
                Some(tangent) => tangent.extend(if sign < 0.0 { -1.0 } else { 1.0 }).to_array(),
                None => any_tangent(vertex.normal),
            };
        }
    }

    /// Generates tangents with mikktspace (Mikkelsen 2008, as glTF 2.0 section 3.7.2.1 asks) from the
    /// coordinates that `normal_map` reads, its texture transform applied. Vertices whose faces disagree
    /// (mirrored coordinates) are split.
    pub fn generate_tangents(&mut self, normal_map: &TextureRef) {
        let mut corners = Corners::new(self, normal_map);
        let recursion = corners.faces.len() * STACK_BYTES_PER_TRIANGLE;
        let done = if corners.faces.len() <= SMALL_MESH {
            mikktspace::generate_tangents(&mut corners)
        } else {
            on_large_stack(recursion, || mikktspace::generate_tangents(&mut corners))
        };
        let tangents = corners.tangents;
        self.set_any_tangents();
        if done {
            self.split_by_tangent(&tangents);
        }
    }

    /// Gives each corner its tangent, copying a vertex that needs more than one.
    fn split_by_tangent(&mut self, tangents: &[Option<[f32; 4]>]) {
        let mut given = vec![false; self.vertices.len()];
        let mut next_copy = vec![NONE; self.vertices.len()];
        for (index, tangent) in self.indices.iter_mut().zip(tangents) {
            let Some(tangent) = *tangent else { continue };
            if !std::mem::replace(&mut given[*index as usize], true) {
                self.vertices[*index as usize].tangent = tangent;
                continue;
            }
            while self.vertices[*index as usize].tangent != tangent {
                if next_copy[*index as usize] == NONE {
                    let copy = self.vertices.len() as u32;
                    self.vertices.push(super::Vertex { tangent, ..self.vertices[*index as usize] });
                    given.push(true);
                    next_copy.push(NONE);
                    next_copy[*index as usize] = copy;
                }
                *index = next_copy[*index as usize];
            }
        }
    }
}

/// Runs `work` on a thread with room for `bytes` of recursion (reserved, not touched, where not needed);
/// false also where no such thread can be had.
fn on_large_stack(bytes: usize, work: impl FnOnce() -> bool + Send) -> bool {
    const BASE: usize = 1 << 20;
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(BASE + bytes).spawn_scoped(scope, work);
        thread.is_ok_and(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

fn any_tangent(normal: [f32; 3]) -> [f32; 4] {
    Vec3::from(normal).any_orthonormal_vector().extend(1.0).to_array()
}

/// The unit vector along the part of `tangent` across a normal, unless what is left is mostly rounding.
fn across(tangent: Vec3, normal: [f32; 3]) -> Option<Vec3> {
    let across = tangent.try_normalize()?.reject_from_normalized(Vec3::from(normal));
    across.try_normalize().filter(|_| across.length_squared() > 1e-6)
}

/// The view of a mesh that mikktspace works on. Triangles without area are left out: they have no
/// tangent, and mikktspace spends quadratic time on them.
struct Corners<'a> {
    mesh: &'a Mesh,
    uv_slot: usize,
    uv_transform: [Vec3; 2],
    /// Triangles of the mesh that have three different corners.
    faces: Vec<u32>,
    /// By corner of the mesh.
    tangents: Vec<Option<[f32; 4]>>,
}

impl<'a> Corners<'a> {
    fn new(mesh: &'a Mesh, normal_map: &TextureRef) -> Self {
        let position = |i: u32| mesh.vertices[i as usize].position;
        let triangles = mesh.indices.as_chunks::<3>().0;
        let faces = (0..triangles.len() as u32)
            .filter(|&face| {
                let [a, b, c] = triangles[face as usize].map(position);
                a != b && b != c && c != a
            })
            .collect();
        Self {
            mesh,
            uv_slot: normal_map.uv_slot as usize,
            uv_transform: normal_map.uv_transform.map(Vec3::from),
            faces,
            tangents: vec![None; mesh.indices.len()],
        }
    }

    fn corner(&self, face: usize, corner: usize) -> usize {
        self.faces[face] as usize * 3 + corner
    }

    fn vertex(&self, face: usize, corner: usize) -> &super::Vertex {
        &self.mesh.vertices[self.mesh.indices[self.corner(face, corner)] as usize]
    }
}

impl mikktspace::Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.faces.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.vertex(face, corner).position
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.vertex(face, corner).normal
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let uv = Vec2::from(self.vertex(face, corner).uv[self.uv_slot]).extend(1.0);
        self.uv_transform.map(|row| row.dot(uv))
    }

    fn set_tangent_encoded(&mut self, [x, y, z, sign]: [f32; 4], face: usize, corner: usize) {
        let tangent = across(Vec3::new(x, y, z), self.vertex(face, corner).normal);
        let corner = self.corner(face, corner);
        // Mikktspace has v pointing up the image, glTF down it: the bitangent turns round.
        self.tangents[corner] = tangent.map(|t| t.extend(-sign).to_array());
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::mesh::{PLAIN_VERTEX, tests::quad};
    use super::super::{Sampler, Vertex, Wrap};
    use super::*;

    fn reading(uv_transform: [[f32; 3]; 2]) -> TextureRef {
        let sampler = Sampler { wrap: [Wrap::Repeat; 2], nearest: false };
        TextureRef { image: 0, sampler, uv_slot: 0, uv_transform }
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
