//! Stage `depth[v]`, with multiview `depth` for all views: prepass of opaque and masked geometry.

use super::draws::{self, DepthUse, SurfacePass, SurfacePipelines};
use crate::buffers::BufferSet;
use crate::draw_list::SurfaceKind;
use crate::frame::{Eyes, Frame};
use crate::pass::Recorder;

/// Lays down the depth of some views.
pub fn record(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
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
}
