//! Stage `build_hierarchy`: the light tree of one clustering, from the lights in clustering space.
//!
//! ```text
//! light_spheres ─> [count_digits ─> digit_offsets ─> reorder] a pass ─> [build_nodes] a depth, from the lights up
//! ```

use super::scan::{digit_offsets, dispatch_indirect};
use crate::assign::{sort_passes, tree_depth};
use crate::frame::Frame;
use crate::gpu_interface::{ASSIGN_GROUP, DISPATCH_NODES, DISPATCH_SORT, SORT_BLOCK};
use crate::pass::{Access, Recorder, Use};
use crate::vk::Pipeline;
use ash::vk;

/// Sorts the lights that can meet a cell by their Morton codes, and makes the tree over them.
pub fn build_hierarchy(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("build_hierarchy", |r| {
        let pipelines = frame.pipelines.accelerated();
        for step in 0..sort_passes(frame.light_count) {
            sort_step(r, frame, clustering, (step, &pipelines.count_digits));
            digit_offsets(r, frame, clustering, step);
            sort_step(r, frame, clustering, (step, &pipelines.reorder));
        }
        for depth in (1..tree_depth(frame.light_count)).rev() {
            build_nodes(r, frame, clustering, depth);
        }
    });
}

fn sort_step(r: &mut Recorder, frame: &Frame, clustering: usize, (step, pipeline): (u32, &Pipeline)) {
    let b = &frame.clusterings[clustering].buffers;
    r.access(&[
        Access::buffer(b.light_spheres.handle, Use::ComputeRead),
        Access::buffer(b.sort_items.handle, Use::ComputeWrite),
        Access::buffer(b.digit_counts.handle, Use::ComputeWrite),
        Access::buffer(b.state.handle, Use::ComputeRead),
    ]);
    frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
    frame.push_step(r, step);
    if step == 0 {
        let groups = frame.light_count.div_ceil(SORT_BLOCK).div_ceil(ASSIGN_GROUP);
        unsafe { r.context.device.cmd_dispatch(r.commands, groups, 1, 1) };
    } else {
        r.access(&[Access::buffer(b.dispatches.handle, Use::Indirect)]);
        dispatch_indirect(r, b.dispatches.handle, DISPATCH_SORT);
    }
}

fn build_nodes(r: &mut Recorder, frame: &Frame, clustering: usize, depth: u32) {
    let b = &frame.clusterings[clustering].buffers;
    r.access(&[
        Access::buffer(b.light_spheres.handle, Use::ComputeRead),
        Access::buffer(b.sort_items.handle, Use::ComputeRead),
        Access::buffer(b.state.handle, Use::ComputeRead),
        Access::buffer(b.tree_spheres.handle, Use::ComputeWrite),
        Access::buffer(b.tree_lights.handle, Use::ComputeWrite),
        Access::buffer(b.light_nodes.handle, Use::ComputeWrite),
        Access::buffer(b.dispatches.handle, Use::Indirect),
    ]);
    let pipeline = &frame.pipelines.accelerated().build_nodes;
    frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
    frame.push_step(r, depth);
    dispatch_indirect(r, b.dispatches.handle, DISPATCH_NODES + depth - 1);
}
