//! Influence volumes of the lights over a still, as translucent spheres.

use super::draws::Overlay;
use super::inputs::Frame;
use super::lights;
use crate::pipelines::{DebugPipelines, SPHERE_VERTICES};

/// All lights of the frame, in their order.
pub fn overlay<'a>(frame: &Frame, pipelines: &'a DebugPipelines) -> Overlay<'a> {
    Overlay {
        pipeline: &pipelines.spheres,
        vertices: SPHERE_VERTICES,
        count: frame.lights.count,
        instances: None,
        closed: true,
        reads: lights::READ,
    }
}
