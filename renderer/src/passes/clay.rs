//! Stage `clay` of stills: opaque and masked surfaces without their shading, so that every camera sees something.

use super::draws::{self, Pipelines};
use crate::draw_list::SurfaceKind;
use crate::frame::{Eyes, Frame};
use crate::pass::{Access, Recorder, Use};
use crate::pipelines::DebugPipelines;
use ash::vk;

/// Draws one view over its prepass. Alpha becomes the light on the surface, 0 where there is none.
pub fn record(r: &mut Recorder, frame: &Frame, pipelines: &DebugPipelines, view: usize) {
    r.scope(("clay", view), |r| {
        begin_over_prepass(r, frame, view);
        draws::draw(
            r,
            frame,
            Eyes::One(view),
            Pipelines::One(&pipelines.clay[0]),
            (SurfaceKind::Opaque, true),
        );
        draws::draw(
            r,
            frame,
            Eyes::One(view),
            Pipelines::One(&pipelines.clay[1]),
            (SurfaceKind::Masked, true),
        );
        draws::end_rendering(r);
    });
}

/// Opens rendering to a view's colour, cleared to nothing, with its depth for testing.
pub fn begin_over_prepass(r: &mut Recorder, frame: &Frame, view: usize) {
    let target = &frame.targets[view];
    r.access(&[
        Access::image(target.color.image.handle, vk::ImageAspectFlags::COLOR, Use::Color),
        Access::image(target.depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::DepthTest),
    ]);
    let color = vk::RenderingAttachmentInfo::default()
        .image_view(target.color.view)
        .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32: [0.0; 4] } });
    let eyes = Eyes::One(view);
    draws::begin_rendering(r, frame, eyes, Some(&color), &draws::depth_attachment(frame, eyes, false));
}
