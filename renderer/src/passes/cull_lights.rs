//! Stage `cull_lights`: the candidates, lights that may meet a visible cluster, by ascending light.
//!
//! ```text
//! visible_clusters ──mark_blocks──> block_bits ─┐
//! lights ───────────────────────────────────────┴─cull_lights──> light_bits ──scan──> ranks
//! ranks, lights ──list_candidates──> candidates, light_spheres
//! ```

use super::assign::indirect;
use super::scan::rank_lights;
use crate::frame::Frame;
use crate::gpu_interface::{ASSIGN_GROUP, DISPATCH_LISTS};
use crate::pass::{Access, Recorder, Use};
use crate::vk::Pipeline;
use ash::vk;

/// Drops the lights whose cells hold nothing visible.
pub fn cull_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("cull_lights", |r| {
        let b = &frame.clusterings[clustering].buffers;
        let pipelines = frame.pipelines.accelerated();
        r.access(&[Access::buffer(b.block_bits.handle, Use::TransferWrite)]);
        unsafe { r.context.device.cmd_fill_buffer(r.commands(), b.block_bits.handle, 0, vk::WHOLE_SIZE, 0) };
        let writes = [&b.block_bits, &b.light_nodes];
        indirect(
            r,
            frame,
            clustering,
            (&pipelines.mark_blocks, DISPATCH_LISTS),
            (&[&b.visible_clusters], &writes),
        );
        r.access(&[
            Access::buffer(frame.lights.handle, Use::ComputeRead),
            Access::buffer(b.block_bits.handle, Use::ComputeRead),
            Access::buffer(b.light_bits.handle, Use::ComputeWrite),
        ]);
        per_word(r, frame, clustering, &pipelines.cull_lights);
        rank_lights(r, frame, clustering);
        r.access(&[
            Access::buffer(b.light_bits.handle, Use::ComputeRead),
            Access::buffer(b.light_spheres.handle, Use::ComputeWrite),
            Access::buffer(b.candidates.handle, Use::ComputeWrite),
        ]);
        per_word(r, frame, clustering, &pipelines.list_candidates);
    });
}

/// Runs a pipeline with a thread for each word of light bits.
fn per_word(r: &Recorder, frame: &Frame, clustering: usize, pipeline: &Pipeline) {
    frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
    let groups = frame.light_count.div_ceil(32).div_ceil(ASSIGN_GROUP);
    unsafe { r.context.device.cmd_dispatch(r.commands(), groups, 1, 1) };
}
