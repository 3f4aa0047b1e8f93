//! Stages `mesh_frames`, `shell_points` and `shell_spots`: in which slices of each tile the mesh around each light lies (Örtegren and
//! Persson sections 4.2 and 4.3).
//!
//! ```text
//! lights, mesh_frames ─mesh_frames─> light_frames ─┐
//! mesh_vertices, mesh_triangles ───────────────────┴─shell_*─> shell_ranges ─fill_clusters─> lists
//! ```
//!
//! A mesh is asked triangle by triangle, as a conservative rasteriser would have them, in compute shaders.

use super::handles::{Lights, VisibleClusters};
use super::inputs::Frame;
use super::lights;
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::ASSIGN_WORKGROUP;
use crate::pass::{Dispatch, Recorder, Size};

/// Stages of the shells of points, and of those of spots.
pub const SHELLS: [&str; 2] = ["shell_points", "shell_spots"];

/// The shells of all lights.
pub fn record(r: &mut Recorder, frame: &Frame, _lights: Lights, visible: VisibleClusters) {
    let (clustering, pipelines) = (visible.clustering, frame.pipelines.clustered().raster());
    let run = |r: &mut Recorder, pipeline, size, declared| {
        r.dispatch(&Dispatch::new(pipeline, frame.buffers(clustering), size, declared));
    };
    r.scope("mesh_frames", |r| {
        let size = Size::threads(frame.lights.count, ASSIGN_WORKGROUP);
        let placed = lights::READ | set(&[B::MeshFrames]);
        run(r, &pipelines.frames, size, (placed, set(&[B::LightFrames])));
    });
    let [columns, rows, _] = frame.clusterings[clustering].dimensions;
    let size = Size::Workgroups((columns * rows).div_ceil(ASSIGN_WORKGROUP), frame.lights.count);
    for (stage, pipeline) in SHELLS.into_iter().zip(&pipelines.shells) {
        r.scope(stage, |r| run(r, pipeline, size, (set(&[B::LightFrames]), set(&[B::ShellRanges]))));
    }
}
