//! Fills, copies and resolves, a call each.

use super::{Access, Recorder, Use};
use crate::vk::{Buffer, Image};
use ash::vk;
use std::ops::Range;

/// A copy from the start of one buffer to somewhere in another.
#[derive(Clone, Copy)]
pub struct BufferCopy<'a> {
    /// Buffer that is copied from, from its start.
    pub from: &'a Buffer,
    /// Buffer that is copied to.
    pub to: &'a Buffer,
    /// Where the copy begins in `to`, bytes.
    pub offset: u64,
    /// How much is copied, bytes.
    pub size: u64,
}

/// Parts of one buffer that are copied to the same places of another.
#[derive(Clone, Copy)]
pub struct BufferParts<'a> {
    /// Buffer that is copied from.
    pub from: &'a Buffer,
    /// Buffer that is copied to.
    pub to: &'a Buffer,
    /// Which elements are copied.
    pub parts: &'a [Range<usize>],
    /// What an element takes, bytes.
    pub element: u64,
}

impl Recorder<'_> {
    /// Zeroes a whole buffer.
    pub fn clear(&mut self, buffer: &Buffer) {
        self.access([Access::buffer(buffer.handle, Use::TransferWrite)]);
        unsafe { self.context.device.cmd_fill_buffer(self.commands(), buffer.handle, 0, vk::WHOLE_SIZE, 0) };
    }

    /// Copies bytes from buffer to buffer.
    pub fn copy(&mut self, copy: &BufferCopy) {
        let (from, to) = (copy.from.handle, copy.to.handle);
        self.access([Access::buffer(from, Use::TransferRead), Access::buffer(to, Use::TransferWrite)]);
        let region = vk::BufferCopy::default().dst_offset(copy.offset).size(copy.size);
        unsafe { self.context.device.cmd_copy_buffer(self.commands(), from, to, &[region]) };
    }

    /// Copies parts of a buffer, some at least.
    pub fn copy_parts(&mut self, copy: &BufferParts) {
        let (from, to) = (copy.from.handle, copy.to.handle);
        self.access([Access::buffer(from, Use::TransferRead), Access::buffer(to, Use::TransferWrite)]);
        let region = |part: &Range<usize>| {
            let (offset, size) = (copy.element * part.start as u64, copy.element * part.len() as u64);
            vk::BufferCopy::default().src_offset(offset).dst_offset(offset).size(size)
        };
        let regions: Vec<vk::BufferCopy> = copy.parts.iter().map(region).collect();
        unsafe { self.context.device.cmd_copy_buffer(self.commands(), from, to, &regions) };
    }

    /// Copies a part of a colour image, so large, to the start of a buffer.
    pub fn copy_image(
        &mut self,
        (image, part): (vk::Image, vk::ImageSubresourceLayers),
        [width, height]: [u32; 2],
        to: &Buffer,
    ) {
        self.access([
            Access::image(image, part.aspect_mask, Use::TransferRead),
            Access::buffer(to.handle, Use::TransferWrite),
        ]);
        let region = vk::BufferImageCopy::default().image_subresource(part).image_extent(vk::Extent3D {
            width,
            height,
            depth: 1,
        });
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        unsafe {
            self.context.device.cmd_copy_image_to_buffer(
                self.commands(),
                image,
                layout,
                to.handle,
                &[region],
            );
        }
    }

    /// Copies the first layers of a colour image, of each a part so large, into a buffer from a byte on, one behind the other.
    pub fn copy_layers(
        &mut self,
        (image, layers): (&Image, u32),
        [width, height]: [u32; 2],
        (to, offset): (vk::Buffer, u64),
    ) {
        self.access([
            Access::image(image.handle, image.aspect, Use::TransferRead),
            Access::buffer(to, Use::TransferWrite),
        ]);
        let part = vk::ImageSubresourceLayers::default().aspect_mask(image.aspect).layer_count(layers);
        let region = vk::BufferImageCopy::default()
            .buffer_offset(offset)
            .image_subresource(part)
            .image_extent(vk::Extent3D { width, height, depth: 1 });
        let (commands, layout) = (self.commands(), vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        unsafe {
            self.context.device.cmd_copy_image_to_buffer(commands, image.handle, layout, to, &[region]);
        }
    }

    /// Averages the samples of a part of one colour image into that of another, so large.
    pub fn resolve(
        &mut self,
        from: (vk::Image, vk::ImageSubresourceLayers),
        to: (vk::Image, vk::ImageSubresourceLayers),
        [width, height]: [u32; 2],
    ) {
        self.access([
            Access::image(from.0, from.1.aspect_mask, Use::TransferRead),
            Access::image(to.0, to.1.aspect_mask, Use::TransferWrite),
        ]);
        let region = vk::ImageResolve2::default()
            .src_subresource(from.1)
            .dst_subresource(to.1)
            .extent(vk::Extent3D { width, height, depth: 1 });
        let regions = [region];
        let info = vk::ResolveImageInfo2::default()
            .src_image(from.0)
            .src_image_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL)
            .dst_image(to.0)
            .dst_image_layout(vk::ImageLayout::TRANSFER_DST_OPTIMAL)
            .regions(&regions);
        unsafe { self.context.device.cmd_resolve_image2(self.commands(), &info) };
    }

    /// Hands a mapped buffer to the host, which reads it once the frame has ended.
    pub fn hand_over(&mut self, buffer: &Buffer) {
        self.access([Access::buffer(buffer.handle, Use::HostRead)]);
    }
}
