//! What is known of each pixel of a view, for images; atemporal runs alone.

use crate::buffers::{BufferName as B, BufferSet, set};
use crate::frame::Frame;
use crate::gpu_interface::PixelData;
use crate::pass::{BufferCopy, Dispatch, Push, Recorder, Size};
use crate::vk::Buffer;

/// What tells the list of a pixel's cluster, and its fragments.
pub const LOOKED_UP: BufferSet = set(&[B::ClusterBits, B::WordRanks, B::ListOffsets, B::VisibleFragments]);

/// Bytes of a view's colour (half RGBA) and, behind it, of its [`PixelData`].
pub fn view_bytes([width, height]: [u32; 2]) -> [u64; 2] {
    let pixels = u64::from(width) * u64::from(height);
    [8 * pixels, size_of::<PixelData>() as u64 * pixels]
}

/// Copies one view's colour and pixel data to `target`, which holds [`view_bytes`].
pub fn record(r: &mut Recorder, frame: &Frame, view: usize, target: &Buffer) {
    let [offset, size] = view_bytes(frame.resolution);
    let clustering = frame.clustering_of_view(view);
    r.dispatch(&Dispatch {
        pipeline: &frame.pipelines.pixel_maps,
        buffers: frame.buffers(clustering),
        size: Size::pixels(frame.resolution),
        reads: LOOKED_UP,
        writes: set(&[B::Pixels]),
        depth: Some(frame.targets[view].depth_image()),
        push: Push::view(view),
    });
    let from = &frame.clusterings[clustering].buffers[B::Pixels];
    r.copy(&BufferCopy { from, to: target, offset, size });
    copy_color(r, frame, view, target);
    r.hand_over(target);
}

/// Copies a view's colour, one sample a pixel, to the start of `target`.
pub fn copy_color(r: &mut Recorder, frame: &Frame, view: usize, target: &Buffer) {
    let targets = &frame.targets[view];
    let source = targets.resolved.as_ref().unwrap_or(&targets.color);
    r.copy_image(source.color(), frame.resolution, target);
}
