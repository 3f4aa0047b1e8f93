//! What a light reaches among the octree's cells: which cells its ball meets, or of a spot light the sector within.
//!
//! Lengths are in deepest cells, so that the faces of all cells are whole numbers, without rounding. How far a cell lies
//! from the centre grows, axis by axis, with the way from the centre's own cell, rounded or not. So a node has a cell
//! that the ball meets where its nearest meets it, and has none that it does not meet where its farthest does: the
//! answers for nodes are exactly those for their cells. So are those of [`Sector`]s, but for rounding.

use super::frame::OctreeFrame;
use super::sector::Sector;
use crate::geometry::LightVolume;
use glam::{DVec3, UVec3};

/// How much of a node's deepest cells a light meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coverage {
    /// None of them.
    None,
    /// All of them.
    All,
    /// Some.
    Some,
}

/// A ball in deepest cells from the octree's origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    centre: DVec3,
    reach: f64,
    side: u32,
    /// What of it a spot light reaches.
    sector: Option<Sector>,
}

/// Branches, and full leaves, of a large ball's octree at least, as parts of its radius squared. Of nodes of two cells along an axis
/// those are branches whose nearest cell is met and whose farthest is not: a shell as thick as a cell seen along the radius, 1.5 on
/// average, so that a sphere has 4 pi 1.5 / 8 = 2.4 of them, and nodes of four and eight cells add 1.1.
const BRANCHES: f64 = 3.0;

/// Radius, in cells, from which on balls are large.
const LARGE: f64 = 16.0;

impl Ball {
    /// How many branches its octree has at least, and how many full leaves. Nothing is told of a sector, which may be narrow.
    pub fn least_branches(&self) -> f64 {
        if self.reach < LARGE || self.sector.is_some() { 0.0 } else { BRANCHES * self.reach * self.reach }
    }

    /// The ball of a light, grown by what f64 rounds of places in the octree.
    pub fn new(light: &LightVolume, frame: &OctreeFrame) -> Self {
        let slack = f64::from(frame.side()) * 2.0_f64.powi(-50);
        let centre = frame.in_cells(light.centre);
        let sector = light.sector.map(|sector| Sector::new(&sector, frame, slack));
        Self { centre, reach: light.radius / frame.node + slack, side: frame.side(), sector }
    }

    /// First and last deepest cell of the grid around the ball.
    pub fn grid(&self) -> (UVec3, UVec3) {
        let last = f64::from(self.side - 1);
        let clamped = |at: DVec3| at.floor().clamp(DVec3::ZERO, DVec3::splat(last)).as_uvec3();
        (clamped(self.centre - self.reach), clamped(self.centre + self.reach))
    }

    /// Whether the light meets a deepest cell.
    pub fn meets(&self, cell: UVec3) -> bool {
        self.coverage(cell, 1) != Coverage::None
    }

    /// What the light meets of the node whose lowest deepest cell is `low`, with `edge` of them along an axis.
    pub fn coverage(&self, low: UVec3, edge: u32) -> Coverage {
        if let Some(sector) = &self.sector {
            return sector.coverage(low, edge);
        }
        let low = low.as_dvec3();
        let high = low + f64::from(edge);
        let far = distance(self.centre, low, low + 1.0).max(distance(self.centre, high - 1.0, high));
        if self.reaches(far) {
            Coverage::All
        } else if self.reaches(distance(self.centre, low, high)) {
            Coverage::Some
        } else {
            Coverage::None
        }
    }

    fn reaches(&self, distance: DVec3) -> bool {
        distance.length_squared() <= self.reach * self.reach
    }
}

/// How far a point lies from a box, axis by axis.
fn distance(point: DVec3, low: DVec3, high: DVec3) -> DVec3 {
    (low - point).max(point - high).max(DVec3::ZERO)
}
