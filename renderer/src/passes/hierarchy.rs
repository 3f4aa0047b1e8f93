//! Stage `build_hierarchy`: the light tree of one clustering, from the candidates.
//!
//! ```text
//! candidates ─> [count_digits ─> digit_offsets ─> reorder] a pass ─> [build_nodes] a depth, from the lights up
//! ```

use super::handles::VisibleClusters;
use super::inputs::Frame;
use super::scan::digit_offsets;
use crate::assign::{sort_passes, tree_depth};
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::{DISPATCH_NODES, DISPATCH_SORT};
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Sorts the candidates by their Morton codes, and makes the tree over them.
pub fn build_hierarchy(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    r.scope("build_hierarchy", |r| {
        let pipelines = frame.pipelines.accelerated();
        let run = |r: &mut Recorder, pipeline, (dispatch_size, step), declared| {
            let dispatch = Dispatch::new(
                pipeline,
                frame.buffers(visible.clustering),
                Size::Indirect(dispatch_size),
                declared,
            );
            r.dispatch(&Dispatch { push: Push::step(step), ..dispatch });
        };
        let (state, sorted) = (set(&[B::State]), set(&[B::SortItems, B::DigitCounts]));
        let lights = state | set(&[B::LightVolumes]);
        for step in 0..sort_passes(frame.lights.count) {
            run(r, &pipelines.count_digits, (DISPATCH_SORT, step), (lights, sorted));
            digit_offsets(r, frame, visible, step);
            run(r, &pipelines.reorder, (DISPATCH_SORT, step), (state, sorted));
        }
        let (reads, nodes) =
            (lights | set(&[B::SortItems]), set(&[B::TreeVolumes, B::TreeLights, B::LightNodes]));
        for depth in (1..tree_depth(frame.lights.count)).rev() {
            run(r, &pipelines.build_nodes, (DISPATCH_NODES + depth - 1, depth), (reads, nodes));
        }
    });
}
