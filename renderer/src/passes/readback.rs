//! What goes back to the host: each frame's few words of state, and in atemporal runs everything counted.

use super::inputs::Frame;
use crate::buffers::BufferName as B;
use crate::gpu_interface::{COUNTER_COUNT, ClusteringState};
use crate::measure::OctreeSizes;
use crate::pass::{BufferCopy, Recorder};
use crate::vk::Buffer;

/// Size in bytes of one clustering's state.
pub const STATE_BYTES: u64 = size_of::<ClusteringState>() as u64;

/// Copies every clustering's state, by which overflow is seen.
pub fn states(r: &mut Recorder, frame: &Frame) {
    for (offset, clustering) in (0..).step_by(STATE_BYTES as usize).zip(frame.clusterings) {
        r.copy(&BufferCopy {
            from: &clustering.buffers[B::State],
            to: frame.states,
            offset,
            size: STATE_BYTES,
        });
    }
    r.hand_over(frame.states);
}

/// Zeroes the counters of an atemporal frame, before it begins.
pub fn clear_counters(r: &mut Recorder, frame: &Frame) {
    for clustering in frame.clusterings {
        r.clear(&clustering.buffers[B::Counters]);
        r.clear(&clustering.buffers[B::LightsPerFragment]);
    }
}

/// What is read back of one clustering, and how many 32-bit words of each.
pub type Source = (B, u64);

/// What every clustering has: counters, and lights per fragment.
fn counts(lights: u32) -> [Source; 2] {
    [(B::Counters, 2 * COUNTER_COUNT as u64), (B::LightsPerFragment, u64::from(lights) + 1)]
}

/// What is read of a clustering of cells, of whose lists `lists` says how many words there are: of visible clusters, and of
/// offsets, lengths and lights.
pub fn of_cells(lists: [u64; 4], lights: u32) -> [Source; 7] {
    let [counters, bins] = counts(lights);
    let [clusters, offsets, lengths, indices] = lists;
    [
        counters,
        bins,
        (B::VisibleClusters, clusters),
        (B::VisibleFragments, clusters),
        (B::ListOffsets, offsets),
        (B::ListLengths, lengths),
        (B::LightIndices, indices),
    ]
}

/// What is read of an octree with tables of these sizes.
pub fn of_leaves(sizes: &OctreeSizes, lights: u32) -> [Source; 5] {
    let [counters, bins] = counts(lights);
    let leaves = u64::from(sizes.leaves);
    [
        counters,
        bins,
        (B::VisibleFragments, leaves),
        (B::OctreeLeaves, 2 * leaves),
        (B::OctreeIndices, sizes.indices.into()),
    ]
}

/// Copies `sources`, one behind the other.
pub fn copy_counted(r: &mut Recorder, frame: &Frame, clustering: usize, sources: &[Source], target: &Buffer) {
    let mut offset = 0;
    for &(source, words) in sources {
        if words > 0 {
            let from = &frame.clusterings[clustering].buffers[source];
            r.copy(&BufferCopy { from, to: target, offset, size: 4 * words });
            offset += 4 * words;
        }
    }
    r.hand_over(target);
}
