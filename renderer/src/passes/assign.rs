//! Stages `transform_lights`, `count_lights` and `assign_lights`: which lights meet which visible cluster
//! (Gelderen section 5.3).
//!
//! ```text
//! brute      light_volumes ──────────────────────────────> meet ┐
//! hierarchy  light_nodes ────────────────────────────────> meet ┼> light_masks ─> list_lengths, then light_indices
//! scatter    candidates ─> groups ─> tiles, group_lights ─> meet ┘
//! ```
//!
//! Where the masks have no room the device sizes the dispatches otherwise: pairs are found twice, counted first and then
//! written, and the lists are sorted.

use super::scan::group_tiles;
use crate::assign::Assigner;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::frame::Frame;
use crate::gpu_interface::{
    ASSIGN_GROUP, DISPATCH_GROUPS, DISPATCH_LISTS, DISPATCH_MASKED, DISPATCH_MEET, DISPATCH_MEET_AGAIN,
    DISPATCH_UNMASKED,
};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Lights into the clustering camera's space.
pub fn transform_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("transform_lights", |r| {
        r.dispatch(&Dispatch {
            pipeline: &frame.pipelines.clustered().transform_lights,
            buffers: frame.buffers(clustering),
            size: Size::threads(frame.light_count, ASSIGN_GROUP),
            reads: set(&[B::Lights]),
            writes: set(&[B::LightVolumes]),
            depth: None,
            push: Push::default(),
        });
    });
}

/// Lengths of the lists.
pub fn count_lights(r: &mut Recorder, frame: &Frame, clustering: usize) {
    r.scope("count_lights", |r| {
        let pipelines = frame.pipelines.clustered();
        let (reads, writes) = (set(&[B::State]), set(&[B::LightMasks, B::ListLengths]));
        indirect(r, frame, clustering, (&pipelines.clear_lists, DISPATCH_LISTS), (reads, writes));
        if frame.assigner == Assigner::Scatter {
            to_groups(r, frame, clustering);
        }
        let writes = set(&[B::LightMasks, B::ListLengths, B::Counters]);
        meet(r, frame, clustering, (&pipelines.count_lights, DISPATCH_MEET), (reads, writes));
        // Brute force writes whole words of bits, and counts as it does.
        if frame.assigner != Assigner::Brute {
            let (reads, writes) = (set(&[B::State, B::LightMasks]), set(&[B::ListLengths]));
            indirect(r, frame, clustering, (&pipelines.read_masks[0], DISPATCH_MASKED), (reads, writes));
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
    let (offsets, indices) = (set(&[B::State, B::ListOffsets]), set(&[B::LightIndices]));
    let reads = offsets | set(&[B::LightMasks, B::Candidates]);
    indirect(r, frame, clustering, (&pipelines.read_masks[1], DISPATCH_MASKED), (reads, indices));
    let writes = indices | set(&[B::ListLengths]);
    meet(r, frame, clustering, (&pipelines.assign_lights, DISPATCH_MEET_AGAIN), (offsets, writes));
}

/// Sorts lists that were written in any order.
pub(crate) fn sort_lists(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let reads = set(&[B::State, B::ListOffsets, B::Candidates]);
    let sort = (&*frame.pipelines.clustered().sort_lists, DISPATCH_UNMASKED);
    indirect(r, frame, clustering, sort, (reads, set(&[B::LightIndices])));
}

/// Takes candidates to groups of visible clusters: counts them, and lists them.
fn to_groups(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let [count, list] = &frame.pipelines.accelerated().scatter_groups;
    let (reads, groups) = (set(&[B::State, B::Candidates]), set(&[B::Groups]));
    indirect(r, frame, clustering, (count, DISPATCH_GROUPS), (reads, groups));
    group_tiles(r, frame, clustering);
    let lists = groups | set(&[B::GroupLights]);
    indirect(r, frame, clustering, (list, DISPATCH_GROUPS), (reads, lists));
}

/// Finds the pairs of light and visible cluster that meet, by what the way at hand has made of the lights.
fn meet(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    dispatch: (&Pipeline, u32),
    (reads, writes): (BufferSet, BufferSet),
) {
    let lights = match frame.assigner {
        Assigner::Brute => set(&[B::LightVolumes]),
        Assigner::Hierarchy => set(&[B::TreeVolumes, B::TreeLights, B::LightNodes]),
        Assigner::Scatter => set(&[B::LightVolumes, B::Groups, B::TileGroups, B::GroupLights]),
    };
    let reads = reads | lights | set(&[B::VisibleClusters]);
    indirect(r, frame, clustering, dispatch, (reads, writes));
}

/// Runs a pipeline with the size in a slot of the dispatches.
fn indirect(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    (pipeline, slot): (&Pipeline, u32),
    (reads, writes): (BufferSet, BufferSet),
) {
    r.dispatch(&Dispatch {
        pipeline,
        buffers: frame.buffers(clustering),
        size: Size::Indirect(slot),
        reads,
        writes,
        depth: None,
        push: Push::default(),
    });
}
