//! Meshes that hold what lights reach (Örtegren and Persson section 4.2; here they lie around their lights, so that none is lost).
//!
//! A mesh is a template of four coordinates a vertex. A frame, which each light has, takes them to space: one vertex shader
//! serves all meshes.
//!
//! ```text
//! MeshKind (a SphereLevel, or spots) ─ LightMesh::new ─> template (x, y, z, t) ──────┐
//! LightVolume ─ MeshFrame::of ─────────────────────────> frame (origin, X, Y, Z, T) ─┴─> origin + x X + y Y + z Z + t T
//! ```

use super::{LightVolume, SphericalSector};
use glam::{DVec3, DVec4};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_8, TAU};
use std::fmt;

/// Vertices of the ring of a spot light's mesh.
const RING: u16 = 8;

/// How fine the mesh around a sphere is: an icosahedron whose triangles are divided in four, some times over. Its name is the number of
/// its vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SphereLevel {
    /// 12 vertices: undivided.
    V12,
    /// 42 vertices: the paper's.
    V42,
    /// 162 vertices.
    V162,
    /// 642 vertices.
    V642,
}

impl SphereLevel {
    /// Every level, the coarsest first.
    pub const ALL: [Self; 4] = [Self::V12, Self::V42, Self::V162, Self::V642];

    /// How often the triangles are divided.
    pub const fn divisions(self) -> u32 {
        self as u32
    }

    /// Number of vertices.
    pub const fn vertices(self) -> u32 {
        10 * 4u32.pow(self.divisions()) + 2
    }

    /// Number of triangles.
    pub const fn triangles(self) -> u32 {
        20 * 4u32.pow(self.divisions())
    }

    /// How far from the centre the vertices lie, in radii of the sphere that the mesh holds.
    pub const fn circumradius(self) -> f64 {
        match self {
            Self::V12 => 1.258_408_572_364_819,
            Self::V42 => 1.070_466_269_319_27,
            Self::V162 => 1.018_073_920_910_255,
            Self::V642 => 1.004_548_967_004_295,
        }
    }

    /// How far the vertices lie beyond the sphere that the mesh holds, in its radii.
    pub const fn beyond(self) -> f64 {
        self.circumradius() - 1.0
    }

    /// The coarsest level at which the mesh of a sphere reaches beyond it by `allowed` at most, as seen from `distance` metres, in
    /// tangents: a part of a tile's width, as a rule. The finest where none does.
    pub fn of_detail(radius: f64, distance: f64, allowed: f64) -> Self {
        let suffices = |level: &Self| level.beyond() * radius <= allowed * distance;
        Self::ALL.into_iter().find(suffices).unwrap_or(Self::V642)
    }
}

impl fmt::Display for SphereLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.vertices().fmt(f)
    }
}

/// Which mesh a light has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshKind {
    /// That around its bounding sphere.
    Sphere(SphereLevel),
    /// That of spot lights.
    Spot,
}

/// A convex mesh, as a template for many lights.
#[derive(Debug, Clone, PartialEq)]
pub struct LightMesh {
    /// Vertices, in coordinates of a [`MeshFrame`].
    pub vertices: Vec<DVec4>,
    /// Vertices of each triangle, anticlockwise as seen from outside.
    pub triangles: Vec<[u16; 3]>,
}

impl LightMesh {
    /// The mesh of a kind.
    pub fn new(kind: MeshKind) -> Self {
        match kind {
            MeshKind::Sphere(level) => Self::sphere(level),
            MeshKind::Spot => Self::spot(),
        }
    }

    /// The edges of the closed mesh, each once, by its vertices: one of the two triangles at each has it upwards.
    pub fn edges(&self) -> impl Iterator<Item = [u16; 2]> {
        let sides = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        sides.filter(|[from, to]| from < to)
    }

    /// The template of a mesh around the unit sphere. Every triangle lies outside.
    pub fn sphere(level: SphereLevel) -> Self {
        let (mut directions, mut triangles) = icosahedron();
        for _ in 0..level.divisions() {
            triangles = divided(&mut directions, &triangles);
        }
        let vertex = |direction: &DVec3| (*direction * level.circumradius()).extend(0.0);
        Self { vertices: directions.iter().map(vertex).collect(), triangles }
    }

    /// The template of a spot light: its apex, a ring around the rim, whose sides touch the cone, and a tip on the axis, from which the
    /// cap's triangles touch the sphere.
    pub fn spot() -> Self {
        let ring = (0..RING).map(|at| {
            let turn = TAU * f64::from(at) / f64::from(RING);
            let out = 1.0 / FRAC_PI_8.cos();
            DVec4::new(out * turn.cos(), out * turn.sin(), 1.0, 0.0)
        });
        let vertices = [DVec4::ZERO].into_iter().chain(ring).chain([DVec4::W]).collect();
        let (apex, tip) = (0, RING + 1);
        let side = |at: u16| {
            let (this, next) = (1 + at, 1 + (at + 1) % RING);
            [[apex, next, this], [tip, this, next]]
        };
        Self { vertices, triangles: (0..RING).flat_map(side).collect() }
    }
}

/// Unit directions and triangles of an icosahedron.
fn icosahedron() -> (Vec<DVec3>, Vec<[u16; 3]>) {
    // A pole, five around it, five around the other one, the other pole.
    let z = 1.0 / 5f64.sqrt();
    let across = (1.0 - z * z).sqrt();
    let around = |at: u16, half: f64, z: f64| {
        let turn = TAU * (f64::from(at) + half) / 5.0;
        DVec3::new(across * turn.cos(), across * turn.sin(), z)
    };
    let upper = (0..5).map(|at| around(at, 0.0, z));
    let lower = (0..5).map(|at| around(at, 0.5, -z));
    let directions = [DVec3::Z].into_iter().chain(upper).chain(lower).chain([-DVec3::Z]).collect();
    let sector = |at: u16| {
        let (upper, lower) = ([1 + at, 1 + (at + 1) % 5], [6 + at, 6 + (at + 1) % 5]);
        [
            [0, upper[0], upper[1]],
            [upper[0], lower[0], upper[1]],
            [upper[1], lower[0], lower[1]],
            [11, lower[1], lower[0]],
        ]
    };
    (directions, (0..5).flat_map(sector).collect())
}

/// Each triangle in four, whose new corners are unit directions halfway along its sides.
fn divided(directions: &mut Vec<DVec3>, triangles: &[[u16; 3]]) -> Vec<[u16; 3]> {
    let mut halfway = HashMap::new();
    let mut middle = |a: u16, b: u16| {
        *halfway.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            directions.push((directions[usize::from(a)] + directions[usize::from(b)]).normalize());
            directions.len() as u16 - 1
        })
    };
    let four = |&[a, b, c]: &[u16; 3]| {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    triangles.iter().flat_map(four).collect()
}

/// Takes the template of a light's mesh to the space of its volume: a vertex (x, y, z, t) to origin + x X + y Y + z Z + t T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshFrame {
    /// Where the coordinates are all 0, metres.
    pub origin: DVec3,
    /// Along x, y and z, metres.
    pub axes: [DVec3; 3],
    /// To the tip of a spot light's mesh, metres; 0 of a sphere.
    pub tip: DVec3,
}

impl MeshFrame {
    /// The frame of a light's volume: of the mesh of spots where it is that of one, else of any around a sphere.
    pub fn of(volume: &LightVolume) -> Self {
        match &volume.sector {
            Some(sector) => Self::of_sector(sector),
            None => {
                let axes = DVec3::AXES.map(|axis| axis * volume.radius);
                Self { origin: volume.centre, axes, tip: DVec3::ZERO }
            }
        }
    }

    /// The cap's triangles touch the sphere at that angle b from the axis at which the mesh is smallest. With a the half angle, the
    /// ring lies 1/cos(a - b) ranges up the side and the tip 1/cos b up the axis, so that the volume goes with
    /// 1/(cos^2(a - b) cos b): least where 2 tan(a - b) = tan b. The paper's cap touches at the rim (b = a), which has no end for wide
    /// spots.
    pub fn of_sector(sector: &SphericalSector) -> Self {
        let SphericalSector { apex, axis, range, half_angle } = *sector;
        let (sine, cosine) = half_angle.sin_cos();
        let touch = (4.0 * sine).atan2(3.0 * cosine + (9.0 * cosine * cosine + 8.0 * sine * sine).sqrt());
        let up_the_side = range / (half_angle - touch).cos();
        let first = axis.any_orthonormal_vector();
        let second = axis.cross(first);
        let out = up_the_side * sine;
        let axes = [first * out, second * out, axis * (up_the_side * cosine)];
        Self { origin: apex, axes, tip: axis * (range / touch.cos()) }
    }

    /// Where a vertex lies, metres.
    pub fn place(&self, vertex: DVec4) -> DVec3 {
        let [x, y, z] = self.axes;
        self.origin + x * vertex.x + y * vertex.y + z * vertex.z + self.tip * vertex.w
    }
}

#[cfg(test)]
mod tests;
