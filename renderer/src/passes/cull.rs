//! Stage `cull[v]`, with multiview `cull` for all views: which instances they may see, as the indirect commands that draw
//! them. Where the host culls, there is none.

use super::inputs::{Draws, Eyes, Frame};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::CULL_WORKGROUP;
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Fills the draw commands of all views, as geometry passes draw them.
pub fn record(r: &mut Recorder, frame: &Frame) {
    frame.eyes().for_each(|eyes| cull(r, frame, eyes));
}

/// Fills the draw commands of some views: of each by itself, and of all at once where a pass draws them so.
fn cull(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    let Draws::Indirect { drawables, .. } = &frame.draws else { return };
    r.scope(eyes.stage("cull"), |r| {
        let mut dispatch = |eyes: Eyes| {
            let view = eyes.first();
            r.dispatch(&Dispatch {
                pipeline: frame.pipelines.cull(),
                buffers: frame.buffers_of_view(view),
                size: Size::threads(drawables.all.len() as u32, CULL_WORKGROUP),
                reads: BufferSet::EMPTY,
                writes: set(&[B::DrawCommands, B::DrawnInstances]),
                depth: None,
                push: Push { view_count: frame.view_count(eyes), ..Push::view(view) },
            });
        };
        // Marking and transparent surfaces are drawn view by view even so.
        if eyes == Eyes::All {
            (0..frame.targets.len()).map(Eyes::One).for_each(&mut dispatch);
        }
        dispatch(eyes);
    });
}
