//! What is known of each pixel of a view, for images; atemporal runs alone.

use super::inputs::Frame;
use super::pixel_models;
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::PixelData;
use crate::layouts::Pipeline;
use crate::pass::{BufferCopy, Dispatch, Push, Recorder, Size};
use crate::targets::TargetName;
use crate::vk::Buffer;

/// Size in bytes of a view's [`TargetName::Radiance`] (half RGBA) and, behind it, of its [`PixelData`].
pub fn view_bytes([width, height]: [u32; 2]) -> [u64; 2] {
    let pixels = u64::from(width) * u64::from(height);
    [TargetName::Radiance.view_bytes([width, height]), size_of::<PixelData>() as u64 * pixels]
}

/// Copies one view's radiance and pixel data to `target`, which holds [`view_bytes`].
pub fn record(r: &mut Recorder, frame: &Frame, view: usize, target: &Buffer) {
    let [offset, _] = view_bytes(frame.resolution);
    let clustering = frame.sharing.clustering_of(view);
    look_up(r, frame, &frame.pipelines.pixel_maps, (view, clustering), (target, offset));
    copy_target(r, frame, (view, TargetName::Radiance), target);
    r.hand_over(target);
}

/// Looks the pixels of a view's prepass up in a clustering, and copies what is known of them behind `offset` bytes of the
/// target.
pub(super) fn look_up(
    r: &mut Recorder,
    frame: &Frame,
    pipeline: &Pipeline,
    (view, clustering): (usize, usize),
    (to, offset): (&Buffer, u64),
) {
    pixel_models::record(r, frame, (view, clustering));
    let looked_up = frame.list_lengths() | set(&[B::VisibleFragments]);
    let declared = (looked_up, set(&[B::Pixels]));
    let dispatch =
        Dispatch::new(pipeline, frame.buffers(clustering), Size::pixels(frame.resolution), declared);
    let depth = Some(frame.targets[view].depth_image());
    r.dispatch(&Dispatch { depth, push: Push::view(view), ..dispatch });
    let from = &frame.clusterings[clustering].buffers[B::Pixels];
    let [_, size] = view_bytes(frame.resolution);
    r.copy(&BufferCopy { from, to, offset, size });
}

/// Copies a target of a view, one sample a pixel, to the start of a buffer.
pub fn copy_target(r: &mut Recorder, frame: &Frame, (view, name): (usize, TargetName), to: &Buffer) {
    r.copy_image(frame.targets[view][name].readable().color(), frame.resolution, to);
}
