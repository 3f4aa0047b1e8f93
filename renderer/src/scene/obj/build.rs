//! Groups of polygons as meshes of triangles.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::super::mesh::{Mesh, PLAIN_VERTEX};
use super::super::{TextureRef, Vertex};
use super::oddities::Kind;
use super::parse::{Corner, Face, Geometry, Group, NONE};
use super::polygon::{self, Cut, Triangle};

/// A mesh and what was odd on the way.
pub(super) struct Built {
    pub mesh: Mesh,
    /// Line, kind and description of each polygon that is not cut as it should be.
    pub odd: Vec<(usize, Kind, &'static str)>,
    /// Triangles that were turned to face as their normals do.
    pub turned: usize,
}

/// Builds the mesh of a group; tangents are made where a normal map reads them.
pub(super) fn build(
    geometry: &Geometry,
    group: &Group,
    material: u32,
    normal_map: Option<&TextureRef>,
) -> Built {
    let mesh = Mesh { vertices: Vec::new(), indices: Vec::new(), material };
    let built = Built { mesh, odd: Vec::new(), turned: 0 };
    let mut builder = Builder { geometry, built, vertex_of_corner: HashMap::new(), outline: Vec::new() };
    for face in &geometry.faces[group.faces.clone()] {
        builder.face(face);
    }
    let mut built = builder.built;
    built.mesh.normalize_normals();
    match normal_map {
        Some(normal_map) => built.mesh.generate_tangents(normal_map),
        None => built.mesh.set_any_tangents(),
    }
    built
}

struct Builder<'a> {
    geometry: &'a Geometry,
    built: Built,
    /// Vertices made so far of corners with a normal.
    vertex_of_corner: HashMap<Corner, u32>,
    /// Room for the points of a face.
    outline: Vec<DVec3>,
}

impl Builder<'_> {
    fn face(&mut self, face: &Face) {
        let corners = &self.geometry.corners[face.corners.clone()];
        let point =
            |corner: &Corner| Vec3::from(self.geometry.positions[corner.position as usize]).as_dvec3();
        self.outline.clear();
        self.outline.extend(corners.iter().map(point));
        // What is wrong with these was told where their vertices stand.
        if !self.outline.iter().all(|point| point.is_finite()) {
            return;
        }
        let triangles = match polygon::triangulate(&self.outline) {
            Cut::Whole(triangles) => triangles,
            Cut::Fan(triangles, what) => {
                self.built.odd.push((face.line, Kind::Fan, what));
                triangles
            }
            Cut::NoArea => {
                self.built.odd.push((face.line, Kind::NoArea, "a polygon without area"));
                return;
            }
        };
        for triangle in triangles {
            self.triangle(corners, triangle);
        }
    }

    fn triangle(&mut self, corners: &[Corner], mut triangle: Triangle) {
        let [a, b, c] = triangle.map(|i| self.outline[i]);
        let mut normal = (b - a).cross(c - a).normalize_or_zero();
        if self.faces_away(triangle.map(|i| corners[i]), normal) {
            triangle.swap(1, 2);
            normal = -normal;
            self.built.turned += 1;
        }
        let indices = triangle.map(|i| self.vertex(corners[i], normal));
        self.built.mesh.indices.extend(indices);
    }

    /// Whether the given normals point away from the side that the winding makes the front. They decide: exporters turn
    /// normals with a mirrored object and leave its winding.
    fn faces_away(&self, corners: [Corner; 3], normal: DVec3) -> bool {
        let given = corners.iter().filter(|corner| corner.normal != NONE);
        let given = given.map(|corner| Vec3::from(self.geometry.normals[corner.normal as usize]).as_dvec3());
        given.map(DVec3::normalize_or_zero).sum::<DVec3>().dot(normal) < 0.0
    }

    /// The place of a corner's vertex. One without a normal has that of its triangle, and is shared with no other.
    fn vertex(&mut self, corner: Corner, face_normal: DVec3) -> u32 {
        let next = self.built.mesh.vertices.len() as u32;
        if corner.normal != NONE {
            let known = *self.vertex_of_corner.entry(corner).or_insert(next);
            if known != next {
                return known;
            }
        }
        self.built.mesh.vertices.push(self.geometry.vertex(corner, face_normal));
        next
    }
}

impl Geometry {
    /// The vertex of a corner, coordinates turned to have v down the image.
    fn vertex(&self, corner: Corner, face_normal: DVec3) -> Vertex {
        let given = (corner.normal != NONE).then(|| self.normals[corner.normal as usize]);
        // A triangle without area has no normal either: as elsewhere, up stands in.
        let own = || if face_normal == DVec3::ZERO { Vec3::Y } else { face_normal.as_vec3() };
        let [u, v] =
            self.coordinates.get(corner.coordinates as usize).map_or([0.0; 2], |[u, v]| [*u, 1.0 - v]);
        Vertex {
            position: self.positions[corner.position as usize],
            normal: given.unwrap_or_else(|| own().to_array()),
            uv: [[u, v], [0.0; 2]],
            color: self.colors.get(corner.position as usize).copied().unwrap_or(PLAIN_VERTEX.color),
            ..PLAIN_VERTEX
        }
    }
}
