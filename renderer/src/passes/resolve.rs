//! Stage `resolve`: the samples of every pixel averaged, with MSAA alone.

use crate::frame::{Frame, ViewTargets};
use crate::pass::{Access, Recorder, Use};
use ash::vk;

/// Resolves every view's colour.
pub fn record(r: &mut Recorder, frame: &Frame) {
    if frame.targets.iter().all(|target| target.resolved.is_none()) {
        return;
    }
    r.scope("resolve", |r| {
        for target in frame.targets {
            resolve(r, target, frame.resolution);
        }
    });
}

/// Resolves one view's colour; without MSAA there is nothing to do.
pub fn resolve(r: &mut Recorder, target: &ViewTargets, [width, height]: [u32; 2]) {
    let Some(resolved) = &target.resolved else { return };
    let aspect = vk::ImageAspectFlags::COLOR;
    r.access(&[
        Access::image(target.color.image.handle, aspect, Use::TransferRead),
        Access::image(resolved.image.handle, aspect, Use::TransferWrite),
    ]);
    let region = vk::ImageResolve2::default()
        .src_subresource(target.color.color())
        .dst_subresource(resolved.color())
        .extent(vk::Extent3D { width, height, depth: 1 });
    let regions = [region];
    let info = vk::ResolveImageInfo2::default()
        .src_image(target.color.image.handle)
        .src_image_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL)
        .dst_image(resolved.image.handle)
        .dst_image_layout(vk::ImageLayout::TRANSFER_DST_OPTIMAL)
        .regions(&regions);
    unsafe { r.context.device.cmd_resolve_image2(r.commands(), &info) };
}
