//! Lists by the meshes around lights (Örtegren and Persson sections 4.2 to 4.4), of points, then of spots.
//!
//! ```text
//! lights, mesh_frames ─mesh_frames─> light_frames ─┐
//! mesh_vertices, mesh_triangles ───────────────────┴─┬─shell_*─> shell_ranges ─fill_*─> light_masks, or nodes of linked lists
//!                                                    └─count_*───────────────────────> light_masks
//! light_masks ─count_lights, light_offsets, write_lists─> lists
//! nodes ─sort_lists─> lists
//! ```
//!
//! A mesh is asked triangle by triangle, as a conservative rasteriser would have them, in compute shaders.

use super::assign::{clear_lists, count_bits, indirect, meet};
use super::handles::{LightLists, Lights, VisibleClusters};
use super::inputs::Frame;
use super::lights;
use crate::assign::{Assigner, NodeLayout};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::{ASSIGN_WORKGROUP, DISPATCH_LISTS, DISPATCH_MEET};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Recorder, Size};

/// Stages of the shells of points, and of those of spots.
pub const SHELLS: [&str; 2] = ["shell_points", "shell_spots"];

fn run(
    r: &mut Recorder,
    frame: &Frame,
    visible: VisibleClusters,
    (pipeline, size): (&Pipeline, Size),
    declared: (BufferSet, BufferSet),
) {
    let buffers = frame.buffers(visible.clustering);
    r.dispatch(&Dispatch::new(pipeline, buffers, size, declared));
}

/// The meshes around all lights.
pub fn mesh_frames(r: &mut Recorder, frame: &Frame, _lights: Lights, visible: VisibleClusters) {
    r.scope("mesh_frames", |r| {
        let size = Size::threads(frame.lights.count, ASSIGN_WORKGROUP);
        let frames = (&*frame.pipelines.clustered().raster().frames, size);
        let placed = lights::READ | set(&[B::MeshFrames]);
        run(r, frame, visible, frames, (placed, set(&[B::LightFrames])));
    });
}

/// The shells of all lights.
pub fn shells(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let [columns, rows, _] = frame.clusterings[visible.clustering].dimensions;
    let size = Size::Workgroups((columns * rows).div_ceil(ASSIGN_WORKGROUP), frame.lights.count);
    for (stage, pipeline) in SHELLS.into_iter().zip(&frame.pipelines.clustered().raster().shells) {
        let declared = (set(&[B::LightFrames]), set(&[B::ShellRanges]));
        r.scope(stage, |r| run(r, frame, visible, (pipeline, size), declared));
    }
}

/// Takes lights to the clusters that their meshes meet: makes nodes of them, or sets bits and counts these.
pub fn count_lights(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    r.scope("clear_lists", |r| clear_lists(r, frame, visible));
    let stages = match frame.assigner {
        Assigner::RasterCount => ["count_points", "count_spots"],
        _ => ["fill_points", "fill_spots"],
    };
    let is_linked = frame.lists.links().is_some();
    let lists = match is_linked {
        true => (BufferSet::EMPTY, set(&[B::State, B::ListOffsets, B::LightIndices, B::Counters])),
        false => (set(&[B::State]), set(&[B::LightMasks, B::ListLengths, B::Counters])),
    };
    for (stage, [meets, _]) in stages.into_iter().zip(&frame.pipelines.clustered().meet) {
        r.scope(stage, |r| meet(r, frame, visible, (meets, DISPATCH_MEET), lists));
    }
    if !is_linked {
        r.scope("count_lights", |r| count_bits(r, frame, visible));
    }
}

/// The lists that nodes link, which are sorted where that is wanted.
pub fn linked_lists(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) -> LightLists {
    if let Some(sort) = &frame.pipelines.clustered().raster().sort_nodes {
        let kinds = match frame.lists.links().map(|links| links.node) {
            Some(NodeLayout::Bits32) => set(&[B::LightFrames]),
            Some(NodeLayout::Bits64) | None => BufferSet::EMPTY,
        };
        let declared = (set(&[B::State]) | kinds, set(&[B::ListOffsets, B::LightIndices]));
        r.scope("sort_lists", |r| indirect(r, frame, visible, (sort, DISPATCH_LISTS), declared));
    }
    LightLists::of(visible)
}
