//! Stages `transform_lights`, `count_lights` and `assign_lights`: which lights meet which visible cluster
//! (Gelderen section 5.3).

use super::scan::dispatch_indirect;
use crate::assign::Assigner;
use crate::frame::Frame;
use crate::gpu_interface::{ASSIGN_GROUP, DISPATCH_ASSIGN};
use crate::pass::{Access, Recorder, Use};
use crate::vk::Pipeline;
use ash::vk;

/// Lights into the clustering camera's space.
pub fn transform_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("transform_lights", |r| {
        let b = &frame.clusterings[clustering].buffers;
        r.access(&[
            Access::buffer(frame.lights.handle, Use::ComputeRead),
            Access::buffer(b.light_spheres.handle, Use::ComputeWrite),
        ]);
        let pipeline = &frame.pipelines.clustered().transform_lights;
        frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
        let groups = frame.light_count.div_ceil(ASSIGN_GROUP);
        unsafe { r.context.device.cmd_dispatch(r.commands, groups, 1, 1) };
    });
}

/// Lengths of the lists' segments.
pub fn count_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("count_lights", |r| {
        let masked = frame.clusterings[clustering].masked;
        if frame.assigner != Assigner::Brute {
            per_list(r, frame, clustering, &frame.pipelines.accelerated().clear_lists);
        }
        meet(r, frame, clustering, &frame.pipelines.clustered().count_lights);
        if masked {
            per_list(r, frame, clustering, &frame.pipelines.accelerated().read_masks[0]);
        }
    });
}

/// The lists themselves, each by ascending light.
pub fn assign_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("assign_lights", |r| {
        if frame.clusterings[clustering].masked {
            per_list(r, frame, clustering, &frame.pipelines.accelerated().read_masks[1]);
            return;
        }
        meet(r, frame, clustering, &frame.pipelines.clustered().assign_lights);
        if frame.assigner != Assigner::Brute {
            per_list(r, frame, clustering, &frame.pipelines.accelerated().sort_lists);
        }
    });
}

/// Finds the pairs of light and visible cluster that meet, and counts or writes them.
fn meet(r: &mut Recorder, frame: &Frame, clustering: usize, pipeline: &Pipeline) {
    let b = &frame.clusterings[clustering].buffers;
    r.access(&[
        Access::buffer(b.light_spheres.handle, Use::ComputeRead),
        Access::buffer(b.visible_clusters.handle, Use::ComputeRead),
        Access::buffer(b.state.handle, Use::ComputeRead),
        Access::buffer(b.list_offsets.handle, Use::ComputeRead),
        Access::buffer(b.segment_counts.handle, Use::ComputeWrite),
        Access::buffer(b.light_indices.handle, Use::ComputeWrite),
        Access::buffer(b.counters.handle, Use::ComputeWrite),
        Access::buffer(b.dispatches.handle, Use::Indirect),
    ]);
    match frame.assigner {
        Assigner::Brute => {}
        Assigner::Hierarchy => r.access(&[
            Access::buffer(b.tree_spheres.handle, Use::ComputeRead),
            Access::buffer(b.tree_lights.handle, Use::ComputeRead),
            Access::buffer(b.light_nodes.handle, Use::ComputeRead),
            Access::buffer(b.light_masks.handle, Use::ComputeWrite),
        ]),
        Assigner::Scatter => r.access(&[
            Access::buffer(b.cluster_bits.handle, Use::ComputeRead),
            Access::buffer(b.word_ranks.handle, Use::ComputeRead),
            Access::buffer(b.light_masks.handle, Use::ComputeWrite),
        ]),
    }
    frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
    if frame.assigner == Assigner::Scatter {
        let groups = frame.light_count.div_ceil(ASSIGN_GROUP);
        unsafe { r.context.device.cmd_dispatch(r.commands, groups, 1, 1) };
    } else {
        dispatch_indirect(r, b.dispatches.handle, DISPATCH_ASSIGN);
    }
}

/// Runs a pipeline with a thread per segment of a list.
fn per_list(r: &mut Recorder, frame: &Frame, clustering: usize, pipeline: &Pipeline) {
    let b = &frame.clusterings[clustering].buffers;
    r.access(&[
        Access::buffer(b.state.handle, Use::ComputeRead),
        Access::buffer(b.list_offsets.handle, Use::ComputeRead),
        Access::buffer(b.segment_counts.handle, Use::ComputeWrite),
        Access::buffer(b.light_masks.handle, Use::ComputeWrite),
        Access::buffer(b.light_indices.handle, Use::ComputeWrite),
        Access::buffer(b.dispatches.handle, Use::Indirect),
    ]);
    frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
    dispatch_indirect(r, b.dispatches.handle, DISPATCH_ASSIGN);
}
