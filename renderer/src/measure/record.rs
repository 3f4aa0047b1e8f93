//! The records that passes produce and [`crate::output`] writes.

use super::counters::OCTAVE_PARTS;
use super::{DeviceCounts, OctreeCounts};
use crate::{Error, Result};
use glam::DVec3;
use half::f16;

/// One visible cluster, read back in an atemporal run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClusterRecord {
    /// Linear index ix + Dx*(iy + Dy*iz).
    pub index: u32,
    /// Fragments (samples) marked in the cluster.
    pub fragments: u32,
    /// Length of its light list.
    pub lights: u32,
}

/// Counters of one clustering in one frame.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ClusteringCounts {
    /// Grid dimensions Dx, Dy, Dz.
    pub dimensions: [u32; 3],
    /// Clusters with at least one visible fragment; or all groups that have lists, where they do not depend on the views.
    pub visible_clusters: u64,
    /// Sum of the lengths of the light lists.
    pub light_indices: u64,
    /// Sphere against cluster tests evaluated.
    pub intersection_tests: u64,
    /// Entries that did not fit; always 0 after the buffers have grown.
    pub light_indices_dropped: u64,
    /// Clusters that did not fit; always 0 after the buffers have grown.
    pub visible_clusters_dropped: u64,
    /// FNV-1a hash over offsets, lengths and entries of all lists, in order.
    pub lists_hash: u64,
    /// Visible clusters by ascending index.
    pub clusters: Vec<ClusterRecord>,
    /// The octree whose filled leaves they are, where groups are such.
    pub octree: Option<OctreeCounts>,
}

/// Counters of one frame: the atemporal run's record.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrameCounts {
    /// Frame number in the recording.
    pub frame: u32,
    /// Frame number times the recording's time step, seconds.
    pub time_s: f64,
    /// How many rendering cameras there are.
    pub views: u32,
    /// What was counted of each clustering: one a view for Indi, one for Encl, none for all-lights.
    pub clusterings: Vec<ClusteringCounts>,
    /// What the shaders counted, over clusterings.
    pub counters: DeviceCounts,
    /// Histogram of each clustering (of each view for all-lights): (lights, fragments) for every bin with fragments,
    /// ascending.
    pub lights_per_fragment: Vec<Vec<(u32, u64)>>,
}

/// Time of one stage.
#[derive(Debug, Clone, PartialEq)]
pub struct StageTime {
    /// Path in the stage tree, such as `frame/cluster[0]/count_lights`.
    pub stage: String,
    /// Time on the GPU, milliseconds.
    pub gpu_ms: f64,
    /// CPU time spent recording it, milliseconds.
    pub cpu_ms: f64,
}

/// All stages of one frame of one temporal run, parents before children, in execution order.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameTimes {
    /// Number of the temporal run, from 0.
    pub run: u32,
    /// Frame number in the recording.
    pub frame: u32,
    /// Stages in execution order.
    pub stages: Vec<StageTime>,
}

/// Everything known of each pixel of one view, row-major from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewPixels {
    /// `mono`, `left`, `right` or `view2`...
    pub name: String,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Linear HDR colour, as it is seen before the background, and coverage.
    pub color: Vec<[f16; 4]>,
    /// Linear HDR colour of the background: `color` holds as much of it as coverage leaves.
    pub background: [f32; 3],
    /// Distance along the view's -Z, metres; infinity where nothing was hit.
    pub depth: Vec<f32>,
    /// How many lights the frame has, wherever they reach.
    pub lights: u32,
    /// Length of the list of the pixel's cluster; 0 where nothing was hit.
    pub light_count: Vec<u32>,
    /// Fragments in the pixel's cluster; 0 where nothing was hit.
    pub fragment_count: Vec<u32>,
    /// Linear cluster index; `u32::MAX` where nothing was hit.
    pub cluster_index: Vec<u32>,
    /// Cells a side of the grid that the index counts in; zeros without clusters.
    pub dimensions: [u32; 3],
    /// Matrix that takes view to world space.
    pub world_from_view: glam::DMat4,
    /// Clip from view (reversed depth), column-major.
    pub clip_from_view: glam::DMat4,
}

impl ViewPixels {
    /// Where the surface at the middle of a pixel is, world space, metres; `None` where nothing was hit. It is as exact as `depth`.
    pub fn place(&self, pixel: usize) -> Option<DVec3> {
        let distance = f64::from(self.depth[pixel]);
        let sides = [self.width as usize, self.height as usize];
        let at = [pixel % sides[0], pixel / sides[0]];
        let [x, y] = [0, 1].map(|axis| 2.0 * (at[axis] as f64 + 0.5) / sides[axis] as f64 - 1.0);
        let near = self.clip_from_view.inverse().project_point3(DVec3::new(x, -y, 0.5));
        distance.is_finite().then(|| self.world_from_view.transform_point3(near * (distance / -near.z)))
    }
}

impl FrameCounts {
    /// Lets go what is known of each cluster and each bin; the sums stay.
    pub fn keep_sums(&mut self) {
        for clustering in &mut self.clusterings {
            clustering.clusters = vec![];
            clustering.octree.iter_mut().for_each(|octree| octree.tables = vec![]);
        }
        self.lights_per_fragment = vec![];
    }

    /// Cells of all grids, visible or not.
    pub fn clusters(&self) -> u64 {
        self.clusterings.iter().map(|c| c.dimensions.iter().map(|&d| u64::from(d)).product::<u64>()).sum()
    }

    /// Visible clusters of all clusterings.
    pub fn visible_clusters(&self) -> u64 {
        self.sum(|clustering| clustering.visible_clusters)
    }

    /// Light indices of all clusterings.
    pub fn light_indices(&self) -> u64 {
        self.sum(|clustering| clustering.light_indices)
    }

    /// Sphere against cluster tests of all clusterings.
    pub fn intersection_tests(&self) -> u64 {
        self.sum(|clustering| clustering.intersection_tests)
    }

    /// Light indices that did not fit, of all clusterings.
    pub fn light_indices_dropped(&self) -> u64 {
        self.sum(|clustering| clustering.light_indices_dropped)
    }

    /// Visible clusters that did not fit, of all clusterings.
    pub fn visible_clusters_dropped(&self) -> u64 {
        self.sum(|clustering| clustering.visible_clusters_dropped)
    }

    /// How often the frame built its octree: never where its lights are those of the last.
    pub fn octree_rebuilds(&self) -> u64 {
        self.sum(|clustering| clustering.octree.as_ref().map_or(0, |octree| octree.rebuilds))
    }

    /// How many tables of its octree the frame hashed.
    pub fn octree_tables_hashed(&self) -> u64 {
        self.sum(|clustering| clustering.octree.as_ref().map_or(0, |octree| octree.tables_hashed))
    }

    /// What the frame took to the device of its octree, bytes.
    pub fn octree_bytes_uploaded(&self) -> u64 {
        self.sum(|clustering| clustering.octree.as_ref().map_or(0, |octree| octree.uploaded))
    }

    /// Light indices of lights that do not reach all cells of their leaf.
    pub fn octree_extra_indices(&self) -> u64 {
        self.sum(|clustering| clustering.octree.as_ref().map_or(0, |octree| octree.extra_indices))
    }

    /// What the tables of its octree take, bytes.
    pub fn octree_bytes(&self) -> u64 {
        self.sum(|clustering| clustering.octree.as_ref().map_or(0, |octree| octree.sizes.bytes()))
    }

    /// How much the depth of the first view jumps from pixel to pixel: the mean over pairs of neighbours of how many octaves their
    /// distances differ by, millionths, rounded down. A million where each pixel is twice as far as the next; 0 without pairs.
    pub fn depth_discontinuity(&self) -> u64 {
        let DeviceCounts { depth_steps, depth_pairs, .. } = self.counters;
        let parts = u128::from(depth_pairs) * u128::from(OCTAVE_PARTS);
        (u128::from(depth_steps) * 1_000_000).checked_div(parts).unwrap_or(0) as u64
    }

    /// Refuses what must never happen, so that no result of such a frame is kept.
    ///
    /// # Errors
    /// [`Error::Internal`] where a fragment that is seen found no visible cluster or was not shaded, or visible clusters or light
    /// indices were dropped.
    pub fn check(&self) -> Result<()> {
        let DeviceCounts { fragments_shaded: shaded, fragments_hidden: hidden, .. } = self.counters;
        // What is seen is taken off what may be hidden.
        let unshaded = if hidden > shaded { hidden.wrapping_neg() } else { 0 };
        let faults = [
            (unshaded, "fragments are seen that were not shaded"),
            (self.counters.fragments_without_cluster, "shaded fragments found no visible cluster"),
            (self.light_indices_dropped(), "light indices did not fit and were dropped"),
            (self.visible_clusters_dropped(), "visible clusters did not fit and were dropped"),
        ];
        match faults.into_iter().find(|(count, _)| *count > 0) {
            None => Ok(()),
            Some((count, what)) => Err(Error::Internal(format!(
                "frame {}: {count} {what}, which must never happen: the program or the driver is at fault, and the run is \
                 not kept; try --device for another driver",
                self.frame
            ))),
        }
    }

    fn sum(&self, count: impl Fn(&ClusteringCounts) -> u64) -> u64 {
        self.clusterings.iter().map(count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discontinuity_is_the_mean_step_in_millionths_of_an_octave() {
        let of = |depth_steps, depth_pairs| {
            let counters = DeviceCounts { depth_steps, depth_pairs, ..DeviceCounts::default() };
            FrameCounts { counters, ..FrameCounts::default() }.depth_discontinuity()
        };
        assert_eq!([of(3 << 16, 3), of(1 << 15, 4), of(0, 5), of(0, 0)], [1_000_000, 125_000, 0, 0]);
        assert_eq!(of(1 << 60, 1 << 40), 16_000_000, "no image is too large");
    }

    #[test]
    fn frames_that_lack_something_are_refused() {
        let whole =
            FrameCounts { frame: 7, clusterings: vec![ClusteringCounts::default(); 2], ..Default::default() };
        whole.check().unwrap();
        let mut faults = [whole.clone(), whole.clone(), whole.clone(), whole];
        faults[0].counters.fragments_without_cluster = 3;
        faults[1].clusterings[1].light_indices_dropped = 4;
        faults[2].clusterings[0].visible_clusters_dropped = 5;
        faults[3].counters.fragments_hidden = 0_u64.wrapping_sub(6);
        let words = ["3 shaded", "4 light indices", "5 visible clusters", "6 fragments are seen"];
        for (counts, what) in faults.iter().zip(words) {
            let error = counts.check().unwrap_err();
            assert!(error.to_string().starts_with(&format!("frame 7: {what}")), "{error}");
            assert_eq!(error.exit_code(), 1);
        }
    }
}
