//! Stage `depth[v]`, with multiview `depth` for all views: prepass of opaque and masked geometry.

use super::draws::{self, Pipelines};
use crate::draw_list::SurfaceKind;
use crate::frame::{Eyes, Frame};
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Lays down the depth of some views.
pub fn record(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    r.scope(eyes.stage("depth"), |r| {
        let target = &frame.targets[eyes.first()];
        r.access(&[Access::image(target.depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::Depth)]);
        draws::begin_rendering(r, frame, eyes, None, &draws::depth_attachment(frame, eyes, true));
        draws::draw(
            r,
            frame,
            eyes,
            Pipelines::One(&frame.pipelines.depth_opaque),
            (SurfaceKind::Opaque, false),
        );
        draws::draw(
            r,
            frame,
            eyes,
            Pipelines::One(&frame.pipelines.depth_masked),
            (SurfaceKind::Masked, true),
        );
        draws::end_rendering(r);
    });
}
