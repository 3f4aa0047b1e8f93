//! Stages `compact` and `light_offsets`: the one prefix sum, over the visibility words and over the lengths of
//! the lists' segments; and, in `build_hierarchy`, over the digits of the sort.
//!
//! ```text
//! items ──reduce──> block_sums ──block_offsets──> block_sums, total ──apply──> exclusive prefix per item
//! ```

use crate::frame::Frame;
use crate::gpu_interface::{
    DISPATCH_SCAN, DISPATCH_SORT_SCAN, DispatchSize, SCAN_BLOCK, SORT_BLOCK, SORT_DIGITS,
};
use crate::pass::{Access, Recorder, Use};
use crate::pipelines::ScanPipelines;
use ash::vk;

/// How many blocks a scan takes.
#[derive(Clone, Copy)]
enum Blocks {
    /// Known to the host.
    Count(u32),
    /// Written by the device into a slot of the dispatch sizes.
    Indirect(u32),
}

/// Ranks the visibility words and lists the visible clusters by ascending index.
pub fn compact(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("compact", |r| {
        let this = &frame.clusterings[clustering];
        let b = &this.buffers;
        r.access(&[
            Access::buffer(b.cluster_bits.handle, Use::ComputeRead),
            Access::buffer(b.word_ranks.handle, Use::ComputeWrite),
            Access::buffer(b.visible_clusters.handle, Use::ComputeWrite),
        ]);
        let blocks = Blocks::Count(this.word_count.div_ceil(SCAN_BLOCK));
        scan(r, frame, clustering, &frame.pipelines.clustered().compact, blocks);
    });
}

/// Offsets of the lists' segments from their lengths.
pub fn light_offsets(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("light_offsets", |r| {
        let b = &frame.clusterings[clustering].buffers;
        r.access(&[Access::buffer(b.segment_counts.handle, Use::ComputeRead)]);
        let blocks = Blocks::Indirect(DISPATCH_SCAN);
        scan(r, frame, clustering, &frame.pipelines.clustered().light_offsets, blocks);
    });
}

/// Where each digit of each block goes, in pass `step` of the sort of lights; the step is pushed already.
pub(super) fn digit_offsets(r: &mut Recorder, frame: &Frame, clustering: usize, step: u32) {
    let b = &frame.clusterings[clustering].buffers;
    r.access(&[Access::buffer(b.digit_counts.handle, Use::ComputeWrite)]);
    let counts = frame.light_count.div_ceil(SORT_BLOCK) * SORT_DIGITS;
    let blocks = match step {
        0 => Blocks::Count(counts.div_ceil(SCAN_BLOCK)),
        _ => Blocks::Indirect(DISPATCH_SORT_SCAN),
    };
    scan(r, frame, clustering, &frame.pipelines.accelerated().digit_offsets, blocks);
}

fn scan(r: &mut Recorder, frame: &Frame, clustering: usize, pipelines: &ScanPipelines, blocks: Blocks) {
    let b = &frame.clusterings[clustering].buffers;
    for (pipeline, blocks) in [
        (&pipelines.reduce, blocks),
        (&pipelines.block_offsets, Blocks::Count(1)),
        (&pipelines.apply, blocks),
    ] {
        // Each dispatch reads what the one before it wrote here; the middle one may write dispatch sizes.
        let sizes = match blocks {
            Blocks::Count(_) => Use::ComputeWrite,
            Blocks::Indirect(_) => Use::Indirect,
        };
        r.access(&[
            Access::buffer(b.dispatches.handle, sizes),
            Access::buffer(b.block_sums.handle, Use::ComputeWrite),
            Access::buffer(b.state.handle, Use::ComputeWrite),
            Access::buffer(b.list_offsets.handle, Use::ComputeWrite),
            Access::buffer(b.digit_counts.handle, Use::ComputeWrite),
        ]);
        frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
        match blocks {
            Blocks::Count(count) => unsafe { r.context.device.cmd_dispatch(r.commands, count, 1, 1) },
            Blocks::Indirect(slot) => dispatch_indirect(r, b.dispatches.handle, slot),
        }
    }
}

/// Dispatches with the size that the device wrote into slot `slot`.
pub(super) fn dispatch_indirect(r: &Recorder, dispatches: vk::Buffer, slot: u32) {
    let offset = u64::from(slot) * size_of::<DispatchSize>() as u64;
    unsafe { r.context.device.cmd_dispatch_indirect(r.commands, dispatches, offset) };
}
