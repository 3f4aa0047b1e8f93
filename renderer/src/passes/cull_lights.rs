//! Stage `cull_lights`: the candidates, lights that may meet a visible cluster, by ascending light.
//!
//! ```text
//! visible_clusters ──mark_blocks──> block_bits ─┐
//! lights ───────────────────────────────────────┴─cull_lights──> light_bits ──scan──> ranks
//! ranks, lights ──list_candidates──> candidates, light_volumes
//! ```

use super::handles::{Lights, VisibleClusters};
use super::inputs::Frame;
use super::scan::rank_lights;
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::{ASSIGN_WORKGROUP, DISPATCH_LISTS};
use crate::pass::{Dispatch, Recorder, Size};

/// Drops the lights whose cells hold nothing visible.
pub fn cull_lights(r: &mut Recorder, frame: &Frame, _lights: Lights, visible: VisibleClusters) {
    let clustering = visible.clustering;
    r.scope("cull_lights", |r| {
        let pipelines = frame.pipelines.accelerated();
        let run = |r: &mut Recorder, pipeline, size, declared| {
            r.dispatch(&Dispatch::new(pipeline, frame.buffers(clustering), size, declared));
        };
        // A thread for each word of light bits.
        let words = Size::threads(frame.light_count.div_ceil(32), ASSIGN_WORKGROUP);
        let (lights, blocks, bits) = (set(&[B::Lights]), set(&[B::BlockBits]), set(&[B::LightBits]));
        r.clear(&frame.clusterings[clustering].buffers[B::BlockBits]);
        let clusters = set(&[B::State, B::VisibleClusters, B::ClusterBounds]);
        let marked = blocks | set(&[B::Groups]);
        run(r, &pipelines.mark_blocks, Size::Indirect(DISPATCH_LISTS), (clusters, marked));
        run(r, &pipelines.cull_lights, words, (lights | blocks, bits));
        rank_lights(r, frame, visible);
        let candidates = set(&[B::LightVolumes, B::Candidates]);
        run(r, &pipelines.list_candidates, words, (lights | bits, candidates));
    });
}
