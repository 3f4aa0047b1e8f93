//! Stage `pixel_clusters[c]` of stills: the marked cluster of each pixel of any camera.

use super::readback::copy;
use crate::frame::Frame;
use crate::gpu_interface::SET_DEPTH;
use crate::pass::{Access, Recorder, Use};
use crate::vk::{Buffer, Pipeline};
use ash::vk;

/// Looks the pixels of `view`'s prepass up in `clustering` and copies what is known of them to `target`.
pub fn record(
    r: &mut Recorder,
    frame: &Frame,
    pipeline: &Pipeline,
    (view, clustering): (usize, usize),
    target: &Buffer,
) {
    r.scope(("pixel_clusters", clustering), |r| {
        let b = &frame.clusterings[clustering].buffers;
        r.access(&[
            Access::image(
                frame.targets[view].depth.image.handle,
                vk::ImageAspectFlags::DEPTH,
                Use::ComputeSample,
            ),
            Access::buffer(b.pixels.handle, Use::ComputeWrite),
            Access::buffer(b.cluster_bits.handle, Use::ComputeRead),
            Access::buffer(b.word_ranks.handle, Use::ComputeRead),
            Access::buffer(b.list_offsets.handle, Use::ComputeRead),
            Access::buffer(b.visible_fragments.handle, Use::ComputeRead),
        ]);
        frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
        frame.push_view(r, view);
        frame.bind_set(r, vk::PipelineBindPoint::COMPUTE, SET_DEPTH, frame.targets[view].depth_set);
        let [width, height] = frame.resolution;
        unsafe { r.context.device.cmd_dispatch(r.commands(), width.div_ceil(8), height.div_ceil(8), 1) };
        copy(r, &b.pixels, target, 0, target.size);
        r.access(&[Access::buffer(target.handle, Use::HostRead)]);
    });
}
