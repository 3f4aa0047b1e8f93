//! Layers of an image into which meshes around lights are drawn, one a light, batch by batch (Örtegren and Persson section 4.3).

use crate::Result;
use crate::measure::{Purpose, StructureMemory};
use crate::vk::{Context, Image, ImageDesc};
use ash::vk;
use std::sync::Arc;

/// Bytes of a texel: the first slice, and how many lie behind the last.
const TEXEL_BYTES: u64 = 2;

/// A layer for each light, as far as the device has so many, with a texel for each of a grid's tiles.
pub fn make(context: &Arc<Context>, [width, height]: [u32; 2], lights: u32) -> Result<Image> {
    let desc = ImageDesc {
        width,
        height,
        layers: lights.clamp(1, context.limits.max_layers),
        format: vk::Format::R8G8_UNORM,
        usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC,
        layer_views: false,
        ..ImageDesc::default()
    };
    Image::new(context, "shell_layers", desc)
}

/// What the layers take, which every frame needs.
pub fn memory(image: &Image) -> StructureMemory {
    let texels = u64::from(image.extent.width) * u64::from(image.extent.height) * u64::from(image.layers);
    let bytes = TEXEL_BYTES * texels;
    let structure = "shell_layers";
    StructureMemory { structure, purpose: Purpose::Building, allocated: bytes, used: bytes, most: bytes }
}
