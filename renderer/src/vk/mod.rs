//! The thin Vulkan layer that the passes stand on: a device, memory that frees itself, shaders from GLSL,
//! pipelines. It knows nothing of lights or clusters.
//!
//! ```text
//! DeviceOptions ──> Context ──> Buffer, Image, SamplerCache, upload_textures
//! shaders-glsl/ ──> ShaderLibrary ──> SPIR-V ──> compute_pipeline, graphics_pipeline
//! ```
//!
//! Everything that owns a Vulkan object holds an `Arc<Context>`, so the device outlives it.

mod buffer;
mod context;
mod device;
mod features;
mod image;
mod instance;
mod limits;
mod pipeline;
mod sampler;
mod shader;
#[cfg(test)]
mod tests;
mod texel_view;
mod texture;
mod validation;

pub use buffer::{Buffer, Memory};
pub use context::{Context, DeviceOptions, c_string};
pub use device::{DeviceListing, ListedDevice, list_devices};
pub use image::{Image, ImageDesc};
pub use limits::{DeviceInfo, Limits};
pub use pipeline::{Blend, GraphicsDesc, Pipeline, compute_pipeline, graphics_pipeline};
pub use sampler::SamplerCache;
pub use shader::ShaderLibrary;
pub use texel_view::{TexelView, texel_bytes};
pub use texture::upload_textures;
pub use validation::ValidationLog;

use crate::Error;
use crate::text::bytes_text;
use ash::vk;

/// No driver is installed, or none that finds a device of its own.
fn no_device() -> Error {
    Error::Device(
        "no Vulkan driver with a device found: install your GPU's driver, or the software device lavapipe (Debian: apt \
         install mesa-vulkan-drivers)"
            .into(),
    )
}

/// The error for a Vulkan call that failed while doing `what`: out of memory is the machine's lack, all else a fault.
fn vk_error(what: &str, result: vk::Result) -> Error {
    match result {
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
            Error::Device(format!("{what}: out of memory"))
        }
        vk::Result::ERROR_DEVICE_LOST => {
            Error::Internal(format!("{what}: the GPU was lost (driver crash or time-out)"))
        }
        other => Error::Internal(format!("{what}: {other}")),
    }
}
