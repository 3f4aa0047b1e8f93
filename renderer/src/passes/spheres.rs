//! Influence volumes of the lights over a still, as translucent spheres.

use super::draws::Overlay;
use crate::buffers::{BufferName as B, set};
use crate::frame::Frame;
use crate::pipelines::DebugPipelines;

/// Bands between the poles of a sphere.
pub const RINGS: u32 = 12;
/// Slices around its axis.
pub const SEGMENTS: u32 = 24;

/// Vertices of a sphere: two triangles a quad.
const VERTICES: u32 = 6 * RINGS * SEGMENTS;

/// All lights of the frame, in their order.
pub fn overlay<'a>(frame: &Frame, pipelines: &'a DebugPipelines) -> Overlay<'a> {
    Overlay {
        pipeline: &pipelines.spheres,
        vertices: VERTICES,
        count: frame.light_count,
        instances: None,
        closed: true,
        reads: set(&[B::Lights]),
    }
}
