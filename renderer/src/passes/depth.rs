//! Stage `depth[v]`: prepass of opaque and masked geometry.

use super::draws;
use crate::draw_list::SurfaceKind;
use crate::frame::Frame;
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Lays down one view's depth.
pub fn record(r: &mut Recorder, frame: &Frame, view: usize) {
    r.scope(("depth", view), |r| {
        let target = &frame.targets[view];
        r.access(&[Access::image(target.depth.handle, vk::ImageAspectFlags::DEPTH, Use::Depth)]);
        draws::begin_rendering(r, frame, None, &draws::depth_attachment(frame, view, true));
        draws::draw(r, frame, view, &frame.pipelines.depth_opaque, (SurfaceKind::Opaque, false));
        draws::draw(r, frame, view, &frame.pipelines.depth_masked, (SurfaceKind::Masked, true));
        draws::end_rendering(r);
    });
}
