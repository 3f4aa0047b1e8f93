//! Stage `lights`: this frame's lights from the host to the device.

use crate::frame::Frame;
use crate::gpu_interface::LightData;
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Copies the frame's lights.
pub fn record(r: &mut Recorder, frame: &Frame) {
    r.scope("lights", |r| {
        let size = frame.light_count as u64 * size_of::<LightData>() as u64;
        if size == 0 {
            return;
        }
        r.access(&[Access::buffer(frame.lights.handle, Use::TransferWrite)]);
        let region = vk::BufferCopy::default().size(size);
        unsafe {
            r.context.device.cmd_copy_buffer(
                r.commands(),
                frame.light_staging.handle,
                frame.lights.handle,
                &[region],
            );
        }
    });
}
