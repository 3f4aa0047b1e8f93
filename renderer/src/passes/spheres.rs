//! Influence volumes of the lights over a still, as translucent spheres.

use super::draws::set_facing;
use crate::frame::Frame;
use crate::pass::Recorder;
use crate::pipelines::DebugPipelines;
use ash::vk;

/// Bands between the poles of a sphere.
pub const RINGS: u32 = 12;
/// Slices around its axis.
pub const SEGMENTS: u32 = 24;

/// Vertices of a sphere: two triangles a quad.
const VERTICES: u32 = 6 * RINGS * SEGMENTS;

/// Draws all lights of the frame, in their order; rendering to the view is open.
pub fn record(r: &Recorder, frame: &Frame, pipelines: &DebugPipelines, view: usize) {
    frame.bind(r, vk::PipelineBindPoint::GRAPHICS, &pipelines.spheres, view);
    set_facing(r, frame.mirrored[view], false);
    unsafe { r.context.device.cmd_draw(r.commands(), VERTICES, frame.light_count, 0, 0) };
}
