//! From lights to the octree of the device.
//!
//! ```text
//! lights ─ frame ─┬ octree of each light ── joined from the root down ──┬ merged ─ linkless
//!                 └ grid of cells of each ─ sorted, up from the deepest ┘   └ where geometry is ┘
//! ```

use super::ball::Ball;
use super::frame::OctreeFrame;
use super::geometry::OctreeGeometry;
use super::light_grid::LightGrid;
use super::light_tree::{BranchBudget, LightTree};
use super::linkless::LinklessOctree;
use super::settings::{OctreeError, OctreeSettings, Route};
use super::tree::Node;
use super::{bottom_up, layers, top_down};
use crate::geometry::LightVolume;
use rayon::prelude::*;
use std::time::Instant;

/// Most branches of all light octrees together: what takes a gigabyte.
const MOST_BRANCHES: usize = 1 << 27;

/// Most cells of the grids of all lights together: what takes a gigabyte.
const MOST_GRID_CELLS: u64 = 1 << 33;

/// Most light indices that are made where sharing may make fewer of them.
const MOST_UNSHARED: usize = 1 << 28;

/// An octree and how long its steps took.
#[derive(Debug, Clone, PartialEq)]
pub struct Built {
    /// The octree.
    pub octree: LinklessOctree,
    /// How long each step took.
    pub times: BuildTimes,
}

/// Seconds of each step of building an octree, in order.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BuildTimes {
    /// Where the octree lies: the empty octree.
    pub empty: f64,
    /// The octree, or the grid of cells, of each light.
    pub lights: f64,
    /// Joining them to one octree.
    pub adding: f64,
    /// Merging nodes whose children are equal, and leaving out those without geometry.
    pub merging: f64,
    /// Tables: collecting keys, perfect hashes, filling slots.
    pub linkless: f64,
}

impl BuildTimes {
    /// Names of the steps, in order.
    pub const STEPS: [&str; 5] =
        ["empty_octree", "light_octrees", "add_lights", "merge_nodes", "hash_layers"];

    /// Each step with its seconds, in order.
    pub fn steps(&self) -> [(&'static str, f64); 5] {
        let Self { empty, lights, adding, merging, linkless } = *self;
        let seconds = [empty, lights, adding, merging, linkless];
        std::array::from_fn(|step| (Self::STEPS[step], seconds[step]))
    }

    /// All steps together, seconds.
    pub fn total(&self) -> f64 {
        self.empty + self.lights + self.adding + self.merging + self.linkless
    }
}

impl LinklessOctree {
    /// The octree over lights. The same lights give the same bytes, on any number of cores.
    ///
    /// # Errors
    /// A light or the node size is no length above 0, or the octree is deeper or larger than the limits allow.
    pub fn build(lights: &[LightVolume], settings: &OctreeSettings) -> Result<Built, OctreeError> {
        build(lights, None, settings)
    }

    /// The octree over lights as [`Self::build`] makes it, but only where there is geometry: it says the same there, and
    /// anything elsewhere.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_for(
        lights: &[LightVolume],
        geometry: &OctreeGeometry,
        settings: &OctreeSettings,
    ) -> Result<Built, OctreeError> {
        build(lights, Some(geometry), settings)
    }
}

fn build(
    lights: &[LightVolume],
    geometry: Option<&OctreeGeometry>,
    settings: &OctreeSettings,
) -> Result<Built, OctreeError> {
    let mut times = BuildTimes::default();
    let frame = timed(&mut times.empty, || OctreeFrame::around(lights, settings))?;
    let mut tree = scene_tree(lights, &frame, settings, &mut times)?;
    if let Some(geometry) = geometry {
        tree = timed(&mut times.merging, || geometry.trim(&tree, &frame));
    }
    let octree = timed(&mut times.linkless, || layers::tables(&tree, frame, settings))?;
    Ok(Built { octree, times })
}

/// What `work` returns; its seconds are added to a step's.
pub(super) fn timed<T>(seconds: &mut f64, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let done = work();
    *seconds += start.elapsed().as_secs_f64();
    done
}

/// The octree over lights, merged.
fn scene_tree(
    lights: &[LightVolume],
    frame: &OctreeFrame,
    settings: &OctreeSettings,
    times: &mut BuildTimes,
) -> Result<Node, OctreeError> {
    let node = settings.node;
    let most = if settings.share_runs { MOST_UNSHARED } else { settings.limits.indices };
    let tree = match settings.route {
        Route::TopDown => {
            let trees = timed(&mut times.lights, || light_trees(lights, frame, most))?;
            timed(&mut times.adding, || top_down::join(&trees, most))
        }
        Route::BottomUp => {
            let grids = timed(&mut times.lights, || light_grids(lights, frame))?;
            timed(&mut times.adding, || bottom_up::join(&grids, frame.depth, most))
        }
    };
    let mut tree = tree.ok_or(OctreeError::TooManyIndices { node, most })?;
    timed(&mut times.merging, || tree.merge());
    Ok(tree)
}

/// The octree of each light, where the leaves of the scene's may have `most` light indices.
///
/// # Errors
/// They are too large, which is told of many before they are made.
pub(super) fn light_trees(
    lights: &[LightVolume],
    frame: &OctreeFrame,
    most: usize,
) -> Result<Vec<LightTree>, OctreeError> {
    let least: f64 = lights.iter().map(|light| Ball::new(light, frame).least_branches()).sum();
    if least > MOST_BRANCHES as f64 {
        return Err(OctreeError::LargeLights { node: frame.node, most: MOST_BRANCHES });
    }
    // Each full leaf of a light's octree is at least one of the scene's.
    if least > most as f64 {
        return Err(OctreeError::TooManyIndices { node: frame.node, most });
    }
    let budget = BranchBudget::new(MOST_BRANCHES);
    let tree = |light| LightTree::new(&Ball::new(light, frame), frame.depth, &budget);
    let trees: Option<Vec<LightTree>> = lights.par_iter().map(tree).collect();
    trees.ok_or(OctreeError::LargeLights { node: frame.node, most: MOST_BRANCHES })
}

/// The grid of each light.
fn light_grids(lights: &[LightVolume], frame: &OctreeFrame) -> Result<Vec<LightGrid>, OctreeError> {
    let balls: Vec<Ball> = lights.iter().map(|light| Ball::new(light, frame)).collect();
    let cells = balls.iter().map(LightGrid::size).fold(0, u64::saturating_add);
    if cells > MOST_GRID_CELLS {
        return Err(OctreeError::LargeLights { node: frame.node, most: MOST_GRID_CELLS as usize });
    }
    Ok(balls.par_iter().map(LightGrid::new).collect())
}
