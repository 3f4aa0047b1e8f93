//! Stage `build_hierarchy`: the light tree of one clustering, from the candidates.
//!
//! ```text
//! candidates ─> [count_digits ─> digit_offsets ─> reorder] a pass ─> [build_nodes] a depth, from the lights up
//! ```

use super::scan::digit_offsets;
use crate::assign::{sort_passes, tree_depth};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::frame::Frame;
use crate::gpu_interface::{DISPATCH_NODES, DISPATCH_SORT};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Sorts the candidates by their Morton codes, and makes the tree over them.
pub fn build_hierarchy(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("build_hierarchy", |r| {
        let pipelines = frame.pipelines.accelerated();
        let (state, sorted) = (set(&[B::State]), set(&[B::SortItems, B::DigitCounts]));
        let lights = state | set(&[B::LightVolumes]);
        for step in 0..sort_passes(frame.light_count) {
            let slot = DISPATCH_SORT;
            run(r, frame, clustering, (&pipelines.count_digits, slot, step), (lights, sorted));
            digit_offsets(r, frame, clustering, step);
            run(r, frame, clustering, (&pipelines.reorder, slot, step), (state, sorted));
        }
        let nodes = set(&[B::TreeVolumes, B::TreeLights, B::LightNodes]);
        for depth in (1..tree_depth(frame.light_count)).rev() {
            let slot = DISPATCH_NODES + depth - 1;
            let reads = lights | set(&[B::SortItems]);
            run(r, frame, clustering, (&pipelines.build_nodes, slot, depth), (reads, nodes));
        }
    });
}

/// Runs a step with the size in a slot of the dispatches.
fn run(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    (pipeline, slot, step): (&Pipeline, u32, u32),
    (reads, writes): (BufferSet, BufferSet),
) {
    r.dispatch(&Dispatch {
        pipeline,
        buffers: frame.buffers(clustering),
        size: Size::Indirect(slot),
        reads,
        writes,
        depth: None,
        push: Push::step(step),
    });
}
