//! Stages `transform_lights`, `count_lights` and `assign_lights`: which lights meet which visible cluster
//! (Gelderen section 5.3). Lists by offsets, by any way, and other lists by hierarchy and scatter:
//!
//! ```text
//! brute       light_volumes ──────────────────────────────> meet ┐
//! hierarchy   light_nodes ────────────────────────────────> meet ┼> light_masks ─> list_lengths, then light_indices
//! scatter     candidates ─> groups ─> packets, group_lights ─> meet ┤
//! rectangles  light_rectangles, cluster_bits ─────────────> meet ┤
//! raster      shell_ranges, or meshes themselves ─────────> meet ┘
//! ```
//!
//! Rectangles call the stages `light_rectangles`, `count_rectangles` and `fill_rectangles` (Tegelaers section 5.2). Meshes have
//! stages of their own, of each kind of light ([`raster`]).
//!
//! Where the masks have no room the device sizes the dispatches otherwise: pairs are found twice, counted first and then
//! written, and the lists are sorted. Lists that are not by offsets are empty then, which the host refuses.
//!
//! Brute force makes lists that are not by offsets at once, and counts nothing before:
//!
//! ```text
//! light_volumes ──collect──> list_lengths, light_indices (list_offsets)
//! ```

use super::handles::{LightLists, Lights, VisibleClusters};
use super::inputs::Frame;
use super::lights;
use super::raster;
use super::scan::group_packets;
use crate::assign::{Assigner, ClusterBounds, ListStore};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::geometry::ConeTest;
use crate::gpu_interface::{
    ASSIGN_WORKGROUP, DISPATCH_GROUPS, DISPATCH_LISTS, DISPATCH_MASKED, DISPATCH_MEET, DISPATCH_MEET_AGAIN,
    DISPATCH_UNMASKED,
};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Recorder, Size};

/// Lights into the clustering camera's space.
pub fn transform_lights(r: &mut Recorder, frame: &Frame, _lights: Lights, visible: VisibleClusters) {
    r.scope("transform_lights", |r| {
        r.dispatch(&Dispatch::new(
            &frame.pipelines.clustered().transform_lights,
            frame.buffers(visible.clustering),
            Size::threads(frame.lights.count, ASSIGN_WORKGROUP),
            (lights::READ, set(&[B::LightVolumes])),
        ));
    });
}

/// The cells in which each light is seen.
pub fn light_rectangles(r: &mut Recorder, frame: &Frame, _lights: Lights, visible: VisibleClusters) {
    r.scope("light_rectangles", |r| {
        r.dispatch(&Dispatch::new(
            frame.pipelines.clustered().light_rectangles(),
            frame.buffers(visible.clustering),
            Size::threads(frame.lights.count, ASSIGN_WORKGROUP),
            (lights::READ, set(&[B::LightRectangles])),
        ));
    });
}

/// Names of the stages that count the lights of lists, and write them.
fn stages(assigner: Assigner) -> [&'static str; 2] {
    match assigner {
        Assigner::Brute | Assigner::Hierarchy | Assigner::Scatter => ["count_lights", "assign_lights"],
        Assigner::Rectangles => ["count_rectangles", "fill_rectangles"],
        Assigner::Raster | Assigner::RasterCount => ["count_lights", "write_lists"],
    }
}

/// Lengths of the lists.
pub fn count_lights(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    if frame.assigner.rasterises() {
        return raster::count_lights(r, frame, visible);
    }
    let [stage, _] = stages(frame.assigner);
    r.scope(stage, |r| {
        let pipelines = frame.pipelines.clustered();
        clear_lists(r, frame, visible);
        if frame.assigner == Assigner::Scatter {
            to_groups(r, frame, visible);
        }
        let writes = set(&[B::LightMasks, B::ListLengths, B::Counters]);
        for [meets, _] in &pipelines.meet {
            meet(r, frame, visible, (meets, DISPATCH_MEET), (set(&[B::State]), writes));
        }
        // The others count a packet's lights as they set their bits.
        if matches!(frame.assigner, Assigner::Hierarchy | Assigner::Rectangles) {
            count_bits(r, frame, visible);
        }
    });
}

/// Empties what counting adds to.
pub(super) fn clear_lists(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let writes = match frame.lists {
        ListStore::Linked(_) => set(&[B::ListOffsets]),
        ListStore::Offsets | ListStore::Fixed(_) | ListStore::Capped(_) => {
            set(&[B::LightMasks, B::ListLengths])
        }
    };
    let clear = (&*frame.pipelines.clustered().clear_lists, DISPATCH_LISTS);
    indirect(r, frame, visible, clear, (set(&[B::State]), writes));
}

/// Lengths of lists from their bits.
pub(super) fn count_bits(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let (reads, writes) = (set(&[B::State, B::LightMasks]), set(&[B::ListLengths]));
    let read_masks = (&*frame.pipelines.clustered().read_masks[0], DISPATCH_MASKED);
    indirect(r, frame, visible, read_masks, (reads, writes));
}

/// The lists themselves, each by ascending light.
pub fn assign_lights(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) -> LightLists {
    let [_, stage] = stages(frame.assigner);
    r.scope(stage, |r| match (frame.lists, frame.assigner) {
        (ListStore::Offsets, _) => {
            write_lists(r, frame, visible);
            sort_lists(r, frame, visible);
        }
        (ListStore::Fixed(_) | ListStore::Capped(_), Assigner::Brute) => collect(r, frame, visible),
        (ListStore::Fixed(_) | ListStore::Capped(_), _) => keep_lists(r, frame, visible),
        // Nodes have linked them.
        (ListStore::Linked(_), _) => {}
    });
    LightLists::of(visible)
}

/// What keeping a list writes, in a store without offsets that are summed.
const KEPT: BufferSet = set(&[B::State, B::ListOffsets, B::ListLengths, B::LightIndices]);

/// Takes all lights to all lists, in order.
fn collect(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let writes = KEPT | set(&[B::Counters]);
    let pipeline = frame.pipelines.clustered().collect();
    meet(r, frame, visible, (pipeline, DISPATCH_LISTS), (BufferSet::EMPTY, writes));
}

/// Reads lists off their bits, to where their store has them.
fn keep_lists(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let writes = match frame.lists {
        ListStore::Capped(_) => KEPT | set(&[B::Counters]),
        ListStore::Offsets | ListStore::Fixed(_) | ListStore::Linked(_) => KEPT,
    };
    let read_masks = (&*frame.pipelines.clustered().read_masks[1], DISPATCH_LISTS);
    indirect(r, frame, visible, read_masks, (set(&[B::LightMasks, B::Candidates]), writes));
}

/// Writes the lists: off their bits, in order, or else pair by pair, in any order.
pub(crate) fn write_lists(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let pipelines = frame.pipelines.clustered();
    let (offsets, indices) = (set(&[B::State, B::ListOffsets]), set(&[B::LightIndices]));
    let reads = offsets | set(&[B::LightMasks, B::Candidates]);
    indirect(r, frame, visible, (&pipelines.read_masks[1], DISPATCH_MASKED), (reads, indices));
    let writes = indices | set(&[B::ListLengths]);
    for [_, meets] in &pipelines.meet {
        meet(r, frame, visible, (meets, DISPATCH_MEET_AGAIN), (offsets, writes));
    }
}

/// Sorts lists that were written in any order.
pub(crate) fn sort_lists(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let reads = set(&[B::State, B::ListOffsets, B::Candidates]);
    let sort = (&*frame.pipelines.clustered().sort_lists, DISPATCH_UNMASKED);
    indirect(r, frame, visible, sort, (reads, set(&[B::LightIndices])));
}

/// Takes candidates to groups of visible clusters: counts them, and lists them.
fn to_groups(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let [count, list] = &frame.pipelines.accelerated().scatter_groups;
    let (reads, groups) = (set(&[B::State, B::Candidates]), set(&[B::Groups]));
    indirect(r, frame, visible, (count, DISPATCH_GROUPS), (reads, groups));
    group_packets(r, frame, visible);
    let lists = groups | set(&[B::GroupLights]);
    indirect(r, frame, visible, (list, DISPATCH_GROUPS), (reads, lists));
}

/// Finds the pairs of light and visible cluster that meet, by what the way at hand has made of the lights.
pub(super) fn meet(
    r: &mut Recorder,
    frame: &Frame,
    visible: VisibleClusters,
    dispatch: (&Pipeline, u32),
    (reads, writes): (BufferSet, BufferSet),
) {
    let cells = set(&[B::VisibleClusters, B::ClusterBounds, B::ClusterCones]) | boxes(frame) | cones(frame);
    let met = match frame.assigner {
        Assigner::Brute => cells | set(&[B::LightVolumes]),
        Assigner::Hierarchy => cells | set(&[B::TreeVolumes, B::TreeLights, B::LightNodes]),
        Assigner::Scatter => cells | set(&[B::LightVolumes, B::Groups, B::PacketGroups, B::GroupLights]),
        Assigner::Raster => frame.places() | set(&[B::LightFrames, B::ShellRanges]),
        Assigner::RasterCount => frame.places() | set(&[B::LightFrames]),
        Assigner::Rectangles => frame.places() | set(&[B::LightRectangles]) | measured(frame),
    };
    let reads = reads | met;
    indirect(r, frame, visible, dispatch, (reads, writes));
}

/// What is measured of clusters and the lights that are tested against it, or against cells with their cones, where either is.
fn measured(frame: &Frame) -> BufferSet {
    match (frame.bounds, frame.cones) {
        (ClusterBounds::Cell, ConeTest::Unasked) => BufferSet::EMPTY,
        _ => lights::READ | set(&[B::VisibleClusters, B::ClusterBounds, B::ClusterCones]),
    }
}

/// The lights whose cones are asked, or, by normal cones, where they stand.
fn cones(frame: &Frame) -> BufferSet {
    match frame.cones {
        ConeTest::Unasked if !frame.normal_cones.are_on() => BufferSet::EMPTY,
        ConeTest::Unasked => set(&[B::Lights]),
        ConeTest::Separating | ConeTest::Exact => lights::READ,
    }
}

/// The boxes around cells, where a cluster's cell is tested.
fn boxes(frame: &Frame) -> BufferSet {
    match frame.bounds {
        ClusterBounds::Cell => set(&[B::ClusterBoxes]),
        ClusterBounds::Depth | ClusterBounds::Box => BufferSet::EMPTY,
    }
}

/// Runs a pipeline with a size that the device wrote.
pub(super) fn indirect(
    r: &mut Recorder,
    frame: &Frame,
    visible: VisibleClusters,
    (pipeline, size): (&Pipeline, u32),
    declared: (BufferSet, BufferSet),
) {
    let buffers = frame.buffers(visible.clustering);
    r.dispatch(&Dispatch::new(pipeline, buffers, Size::Indirect(size), declared));
}
