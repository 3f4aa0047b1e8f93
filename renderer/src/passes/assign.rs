//! Stages `transform_lights`, `count_lights` and `assign_lights`: which lights meet which visible cluster
//! (Gelderen section 5.3).
//!
//! ```text
//! brute      light_spheres ──────────────────────────────> meet ┐
//! hierarchy  light_nodes ────────────────────────────────> meet ┼> light_masks ─> list_lengths, then light_indices
//! scatter    candidates ─> groups ─> tiles, group_lights ─> meet ┘
//! ```
//!
//! Where the masks have no room the device sizes the dispatches otherwise: pairs are found twice, counted first and then
//! written, and the lists are sorted.

use super::scan::{dispatch_indirect, group_tiles};
use crate::assign::Assigner;
use crate::clustering::ClusteringBuffers;
use crate::frame::Frame;
use crate::gpu_interface::{
    ASSIGN_GROUP, DISPATCH_GROUPS, DISPATCH_LISTS, DISPATCH_MASKED, DISPATCH_MEET, DISPATCH_MEET_AGAIN,
    DISPATCH_UNMASKED,
};
use crate::pass::{Access, Recorder, Use};
use crate::vk::{Buffer, Pipeline};
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
        unsafe { r.context.device.cmd_dispatch(r.commands(), groups, 1, 1) };
    });
}

/// Lengths of the lists.
pub fn count_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("count_lights", |r| {
        let pipelines = frame.pipelines.clustered();
        per_list(r, frame, clustering, (&pipelines.clear_lists, DISPATCH_LISTS));
        if frame.assigner == Assigner::Scatter {
            let [count, list] = &frame.pipelines.accelerated().scatter_groups;
            to_groups(r, frame, clustering, count);
            group_tiles(r, frame, clustering);
            to_groups(r, frame, clustering, list);
        }
        meet(r, frame, clustering, (&pipelines.count_lights, DISPATCH_MEET));
        // Brute force writes whole words of bits, and counts as it does.
        if frame.assigner != Assigner::Brute {
            per_list(r, frame, clustering, (&pipelines.read_masks[0], DISPATCH_MASKED));
        }
    });
}

/// The lists themselves, each by ascending light.
pub fn assign_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("assign_lights", |r| {
        write_lists(r, frame, clustering);
        sort_lists(r, frame, clustering);
    });
}

/// Writes the lists: off their bits, in order, or else pair by pair, in any order.
pub(crate) fn write_lists(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let pipelines = frame.pipelines.clustered();
    per_list(r, frame, clustering, (&pipelines.read_masks[1], DISPATCH_MASKED));
    meet(r, frame, clustering, (&pipelines.assign_lights, DISPATCH_MEET_AGAIN));
}

/// Sorts lists that were written in any order.
pub(crate) fn sort_lists(r: &mut Recorder, frame: &Frame, clustering: usize) {
    per_list(r, frame, clustering, (&frame.pipelines.clustered().sort_lists, DISPATCH_UNMASKED));
}

/// Takes candidates to groups of visible clusters: counts them, or lists them.
fn to_groups(r: &mut Recorder, frame: &Frame, clustering: usize, pipeline: &Pipeline) {
    let b = &frame.clusterings[clustering].buffers;
    indirect(
        r,
        frame,
        clustering,
        (pipeline, DISPATCH_GROUPS),
        (&[&b.candidates], &[&b.light_nodes, &b.tree_lights]),
    );
}

/// Finds the pairs of light and visible cluster that meet.
fn meet(r: &mut Recorder, frame: &Frame, clustering: usize, dispatch: (&Pipeline, u32)) {
    let b = &frame.clusterings[clustering].buffers;
    let reads = [
        &b.light_spheres,
        &b.visible_clusters,
        &b.list_offsets,
        &b.candidates,
        &b.digit_counts,
        &b.tree_spheres,
        &b.tree_lights,
        &b.light_nodes,
    ];
    let writes = [&b.light_masks, &b.list_lengths, &b.light_indices, &b.counters];
    indirect(r, frame, clustering, dispatch, (&reads, &writes));
}

/// Runs a pipeline that works on each list by itself.
fn per_list(r: &mut Recorder, frame: &Frame, clustering: usize, dispatch: (&Pipeline, u32)) {
    let b = &frame.clusterings[clustering].buffers;
    let writes = [&b.light_masks, &b.list_lengths, &b.light_indices];
    indirect(r, frame, clustering, dispatch, (&[&b.list_offsets, &b.candidates], &writes));
}

/// Runs a pipeline with the size in a slot of the dispatches, after what it reads and what it writes (and may read).
pub(super) fn indirect(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    (pipeline, slot): (&Pipeline, u32),
    (reads, writes): (&[&Buffer], &[&Buffer]),
) {
    let ClusteringBuffers { state, dispatches, .. } = &frame.clusterings[clustering].buffers;
    r.access(&[
        Access::buffer(state.handle, Use::ComputeRead),
        Access::buffer(dispatches.handle, Use::Indirect),
    ]);
    for buffer in reads {
        r.access(&[Access::buffer(buffer.handle, Use::ComputeRead)]);
    }
    for buffer in writes {
        r.access(&[Access::buffer(buffer.handle, Use::ComputeWrite)]);
    }
    frame.bind_clustering(r, vk::PipelineBindPoint::COMPUTE, pipeline, clustering);
    dispatch_indirect(r, dispatches.handle, slot);
}
