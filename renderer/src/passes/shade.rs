//! Stages `shade[v] > opaque, masked, transparent`: forward shading through the method's lookup. With multiview `shade`
//! draws opaque and masked surfaces of all views at once, where they look lights up in one clustering; transparent ones are
//! blended view by view, each in its own order.

use super::draws::{self, ColorUse, DepthUse, SurfacePass, SurfacePipelines};
use super::handles::{Color, Depth, LightLists};
use super::inputs::{Eyes, Frame};
use crate::buffers::{BufferName as B, set};
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;
use crate::targets::TargetName;

/// What is seen where nothing was drawn: a dim night sky, linear.
pub const BACKGROUND: [f32; 3] = [0.004, 0.006, 0.012];

/// Before anything is drawn: the background, which covers nothing.
const CLEARED: [f32; 4] = [BACKGROUND[0], BACKGROUND[1], BACKGROUND[2], 0.0];

/// Shades all views, of which `depth` is laid down and for which `lists` serve.
pub fn record(r: &mut Recorder, frame: &Frame, depth: Depth, lists: LightLists) -> Color {
    for eyes in frame.shaded_eyes() {
        debug_assert!(depth.covers(frame, eyes) && lists.serve(frame, eyes.first()));
        shade(r, frame, eyes);
    }
    Color::shaded()
}

fn shade(r: &mut Recorder, frame: &Frame, eyes: Eyes) {
    r.scope(eyes.stage("shade"), |r| {
        r.scope("opaque", |r| surfaces(r, frame, eyes, SurfaceKind::Opaque));
        r.scope("masked", |r| surfaces(r, frame, eyes, SurfaceKind::Masked));
        r.scope("transparent", |r| {
            let views = match eyes {
                Eyes::One(view) => view..view + 1,
                Eyes::All => 0..frame.targets.len(),
            };
            for view in views {
                surfaces(r, frame, Eyes::One(view), SurfaceKind::Transparent);
            }
        });
    });
}

fn surfaces(r: &mut Recorder, frame: &Frame, eyes: Eyes, kind: SurfaceKind) {
    let first = kind == SurfaceKind::Opaque;
    let radiance = if first { ColorUse::Clear(CLEARED) } else { ColorUse::Keep };
    let pass = SurfacePass {
        eyes,
        colors: &[(TargetName::Radiance, radiance)],
        depth: DepthUse::Test,
        draws: &[(kind, SurfacePipelines::ByTextures(&frame.pipelines.shade[kind as usize]))],
        reads: set(&[B::Lights, B::ClusterBits, B::WordRanks, B::ListOffsets, B::LightIndices]),
        writes: set(&[B::Counters, B::LightsPerFragment]),
    };
    draws::surfaces(r, frame, &pass);
}
