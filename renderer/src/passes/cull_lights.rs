//! Stage `cull_lights`: the candidates, lights that may meet a visible cluster, by ascending light.
//!
//! ```text
//! visible_clusters ──mark_blocks──> block_bits ─┐
//! lights ───────────────────────────────────────┴─cull_lights──> light_bits ──scan──> ranks
//! ranks, lights ──list_candidates──> candidates, light_volumes
//! ```

use super::scan::rank_lights;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::frame::Frame;
use crate::gpu_interface::{ASSIGN_GROUP, DISPATCH_LISTS};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Drops the lights whose cells hold nothing visible.
pub fn cull_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("cull_lights", |r| {
        let pipelines = frame.pipelines.accelerated();
        r.clear(&frame.clusterings[clustering].buffers[B::BlockBits]);
        r.dispatch(&Dispatch {
            pipeline: &pipelines.mark_blocks,
            buffers: frame.buffers(clustering),
            size: Size::Indirect(DISPATCH_LISTS),
            reads: set(&[B::State, B::VisibleClusters]),
            writes: set(&[B::BlockBits, B::Groups]),
            depth: None,
            push: Push::default(),
        });
        let lights = set(&[B::Lights]);
        let (blocks, bits) = (set(&[B::BlockBits]), set(&[B::LightBits]));
        per_word(r, frame, clustering, &pipelines.cull_lights, (lights | blocks, bits));
        rank_lights(r, frame, clustering);
        let candidates = set(&[B::LightVolumes, B::Candidates]);
        per_word(r, frame, clustering, &pipelines.list_candidates, (lights | bits, candidates));
    });
}

/// Runs a pipeline with a thread for each word of light bits.
fn per_word(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    pipeline: &Pipeline,
    (reads, writes): (BufferSet, BufferSet),
) {
    r.dispatch(&Dispatch {
        pipeline,
        buffers: frame.buffers(clustering),
        size: Size::threads(frame.light_count.div_ceil(32), ASSIGN_GROUP),
        reads,
        writes,
        depth: None,
        push: Push::default(),
    });
}
