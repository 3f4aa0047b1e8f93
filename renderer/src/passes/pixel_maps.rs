//! What is known of each pixel of a view, for images; atemporal runs alone.

use crate::frame::Frame;
use crate::gpu_interface::{PixelData, SET_DEPTH};
use crate::pass::{Access, Recorder, Use};
use crate::passes::readback::copy;
use crate::vk::Buffer;
use ash::vk;

/// Bytes of a view's colour (half RGBA) and, behind it, of its [`PixelData`].
pub fn view_bytes([width, height]: [u32; 2]) -> [u64; 2] {
    let pixels = u64::from(width) * u64::from(height);
    [8 * pixels, size_of::<PixelData>() as u64 * pixels]
}

/// Copies one view's colour and pixel data to `target`, which holds [`view_bytes`].
pub fn record(r: &mut Recorder, frame: &Frame, view: usize, target: &Buffer) {
    let [color_bytes, pixel_bytes] = view_bytes(frame.resolution);
    let pixels = &frame.clusterings[frame.clustering_of_view(view)].buffers.pixels;
    compute(r, frame, view);
    copy(r, pixels, target, color_bytes, pixel_bytes);
    copy_color(r, frame, view, target);
    r.access(&[Access::buffer(target.handle, Use::HostRead)]);
}

fn compute(r: &mut Recorder, frame: &Frame, view: usize) {
    let target = &frame.targets[view];
    let b = &frame.clusterings[frame.clustering_of_view(view)].buffers;
    r.access(&[
        Access::image(target.depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::ComputeSample),
        Access::buffer(b.pixels.handle, Use::ComputeWrite),
        Access::buffer(b.cluster_bits.handle, Use::ComputeRead),
        Access::buffer(b.word_ranks.handle, Use::ComputeRead),
        Access::buffer(b.list_offsets.handle, Use::ComputeRead),
        Access::buffer(b.visible_fragments.handle, Use::ComputeRead),
    ]);
    frame.bind(r, vk::PipelineBindPoint::COMPUTE, &frame.pipelines.pixel_maps, view);
    frame.bind_set(r, vk::PipelineBindPoint::COMPUTE, SET_DEPTH, target.depth_set);
    let [width, height] = frame.resolution;
    unsafe { r.context.device.cmd_dispatch(r.commands(), width.div_ceil(8), height.div_ceil(8), 1) };
}

/// Copies a view's colour, one sample a pixel, to the start of `target`.
pub fn copy_color(r: &mut Recorder, frame: &Frame, view: usize, target: &Buffer) {
    let targets = &frame.targets[view];
    let source = targets.resolved.as_ref().unwrap_or(&targets.color);
    r.access(&[
        Access::image(source.image.handle, vk::ImageAspectFlags::COLOR, Use::TransferRead),
        Access::buffer(target.handle, Use::TransferWrite),
    ]);
    let [width, height] = frame.resolution;
    let region = vk::BufferImageCopy::default()
        .image_subresource(source.color())
        .image_extent(vk::Extent3D { width, height, depth: 1 });
    unsafe {
        r.context.device.cmd_copy_image_to_buffer(
            r.commands(),
            source.image.handle,
            vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            target.handle,
            &[region],
        );
    }
}
