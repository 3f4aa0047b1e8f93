//! Geometry on its way into a [`Scene`]: bounds and missing normals.

use glam::Vec3;

use super::{Bounds, Primitive, Scene, Vertex};

/// What a vertex has where the source says nothing.
pub(super) const PLAIN_VERTEX: Vertex =
    Vertex { position: [0.0; 3], normal: [0.0; 3], tangent: [0.0; 4], uv: [[0.0; 2]; 2], color: [255; 4] };

/// An indexed triangle list of one material.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mesh {
    pub vertices: Vec<Vertex>,
    /// Three a triangle, all below the number of vertices.
    pub indices: Vec<u32>,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

impl Mesh {
    /// The first vertex whose position is not finite.
    pub fn first_bad_position(&self) -> Option<usize> {
        self.vertices.iter().position(|v| !v.position.iter().all(|x| x.is_finite()))
    }

    /// Gives every triangle its own three vertices and its face normal, as glTF asks for where normals are
    /// missing (glTF 2.0, section 3.7.2.1).
    pub fn flatten_normals(&mut self) {
        let mut vertices = Vec::with_capacity(self.indices.len());
        for triangle in self.indices.as_chunks::<3>().0 {
            let normal = unit_or_up(self.face_normal(triangle)).to_array();
            vertices.extend(triangle.map(|i| Vertex { normal, ..self.vertices[i as usize] }));
        }
        self.vertices = vertices;
        self.indices = (0..self.vertices.len() as u32).collect();
    }

    /// Makes all normals unit vectors; one that has no direction becomes the area-weighted mean of its faces'.
    pub fn normalize_normals(&mut self) {
        let mut lost = false;
        for vertex in &mut self.vertices {
            let normal = unit(Vec3::from(vertex.normal));
            vertex.normal = normal.unwrap_or_default().to_array();
            lost |= normal.is_none();
        }
        if lost {
            self.mend_normals();
        }
    }

    fn mend_normals(&mut self) {
        let missing: Vec<bool> = self.vertices.iter().map(|v| v.normal == [0.0; 3]).collect();
        for triangle in self.indices.as_chunks::<3>().0 {
            let normal = self.face_normal(triangle);
            for &i in triangle.iter().filter(|&&i| missing[i as usize]) {
                let vertex = &mut self.vertices[i as usize];
                vertex.normal = (Vec3::from(vertex.normal) + normal).to_array();
            }
        }
        for (vertex, _) in self.vertices.iter_mut().zip(missing).filter(|(_, missing)| *missing) {
            vertex.normal = unit_or_up(Vec3::from(vertex.normal)).to_array();
        }
    }

    /// Normal of a counter-clockwise triangle, twice its area long.
    fn face_normal(&self, triangle: &[u32; 3]) -> Vec3 {
        let [a, b, c] = triangle.map(|i| Vec3::from(self.vertices[i as usize].position));
        (b - a).cross(c - a)
    }

    fn bounds(&self) -> Bounds {
        let points = self.vertices.iter().map(|v| Vec3::from(v.position));
        let (min, max) =
            points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
        Bounds { min, max }
    }
}

impl Scene {
    /// Adds a mesh as the next primitive.
    ///
    /// # Errors
    /// The scene would hold more vertices or indices than 32 bits count.
    pub(super) fn add_mesh(&mut self, mut mesh: Mesh) -> Result<(), String> {
        let too_many = |_| "has more vertices or indices than 32 bits count".to_owned();
        let end = |held: usize, more: usize| u32::try_from(held + more).map_err(too_many);
        end(self.vertices.len(), mesh.vertices.len())?;
        end(self.indices.len(), mesh.indices.len())?;
        self.primitives.push(Primitive {
            first_index: self.indices.len() as u32,
            index_count: mesh.indices.len() as u32,
            vertex_offset: self.vertices.len() as u32,
            vertex_count: mesh.vertices.len() as u32,
            material: mesh.material,
            bounds: mesh.bounds(),
        });
        self.vertices.append(&mut mesh.vertices);
        self.indices.append(&mut mesh.indices);
        Ok(())
    }
}

/// The unit vector along `v`, if `v` has a direction. In f64, so that no finite vector is too short or too long.
fn unit(v: Vec3) -> Option<Vec3> {
    v.as_dvec3().try_normalize().map(|n| n.as_vec3()).filter(|n| n.is_finite())
}

fn unit_or_up(v: Vec3) -> Vec3 {
    unit(v).unwrap_or(Vec3::Y)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A quad in the z = 0 plane facing +z, from (0, 0) to (1, 1), texture the right way up.
    pub fn quad() -> Mesh {
        let corner = |x: f32, y: f32| Vertex {
            position: [x, y, 0.0],
            normal: [0.0, 0.0, 1.0],
            uv: [[x, 1.0 - y]; 2],
            ..PLAIN_VERTEX
        };
        Mesh {
            vertices: vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
            indices: vec![0, 1, 2, 0, 2, 3],
            material: 0,
        }
    }

    #[test]
    fn flat_normals_unshare_vertices() {
        let mut mesh = quad();
        mesh.vertices[2].position[2] = 1.0;
        mesh.vertices[3].position[2] = 0.0;
        mesh.flatten_normals();
        assert_eq!(mesh.indices, [0, 1, 2, 3, 4, 5]);
        let first = Vec3::new(0.0, -1.0, 1.0).normalize();
        let second = Vec3::new(-1.0, 0.0, 1.0).normalize();
        for (i, vertex) in mesh.vertices.iter().enumerate() {
            let expected = if i < 3 { first } else { second };
            assert!(Vec3::from(vertex.normal).abs_diff_eq(expected, 1e-6), "{i}: {:?}", vertex.normal);
        }
    }

    #[test]
    fn lost_normals_come_from_the_faces() {
        let mut mesh = quad();
        mesh.vertices[0].normal = [0.0; 3];
        mesh.vertices[1].normal = [f32::NAN, 0.0, 0.0];
        mesh.vertices[2].normal = [0.0, 3e-30, 0.0];
        mesh.vertices.push(PLAIN_VERTEX);
        mesh.normalize_normals();
        let normals: Vec<_> = mesh.vertices.iter().map(|v| v.normal).collect();
        let (z, y) = ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
        assert_eq!(normals, [z, z, y, z, y]);
    }

    #[test]
    fn degenerate_triangles_get_some_normal() {
        let mut mesh = quad();
        mesh.vertices.iter_mut().for_each(|v| v.position = [1.0; 3]);
        mesh.flatten_normals();
        assert!(mesh.vertices.iter().all(|v| v.normal == [0.0, 1.0, 0.0]));
    }

    #[test]
    fn primitives_follow_each_other() {
        let mut scene = Scene::empty("two".into());
        scene.add_mesh(quad()).unwrap();
        scene.add_mesh(quad()).unwrap();
        let second = &scene.primitives[1];
        assert_eq!((second.first_index, second.index_count), (6, 6));
        assert_eq!((second.vertex_offset, second.vertex_count), (4, 4));
        assert_eq!(second.bounds, Bounds { min: Vec3::ZERO, max: Vec3::new(1.0, 1.0, 0.0) });
    }
}
