//! Tangents for normal maps.
//!
//! Where a file gives none they are made as MikkTSpace makes them (Mikkelsen, *Simulation of Wrinkled Surfaces
//! Revisited*, 2008, which glTF 2.0 section 3.7.2.1 asks for): the faces around a vertex that map the texture the same
//! way round, weighted by their angles there. Faces that meet in a vertex alone, without an edge, count as neighbours
//! too; the tests compare the rest with the bevy_mikktspace crate.

use glam::{Vec2, Vec3};

use super::mesh::Mesh;
use super::{TextureRef, Vertex};

/// No place yet.
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

    /// Generates tangents from the coordinates that `normal_map` reads, its texture transform applied. Vertices whose
    /// faces disagree (mirrored coordinates) are split.
    pub fn generate_tangents(&mut self, normal_map: &TextureRef) {
        let uvs = transformed_uvs(&self.vertices, normal_map);
        let points = weld(&self.vertices, &uvs);
        let faces: Vec<Option<Face>> =
            self.indices.as_chunks::<3>().0.iter().map(|corners| self.face(corners, &uvs)).collect();
        let mut sums = vec![[Vec3::ZERO; 2]; self.vertices.len()];
        for (corners, face) in self.indices.as_chunks::<3>().0.iter().zip(&faces) {
            let Some(face) = face else { continue };
            for turn in 0..3 {
                let corner = corners[turn] as usize;
                let share = self.share(face, [turn, turn + 1, turn + 2].map(|i| corners[i % 3] as usize));
                sums[points[corner] as usize][face.side] += share;
            }
        }
        self.give_tangents(&faces, |vertex| sums[points[vertex] as usize]);
    }

    /// What a triangle says of its tangent; `None` without an area in space or in the texture.
    fn face(&self, corners: &[u32; 3], uvs: &[Vec2]) -> Option<Face> {
        let [a, b, c] = corners.map(|i| Vec3::from(self.vertices[i as usize].position));
        let [ua, ub, uc] = corners.map(|i| uvs[i as usize]);
        let (ab, ac) = (ub - ua, uc - ua);
        let area = ab.perp_dot(ac);
        let along_u = ((b - a) * ac.y - (c - a) * ab.y) * area.signum();
        let flat = a == b || b == c || c == a || area == 0.0;
        along_u
            .try_normalize()
            .filter(|_| !flat)
            .map(|along_u| Face { along_u, side: usize::from(area > 0.0) })
    }

    /// What a face adds at its corner `at`: its tangent across the normal there, weighted by the angle.
    fn share(&self, face: &Face, [at, next, last]: [usize; 3]) -> Vec3 {
        let normal = Vec3::from(self.vertices[at].normal);
        let from = Vec3::from(self.vertices[at].position);
        let edge = |to: usize| {
            let edge = Vec3::from(self.vertices[to].position) - from;
            edge.reject_from_normalized(normal).normalize_or_zero()
        };
        let angle = edge(next).dot(edge(last)).clamp(-1.0, 1.0).acos();
        face.along_u.reject_from_normalized(normal).normalize_or_zero() * angle
    }

    /// Gives each vertex the sum of its faces' side, and copies those with faces of both.
    fn give_tangents(&mut self, faces: &[Option<Face>], sums: impl Fn(usize) -> [Vec3; 2]) {
        let tangent = |vertex: usize, side: usize, normal| {
            // The bitangent points up the image, and v down it: faces of positive area are mirrored.
            let sign = if side == 1 { -1.0 } else { 1.0 };
            across(sums(vertex)[side], normal).map(|tangent| tangent.extend(sign).to_array())
        };
        let mut placed = vec![[NONE; 2]; self.vertices.len()];
        self.set_any_tangents();
        for (corner, index) in self.indices.iter_mut().enumerate() {
            let vertex = *index as usize;
            let full = usize::from(sums(vertex)[0] == Vec3::ZERO);
            let side = faces[corner / 3].as_ref().map_or(full, |face| face.side);
            if placed[vertex][side] == NONE {
                placed[vertex][side] = *index;
                let mut copy = self.vertices[vertex];
                copy.tangent = tangent(vertex, side, copy.normal).unwrap_or(any_tangent(copy.normal));
                if placed[vertex][1 - side] == NONE {
                    self.vertices[vertex] = copy;
                } else {
                    placed[vertex][side] = self.vertices.len() as u32;
                    self.vertices.push(copy);
                }
            }
            *index = placed[vertex][side];
        }
    }
}

/// How a triangle lies in its texture.
struct Face {
    /// Unit vector along which u grows.
    along_u: Vec3,
    /// 1 where the triangle turns the same way in the texture as in space, else 0.
    side: usize,
}

fn transformed_uvs(vertices: &[Vertex], texture: &TextureRef) -> Vec<Vec2> {
    let rows = texture.uv_transform.map(Vec3::from);
    let uv = |vertex: &Vertex| {
        let uv = Vec2::from(vertex.uv[texture.uv_slot as usize]).extend(1.0);
        Vec2::from(rows.map(|row| row.dot(uv)))
    };
    vertices.iter().map(uv).collect()
}

/// For each vertex the first with the same position, normal and coordinates.
fn weld(vertices: &[Vertex], uvs: &[Vec2]) -> Vec<u32> {
    let key = |i: usize| (vertices[i].position, vertices[i].normal, uvs[i].to_array());
    let slots = (2 * vertices.len()).next_power_of_two();
    let mut table = vec![NONE; slots];
    let first_equal = |i: usize| {
        let (position, normal, uv) = key(i);
        let words = position.into_iter().chain(normal).chain(uv);
        // Adding zero makes both zeros one: they are equal.
        let hash = words.fold(0_u64, |hash, x| {
            (hash.rotate_left(5) ^ u64::from((x + 0.0).to_bits())).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        });
        let mut slot = (hash >> 32) as usize % slots;
        while table[slot] != NONE && key(table[slot] as usize) != key(i) {
            slot = (slot + 1) % slots;
        }
        if table[slot] == NONE {
            table[slot] = i as u32;
        }
        table[slot]
    };
    (0..vertices.len()).map(first_equal).collect()
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
    use bevy_mikktspace::TangentSpace;

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

    /// What the bevy_mikktspace crate makes of a mesh, by corner.
    struct Peer<'a> {
        mesh: &'a Mesh,
        tangents: Vec<[f32; 4]>,
    }

    impl Peer<'_> {
        fn vertex(&self, face: usize, corner: usize) -> &Vertex {
            &self.mesh.vertices[self.mesh.indices[3 * face + corner] as usize]
        }
    }

    impl bevy_mikktspace::Geometry for Peer<'_> {
        fn num_faces(&self) -> usize {
            self.mesh.indices.len() / 3
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
            self.vertex(face, corner).uv[0]
        }

        fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
            let [x, y, z, sign] = space.expect("every face has a tangent").tangent_encoded();
            self.tangents[3 * face + corner] = [x, y, z, -sign];
        }
    }

    /// A hilly sheet of `side` by `side` quads; its texture folds back along the middle.
    fn sheet(side: u16) -> Mesh {
        let height = |x: f32, y: f32| 0.3 * (3.0 * x).sin() * (2.0 * y).cos();
        let at = |i: u16| {
            let (x, y) = (f32::from(i % (side + 1)), f32::from(i / (side + 1)));
            let (x, y) = (x / f32::from(side), y / f32::from(side));
            let slope =
                Vec3::new(height(x + 0.01, y) - height(x, y), height(x, y + 0.01) - height(x, y), 0.01);
            let normal = Vec3::new(-slope.x, -slope.y, slope.z).normalize().to_array();
            let uv = [(x - 0.5).abs() + 0.2 * y * y, y + 0.3 * x * x];
            Vertex { position: [x, y, height(x, y)], normal, uv: [uv; 2], ..PLAIN_VERTEX }
        };
        let quad = |i: u16| {
            let (low, high) = (u32::from(i), u32::from(i + side + 1));
            [low, low + 1, high + 1, low, high + 1, high]
        };
        let quads = (0..side * (side + 1)).filter(|i| i % (side + 1) != side);
        let vertices = (0..(side + 1) * (side + 1)).map(at).collect();
        Mesh { vertices, indices: quads.flat_map(quad).collect(), material: 0 }
    }

    #[test]
    fn tangents_are_those_of_mikktspace() {
        let shared = sheet(12);
        let corners = shared.indices.iter().map(|&i| shared.vertices[i as usize]).collect();
        let indices = (0..shared.indices.len() as u32).collect();
        let unshared = Mesh { vertices: corners, indices, material: 0 };
        for mut mesh in [shared, unshared] {
            let mut peer = Peer { mesh: &mesh, tangents: vec![[0.0; 4]; mesh.indices.len()] };
            bevy_mikktspace::generate_tangents(&mut peer).unwrap();
            let expected = peer.tangents;
            mesh.generate_tangents(&reading(TextureRef::IDENTITY));
            for (corner, (&index, expected)) in mesh.indices.iter().zip(expected).enumerate() {
                let found = glam::Vec4::from(mesh.vertices[index as usize].tangent);
                let difference = (found - glam::Vec4::from(expected)).length();
                assert!(difference < 1e-4, "corner {corner}: {found} for {expected:?}");
            }
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
