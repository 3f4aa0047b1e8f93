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
//! The triangles of a mesh are drawn over a screen with a pixel a tile, conservatively, by the device or grown by half a tile; or compute
//! shaders ask, in every tile around the mesh, those that may be seen in it. Pixels leave slices in `shell_ranges`, the least of each
//! half, so that no order matters; or, as in the paper, in the layers of an image, one a light, as many lights at once as the device
//! has layers:
//!
//! ```text
//! batch of lights ─shell─> layers ─copied─> shell_texels ─start_shells─> shell_ranges
//! ```

use super::assign::{clear_lists, count_bits, indirect, meet};
use super::handles::{LightLists, Lights, VisibleClusters};
use super::inputs::Frame;
use super::lights;
use crate::assign::{Assigner, NodeLayout};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::{ASSIGN_WORKGROUP, DISPATCH_LISTS, DISPATCH_MEET, MESH_TILES};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Draw, Recorder, Size};
use crate::pipelines::Shells;
use crate::vk::Image;

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
    let raster = frame.pipelines.clustered().raster();
    each_kind(r, SHELLS, raster.by_kind(&raster.shells), |r, shells| {
        shells_of_mesh(r, frame, visible, shells)
    });
}

/// What is done with the meshes of points and with those of spots, in a stage each.
fn each_kind<T>(
    r: &mut Recorder,
    stages: [&'static str; 2],
    meshes: [&[T]; 2],
    mut of_mesh: impl FnMut(&mut Recorder, &T),
) {
    for (stage, meshes) in stages.into_iter().zip(meshes).filter(|(_, meshes)| !meshes.is_empty()) {
        r.scope(stage, |r| meshes.iter().for_each(|mesh| of_mesh(r, mesh)));
    }
}

fn shells_of_mesh(r: &mut Recorder, frame: &Frame, visible: VisibleClusters, shells: &Shells) {
    let [columns, rows, _] = frame.clusterings[visible.clustering].dimensions;
    let lights = frame.lights.count;
    let declared = (set(&[B::LightFrames]), set(&[B::ShellRanges]));
    match shells {
        Shells::Computed(pipeline) => {
            let size = Size::Workgroups(lights, (columns * rows).div_ceil(MESH_TILES));
            run(r, frame, visible, (pipeline, size), declared);
        }
        Shells::Drawn { start, draw, vertices } => {
            let start = (&**start, Size::Workgroups(lights, 1));
            let draw = Draw {
                pipeline: draw,
                buffers: frame.buffers(visible.clustering),
                size: [columns, rows],
                vertices: *vertices,
                instances: 0..lights,
                layers: frame.shell_layers,
                reads: declared.0,
                writes: declared.1,
            };
            if let Some(layers) = frame.shell_layers {
                draw_batches(r, &draw, layers);
                return run(r, frame, visible, start, (declared.0 | set(&[B::ShellTexels]), declared.1));
            }
            run(r, frame, visible, start, declared);
            r.draw(&draw);
        }
    }
}

/// Draws as many lights at once as there are layers, whose texels are taken to those of all lights.
fn draw_batches(r: &mut Recorder, draw: &Draw, layers: &Image) {
    let texels = draw.buffers.handles[B::ShellTexels as usize];
    let light_bytes = 2 * u64::from(draw.size[0] * draw.size[1]);
    for first in draw.instances.clone().step_by(layers.layers as usize) {
        let instances = first..draw.instances.end.min(first + layers.layers);
        let count = instances.len() as u32;
        r.draw(&Draw { instances, writes: BufferSet::EMPTY, ..draw.clone() });
        r.copy_layers((layers, count), draw.size, (texels, light_bytes * u64::from(first)));
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
    let pipelines = frame.pipelines.clustered();
    each_kind(r, stages, pipelines.raster().by_kind(&pipelines.meet), |r, [meets, _]| {
        meet(r, frame, visible, (meets, DISPATCH_MEET), lists);
    });
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
