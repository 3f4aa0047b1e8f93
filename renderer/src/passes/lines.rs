//! Lines over a still: frusta and boxes. Faint where the scene hides them.

use super::draws::Overlay;
use crate::buffers::BufferSet;
use crate::pipelines::DebugPipelines;
use crate::vk::Buffer;

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

/// `count` lines, through everything and then where nothing hides them.
pub fn overlays<'a>(pipelines: &'a DebugPipelines, (lines, count): (&'a Buffer, u32)) -> [Overlay<'a>; 2] {
    pipelines.lines.each_ref().map(|pipeline| Overlay {
        pipeline,
        vertices: VERTICES,
        count,
        instances: Some(lines),
        closed: false,
        reads: BufferSet::EMPTY,
    })
}
