//! Stage `cull[v]`: which instances a view may see, as the indirect commands that draw them. Where the host culls, there
//! is none.

use crate::frame::{Draws, Frame};
use crate::gpu_interface::CULL_GROUP;
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Fills the draw commands of one view.
pub fn record(r: &mut Recorder, frame: &Frame, view: usize) {
    let Draws::Indirect { slots, buffers, .. } = &frame.draws else { return };
    r.scope(("cull", view), |r| {
        r.access(&[
            Access::buffer(buffers.commands.handle, Use::ComputeWrite),
            Access::buffer(buffers.drawn_instances.handle, Use::ComputeWrite),
        ]);
        frame.bind(r, vk::PipelineBindPoint::COMPUTE, frame.pipelines.cull(), view);
        frame.push_step(r, 1);
        let groups = (slots.slots.len() as u32).div_ceil(CULL_GROUP);
        unsafe { r.context.device.cmd_dispatch(r.commands, groups, 1, 1) };
    });
}
