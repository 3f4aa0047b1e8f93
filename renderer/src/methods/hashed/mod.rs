//! Hashed shading (Tegelaers chapter 7): an octree over the lights, whatever the views, whose branches and filled leaves lie in
//! perfect spatial hashes, a pair for each depth, so that shading follows no links.
//!
//! ```text
//! lights ──reaches──> octree (host, where lights have changed) ──tables──> octree, octree_nodes, octree_offsets,
//!                                                                          octree_leaves, octree_indices
//!                     position of a sample ──branch by branch──> its leaf ──> its list (shading)
//! ```
//!
//! [`HashedMethod::settings`] says how large nodes are, [`reaches`] what the tree is built of, [`data()`] how shaders see it. The
//! engine builds it and hands its tables on; `lookup/hashed.glsl` finds the leaf of a sample, as
//! [`LinklessOctree::lights_at`](crate::octree::LinklessOctree::lights_at) does on the host.

mod data;
mod geometry;
mod way;

pub use data::{data, slack, table_sizes, told_tables};
pub use geometry::SceneGeometry;
pub use way::OctreeWay;

use super::{Method, Size, Unit};
use crate::clustering::SLACK_PER_METRE;
use crate::geometry::LightVolume;
use crate::lights::Light;
use crate::octree::OctreeSettings;
use crate::pass::Recorder;
use crate::passes::{Depth, Frame, LightLists, octree};
use crate::{Error, Result};
use glam::DVec3;

/// Deepest start: a table then has a slot for each of two million nodes.
const MOST_START_DEPTH: u32 = 7;

/// How large the smallest nodes of an octree are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NodeSize {
    /// In radii of the smallest light of the frame.
    Radii(f64),
    /// In metres.
    Metres(f64),
}

/// A method of an octree over the lights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HashedMethod {
    /// Edge of the smallest nodes.
    pub node: NodeSize,
    /// Depth at which lookups begin, a whole number; in a tree that is less deep they begin at its deepest branches.
    pub start_depth: f64,
}

impl HashedMethod {
    /// Sizes in the order of the method's name.
    pub fn sizes(&self) -> [Size; 2] {
        let node = match self.node {
            NodeSize::Radii(number) => Size { unit: Unit::Own, number },
            NodeSize::Metres(number) => Size { unit: Unit::Metres, number },
        };
        [node, Size::from(self.start_depth)]
    }

    /// Refuses a start so deep that its table would hold more than every node that there may be.
    ///
    /// # Errors
    /// A depth above 7.
    pub fn check(&self) -> Result<()> {
        if self.start_depth <= f64::from(MOST_START_DEPTH) {
            return Ok(());
        }
        Err(Error::input(format!(
            "method {}: lookups begin at depth {MOST_START_DEPTH} at most, for all nodes of that depth are kept: use a \
             smaller DEPTH",
            Method::Hashed(*self)
        )))
    }

    /// How the octree over a frame's lights is built.
    pub fn settings(&self, lights: &[Light]) -> OctreeSettings {
        let node = match self.node {
            NodeSize::Metres(metres) => metres,
            NodeSize::Radii(radii) => radii * smallest_radius(lights),
        };
        OctreeSettings::new(node, self.start_depth as u32)
    }
}

/// Radius of the smallest light, metres; 1 without any, for then nodes may have any size.
fn smallest_radius(lights: &[Light]) -> f64 {
    let radii = lights.iter().map(|light| f64::from(light.r1));
    radii.min_by(f64::total_cmp).unwrap_or(1.0)
}

/// How far the light reaches that reaches farthest, metres; 0 without any.
pub fn largest_radius(lights: &[Light]) -> f64 {
    lights.iter().map(|light| f64::from(light.r1)).fold(0.0, f64::max)
}

/// What lights reach, with `slack` metres to cover what rounding moves a fragment by; the place of a light among them is its own.
pub fn reaches(lights: &[Light], slack: f64) -> impl Iterator<Item = LightVolume> + '_ {
    let grown_by = move |reach: f64| reach * f64::from(SLACK_PER_METRE) + slack;
    lights.iter().map(move |light| match light.sector() {
        Some(sector) => LightVolume::sector(sector.grown(grown_by(sector.range)).unwrap_or(sector)),
        None => LightVolume::sphere(light.place(), f64::from(light.r1) + grown_by(light.r1.into())),
    })
}

/// The box around what all lights reach, metres; `None` without lights.
pub fn bounds(lights: &[Light]) -> Option<(DVec3, DVec3)> {
    let corners =
        reaches(lights, 0.0).map(|LightVolume { centre, radius, .. }| (centre - radius, centre + radius));
    corners.reduce(|(low, high), other| (low.min(other.0), high.max(other.1)))
}

/// Records what shading needs to find lights: the tables, where the device has not those of this frame.
pub fn record(r: &mut Recorder, frame: &Frame, depth: Depth) -> (Depth, LightLists) {
    (depth, octree::record(r, frame))
}

#[cfg(test)]
mod tests;
