//! The frame: which passes run, in which order, for every method. Nothing is reordered, so what is written here is what is
//! measured.
//!
//! ```text
//! host lights ──lights──> Lights ─┐
//! scene ──(cull)──> draws         ├─ the method's groups ─> LightLists ─┐
//!            └──────────depth──> Depth ─┘ (where it marks) ─────────────┴─shade──> Color ──resolve
//! ```
//!
//! With overdraw shading lays down depth of its own: there is a prepass only where the method's groups come from it.

use crate::methods::Method;
use crate::pass::Recorder;
use crate::passes::{Frame, cull, depth, lights, readback, resolve, shade};
use crate::shading::Shading;

/// Records the whole frame of a method.
pub fn record(r: &mut Recorder, frame: &Frame, method: &Method) {
    r.scope("frame", |r| {
        let lights = lights::record(r, frame);
        cull::record(r, frame);
        let (depth, lists) = method.record(r, frame, lights);
        if frame.shaded {
            let depth = match frame.shading {
                Shading::Prepass => Some(depth::complete(r, frame, depth)),
                Shading::Overdraw => None,
            };
            let color = shade::record(r, frame, depth, lists);
            resolve::record(r, frame, color);
        }
        readback::states(r, frame);
    });
}
