//! Stage `gbuffer_picture[v]` of stills: what a G-buffer holds, drawn to be looked at.

use super::draws::{self, ColorUse, ScreenPass};
use super::handles::GBuffer;
use super::inputs::{Eyes, Frame};
use crate::buffers::BufferSet;
use crate::layouts::Pipeline;
use crate::pass::Recorder;

/// What of a G-buffer there are pictures of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Shown {
    /// Base colours.
    BaseColor,
    /// Normals, whose axes from -1 to 1 are red, green and blue from 0 to 1.
    Normal,
}

impl Shown {
    /// All there are pictures of.
    pub const ALL: [Self; 2] = [Self::BaseColor, Self::Normal];
}

/// Draws a part of the G-buffer of a view over its cleared radiance.
pub fn record(
    r: &mut Recorder,
    frame: &Frame,
    (pipeline, shown): (&Pipeline, Shown),
    (view, surfaces): (usize, GBuffer),
) {
    debug_assert!(surfaces.depth().covers(frame, Eyes::One(view)));
    r.scope(("gbuffer_picture", view), |r| {
        let pass = ScreenPass {
            pipeline,
            radiance: ColorUse::Clear([0.0; 4]),
            step: shown as u32,
            sampled: frame.pipelines.deferred().kept,
            reads: BufferSet::EMPTY,
            writes: BufferSet::EMPTY,
        };
        draws::screen(r, frame, view, &pass);
    });
}
