//! The ways of finding the lights of a fragment. [`KINDS`] is the one table of them: name, sizes, and what each can do.
//!
//! A method's name is its identity everywhere: on the command line, in configurations, as run directory and as row of every
//! table. `indi-persp-64`, `encl-ortho-4`, `indi-displ-64-32`, `tiled-16`, `sc-e-48-40`, `all-lights`.
//!
//! ```text
//! plan (pure, f64) -> resources -> record (passes) -> lookup/<name>.glsl (shading) -> twin (CPU)
//! ```
//!
//! A family of methods is a folder with these parts.

pub mod all_lights;
pub mod grid;
mod kinds;
mod name;

pub use crate::geometry::Sharing;
pub use grid::{Division, GridMethod, Space};
pub use kinds::{KINDS, Kind};

use crate::Result;
use crate::assign::{Bounds, ClusterBounds, Clusters};
use crate::geometry::Grid;
use crate::geometry::views::View;
use crate::measure::Capacities;
use crate::pass::Recorder;
use crate::passes::{Depth, Frame, LightLists, Lights};

/// A method: how the lights of a fragment are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Brute force: every fragment evaluates every light.
    AllLights,
    /// Lights are found by the cells of grids.
    Grid(GridMethod),
}

impl Method {
    /// A method of grids with lists by offsets for visible clusters, and implicit bounds.
    pub const fn grid(sharing: Sharing, space: Space) -> Self {
        Self::Grid(GridMethod::new(sharing, space))
    }

    /// The grids of a frame: one a view for [`Sharing::Indi`], one for [`Sharing::Encl`], none for a method without.
    ///
    /// # Errors
    /// Views or sizes that it cannot serve; see [`GridMethod::plan`].
    pub fn plan(&self, views: &[View], resolution: [u32; 2], division: Division) -> Result<Vec<Grid>> {
        match self {
            Self::AllLights => Ok(vec![]),
            Self::Grid(grid) => grid.plan(views, resolution, division),
        }
    }

    /// Which clusters get lists by the method's name.
    pub fn own_clusters(&self) -> Clusters {
        match self {
            Self::AllLights => Clusters::Visible,
            Self::Grid(grid) => grid.clusters,
        }
    }

    /// What of clusters is tested against lights by the method's name.
    pub fn own_bounds(&self) -> Bounds {
        match self {
            Self::AllLights => Bounds::Implicit,
            Self::Grid(grid) => grid.bounds,
        }
    }

    /// What is kept of a cluster for these bounds.
    pub fn kept_bounds(&self, bounds: Bounds) -> ClusterBounds {
        match (self, bounds) {
            (Self::AllLights, _) | (_, Bounds::Implicit) => ClusterBounds::Cell,
            (Self::Grid(grid), Bounds::Measured) => grid.space.measured_bounds(),
        }
    }

    /// Whether a law says where slices begin.
    pub fn has_slices(&self) -> bool {
        matches!(self, Self::Grid(grid) if grid.space.has_slices())
    }

    /// What a clustering's buffers hold at first, for grids of up to `clusters` clusters; nothing without lists.
    pub fn capacities(&self, clusters: u64, listed: Clusters, first: Capacities) -> Capacities {
        match self {
            Self::AllLights => Capacities { visible_clusters: 0, light_indices: 0 },
            Self::Grid(_) => grid::capacities(clusters, listed, first),
        }
    }

    /// Records what shading needs to find lights; the depth that comes back is what that took.
    pub fn record(&self, r: &mut Recorder, frame: &Frame, lights: Lights) -> (Depth, LightLists) {
        match self {
            Self::AllLights => all_lights::record(),
            Self::Grid(_) => grid::record(r, frame, lights),
        }
    }
}
