//! The ways of finding the lights of a fragment. [`KINDS`] is the one table of them: name, sizes, and what each can do.
//!
//! A method's name is its identity everywhere: on the command line, in configurations, as run directory and as row of every
//! table. `indi-persp-64`, `encl-ortho-4`, `indi-displ-64-32`, `tiled-16`, `sc-e-48-40`, `ortiz-16-9-24`, `tiled-mm-32`,
//! `g-20`, `m`, `hashed-0.5-3`, `all-lights`.
//!
//! ```text
//! plan (pure, f64) -> resources -> record (passes) -> lookup/<name>.glsl (shading) -> twin (CPU)
//! ```
//!
//! A family of methods is a folder with these parts.

pub mod all_lights;
pub mod grid;
pub mod hashed;
mod kinds;
pub mod model;
mod name;
mod sizes;
pub mod world;

pub use crate::geometry::Sharing;
pub use grid::{Division, GridMethod, Space};
pub use hashed::{HashedMethod, NodeSize, OctreeWay};
pub use kinds::{Groups, KINDS, Kind};
pub use sizes::{Size, Unit};
pub use world::{GridBox, WorldGrid};

use crate::Result;
use crate::assign::{Bounds, ClusterBounds, Clusters};
use crate::geometry::views::View;
use crate::geometry::{Grid, SliceLaw, SphereTest};
use crate::lights::Light;
use crate::measure::Capacities;
use crate::pass::Recorder;
use crate::passes::{Depth, Frame, LightLists, Lights};
use glam::DVec3;

/// A method: how the lights of a fragment are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Brute force: every fragment evaluates every light.
    AllLights,
    /// Lights are found by the cells of grids.
    Grid(GridMethod),
    /// Lights are found by the cells of a grid that lies in the world, whatever the views.
    World(WorldGrid),
    /// Lights are found by the model that a fragment is of.
    Models,
    /// Lights are found by the leaves of an octree over them.
    Hashed(HashedMethod),
}

/// What of a frame but its views decides where groups lie.
#[derive(Debug, Clone, Copy)]
pub struct Scenery<'a> {
    /// Lights of the frame.
    pub lights: &'a [Light],
    /// Lowest and highest corner of all geometry, metres; `None` without any.
    pub scene: Option<(DVec3, DVec3)>,
    /// How many models the scene has: instances that are drawn.
    pub models: u32,
    /// Which of lights and geometry a world grid is laid around.
    pub grid_box: GridBox,
}

impl Method {
    /// A method of grids with lists for visible clusters, and implicit bounds.
    pub const fn grid(sharing: Sharing, space: Space) -> Self {
        Self::Grid(GridMethod::new(sharing, space))
    }

    /// The grids of a frame: one a view for [`Sharing::Indi`], one for [`Sharing::Encl`], none for a method without cells. Those that
    /// do not depend on the views lie nowhere yet: [`Self::settled`].
    ///
    /// # Errors
    /// Views or sizes that it cannot serve; see [`GridMethod::plan`] and [`world::plan`].
    pub fn plan(&self, views: &[View], resolution: [u32; 2], division: Division) -> Result<Vec<Grid>> {
        match *self {
            Self::AllLights => Ok(vec![]),
            Self::Hashed(hashed) => hashed.check().map(|()| vec![]),
            Self::Grid(grid) => grid.plan(views, resolution, division),
            Self::World(grid) => Ok(vec![world::plan(grid)?]),
            Self::Models => Ok(vec![model::plan()]),
        }
    }

    /// A planned grid where it lies among a frame's lights and geometry.
    pub fn settled(&self, grid: &Grid, around: &Scenery) -> Grid {
        match self {
            Self::AllLights | Self::Grid(_) | Self::Hashed(_) => *grid,
            Self::World(_) => world::settled(grid, around),
            Self::Models => model::settled(around),
        }
    }

    /// Which groups get lists where the configuration asks for `asked`: those that do not depend on the views all do.
    pub fn listed(&self, asked: Clusters) -> Clusters {
        if self.is_apart_from_views() { Clusters::All } else { asked }
    }

    /// Whether groups, and so their lists, are the same whatever the views.
    pub fn is_apart_from_views(&self) -> bool {
        match self {
            Self::AllLights | Self::Grid(_) => false,
            Self::World(_) | Self::Models | Self::Hashed(_) => true,
        }
    }

    /// Which clusters get lists by the method's name.
    pub fn own_clusters(&self) -> Clusters {
        match self {
            Self::AllLights => Clusters::Visible,
            Self::Grid(grid) => grid.clusters,
            Self::World(_) | Self::Models | Self::Hashed(_) => Clusters::All,
        }
    }

    /// What of clusters is tested against lights by the method's name.
    pub fn own_bounds(&self) -> Bounds {
        match self {
            Self::AllLights | Self::World(_) | Self::Models | Self::Hashed(_) => Bounds::Implicit,
            Self::Grid(grid) => grid.bounds,
        }
    }

    /// What decides whether a light meets a cluster by the method's name; models are tested exactly.
    pub fn own_test(&self) -> SphereTest {
        match self {
            Self::AllLights | Self::Hashed(_) => SphereTest::HALF_SPACES,
            Self::Grid(grid) => grid.test,
            Self::World(_) => SphereTest::Box,
            Self::Models => SphereTest::Exact,
        }
    }

    /// Where slices begin by the method's name.
    pub fn own_slices(&self) -> SliceLaw {
        match self {
            Self::Grid(grid) => grid.slices,
            Self::AllLights | Self::World(_) | Self::Models | Self::Hashed(_) => SliceLaw::Geometric,
        }
    }

    /// Side of the tiles that a view's screen of so many pixels is divided into, where there are such.
    pub fn tile_pixels(&self, resolution: [u32; 2]) -> Option<f64> {
        match self {
            Self::Grid(grid) => grid.tile_pixels(resolution),
            Self::AllLights | Self::World(_) | Self::Models | Self::Hashed(_) => None,
        }
    }

    /// What is kept of a cluster for these bounds.
    pub fn kept_bounds(&self, bounds: Bounds) -> ClusterBounds {
        match (self, bounds) {
            (Self::Grid(grid), Bounds::Measured) => grid.space.measured_bounds(),
            _ => ClusterBounds::Cell,
        }
    }

    /// Whether a law says where slices begin.
    pub fn has_slices(&self) -> bool {
        matches!(self, Self::Grid(grid) if grid.space.has_slices())
    }

    /// Whether a fragment's geometric slice is found by adding to a logarithm: see [`Space::adds_bias`].
    pub fn adds_bias(&self) -> bool {
        matches!(self, Self::Grid(grid) if grid.space.adds_bias())
    }

    /// What a clustering's buffers hold at first, for grids of up to `clusters` clusters; nothing without lists.
    pub fn capacities(&self, clusters: u64, listed: Clusters, first: Capacities) -> Capacities {
        match self {
            Self::AllLights => Capacities::default(),
            Self::Hashed(_) => Capacities { octree: first.octree, ..Capacities::default() },
            Self::Grid(_) | Self::World(_) | Self::Models => grid::capacities(clusters, listed, first),
        }
    }

    /// Records what shading needs to find lights, from the lights and what depth there is; the depth that comes back is with
    /// what that took.
    pub fn record(
        &self,
        r: &mut Recorder,
        frame: &Frame,
        (lights, depth): (Lights, Depth),
    ) -> (Depth, LightLists) {
        match self {
            Self::AllLights => all_lights::record(depth),
            Self::Hashed(_) => hashed::record(r, frame, depth),
            Self::Grid(_) | Self::World(_) | Self::Models => grid::record(r, frame, (lights, depth)),
        }
    }
}
