//! Stage `gbuffer[v]`, with multiview `gbuffer` for all views: what deferred shading keeps of opaque and masked surfaces, a
//! texel a sample, and what they radiate without any light, which goes into the picture at once.
//!
//! ```text
//! prepass   Depth ──(equal)──> opaque, masked ──> GBuffer, radiance
//! overdraw  depth cleared ──(nearer, written)──> opaque, masked ──> GBuffer, radiance, Depth
//! ```
//!
//! | target | format | holds |
//! | --- | --- | --- |
//! | `base_color` | `R8G8B8A8_SRGB` | base colour; metalness |
//! | `normal` | `R16G16_SNORM` | shading normal in the world, octahedral |
//! | `roughness` | `R16_UNORM` | perceptual roughness; 0 is unlit |
//! | `model` | `R32_UINT` | the index of the model, for methods whose groups are models alone |
//!
//! That is 10 bytes a sample, 14 with the model. Where the surface lies, depth tells. What no surface is drawn over holds anything:
//! it is not read where depth is that of the background.

use super::draws::{self, ColorUse, DepthUse, SurfacePass, SurfacePipelines};
use super::handles::{Depth, GBuffer};
use super::inputs::{Eyes, Frame};
use super::shade::CLEARED;
use crate::buffers::BufferSet;
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;
use crate::shading::Shading;
use crate::targets::TargetName;

/// What is drawn into, the model last.
const DRAWN: [(TargetName, ColorUse); 5] = [
    (TargetName::Radiance, ColorUse::Clear(CLEARED)),
    (TargetName::BaseColor, ColorUse::Fresh),
    (TargetName::Normal, ColorUse::Fresh),
    (TargetName::Roughness, ColorUse::Fresh),
    (TargetName::Model, ColorUse::Fresh),
];

/// Draws the surfaces of all views as they come, whatever hides them later, which lays down depth.
pub fn drawn_over(r: &mut Recorder, frame: &Frame) -> GBuffer {
    frame.eyes().fold(GBuffer::NONE, |filled, eyes| filled | record(r, frame, eyes))
}

/// Draws what is seen of all views, whose `depth` is there.
pub fn of_what_is_seen(r: &mut Recorder, frame: &Frame, depth: Depth) -> GBuffer {
    frame.eyes().fold(GBuffer::NONE, |filled, eyes| {
        debug_assert!(depth.covers(frame, eyes));
        filled | record(r, frame, eyes)
    })
}

/// Fills the G-buffers of some views: with what is seen by the depth that is there, or, with overdraw, laying it down.
pub fn record(r: &mut Recorder, frame: &Frame, eyes: Eyes) -> GBuffer {
    r.scope(eyes.stage("gbuffer"), |r| {
        let pipelines = frame.pipelines.deferred();
        let [opaque, masked] = pipelines.fill.each_ref().map(SurfacePipelines::ByTextures);
        let pass = SurfacePass {
            eyes,
            colors: &DRAWN[..=pipelines.kept.len()],
            depth: match frame.shading {
                Shading::Prepass => DepthUse::Test,
                Shading::Overdraw => DepthUse::Write,
            },
            draws: &[(SurfaceKind::Opaque, opaque), (SurfaceKind::Masked, masked)],
            reads: BufferSet::EMPTY,
            writes: BufferSet::EMPTY,
        };
        draws::surfaces(r, frame, &pass);
    });
    GBuffer::of(frame, eyes)
}
