//! Stages `transform_lights`, `count_lights` and `assign_lights`: which lights meet which visible cluster
//! (Gelderen section 5.3).

use super::scan::dispatch_indirect;
use crate::frame::Frame;
use crate::gpu_interface::{ASSIGN_GROUP, DISPATCH_ASSIGN};
use crate::pass::{Access, Recorder, Use};
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
        let b = &frame.clusterings[clustering].buffers;
        r.access(&[
            Access::buffer(b.light_spheres.handle, Use::ComputeRead),
            Access::buffer(b.visible_clusters.handle, Use::ComputeRead),
            Access::buffer(b.state.handle, Use::ComputeRead),
            Access::buffer(b.segment_counts.handle, Use::ComputeWrite),
            Access::buffer(b.counters.handle, Use::ComputeWrite),
            Access::buffer(b.dispatches.handle, Use::Indirect),
        ]);
        let pipeline = &frame.pipelines.clustered().count_lights;
        frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
        dispatch_indirect(r, b.dispatches.handle, DISPATCH_ASSIGN);
    });
}

/// The lists themselves, each by ascending light.
pub fn assign_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("assign_lights", |r| {
        let b = &frame.clusterings[clustering].buffers;
        r.access(&[
            Access::buffer(b.light_spheres.handle, Use::ComputeRead),
            Access::buffer(b.visible_clusters.handle, Use::ComputeRead),
            Access::buffer(b.state.handle, Use::ComputeRead),
            Access::buffer(b.list_offsets.handle, Use::ComputeRead),
            Access::buffer(b.light_indices.handle, Use::ComputeWrite),
            Access::buffer(b.counters.handle, Use::ComputeWrite),
            Access::buffer(b.dispatches.handle, Use::Indirect),
        ]);
        let pipeline = &frame.pipelines.clustered().assign_lights;
        frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
        dispatch_indirect(r, b.dispatches.handle, DISPATCH_ASSIGN);
    });
}
