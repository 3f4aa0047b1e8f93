//! What a spot light reaches among the octree's cells: which cells its sector meets, exactly.
//!
//! A node has a cell that the sector meets where the node itself meets it. Both are convex: so are the centres of all cubes
//! of a cell's size that the sector meets, and a node has none that it does not meet where it meets the eight in its corners.

use super::ball::Coverage;
use super::frame::OctreeFrame;
use crate::geometry::{Hexahedron, OrientedBox, SphericalSector};
use glam::{DVec3, UVec3};

/// A sector in deepest cells from the octree's origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sector(SphericalSector);

impl Sector {
    /// Of a sector in world space (metres), which reaches `slack` cells farther.
    pub fn new(sector: &SphericalSector, frame: &OctreeFrame, slack: f64) -> Self {
        let (apex, range) = (frame.in_cells(sector.apex), sector.range / frame.node + slack);
        Self(SphericalSector { apex, range, ..*sector })
    }

    /// What it meets of the node whose lowest deepest cell is `low`, with `edge` of them along an axis.
    pub fn coverage(&self, low: UVec3, edge: u32) -> Coverage {
        if !self.meets(low, edge) {
            return Coverage::None;
        }
        let corner = |corner: u32| low + UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2) * (edge - 1);
        match edge == 1 || (0..8).all(|at| self.meets(corner(at), 1)) {
            true => Coverage::All,
            false => Coverage::Some,
        }
    }

    /// Whether it meets a cube of cells.
    fn meets(&self, low: UVec3, edge: u32) -> bool {
        let half = f64::from(edge) / 2.0;
        let center = low.as_dvec3() + half;
        let away = self.0.distance(center);
        // The cube holds one ball and lies in another: what they tell takes a fraction of the exact test.
        if away <= half || away > half * 3f64.sqrt() {
            return away <= half;
        }
        let beside = ((self.0.apex - center).abs() - half).max(DVec3::ZERO);
        if beside.length_squared() > self.0.range * self.0.range {
            return false;
        }
        let cube = OrientedBox { center, half_extent: DVec3::splat(half), axes: DVec3::AXES };
        Hexahedron::of_box(&cube).meets(&self.0)
    }
}
