//! What goes back to the host: each frame's few words of state, and in atemporal runs everything counted.

use crate::frame::Frame;
use crate::gpu_interface::{COUNTER_COUNT, ClusteringState};
use crate::pass::{Access, Recorder, Use};
use crate::vk::Buffer;
use ash::vk;

/// Bytes of one clustering's state.
pub const STATE_BYTES: u64 = size_of::<ClusteringState>() as u64;

/// Copies every clustering's state, by which overflow is seen.
pub fn states(r: &mut Recorder, frame: &Frame) {
    for (c, clustering) in frame.clusterings.iter().enumerate() {
        r.access(&[
            Access::buffer(clustering.buffers.state.handle, Use::TransferRead),
            Access::buffer(frame.states.handle, Use::TransferWrite),
        ]);
        let source = clustering.buffers.state.handle;
        let region = vk::BufferCopy::default().dst_offset(c as u64 * STATE_BYTES).size(STATE_BYTES);
        unsafe { r.context.device.cmd_copy_buffer(r.commands(), source, frame.states.handle, &[region]) };
    }
    r.access(&[Access::buffer(frame.states.handle, Use::HostRead)]);
}

/// Zeroes the counters of an atemporal frame, before it begins.
pub fn clear_counters(r: &mut Recorder, frame: &Frame) {
    for clustering in frame.clusterings {
        for buffer in [&clustering.buffers.counters, &clustering.buffers.lights_per_fragment] {
            r.access(&[Access::buffer(buffer.handle, Use::TransferWrite)]);
            unsafe { r.context.device.cmd_fill_buffer(r.commands(), buffer.handle, 0, vk::WHOLE_SIZE, 0) };
        }
    }
}

/// Sizes of what [`copy_counted`] copies of one clustering, in its order; 32-bit words.
pub fn counted_words(visible: u32, indices: u32, lights: u32) -> [u64; 6] {
    [
        2 * COUNTER_COUNT as u64,
        u64::from(lights) + 1,
        u64::from(visible),
        u64::from(visible),
        u64::from(visible) + 1,
        u64::from(indices),
    ]
}

/// Copies, one behind the other: counters, lights per fragment, visible clusters, their fragments, offsets, indices.
pub fn copy_counted(r: &mut Recorder, frame: &Frame, clustering: usize, words: &[u64; 6], target: &Buffer) {
    let b = &frame.clusterings[clustering].buffers;
    let sources = [
        &b.counters,
        &b.lights_per_fragment,
        &b.visible_clusters,
        &b.visible_fragments,
        &b.list_offsets,
        &b.light_indices,
    ];
    let mut offset = 0;
    for (source, words) in sources.into_iter().zip(words) {
        if *words > 0 {
            copy(r, source, target, offset, 4 * words);
            offset += 4 * words;
        }
    }
    r.access(&[Access::buffer(target.handle, Use::HostRead)]);
}

/// Copies the first `size` bytes of `source` to `offset` in `target`.
pub fn copy(r: &mut Recorder, source: &Buffer, target: &Buffer, offset: u64, size: u64) {
    r.access(&[
        Access::buffer(source.handle, Use::TransferRead),
        Access::buffer(target.handle, Use::TransferWrite),
    ]);
    let region = vk::BufferCopy::default().dst_offset(offset).size(size);
    unsafe { r.context.device.cmd_copy_buffer(r.commands(), source.handle, target.handle, &[region]) };
}
