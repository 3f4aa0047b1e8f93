//! Stage `cull[v]`, with multiview `cull` for all views: which instances they may see, as the indirect commands that draw
//! them. Where the host culls, there is none.

use crate::frame::{Draws, Eyes, Frame};
use crate::gpu_interface::CULL_GROUP;
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Fills the draw commands of some views: of each by itself, and of all at once where a pass draws them so.
pub fn record(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    let Draws::Indirect { slots, buffers, .. } = &frame.draws else { return };
    r.scope(eyes.stage("cull"), |r| {
        r.access(&[
            Access::buffer(buffers.commands.handle, Use::ComputeWrite),
            Access::buffer(buffers.drawn_instances.handle, Use::ComputeWrite),
        ]);
        let groups = (slots.slots.len() as u32).div_ceil(CULL_GROUP);
        let dispatch = |eyes: Eyes| {
            frame.bind(r, vk::PipelineBindPoint::COMPUTE, frame.pipelines.cull(), eyes.first());
            frame.push_step(r, frame.view_count(eyes));
            unsafe { r.context.device.cmd_dispatch(r.commands(), groups, 1, 1) };
        };
        // Marking and transparent surfaces are drawn view by view even so.
        if eyes == Eyes::All {
            (0..frame.targets.len()).map(Eyes::One).for_each(&dispatch);
        }
        dispatch(eyes);
    });
}
