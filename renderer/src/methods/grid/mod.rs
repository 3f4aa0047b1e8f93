//! Methods that group fragments by the cells of a grid. They differ in ways that do not depend on each other:
//!
//! | | | |
//! | --- | --- | --- |
//! | grouping | [`Space`]: what the cells are; [`Sharing`]: whose grid it is | the name's |
//! | depths between slices | [`SliceLaw`] | the configuration's, else the name's: geometric for most |
//! | groups with lists | [`Clusters`]: those that hold a fragment, or all | the configuration's, else the name's |
//! | bounds tested against lights | [`Bounds`] | the configuration's, else the name's |
//! | test of lights | [`SphereTest`] | the configuration's, else the name's |
//! | list store | [`ListStore`] | the configuration's |
//!
//! [`GridMethod::plan`] makes the grids, [`capacities`] sizes their buffers, [`record()`] runs their passes, `lookup/clustered.glsl` walks
//! their lists, [`twin`] does the same on the CPU. What the assignment works with is in [`crate::assign`].

mod plan;
mod record;
mod resources;
pub mod twin;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod worked_values;

pub use plan::{Division, plan};
pub use record::{compact, light_lists, record};
pub use resources::capacities;

use super::Sharing;
#[cfg(doc)]
use crate::assign::ListStore;
use crate::assign::{Assigner, Bounds, ClusterBounds, Clusters};
use crate::geometry::{CellShape, SliceLaw, SphereTest, counted_pixels};
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
    /// Tiles of the screen: those of [`Self::Sliced`] in one slice over the whole depth.
    Tiled {
        /// Tile side, pixels.
        pixels: f64,
    },
    /// Tiles of the screen, each divided into slices (Enhuber section 3.2).
    Sliced {
        /// Tile side, pixels.
        pixels: f64,
        /// How many slices there are; a whole number.
        slices: f64,
    },
    /// So many square tiles and slices, whatever the resolution (Ortiz, step 1).
    Counted {
        /// How many tiles stand side by side; a whole number.
        columns: f64,
        /// How many tiles stand one above the other, where the screen is not higher; a whole number.
        rows: f64,
        /// How many slices there are; a whole number.
        slices: f64,
    },
}

impl Space {
    /// Sizes of the cells, in the order of a method's name.
    pub fn sizes(&self) -> Vec<f64> {
        match *self {
            Self::Persp { pixels } | Self::Tiled { pixels } => vec![pixels],
            Self::Ortho { metres } => vec![metres],
            Self::Displ { pixels, displacement } => vec![pixels, displacement],
            Self::Sliced { pixels, slices } => vec![pixels, slices],
            Self::Counted { columns, rows, slices } => vec![columns, rows, slices],
        }
    }

    /// What its cells look like.
    pub const fn shape(&self) -> CellShape {
        match self {
            Self::Persp { .. } | Self::Displ { .. } | Self::Tiled { .. } | Self::Sliced { .. } => {
                CellShape::Frustum
            }
            Self::Counted { .. } => CellShape::BoxedFrustum,
            Self::Ortho { .. } => CellShape::Box,
        }
    }

    /// What is kept of a cluster where its samples are measured.
    pub fn measured_bounds(&self) -> ClusterBounds {
        match self {
            Self::Tiled { .. } => ClusterBounds::Depth,
            Self::Persp { .. }
            | Self::Displ { .. }
            | Self::Sliced { .. }
            | Self::Counted { .. }
            | Self::Ortho { .. } => ClusterBounds::Box,
        }
    }

    /// Whether a fragment's geometric slice is found from the logarithm of its depth, to which a constant is added (Ortiz), else from
    /// that of the depth over the near one.
    pub fn adds_bias(&self) -> bool {
        match self {
            Self::Counted { .. } => true,
            Self::Persp { .. }
            | Self::Displ { .. }
            | Self::Tiled { .. }
            | Self::Sliced { .. }
            | Self::Ortho { .. } => false,
        }
    }

    /// Whether a law says where slices begin: tiles have but one, and boxes stand in rows.
    pub fn has_slices(&self) -> bool {
        match self {
            Self::Persp { .. } | Self::Displ { .. } | Self::Sliced { .. } | Self::Counted { .. } => true,
            Self::Ortho { .. } | Self::Tiled { .. } => false,
        }
    }
}

/// A method that groups fragments by the cells of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridMethod {
    /// Whether each view has a grid or all share one.
    pub sharing: Sharing,
    /// Space that the cells divide.
    pub space: Space,
    /// Which clusters get lists where the configuration leaves it to the name.
    pub clusters: Clusters,
    /// What of the clusters is tested against lights where the configuration leaves it to the name.
    pub bounds: Bounds,
    /// What decides whether a light meets a cluster where the configuration leaves it to the name.
    pub test: SphereTest,
    /// Where slices begin where the configuration leaves it to the name.
    pub slices: SliceLaw,
    /// How lists are made where that is by rasterising the meshes around lights, not by testing these.
    pub rasterising: Option<Assigner>,
}

impl GridMethod {
    /// The method with lists for visible clusters, implicit bounds and geometric slices. Lights are tested as in Gelderen's thesis: by
    /// half spaces in perspective grids, by the box where cells are boxes or can be tested as such.
    pub const fn new(sharing: Sharing, space: Space) -> Self {
        let test = match space.shape() {
            CellShape::Box | CellShape::BoxedFrustum => SphereTest::Box,
            CellShape::Frustum | CellShape::Model => SphereTest::HALF_SPACES,
        };
        let (clusters, bounds) = (Clusters::Visible, Bounds::Implicit);
        Self { sharing, space, clusters, bounds, test, slices: SliceLaw::Geometric, rasterising: None }
    }

    /// Side of the tiles that a view's screen of so many pixels is divided into, where there are such.
    pub fn tile_pixels(&self, resolution: [u32; 2]) -> Option<f64> {
        match (self.sharing, self.space) {
            (Sharing::Encl, _) | (_, Space::Ortho { .. } | Space::Displ { .. }) => None,
            (
                Sharing::Indi,
                Space::Persp { pixels } | Space::Tiled { pixels } | Space::Sliced { pixels, .. },
            ) => Some(pixels),
            (Sharing::Indi, Space::Counted { columns, .. }) => Some(counted_pixels(resolution, columns)),
        }
    }

    /// Whether the two differ in their sizes alone.
    pub fn is_like(&self, other: &Self) -> bool {
        let Self { sharing, space, clusters, bounds, test, slices, rasterising } = *self;
        (sharing, clusters, bounds) == (other.sharing, other.clusters, other.bounds)
            && (test, slices, rasterising) == (other.test, other.slices, other.rasterising)
            && discriminant(&space) == discriminant(&other.space)
    }
}
