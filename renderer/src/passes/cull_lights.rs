//! Stage `cull_lights`: the candidates, lights that may meet a visible cluster, by ascending light.
//!
//! ```text
//! visible_clusters ──mark_blocks──> block_bits ─┐
//! lights ───────────────────────────────────────┴─cull_lights──> light_bits, their number by block of lights
//! light_bits, lights ──list_candidates──> candidates, light_volumes, their number
//! ```

use super::handles::{Lights, VisibleClusters};
use super::inputs::Frame;
use super::lights;
use crate::assign::light_blocks;
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::DISPATCH_LISTS;
use crate::pass::{Dispatch, Recorder, Size};

/// Drops the lights whose cells hold nothing visible.
pub fn cull_lights(r: &mut Recorder, frame: &Frame, _lights: Lights, visible: VisibleClusters) {
    let clustering = visible.clustering;
    r.scope("cull_lights", |r| {
        let pipelines = frame.pipelines.accelerated();
        let run = |r: &mut Recorder, pipeline, size, declared| {
            r.dispatch(&Dispatch::new(pipeline, frame.buffers(clustering), size, declared));
        };
        let by_block = Size::Workgroups(light_blocks(frame.lights.count), 1);
        let (lights, blocks, bits) = (lights::READ, set(&[B::BlockBits]), set(&[B::LightBits]));
        r.clear(&frame.clusterings[clustering].buffers[B::BlockBits]);
        let clusters = set(&[B::State, B::VisibleClusters, B::ClusterBounds]);
        let marked = blocks | set(&[B::Groups]);
        run(r, &pipelines.mark_blocks, Size::Indirect(DISPATCH_LISTS), (clusters, marked));
        let spanned = blocks | set(&[B::ClusterBoxes]);
        run(r, &pipelines.cull_lights, by_block, (lights | spanned, bits));
        let candidates = set(&[B::LightVolumes, B::Candidates, B::State, B::Dispatches]);
        run(r, &pipelines.list_candidates, by_block, (lights | bits, candidates));
    });
}
