//! What is known of each pixel of a view, for images; atemporal runs alone.

use crate::buffers::{BufferName as B, BufferSet, set};
use crate::frame::Frame;
use crate::gpu_interface::PixelData;
use crate::pass::{BufferCopy, Dispatch, Push, Recorder, Size};
use crate::targets::TargetName;
use crate::vk::Buffer;

/// What tells the list of a pixel's cluster, and its fragments.
pub const LOOKED_UP: BufferSet = set(&[B::ClusterBits, B::WordRanks, B::ListOffsets, B::VisibleFragments]);

/// Bytes of a view's [`TargetName::Radiance`] (half RGBA) and, behind it, of its [`PixelData`].
pub fn view_bytes([width, height]: [u32; 2]) -> [u64; 2] {
    let pixels = u64::from(width) * u64::from(height);
    [TargetName::Radiance.view_bytes([width, height]), size_of::<PixelData>() as u64 * pixels]
}

/// Copies one view's radiance and pixel data to `target`, which holds [`view_bytes`].
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
    copy_target(r, frame, (view, TargetName::Radiance), target);
    r.hand_over(target);
}

/// Copies a target of a view, one sample a pixel, to the start of a buffer.
pub fn copy_target(r: &mut Recorder, frame: &Frame, (view, name): (usize, TargetName), to: &Buffer) {
    r.copy_image(frame.targets[view][name].readable().color(), frame.resolution, to);
}
