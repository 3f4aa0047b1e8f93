//! Stage `mark[v]`: which clusters hold visible fragments (Gelderen section 5.2).

use super::draws;
use crate::clustering::Clustering;
use crate::config::Marking;
use crate::draw_list::SurfaceKind;
use crate::frame::Frame;
use crate::gpu_interface::SET_DEPTH;
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Marks the clusters of one view's fragments: opaque and masked ones from the depth buffer or from their
/// geometry, transparent ones always from their geometry.
pub fn record(r: &mut Recorder, frame: &Frame, clustering: usize, view: usize) {
    r.scope(("mark", view), |r| {
        let buffers = &frame.clusterings[clustering];
        if view == buffers.views.start {
            clear(r, buffers);
        }
        let list = &frame.draw_lists[view];
        let geometry = match frame.marking {
            Marking::Depth => {
                from_depth(r, frame, buffers, view);
                &[SurfaceKind::Transparent][..]
            }
            Marking::Geometry => &SurfaceKind::ALL[..],
        };
        if geometry.iter().any(|&kind| !list.runs(kind).is_empty()) {
            from_geometry(r, frame, buffers, view, geometry);
        }
    });
}

fn clear(r: &mut Recorder, clustering: &Clustering) {
    let buffers = &clustering.buffers;
    r.access(&[
        Access::buffer(buffers.cluster_bits.handle, Use::TransferWrite),
        Access::buffer(buffers.fragment_counts.handle, Use::TransferWrite),
    ]);
    let device = &r.context.device;
    unsafe {
        device.cmd_fill_buffer(r.commands, buffers.cluster_bits.handle, 0, vk::WHOLE_SIZE, 0);
        if clustering.counting {
            device.cmd_fill_buffer(r.commands, buffers.fragment_counts.handle, 0, vk::WHOLE_SIZE, 0);
        }
    }
}

fn from_depth(r: &mut Recorder, frame: &Frame, clustering: &Clustering, view: usize) {
    let target = &frame.targets[view];
    r.access(&[
        Access::image(target.depth.handle, vk::ImageAspectFlags::DEPTH, Use::ComputeSample),
        Access::buffer(clustering.buffers.cluster_bits.handle, Use::ComputeWrite),
        Access::buffer(clustering.buffers.fragment_counts.handle, Use::ComputeWrite),
    ]);
    frame.bind(r, vk::PipelineBindPoint::COMPUTE, &frame.pipelines.clustered().mark_depth, view);
    frame.bind_set(r, vk::PipelineBindPoint::COMPUTE, SET_DEPTH, target.depth_set);
    let [width, height] = frame.resolution;
    unsafe { r.context.device.cmd_dispatch(r.commands, width.div_ceil(8), height.div_ceil(8), 1) };
}

fn from_geometry(
    r: &mut Recorder,
    frame: &Frame,
    clustering: &Clustering,
    view: usize,
    kinds: &[SurfaceKind],
) {
    r.access(&[
        Access::image(frame.targets[view].depth.handle, vk::ImageAspectFlags::DEPTH, Use::DepthTest),
        Access::buffer(clustering.buffers.cluster_bits.handle, Use::FragmentWrite),
        Access::buffer(clustering.buffers.fragment_counts.handle, Use::FragmentWrite),
    ]);
    draws::begin_rendering(r, frame, None, &draws::depth_attachment(frame, view, false));
    for &kind in kinds {
        let pipeline = &frame.pipelines.clustered().mark_geometry[kind as usize];
        draws::draw(r, frame, view, pipeline, frame.draw_lists[view].runs(kind), false);
    }
    draws::end_rendering(r);
}
