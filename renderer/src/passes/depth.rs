//! Stage `depth[v]`, with multiview `depth` for all views: prepass of opaque and masked geometry.

use super::draws::{self, DepthUse, SurfacePass, SurfacePipelines};
use super::handles::Depth;
use super::inputs::{Eyes, Frame};
use crate::buffers::BufferSet;
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;

/// Lays down the depth of all views that `depth` does not cover yet.
pub fn complete(r: &mut Recorder, frame: &Frame, depth: Depth) -> Depth {
    let missing = frame.eyes().filter(|&eyes| !depth.covers(frame, eyes));
    missing.fold(depth, |depth, eyes| depth | record(r, frame, eyes))
}

/// Lays down the depth of some views.
pub fn record(r: &mut Recorder, frame: &Frame, eyes: Eyes) -> Depth {
    r.scope(eyes.stage("depth"), |r| {
        let pass = SurfacePass {
            eyes,
            colors: &[],
            depth: DepthUse::Write,
            draws: &[
                (SurfaceKind::Opaque, SurfacePipelines::One(&frame.pipelines.depth_opaque)),
                (SurfaceKind::Masked, SurfacePipelines::One(&frame.pipelines.depth_masked)),
            ],
            reads: BufferSet::EMPTY,
            writes: BufferSet::EMPTY,
        };
        draws::surfaces(r, frame, &pass);
    });
    Depth::of(frame, eyes)
}
