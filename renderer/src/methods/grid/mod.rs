//! Methods that group fragments by the cells of a grid. They differ in four ways that do not depend on each other:
//!
//! | | |
//! | --- | --- |
//! | grouping | [`Space`]: what the cells are; [`Sharing`]: whose grid it is |
//! | groups with lists | [`crate::assign::Clusters`], of the configuration: those that hold a fragment, or all |
//! | bounds tested against lights | [`ClusterBounds`] |
//! | list store | [`ListStore`] |
//!
//! [`plan()`] makes the grids, [`capacities`] sizes their buffers, [`record()`] runs their passes, `lookup/clustered.glsl` walks
//! their lists, [`twin`] does the same on the CPU. What the assignment works with is in [`crate::assign`].

mod plan;
mod record;
mod resources;
pub mod twin;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod worked_values;

pub use plan::plan;
pub use record::{light_lists, record};
pub use resources::capacities;

use super::Sharing;
use crate::geometry::CellShape;
use std::mem::discriminant;

/// What the cells of a grid are (Gelderen sections 3.1, 4.2, 4.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Space {
    /// Perspective grid; the size of a cluster in pixels.
    Persp {
        /// Cluster side on the screen, pixels.
        pixels: f64,
    },
    /// Orthographic grid; the side of a cluster in metres.
    Ortho {
        /// Cluster side, metres.
        metres: f64,
    },
    /// Displaced perspective grid: apex moved back.
    Displ {
        /// Cluster side in pixels of the perspective grid whose average cluster volume is kept.
        pixels: f64,
        /// How far the apex moves back, metres.
        displacement: f64,
    },
    /// Tiles of the screen: a perspective grid of one slice over the whole depth.
    Tiled {
        /// Tile side, pixels.
        pixels: f64,
    },
}

impl Space {
    /// Sizes of the cells, in the order of a method's name.
    pub fn sizes(&self) -> Vec<f64> {
        match *self {
            Self::Persp { pixels } | Self::Tiled { pixels } => vec![pixels],
            Self::Ortho { metres } => vec![metres],
            Self::Displ { pixels, displacement } => vec![pixels, displacement],
        }
    }

    /// What its cells look like.
    pub fn shape(&self) -> CellShape {
        match self {
            Self::Persp { .. } | Self::Displ { .. } | Self::Tiled { .. } => CellShape::Frustum,
            Self::Ortho { .. } => CellShape::Box,
        }
    }
}

/// What of a cluster is tested against lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClusterBounds {
    /// The cell of the grid.
    Implicit,
}

/// How the lists of clusters lie in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListStore {
    /// Each behind the other, found by the sum of the lengths before.
    Offsets,
}

/// A method that groups fragments by the cells of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridMethod {
    /// Whether each view has a grid or all share one.
    pub sharing: Sharing,
    /// Space that the cells divide.
    pub space: Space,
    /// What of the clusters is tested against lights.
    pub bounds: ClusterBounds,
    /// How the lists of the clusters lie in memory.
    pub lists: ListStore,
}

impl GridMethod {
    /// The method with implicit bounds and lists by offsets.
    pub const fn new(sharing: Sharing, space: Space) -> Self {
        Self { sharing, space, bounds: ClusterBounds::Implicit, lists: ListStore::Offsets }
    }

    /// Whether the two differ in their sizes alone.
    pub fn is_like(&self, other: &Self) -> bool {
        let Self { sharing, space, bounds, lists } = *self;
        (sharing, bounds, lists) == (other.sharing, other.bounds, other.lists)
            && discriminant(&space) == discriminant(&other.space)
    }
}
