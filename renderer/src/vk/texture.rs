//! Brings decoded scene images to the device.

use super::buffer::{Buffer, Memory, STAGING_BYTES};
use super::context::Context;
use super::image::{Image, ImageDesc};
use crate::{Error, Result, scene};
use ash::vk;
use std::sync::Arc;

const BYTES_PER_TEXEL: usize = 4;

/// Makes one image a scene image, in order, RGBA8 with all mips (sRGB where the image is), and copies the texels
/// through one staging buffer of at most 64 MiB. All end in SHADER_READ_ONLY_OPTIMAL. Of an image with sides that the
/// device does not take, the levels that it takes are left, with a warning.
///
/// # Errors
/// [`Error::Device`] when the memory is out.
pub fn upload_textures(context: &Arc<Context>, images: &[scene::Image]) -> Result<Vec<Image>> {
    let side = context.limits.max_image_dimension_2d;
    upload_in_chunks(context, images, Most { bytes: STAGING_BYTES, side })
}

/// What bounds an upload.
#[derive(Debug, Clone, Copy)]
pub(super) struct Most {
    /// Staged at a time; a row of texels may be more.
    pub bytes: usize,
    /// Texels of a side.
    pub side: u32,
}

/// Uploads as [`upload_textures`] does, within bounds of memory.
pub(super) fn upload_in_chunks(
    context: &Arc<Context>,
    images: &[scene::Image],
    most: Most,
) -> Result<Vec<Image>> {
    images.iter().try_for_each(check)?;
    let images: Vec<_> = images.iter().map(|image| Levels::new(image, most.side)).collect();
    images.iter().for_each(|levels| levels.warn(context));
    let targets: Vec<Image> = images.iter().map(|levels| make(context, levels)).collect::<Result<_>>()?;
    let chunks = plan(&images, most.bytes);
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
        fill(&staging, &images, chunk);
        context.submit_and_wait(|cmd| {
            context.begin_label(cmd, c"upload textures");
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

/// The mip levels of an image that a device takes.
struct Levels<'a> {
    image: &'a scene::Image,
    /// Index of the first level that is uploaded.
    first: usize,
}

impl<'a> Levels<'a> {
    /// Mip levels with sides of at most `side` texels.
    fn new(image: &'a scene::Image, side: u32) -> Self {
        let too_large = |&mip: &usize| {
            let (width, height) = level_size(image, mip);
            width.max(height) > side as usize
        };
        Self { image, first: (0..image.mips.len() - 1).take_while(too_large).count() }
    }

    fn texels(&self) -> &[Vec<u8>] {
        &self.image.mips[self.first..]
    }

    /// Width and height of a level, texels; level 0 is the first.
    fn size(&self, level: usize) -> (usize, usize) {
        level_size(self.image, self.first + level)
    }

    fn warn(&self, context: &Context) {
        let scene::Image { name, width, height, .. } = self.image;
        if self.first > 0 {
            let (most, (w, h)) = (context.limits.max_image_dimension_2d, self.size(0));
            let device = &context.info.name;
            tracing::warn!(
                "texture {name}: {width}x{height} texels are drawn as {w}x{h}: {device} takes sides of {most}"
            );
        }
    }
}

/// Some whole rows of one mip level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Copy {
    image: usize,
    /// Index among the mip levels that are uploaded.
    level: usize,
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
fn plan(images: &[Levels], capacity: usize) -> Vec<Vec<Copy>> {
    let mut chunks: Vec<Vec<Copy>> = Vec::new();
    let mut free = 0;
    let levels = images
        .iter()
        .enumerate()
        .flat_map(|(index, image)| (0..image.texels().len()).map(move |level| (index, level)));
    for (image, level) in levels {
        let (width, height) = images[image].size(level);
        let row_bytes = width * BYTES_PER_TEXEL;
        let mut first_row = 0;
        while first_row < height {
            if free < row_bytes || chunks.is_empty() {
                chunks.push(Vec::new());
                free = capacity.max(row_bytes);
            }
            let rows = (free / row_bytes).min(height - first_row);
            let copy = Copy { image, level, width, first_row, rows };
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

fn make(context: &Arc<Context>, levels: &Levels) -> Result<Image> {
    let (width, height) = levels.size(0);
    let desc = ImageDesc {
        width: width as u32,
        height: height as u32,
        mip_levels: levels.texels().len() as u32,
        format: if levels.image.srgb { vk::Format::R8G8B8A8_SRGB } else { vk::Format::R8G8B8A8_UNORM },
        usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
        ..Default::default()
    };
    Image::new(context, &format!("texture {}", levels.image.name), desc)
}

fn fill(staging: &Buffer, images: &[Levels], chunk: &[Copy]) {
    let mut offset = 0;
    for copy in chunk {
        let start = copy.first_row * copy.width * BYTES_PER_TEXEL;
        let texels = &images[copy.image].texels()[copy.level];
        staging.write(offset as u64, &texels[start..start + copy.bytes()]);
        offset += copy.bytes();
    }
}

fn record(context: &Context, cmd: vk::CommandBuffer, staging: &Buffer, targets: &[Image], chunk: &[Copy]) {
    let mut offset = 0;
    for copy in chunk {
        let target = &targets[copy.image];
        let layer = vk::ImageSubresourceLayers::default()
            .aspect_mask(target.aspect)
            .mip_level(copy.level as u32)
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
pub(super) struct Layouts {
    pub old: vk::ImageLayout,
    pub new: vk::ImageLayout,
}

impl Layouts {
    pub fn change(&self, context: &Context, cmd: vk::CommandBuffer, targets: &[Image]) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn blank(width: u32, height: u32) -> scene::Image {
        let levels = width.max(height).ilog2() as usize + 1;
        let mut image = scene::Image { name: "blank".into(), width, height, srgb: false, mips: Vec::new() };
        for mip in 0..levels {
            let (w, h) = level_size(&image, mip);
            image.mips.push(vec![0; w * h * BYTES_PER_TEXEL]);
        }
        image
    }

    proptest! {
        #[test]
        fn every_row_is_copied_once_and_no_chunk_is_too_large(
            sizes in prop::collection::vec((1u32..40, 1u32..40), 0..6),
            capacity in 1usize..2000,
        ) {
            let images: Vec<_> = sizes.iter().map(|&(width, height)| blank(width, height)).collect();
            let whole: Vec<_> = images.iter().map(|image| Levels::new(image, u32::MAX)).collect();
            let mut copied: Vec<Vec<Vec<u8>>> = images.iter().map(|image| image.mips.clone()).collect();
            for chunk in plan(&whole, capacity) {
                prop_assert!(!chunk.is_empty());
                let one_row = chunk.len() == 1 && chunk[0].rows == 1;
                prop_assert!(one_row || chunk.iter().map(Copy::bytes).sum::<usize>() <= capacity);
                for copy in chunk {
                    let start = copy.first_row * copy.width * BYTES_PER_TEXEL;
                    let level = &mut copied[copy.image][copy.level];
                    level[start..start + copy.bytes()].iter_mut().for_each(|times| *times += 1);
                }
            }
            prop_assert!(copied.iter().flatten().flatten().all(|&times| times == 1));
        }
    }

    #[test]
    fn levels_that_the_device_does_not_take_are_left_out() {
        for (side, first, size) in [(16, 0, (16, 4)), (15, 1, (8, 2)), (8, 1, (8, 2)), (1, 4, (1, 1))] {
            let image = blank(16, 4);
            let levels = Levels::new(&image, side);
            assert_eq!(
                (levels.first, levels.size(0), levels.texels().len()),
                (first, size, 5 - first),
                "{side}"
            );
        }
    }

    #[test]
    fn an_image_whose_levels_do_not_fit_is_refused() {
        let mut image = blank(8, 4);
        check(&image).unwrap();
        image.mips[1].pop();
        assert!(check(&image).unwrap_err().to_string().contains("blank"));
        image.mips.clear();
        assert!(check(&image).is_err());
    }
}
