//! The frame: which passes run, in which order, for every method. Nothing is reordered, so what is written here is what is
//! measured.
//!
//! ```text
//! host lights ──lights──> Lights ─┐
//! scene ──(cull)──> draws         ├─ the method's groups ─> LightLists ─┐
//!            └──────────depth──> Depth ─┘ (where it marks) ─────────────┴─shade──> Color ──resolve
//! deferred:
//!            └────────gbuffer──> GBuffer with its Depth ────────────────┴─light──> lit ──shade (transparent)──> Color
//! ```
//!
//! With overdraw shading lays down depth of its own: there is a prepass only where the method's groups come from it. A G-buffer
//! that is drawn so comes before the groups, and its depth takes the prepass's place.

use crate::methods::Method;
use crate::pass::Recorder;
use crate::passes::{
    Color, Depth, Frame, GBuffer, LightLists, cull, depth, gbuffer, light, lights, readback, resolve, shade,
};
use crate::shading::{Shading, ShadingPipeline};

/// Records the whole frame of a method.
pub fn record(r: &mut Recorder, frame: &Frame, method: &Method) {
    r.scope("frame", |r| {
        let lights = lights::record(r, frame);
        cull::record(r, frame);
        let surfaces = match (frame.pipeline, frame.shading) {
            (ShadingPipeline::Deferred, Shading::Overdraw) if frame.shaded => gbuffer::drawn_over(r, frame),
            _ => GBuffer::NONE,
        };
        let (depth, lists) = method.record(r, frame, (lights, surfaces.depth()));
        if frame.shaded {
            let color = match frame.pipeline {
                ShadingPipeline::Forward => forward(r, frame, depth, lists),
                ShadingPipeline::Deferred => deferred(r, frame, (surfaces, depth), lists),
            };
            resolve::record(r, frame, color);
        }
        readback::states(r, frame);
    });
}

/// Shades every surface where it is drawn.
fn forward(r: &mut Recorder, frame: &Frame, depth: Depth, lists: LightLists) -> Color {
    let depth = match frame.shading {
        Shading::Prepass => Some(depth::complete(r, frame, depth)),
        Shading::Overdraw => None,
    };
    shade::record(r, frame, depth, lists)
}

/// Shades what the G-buffer keeps of surfaces, and what is transparent over it.
fn deferred(
    r: &mut Recorder,
    frame: &Frame,
    (surfaces, depth): (GBuffer, Depth),
    lists: LightLists,
) -> Color {
    let surfaces = match frame.shading {
        Shading::Prepass => {
            let depth = depth::complete(r, frame, depth);
            gbuffer::of_what_is_seen(r, frame, depth)
        }
        Shading::Overdraw => surfaces,
    };
    let lit = light::record(r, frame, surfaces, lists);
    shade::transparent(r, frame, lit, lists)
}
