//! What the self-test measures on the device by itself: shaders that write what they find into `measurements`.

use super::draws::{self, DepthUse, SurfacePass, SurfacePipelines};
use super::inputs::{Eyes, Frame};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::draw_list::SurfaceKind;
use crate::gpu_interface::ASSIGN_WORKGROUP;
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Runs a compute probe with a thread for each of `items`, which it is told.
pub fn compute(r: &mut Recorder, frame: &Frame, pipeline: &Pipeline, items: u32) {
    let size = Size::threads(items, ASSIGN_WORKGROUP);
    let declared = (BufferSet::EMPTY, set(&[B::Measurements]));
    r.dispatch(&Dispatch {
        push: Push::step(items),
        ..Dispatch::new(pipeline, frame.buffers(0), size, declared)
    });
}

/// Draws the first view's opaque surfaces once more by a probe, where its depth shows them.
pub fn surfaces(r: &mut Recorder, frame: &Frame, pipeline: &Pipeline) {
    r.clear(&frame.clusterings[0].buffers[B::Measurements]);
    let pass = SurfacePass {
        eyes: Eyes::One(0),
        colors: &[],
        depth: DepthUse::Test,
        draws: &[(SurfaceKind::Opaque, SurfacePipelines::One(pipeline))],
        reads: BufferSet::EMPTY,
        writes: set(&[B::Measurements]),
    };
    draws::surfaces(r, frame, &pass);
}
