//! The family on the CPU: what a frame's passes make, from the fragments of clusters to light lists, put together from the
//! twins of single passes.

use crate::assign::Clusters;
use crate::cpu::{self, LightLists, Visible};
use crate::geometry::{Grid, VolumeTest};
use crate::lights::Light;

/// The clusters of `grid` that get lists, by ascending index: of all, those with fragments, or every one.
pub fn listed_clusters(grid: &Grid, clusters: Clusters, fragments: &[u32]) -> Vec<u32> {
    match clusters {
        Clusters::Visible => cpu::compact(fragments).visible,
        Clusters::All => (0..grid.cluster_count() as u32).collect(),
    }
}

/// The light lists of those clusters, from lights in world space. Pairs whose margin is below `epsilon` (metres) are marked
/// as too close to call.
pub fn light_lists(
    listed: Visible,
    lights: &[Light],
    test: impl Into<VolumeTest>,
    epsilon: f64,
) -> LightLists {
    cpu::assign(listed.grid, listed.clusters, lights, test, epsilon)
}
