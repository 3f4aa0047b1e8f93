//! How much the depth of the first view jumps from pixel to pixel; atemporal runs alone, after the frame.

use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::pass::{Dispatch, Push, Recorder, Size};

/// The view whose depth it is.
const VIEW: usize = 0;

/// Adds up the steps of the first view's depth in the counters of the clustering that it looks lights up in.
pub fn record(r: &mut Recorder, frame: &Frame) {
    let Some(pipeline) = &frame.pipelines.depth_steps else { return };
    let buffers = frame.buffers_of_view(VIEW);
    let declared = (BufferSet::EMPTY, set(&[B::Counters]));
    let dispatch = Dispatch::new(pipeline, buffers, Size::pixels(frame.resolution), declared);
    let depth = Some(frame.targets[VIEW].depth_image());
    r.dispatch(&Dispatch { depth, push: Push::view(VIEW), ..dispatch });
}
