//! The one prefix sum: stages `compact` (over the visibility words) and `light_offsets` (over the lengths of the lists),
//! and parts of others (over the words of light bits, the digits of the sort, the tiles of scatter's groups).
//!
//! ```text
//! items ──reduce──> block_sums ──block_offsets──> block_sums, total ──apply──> exclusive prefix per item
//! items ──single──> total, exclusive prefix per item                           where there are few
//! ```

use crate::frame::Frame;
use crate::gpu_interface::{
    ASSIGN_GROUP, DISPATCH_SCAN, DISPATCH_SORT_SCAN, DispatchSize, SCAN_BLOCK, SORT_BLOCK, SORT_DIGITS,
};
use crate::pass::{Access, Recorder, Use};
use crate::pipelines::ScanPipelines;
use crate::vk::Buffer;
use ash::vk;

/// How many items a scan takes.
#[derive(Clone, Copy)]
enum Items {
    /// As many.
    Count(u32),
    /// At most as many; the device knows, and has written how many blocks that is into a slot of the dispatch sizes.
    AtMost(u32, u32),
}

/// Up to this many blocks one workgroup scans them all: two dispatches fewer.
const MAX_SINGLE_BLOCKS: u32 = 16;

/// Ranks the visibility words and lists the visible clusters by ascending index.
pub fn compact(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("compact", |r| {
        let this = &frame.clusterings[clustering];
        let b = &this.buffers;
        let touched = [&b.cluster_bits, &b.word_ranks, &b.visible_clusters];
        let pipelines = &frame.pipelines.clustered().compact;
        scan(r, frame, clustering, pipelines, (Items::Count(this.word_count), &touched));
    });
}

/// Offsets of the lists from their lengths.
pub fn light_offsets(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("light_offsets", |r| {
        let this = &frame.clusterings[clustering];
        let touched = [&this.buffers.list_lengths, &this.buffers.list_offsets];
        let items = Items::AtMost(this.visible_capacity, DISPATCH_SCAN);
        scan(r, frame, clustering, &frame.pipelines.clustered().light_offsets, (items, &touched));
    });
}

/// Ranks the words of light bits.
pub(super) fn rank_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let b = &frame.clusterings[clustering].buffers;
    let touched = [&b.light_bits];
    let items = Items::Count(frame.light_count.div_ceil(32));
    scan(r, frame, clustering, &frame.pipelines.accelerated().rank_lights, (items, &touched));
}

/// Gives groups of visible clusters the tiles that their lights fill.
pub(super) fn group_tiles(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let this = &frame.clusterings[clustering];
    let touched = [&this.buffers.light_nodes, &this.buffers.digit_counts];
    let items = Items::Count(this.visible_capacity.div_ceil(ASSIGN_GROUP));
    scan(r, frame, clustering, &frame.pipelines.accelerated().group_tiles, (items, &touched));
}

/// Where each digit of each block of the sort goes; the step is pushed already.
pub(super) fn digit_offsets(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let b = &frame.clusterings[clustering].buffers;
    let most = frame.light_count.div_ceil(SORT_BLOCK) * SORT_DIGITS;
    let items = Items::AtMost(most, DISPATCH_SORT_SCAN);
    scan(r, frame, clustering, &frame.pipelines.accelerated().digit_offsets, (items, &[&b.digit_counts]));
}

/// Scans; `touched` is what the items are read from and what becomes of them is written to.
fn scan(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    pipelines: &ScanPipelines,
    (items, touched): (Items, &[&Buffer]),
) {
    let (most, slot) = match items {
        Items::Count(count) => (count, None),
        Items::AtMost(most, slot) => (most, Some(slot)),
    };
    let blocks = most.div_ceil(SCAN_BLOCK);
    let all = &[
        (&pipelines.reduce, blocks, slot),
        (&pipelines.block_offsets, 1, None),
        (&pipelines.apply, blocks, slot),
    ];
    let single = &[(&pipelines.single, 1, None)];
    let b = &frame.clusterings[clustering].buffers;
    for &(pipeline, groups, slot) in if blocks <= MAX_SINGLE_BLOCKS { &single[..] } else { &all[..] } {
        // Each dispatch reads what the one before it wrote here; the one that knows the total writes dispatch sizes.
        let sizes = if slot.is_some() { Use::Indirect } else { Use::ComputeWrite };
        r.access(&[
            Access::buffer(b.dispatches.handle, sizes),
            Access::buffer(b.block_sums.handle, Use::ComputeWrite),
            Access::buffer(b.state.handle, Use::ComputeWrite),
        ]);
        for buffer in touched {
            r.access(&[Access::buffer(buffer.handle, Use::ComputeWrite)]);
        }
        frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
        match slot {
            None => unsafe { r.context.device.cmd_dispatch(r.commands(), groups, 1, 1) },
            Some(slot) => dispatch_indirect(r, b.dispatches.handle, slot),
        }
    }
}

/// Dispatches with the size that the device wrote into slot `slot`.
pub(super) fn dispatch_indirect(r: &Recorder, dispatches: vk::Buffer, slot: u32) {
    let offset = u64::from(slot) * size_of::<DispatchSize>() as u64;
    unsafe { r.context.device.cmd_dispatch_indirect(r.commands(), dispatches, offset) };
}
