//! Stage `lights`: this frame's lights from the host to the device, where others are there.

use super::handles::Lights;
use super::inputs::Frame;
use crate::gpu_interface::LightData;
use crate::pass::{BufferCopy, Recorder};

/// Copies the frame's lights, unless they are on the device already.
pub fn record(r: &mut Recorder, frame: &Frame) -> Lights {
    r.scope("lights", |r| {
        let size = frame.light_count as u64 * size_of::<LightData>() as u64;
        if frame.lights_changed && size > 0 {
            r.copy(&BufferCopy { from: frame.light_staging, to: frame.lights, offset: 0, size });
        }
    });
    Lights::uploaded()
}
