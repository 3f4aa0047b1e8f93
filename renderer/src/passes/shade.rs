//! Stages `shade[v] > opaque, masked, transparent`: forward shading through the method's lookup. With multiview `shade`
//! draws opaque and masked surfaces of all views at once, where they look lights up in one clustering; transparent ones are
//! blended view by view, each in its own order.

use super::draws::{self, Pipelines};
use crate::draw_list::SurfaceKind;
use crate::frame::{Eyes, Frame};
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// What is seen where nothing was drawn: a dim night sky, linear, that covers nothing.
pub const BACKGROUND: [f32; 4] = [0.004, 0.006, 0.012, 0.0];

/// Shades some views.
pub fn record(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    r.scope(eyes.stage("shade"), |r| {
        r.scope("opaque", |r| surfaces(r, frame, eyes, SurfaceKind::Opaque));
        r.scope("masked", |r| surfaces(r, frame, eyes, SurfaceKind::Masked));
        r.scope("transparent", |r| {
            let views = match eyes {
                Eyes::One(view) => view..view + 1,
                Eyes::All => 0..frame.targets.len(),
            };
            for view in views {
                surfaces(r, frame, Eyes::One(view), SurfaceKind::Transparent);
            }
        });
    });
}

fn surfaces(r: &mut Recorder, frame: &Frame, eyes: Eyes, kind: SurfaceKind) {
    let view = eyes.first();
    let target = &frame.targets[view];
    let buffers = &frame.clusterings[frame.clustering_of_view(view)].buffers;
    let read = |buffer: &crate::vk::Buffer| Access::buffer(buffer.handle, Use::FragmentRead);
    r.access(&[
        Access::image(target.color.image.handle, vk::ImageAspectFlags::COLOR, Use::Color),
        Access::image(target.depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::DepthTest),
        read(frame.lights),
        read(&buffers.cluster_bits),
        read(&buffers.word_ranks),
        read(&buffers.list_offsets),
        read(&buffers.light_indices),
        Access::buffer(buffers.counters.handle, Use::FragmentWrite),
        Access::buffer(buffers.lights_per_fragment.handle, Use::FragmentWrite),
    ]);
    let first = kind == SurfaceKind::Opaque;
    let color = vk::RenderingAttachmentInfo::default()
        .image_view(draws::attached(&target.color, eyes))
        .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        .load_op(if first { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD })
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32: BACKGROUND } });
    draws::begin_rendering(r, frame, eyes, Some(&color), &draws::depth_attachment(frame, eyes, false));
    let pipelines = Pipelines::ByTextures(&frame.pipelines.shade[kind as usize]);
    draws::draw(r, frame, eyes, pipelines, (kind, true));
    draws::end_rendering(r);
}
