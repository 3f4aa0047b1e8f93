//! The frame: which passes run, in which order, for every method. Nothing is reordered, so what is written here is what is
//! measured.
//!
//! ```text
//! host lights ──lights──> Lights ─┐
//! scene ──(cull)──> draws         ├─ the method's groups ─> LightLists ─┐
//!            └──────────depth──> Depth ─┘ (where it marks) ─────────────┴─shade──> Color ──resolve
//! ```

use crate::methods::Method;
use crate::pass::Recorder;
use crate::passes::{Frame, cull, depth, lights, readback, resolve, shade};

/// Records the whole frame of a method.
pub fn record(r: &mut Recorder, frame: &Frame, method: &Method) {
    r.scope("frame", |r| {
        let lights = lights::record(r, frame);
        cull::record(r, frame);
        let (depth, lists) = method.record(r, frame, lights);
        if frame.shaded {
            let depth = depth::complete(r, frame, depth);
            let color = shade::record(r, frame, depth, lists);
            resolve::record(r, frame, color);
        }
        readback::states(r, frame);
    });
}
