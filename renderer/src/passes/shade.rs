//! Stages `shade[v] > opaque, masked, transparent`: forward shading through the method's lookup.

use super::draws;
use crate::draw_list::SurfaceKind;
use crate::frame::Frame;
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// What is seen where nothing was drawn: a dim night sky, linear.
pub const BACKGROUND: [f32; 4] = [0.004, 0.006, 0.012, 1.0];

/// Shades one view.
pub fn record(r: &mut Recorder, frame: &Frame, view: usize) {
    r.scope(("shade", view), |r| {
        for (kind, stage) in SurfaceKind::ALL.into_iter().zip(["opaque", "masked", "transparent"]) {
            r.scope(stage, |r| surfaces(r, frame, view, kind));
        }
    });
}

fn surfaces(r: &mut Recorder, frame: &Frame, view: usize, kind: SurfaceKind) {
    let target = &frame.targets[view];
    let buffers = &frame.clusterings[frame.clustering_of_view(view)].buffers;
    let read = |buffer: &crate::vk::Buffer| Access::buffer(buffer.handle, Use::FragmentRead);
    r.access(&[
        Access::image(target.color.handle, vk::ImageAspectFlags::COLOR, Use::Color),
        Access::image(target.depth.handle, vk::ImageAspectFlags::DEPTH, Use::DepthTest),
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
        .image_view(target.color.view)
        .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        .load_op(if first { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD })
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32: BACKGROUND } });
    draws::begin_rendering(r, frame, Some(&color), &draws::depth_attachment(frame, view, false));
    let pipeline = &frame.pipelines.shade[kind as usize];
    draws::draw(r, frame, view, pipeline, (kind, true));
    draws::end_rendering(r);
}
