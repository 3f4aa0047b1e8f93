//! Brings decoded scene images to the device.

use super::buffer::{Buffer, Memory, STAGING_BYTES};
use super::context::Context;
use super::image::{Image, ImageDesc};
use crate::{Error, Result, scene};
use ash::vk;
use std::sync::Arc;

const BYTES_PER_TEXEL: usize = 4;

/// Makes one image a scene image, in order, RGBA8 with all mips (sRGB where the image is), and copies the texels
/// through one staging buffer of at most 64 MiB. All end in SHADER_READ_ONLY_OPTIMAL.
///
/// # Errors
/// [`Error::Device`] when an image is too large for the device or the memory is out.
pub fn upload_textures(context: &Arc<Context>, images: &[scene::Image]) -> Result<Vec<Image>> {
    images.iter().try_for_each(check)?;
    let targets: Vec<Image> = images.iter().map(|image| make(context, image)).collect::<Result<_>>()?;
    let chunks = plan(images, STAGING_BYTES);
    let Some(size) = chunks.iter().map(|chunk| chunk.iter().map(Copy::bytes).sum::<usize>()).max() else {
        return Ok(targets);
    };
    let staging = Buffer::new(
        context,
        "texture staging",
        size as u64,
        vk::BufferUsageFlags::TRANSFER_SRC,
        Memory::Upload,
    )?;
    for (index, chunk) in chunks.iter().enumerate() {
        fill(&staging, images, chunk);
        context.submit_and_wait(|cmd| {
            context.begin_label(cmd, "upload textures");
            if index == 0 {
                let begin =
                    Layouts { old: vk::ImageLayout::UNDEFINED, new: vk::ImageLayout::TRANSFER_DST_OPTIMAL };
                begin.change(context, cmd, &targets);
            }
            record(context, cmd, &staging, &targets, chunk);
            if index + 1 == chunks.len() {
                let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
                let end = Layouts { old: vk::ImageLayout::TRANSFER_DST_OPTIMAL, new: read };
                end.change(context, cmd, &targets);
            }
            context.end_label(cmd);
        })?;
    }
    Ok(targets)
}

/// Some whole rows of one mip level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Copy {
    image: usize,
    mip: usize,
    /// Width of the level, texels.
    width: usize,
    first_row: usize,
    rows: usize,
}

impl Copy {
    fn bytes(&self) -> usize {
        self.rows * self.width * BYTES_PER_TEXEL
    }
}

/// Splits all levels of all images into chunks of at most `capacity` bytes (or one row, where that is more).
fn plan(images: &[scene::Image], capacity: usize) -> Vec<Vec<Copy>> {
    let mut chunks: Vec<Vec<Copy>> = Vec::new();
    let mut free = 0;
    let levels = images
        .iter()
        .enumerate()
        .flat_map(|(index, image)| (0..image.mips.len()).map(move |mip| (index, mip)));
    for (image, mip) in levels {
        let (width, height) = level_size(&images[image], mip);
        let row_bytes = width * BYTES_PER_TEXEL;
        let mut first_row = 0;
        while first_row < height {
            if free < row_bytes || chunks.is_empty() {
                chunks.push(Vec::new());
                free = capacity.max(row_bytes);
            }
            let rows = (free / row_bytes).min(height - first_row);
            let copy = Copy { image, mip, width, first_row, rows };
            chunks.last_mut().expect("a chunk was pushed").push(copy);
            free -= copy.bytes();
            first_row += rows;
        }
    }
    chunks
}

/// Width and height of level `mip`, texels.
fn level_size(image: &scene::Image, mip: usize) -> (usize, usize) {
    let side = |full: u32| full.checked_shr(mip as u32).unwrap_or(0).max(1) as usize;
    (side(image.width), side(image.height))
}

fn check(image: &scene::Image) -> Result<()> {
    let whole = |(mip, texels): (usize, &Vec<u8>)| {
        let (width, height) = level_size(image, mip);
        texels.len() == width * height * BYTES_PER_TEXEL
    };
    match !image.mips.is_empty() && image.mips.iter().enumerate().all(whole) {
        true => Ok(()),
        false => Err(Error::Internal(format!("texture {}: its mip levels do not fit its size", image.name))),
    }
}

fn make(context: &Arc<Context>, image: &scene::Image) -> Result<Image> {
    let desc = ImageDesc {
        width: image.width,
        height: image.height,
        mip_levels: image.mips.len() as u32,
        format: if image.srgb { vk::Format::R8G8B8A8_SRGB } else { vk::Format::R8G8B8A8_UNORM },
        usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
        ..Default::default()
    };
    Image::new(context, &format!("texture {}", image.name), desc)
}

fn fill(staging: &Buffer, images: &[scene::Image], chunk: &[Copy]) {
    let mut offset = 0;
    for copy in chunk {
        let start = copy.first_row * copy.width * BYTES_PER_TEXEL;
        staging.write(offset as u64, &images[copy.image].mips[copy.mip][start..start + copy.bytes()]);
        offset += copy.bytes();
    }
}

fn record(context: &Context, cmd: vk::CommandBuffer, staging: &Buffer, targets: &[Image], chunk: &[Copy]) {
    let mut offset = 0;
    for copy in chunk {
        let target = &targets[copy.image];
        let layer = vk::ImageSubresourceLayers::default()
            .aspect_mask(target.aspect)
            .mip_level(copy.mip as u32)
            .layer_count(1);
        let region = vk::BufferImageCopy::default()
            .buffer_offset(offset as u64)
            .image_subresource(layer)
            .image_offset(vk::Offset3D { x: 0, y: copy.first_row as i32, z: 0 })
            .image_extent(vk::Extent3D { width: copy.width as u32, height: copy.rows as u32, depth: 1 });
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        unsafe {
            context.device.cmd_copy_buffer_to_image(cmd, staging.handle, target.handle, layout, &[region])
        };
        offset += copy.bytes();
    }
}

/// A change of layout of whole images.
struct Layouts {
    old: vk::ImageLayout,
    new: vk::ImageLayout,
}

impl Layouts {
    fn change(&self, context: &Context, cmd: vk::CommandBuffer, targets: &[Image]) {
        let barrier = |image: &Image| {
            vk::ImageMemoryBarrier2::default()
                .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
                .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
                .old_layout(self.old)
                .new_layout(self.new)
                .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .image(image.handle)
                .subresource_range(image.range())
        };
        let barriers: Vec<_> = targets.iter().map(barrier).collect();
        unsafe {
            context
                .device
                .cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().image_memory_barriers(&barriers))
        };
    }
}
