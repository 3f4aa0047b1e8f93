//! Lines over a still: frusta and boxes. Faint where the scene hides them.

use super::draws::Overlay;
use crate::buffers::BufferSet;
use crate::pipelines::DebugPipelines;
use crate::vk::Buffer;

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
