//! What goes back to the host: each frame's few words of state, and in atemporal runs everything counted.

use super::inputs::Frame;
use crate::buffers::BufferName as B;
use crate::gpu_interface::{COUNTER_COUNT, ClusteringState};
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

/// Sizes of what [`copy_counted`] copies of one clustering, in its order; 32-bit words. `lists` are those of visible clusters, and
/// of offsets, lengths and lights of their lists.
pub fn counted_words(lists: [u64; 4], lights: u32) -> [u64; 7] {
    let [clusters, offsets, lengths, indices] = lists;
    [2 * COUNTER_COUNT as u64, u64::from(lights) + 1, clusters, clusters, offsets, lengths, indices]
}

/// Copies, one behind the other: counters, lights per fragment, visible clusters, their fragments, offsets, lengths and lights of
/// their lists.
pub fn copy_counted(r: &mut Recorder, frame: &Frame, clustering: usize, words: &[u64; 7], target: &Buffer) {
    let sources = [
        B::Counters,
        B::LightsPerFragment,
        B::VisibleClusters,
        B::VisibleFragments,
        B::ListOffsets,
        B::ListLengths,
        B::LightIndices,
    ];
    let mut offset = 0;
    for (source, words) in sources.into_iter().zip(words) {
        if *words > 0 {
            let from = &frame.clusterings[clustering].buffers[source];
            r.copy(&BufferCopy { from, to: target, offset, size: 4 * words });
            offset += 4 * words;
        }
    }
    r.hand_over(target);
}
