//! Views of buffers as arrays of texels.

use super::context::Context;
use super::{Buffer, vk_error};
use crate::{Error, Result};
use ash::vk;
use std::sync::Arc;

/// A whole buffer as texels of one format.
pub struct TexelView {
    /// Vulkan handle, for descriptors.
    pub handle: vk::BufferView,
    context: Arc<Context>,
}

impl TexelView {
    /// Views `buffer`, whose usage must have UNIFORM_TEXEL_BUFFER, from its start as far as whole texels go.
    ///
    /// # Errors
    /// [`Error::Device`] when the device views no buffer that long.
    pub fn new(context: &Arc<Context>, buffer: &Buffer, format: vk::Format) -> Result<Self> {
        let texel = texel_bytes(format);
        let texels = buffer.size / texel;
        let most = context.limits.max_texel_buffer_elements;
        if texels > most {
            return Err(Error::Device(format!(
                "{}: {texels} texels are more than the {most} that a buffer may be read as on {}",
                buffer.name(),
                context.info.name
            )));
        }
        let info = vk::BufferViewCreateInfo::default()
            .buffer(buffer.handle)
            .format(format)
            .offset(0)
            .range(texels * texel);
        let handle = unsafe { context.device.create_buffer_view(&info, None) }
            .map_err(|e| vk_error(&format!("{}: viewing the buffer as texels", buffer.name()), e))?;
        context.name(handle, &format!("{} texels", buffer.name()));
        Ok(Self { handle, context: context.clone() })
    }
}

impl Drop for TexelView {
    fn drop(&mut self) {
        unsafe { self.context.device.destroy_buffer_view(self.handle, None) };
    }
}

/// Size in bytes of a texel. Every device has buffers of these formats, or images (Vulkan 1.3, "Required Format
/// Support").
pub fn texel_bytes(format: vk::Format) -> u64 {
    match format {
        vk::Format::R16_UINT | vk::Format::R16_UNORM => 2,
        vk::Format::R32_UINT
        | vk::Format::R8G8B8A8_UINT
        | vk::Format::R8G8B8A8_SRGB
        | vk::Format::R16G16_SNORM => 4,
        vk::Format::R16G16B16A16_SFLOAT | vk::Format::R32G32_UINT => 8,
        vk::Format::R32G32B32A32_SFLOAT | vk::Format::R32G32B32A32_UINT => 16,
        other => unreachable!("no buffer or target has texels of {other:?}"),
    }
}
