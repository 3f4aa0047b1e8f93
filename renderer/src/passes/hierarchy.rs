//! Stage `build_hierarchy`: the light tree of one clustering, from the candidates.
//!
//! ```text
//! candidates ─> [count_digits ─> digit_offsets ─> reorder] a pass ─> [build_nodes] a depth, from the lights up
//! ```

use super::assign::indirect;
use super::scan::digit_offsets;
use crate::assign::{sort_passes, tree_depth};
use crate::frame::Frame;
use crate::gpu_interface::{DISPATCH_NODES, DISPATCH_SORT};
use crate::pass::Recorder;
use crate::vk::Pipeline;

/// Sorts the candidates by their Morton codes, and makes the tree over them.
pub fn build_hierarchy(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("build_hierarchy", |r| {
        let pipelines = frame.pipelines.accelerated();
        for step in 0..sort_passes(frame.light_count) {
            sort_step(r, frame, clustering, (step, &pipelines.count_digits));
            digit_offsets(r, frame, clustering);
            sort_step(r, frame, clustering, (step, &pipelines.reorder));
        }
        for depth in (1..tree_depth(frame.light_count)).rev() {
            build_nodes(r, frame, clustering, depth);
        }
    });
}

fn sort_step(r: &mut Recorder, frame: &Frame, clustering: usize, (step, pipeline): (u32, &Pipeline)) {
    let b = &frame.clusterings[clustering].buffers;
    frame.push_step(r, step);
    let reads = [&b.light_spheres, &b.candidates];
    indirect(r, frame, clustering, (pipeline, DISPATCH_SORT), (&reads, &[&b.sort_items, &b.digit_counts]));
}

fn build_nodes(r: &mut Recorder, frame: &Frame, clustering: usize, depth: u32) {
    let b = &frame.clusterings[clustering].buffers;
    frame.push_step(r, depth);
    let reads = [&b.light_spheres, &b.candidates, &b.sort_items];
    let writes = [&b.tree_spheres, &b.tree_lights, &b.light_nodes];
    let pipeline = &frame.pipelines.accelerated().build_nodes;
    indirect(r, frame, clustering, (pipeline, DISPATCH_NODES + depth - 1), (&reads, &writes));
}
