//! What a configuration asks of the device.

use crate::assign::Marking;
use crate::config::Config;
use crate::culling::Culling;
use crate::geometry::views::ViewSet;
use crate::methods::Method;
use crate::vk::Context;
use crate::{Error, Result};

/// Refuses what the device cannot do, before anything is made.
pub fn check_device(context: &Context, config: &Config, views: ViewSet) -> Result<()> {
    let limits = &context.limits;
    let (samples, marking) = (config.msaa, config.marking);
    if !limits.sample_counts.contains(&samples) {
        return Err(Error::Device(format!(
            "{} cannot render {samples} samples per pixel (it can: {:?}): change --msaa",
            context.info.name, limits.sample_counts
        )));
    }
    if samples > 1 && !limits.standard_sample_locations {
        return Err(Error::Device(format!(
            "{} does not say where its samples lie (it lacks standardSampleLocations), which clusters of samples need: use \
             --msaa 1",
            context.info.name
        )));
    }
    if samples > 1 && marking == Marking::Depth && !limits.sample_rate_shading {
        return Err(Error::Device(format!(
            "{} cannot shade per sample, which marking from depth needs with MSAA: use --marking geometry",
            context.info.name
        )));
    }
    let indirect = limits.max_draw_indirect_count > 1 && limits.draw_indirect_first_instance;
    if config.culling == Culling::Gpu && !indirect {
        return Err(Error::Device(format!(
            "{} lacks multiDrawIndirect or drawIndirectFirstInstance, which culling on the device needs: use --culling \
             cpu",
            context.info.name
        )));
    }
    if config.multiview && !limits.shader_output_layer {
        return Err(Error::Device(format!(
            "{} lacks shaderOutputLayer, which drawing all views at once needs: leave --multiview out",
            context.info.name
        )));
    }
    let draws_shells = config.methods.iter().any(Method::has_shells);
    if draws_shells
        && config.conservative.iter().any(|way| way.is_hardware())
        && !limits.conservative_rasterization
    {
        return Err(Error::Device(format!(
            "{} lacks VK_EXT_conservative_rasterization, which drawing meshes by hardware needs: use --conservative auto",
            context.info.name
        )));
    }
    if draws_shells && config.conservative.iter().any(|way| way.has_layers()) && !limits.shader_output_layer {
        return Err(Error::Device(format!(
            "{} lacks shaderOutputLayer, which drawing meshes into layers needs: use --conservative without -layers",
            context.info.name
        )));
    }
    if config.multiview && samples > 1 && !limits.multisample_array_images {
        return Err(Error::Device(format!(
            "{} lacks multisampleArrayImage, which drawing all views at once with MSAA needs: leave --multiview out",
            context.info.name
        )));
    }
    if views.mirrors && !limits.shader_clip_distance {
        return Err(Error::Device(format!(
            "{} lacks shaderClipDistance, which views in mirrors need: use a recording without",
            context.info.name
        )));
    }
    Ok(())
}
