//! Stage `lights`: this frame's lights from the host to the device.

use crate::frame::Frame;
use crate::gpu_interface::LightData;
use crate::pass::{BufferCopy, Recorder};

/// Copies the frame's lights.
pub fn record(r: &mut Recorder, frame: &Frame) {
    r.scope("lights", |r| {
        let size = frame.light_count as u64 * size_of::<LightData>() as u64;
        if size > 0 {
            r.copy(&BufferCopy { from: frame.light_staging, to: frame.lights, offset: 0, size });
        }
    });
}
