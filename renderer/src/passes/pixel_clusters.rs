//! Stage `pixel_clusters[c]` of stills: the marked cluster of each pixel of any camera.

use super::pixel_maps::LOOKED_UP;
use crate::buffers::{BufferName as B, set};
use crate::frame::Frame;
use crate::layouts::Pipeline;
use crate::pass::{BufferCopy, Dispatch, Push, Recorder, Size};
use crate::vk::Buffer;

/// Looks the pixels of `view`'s prepass up in `clustering` and copies what is known of them to `target`.
pub fn record(
    r: &mut Recorder,
    frame: &Frame,
    pipeline: &Pipeline,
    (view, clustering): (usize, usize),
    target: &Buffer,
) {
    r.scope(("pixel_clusters", clustering), |r| {
        r.dispatch(&Dispatch {
            pipeline,
            buffers: frame.buffers(clustering),
            size: Size::pixels(frame.resolution),
            reads: LOOKED_UP,
            writes: set(&[B::Pixels]),
            depth: Some(frame.targets[view].depth_image()),
            push: Push::view(view),
        });
        let from = &frame.clusterings[clustering].buffers[B::Pixels];
        r.copy(&BufferCopy { from, to: target, offset: 0, size: target.size });
        r.hand_over(target);
    });
}
