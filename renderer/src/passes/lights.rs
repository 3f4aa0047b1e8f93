//! Stage `lights`: this frame's lights from the host to the device, where others are there.

use super::handles::Lights;
use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::pass::{BufferCopy, Recorder};

/// The buffers that tell what a light is.
pub const READ: BufferSet = set(&[B::Lights, B::Spots]);

/// The lights of a frame, as the host wrote them and on the device.
pub struct LightUpload<'a> {
    /// Copies of the lights, of their cones, and of what places their meshes; nothing is copied that is there already.
    pub copies: [BufferCopy<'a>; 3],
    /// How many lights there are.
    pub count: u32,
}

/// Copies the frame's lights, unless they are on the device already.
pub fn record(r: &mut Recorder, frame: &Frame) -> Lights {
    r.scope("lights", |r| {
        frame.lights.copies.iter().filter(|copy| copy.size > 0).for_each(|copy| r.copy(copy));
    });
    Lights::uploaded()
}
