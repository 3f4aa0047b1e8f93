//! Stage `mark[v]`: which clusters hold visible fragments (Gelderen section 5.2). In atemporal runs the same
//! fragments are visited once more, when clusters are ranked, to count those of each visible cluster.

use super::draws::{self, Pipelines};
use crate::config::Marking;
use crate::draw_list::SurfaceKind;
use crate::frame::{Eyes, Frame};
use crate::gpu_interface::SET_DEPTH;
use crate::pass::{Access, Recorder, Use};
use crate::pipelines::MarkPipelines;
use crate::vk::Buffer;
use ash::vk;

/// Marks the clusters of one view's fragments: opaque and masked ones from the depth buffer or from their
/// geometry, transparent ones always from their geometry.
pub fn record(r: &mut Recorder, frame: &Frame, clustering: usize, view: usize) {
    r.scope(("mark", view), |r| {
        let clustering = &frame.clusterings[clustering];
        let bits = &clustering.buffers.cluster_bits;
        if view == clustering.views.start {
            clear(r, bits);
        }
        visit(r, frame, view, &frame.pipelines.clustered().mark, bits);
    });
}

/// Counts the fragments of each visible cluster, of all views; atemporal runs alone, after the frame.
pub fn count_fragments(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let clustering = &frame.clusterings[clustering];
    let counts = &clustering.buffers.visible_fragments;
    clear(r, counts);
    for ranks in [&clustering.buffers.cluster_bits, &clustering.buffers.word_ranks] {
        let read = |usage| Access::buffer(ranks.handle, usage);
        r.access(&[read(Use::ComputeRead), read(Use::FragmentRead)]);
    }
    for view in clustering.views.clone() {
        visit(r, frame, view, &frame.pipelines.clustered().count_fragments, counts);
    }
}

fn clear(r: &mut Recorder, buffer: &Buffer) {
    r.access(&[Access::buffer(buffer.handle, Use::TransferWrite)]);
    unsafe { r.context.device.cmd_fill_buffer(r.commands(), buffer.handle, 0, vk::WHOLE_SIZE, 0) };
}

/// Visits the cluster of every fragment of a view; what is found goes to `written`.
fn visit(r: &mut Recorder, frame: &Frame, view: usize, pipelines: &MarkPipelines, written: &Buffer) {
    let kinds = match frame.marking {
        Marking::Depth => {
            from_depth(r, frame, view, pipelines, written);
            &[SurfaceKind::Transparent][..]
        }
        Marking::Geometry => &SurfaceKind::ALL[..],
    };
    if kinds.iter().any(|&kind| frame.draws_any(Eyes::One(view), kind)) {
        from_geometry(r, frame, (view, kinds), pipelines, written);
    }
}

fn from_depth(r: &mut Recorder, frame: &Frame, view: usize, pipelines: &MarkPipelines, written: &Buffer) {
    let target = &frame.targets[view];
    r.access(&[
        Access::image(target.depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::ComputeSample),
        Access::buffer(written.handle, Use::ComputeWrite),
    ]);
    frame.bind(r, vk::PipelineBindPoint::COMPUTE, &pipelines.depth, view);
    frame.bind_set(r, vk::PipelineBindPoint::COMPUTE, SET_DEPTH, target.depth_set);
    let [width, height] = frame.resolution;
    unsafe { r.context.device.cmd_dispatch(r.commands(), width.div_ceil(8), height.div_ceil(8), 1) };
}

fn from_geometry(
    r: &mut Recorder,
    frame: &Frame,
    (view, kinds): (usize, &[SurfaceKind]),
    pipelines: &MarkPipelines,
    written: &Buffer,
) {
    r.access(&[
        Access::image(frame.targets[view].depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::DepthTest),
        Access::buffer(written.handle, Use::FragmentWrite),
    ]);
    let eyes = Eyes::One(view);
    draws::begin_rendering(r, frame, eyes, None, &draws::depth_attachment(frame, eyes, false));
    for &kind in kinds {
        draws::draw(r, frame, eyes, Pipelines::One(&pipelines.geometry[kind as usize]), (kind, false));
    }
    draws::end_rendering(r);
}
