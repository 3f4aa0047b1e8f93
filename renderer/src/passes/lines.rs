//! Lines over a still: frusta and boxes. Faint where the scene hides them.

use crate::frame::Frame;
use crate::pass::Recorder;
use crate::pipelines::DebugPipelines;
use crate::vk::Buffer;
use ash::vk;

/// A line in world space, as the vertex shader reads it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Line {
    /// One end, metres.
    pub from: [f32; 3],
    /// The other end, metres.
    pub to: [f32; 3],
    /// Linear colour.
    pub tint: [f32; 3],
}

/// Vertices of a line: two triangles.
const VERTICES: u32 = 6;

/// Draws `count` lines; rendering to the view is open.
pub fn record(
    r: &Recorder,
    frame: &Frame,
    pipelines: &DebugPipelines,
    view: usize,
    (lines, count): (&Buffer, u32),
) {
    for pipeline in &pipelines.lines {
        frame.bind(r, vk::PipelineBindPoint::GRAPHICS, pipeline, view);
        unsafe {
            r.context.device.cmd_bind_vertex_buffers(r.commands(), 0, &[lines.handle], &[0]);
            r.context.device.cmd_draw(r.commands(), VERTICES, count, 0, 0);
        }
    }
}
