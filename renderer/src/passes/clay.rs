//! Stage `clay` of stills: opaque and masked surfaces without their shading, so that every camera sees something.

use super::draws::{self, ColorUse, DepthUse, SurfacePass, SurfacePipelines};
use super::inputs::{Eyes, Frame};
use crate::buffers::BufferSet;
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;
use crate::pipelines::DebugPipelines;
use crate::targets::TargetName;

/// Draws one view over its prepass. Alpha becomes the light on the surface, 0 where there is none.
pub fn record(r: &mut Recorder, frame: &Frame, pipelines: &DebugPipelines, view: usize) {
    r.scope(("clay", view), |r| {
        let [opaque, masked] = pipelines.clay.each_ref().map(|pipeline| SurfacePipelines::One(pipeline));
        let pass = SurfacePass {
            eyes: Eyes::One(view),
            colors: &[(TargetName::Radiance, ColorUse::Clear([0.0; 4]))],
            depth: DepthUse::Test,
            draws: &[(SurfaceKind::Opaque, opaque), (SurfaceKind::Masked, masked)],
            reads: BufferSet::EMPTY,
            writes: BufferSet::EMPTY,
        };
        draws::surfaces(r, frame, &pass);
    });
}
