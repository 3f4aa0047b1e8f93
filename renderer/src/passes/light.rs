//! Stage `light[v]`: deferred shading of what is seen of opaque and masked surfaces, through the method's lookup: a pass over all
//! pixels reads the G-buffer once, and adds what lights do to what surfaces radiate without any.
//!
//! ```text
//! GBuffer, Depth, LightLists ──(where depth is nearer than the background's)──> light added to the radiance
//! ```
//!
//! It walks the lists as forward shading does, and counts the same; with MSAA it runs for each sample.

use super::draws::{self, ColorUse, ScreenPass};
use super::handles::{Color, GBuffer, LightLists};
use super::inputs::{Eyes, Frame};
use super::shade::COUNTED;
use crate::pass::Recorder;

/// Shades what the G-buffers of all views hold, for which `lists` serve.
pub fn record(r: &mut Recorder, frame: &Frame, surfaces: GBuffer, lists: LightLists) -> Color {
    let pipelines = frame.pipelines.deferred();
    for view in 0..frame.targets.len() {
        debug_assert!(surfaces.depth().covers(frame, Eyes::One(view)));
        debug_assert!(lists.serve(frame, view));
        r.scope(("light", view), |r| {
            let pass = ScreenPass {
                pipeline: &pipelines.light,
                radiance: ColorUse::Keep,
                step: 0,
                sampled: pipelines.kept,
                reads: frame.light_lists(),
                writes: COUNTED,
            };
            draws::screen(r, frame, view, &pass);
        });
    }
    Color::shaded()
}
