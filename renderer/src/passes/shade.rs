//! Stages `shade[v] > opaque, masked, transparent`: forward shading through the method's lookup. With multiview `shade`
//! draws opaque and masked surfaces of all views at once, where they look lights up in one clustering; transparent ones are
//! blended view by view, each in its own order. Deferred shading leaves transparent ones alone to it.
//!
//! ```text
//! prepass   Depth ──(equal)──> opaque, masked ──(nearer)──> transparent ──> Color
//! overdraw  depth cleared ──(nearer, written)──> opaque, masked ──(nearer)──> transparent ──> Color
//! ```
//!
//! With overdraw, masked surfaces are alpha tested here, and so their depth is tested once their fragments ran, which counters
//! must not see. Where all is counted they are therefore drawn twice: first counted, tested early against opaque depth and
//! leaving none; then as in temporal runs. Of masked fragments all are counted that no opaque surface hides: how many of those
//! behind other masked ones a device spares is its own affair.

use super::draws::{self, ColorUse, DepthUse, SurfacePass, SurfacePipelines};
use super::handles::{Color, Depth, LightLists};
use super::inputs::{Eyes, Frame};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;
use crate::shading::Shading;
use crate::targets::TargetName;

/// What is seen where nothing was drawn: a dim night sky, linear.
pub const BACKGROUND: [f32; 3] = [0.004, 0.006, 0.012];

/// Before anything is drawn: the background, which covers nothing.
pub(super) const CLEARED: [f32; 4] = [BACKGROUND[0], BACKGROUND[1], BACKGROUND[2], 0.0];

/// What shading counts.
pub(super) const COUNTED: BufferSet = set(&[B::Counters, B::LightsPerFragment]);

/// Shades all views, for which `lists` serve: what is seen of them where `depth` is laid down; else everything as it is drawn,
/// whatever hides it later, which lays depth down.
pub fn record(r: &mut Recorder, frame: &Frame, depth: Option<Depth>, lists: LightLists) -> Color {
    for eyes in frame.shaded_eyes() {
        debug_assert!(depth.is_none_or(|depth| depth.covers(frame, eyes)));
        debug_assert!(lists.serve(frame, eyes.first()));
        shade(r, frame, eyes);
    }
    Color::shaded()
}

/// Shades what is transparent of all views, for which `lists` serve, over what is lit of the others by other passes.
pub fn transparent(r: &mut Recorder, frame: &Frame, lit: Color, lists: LightLists) -> Color {
    for view in 0..frame.targets.len() {
        debug_assert!(lists.serve(frame, view));
        r.scope(("shade", view), |r| blend(r, frame, Eyes::One(view)));
    }
    lit
}

fn shade(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    r.scope(eyes.stage("shade"), |r| {
        r.scope("opaque", |r| surfaces(r, frame, eyes, SurfaceKind::Opaque));
        r.scope("masked", |r| {
            count_masked(r, frame, eyes);
            surfaces(r, frame, eyes, SurfaceKind::Masked);
        });
        blend(r, frame, eyes);
    });
}

/// Blends transparent surfaces over the picture.
fn blend(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    r.scope("transparent", |r| {
        let views = match eyes {
            Eyes::One(view) => view..view + 1,
            Eyes::All => 0..frame.targets.len(),
        };
        for view in views {
            surfaces(r, frame, Eyes::One(view), SurfaceKind::Transparent);
        }
    });
}

fn surfaces(r: &mut Recorder, frame: &Frame, eyes: Eyes, kind: SurfaceKind) {
    let radiance = match kind {
        SurfaceKind::Opaque => ColorUse::Clear(CLEARED),
        SurfaceKind::Masked | SurfaceKind::Transparent => ColorUse::Keep,
    };
    let depth = match (frame.shading, kind) {
        (Shading::Prepass, _) | (_, SurfaceKind::Transparent) => DepthUse::Test,
        (Shading::Overdraw, SurfaceKind::Opaque) => DepthUse::Write,
        (Shading::Overdraw, SurfaceKind::Masked) => DepthUse::Keep,
    };
    let draws = [(kind, SurfacePipelines::ByTextures(&frame.pipelines.shade[kind as usize]))];
    let pass = SurfacePass {
        colors: &[(TargetName::Radiance, radiance)],
        depth,
        // Masked surfaces are counted apart.
        writes: if depth == DepthUse::Keep { BufferSet::EMPTY } else { COUNTED },
        ..shading(frame, eyes, &draws)
    };
    draws::surfaces(r, frame, &pass);
}

/// Counts masked surfaces with overdraw. What this draws is drawn over, wherever it is.
fn count_masked(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    let Some(pipelines) = &frame.pipelines.count_masked else { return };
    let draws = [(SurfaceKind::Masked, SurfacePipelines::ByTextures(pipelines))];
    draws::surfaces(r, frame, &shading(frame, eyes, &draws));
}

/// Shading of surfaces that counts, over what is there of radiance and depth.
fn shading<'a>(
    frame: &Frame,
    eyes: Eyes,
    draws: &'a [(SurfaceKind, SurfacePipelines<'a>)],
) -> SurfacePass<'a> {
    SurfacePass {
        eyes,
        colors: &[(TargetName::Radiance, ColorUse::Keep)],
        depth: DepthUse::Test,
        draws,
        reads: frame.light_lists(),
        writes: COUNTED,
    }
}
