//! The samplers that materials ask for.

use super::context::Context;
use super::vk_error;
use crate::{Result, scene};
use ash::vk;
use std::sync::Arc;

/// Anisotropy of linear filtering, where the device has as much.
const ANISOTROPY: f32 = 8.0;

const WRAPS: [scene::Wrap; 3] = [scene::Wrap::Repeat, scene::Wrap::Mirror, scene::Wrap::Clamp];

/// One sampler for every [`scene::Sampler`] there can be (18), all made at once.
pub struct SamplerCache {
    samplers: Vec<vk::Sampler>,
    context: Arc<Context>,
}

impl SamplerCache {
    /// Makes all samplers.
    pub fn new(context: &Arc<Context>) -> Result<Self> {
        let mut cache = Self { samplers: Vec::new(), context: context.clone() };
        for key in all() {
            cache.samplers.push(make(context, key)?);
        }
        Ok(cache)
    }

    /// The sampler with the filter and wrap modes of `key`: nearest texel and nearest mip, or trilinear and,
    /// on GPUs, anisotropic up to the lesser of 8 and the device's limit.
    pub fn get(&self, key: scene::Sampler) -> vk::Sampler {
        self.samplers[index(key)]
    }
}

impl Drop for SamplerCache {
    fn drop(&mut self) {
        self.samplers
            .iter()
            .for_each(|&sampler| unsafe { self.context.device.destroy_sampler(sampler, None) });
    }
}

/// Every key, each at the place that [`index`] gives it.
fn all() -> impl Iterator<Item = scene::Sampler> {
    let pairs = WRAPS.into_iter().flat_map(|u| WRAPS.into_iter().map(move |v| [u, v]));
    pairs.flat_map(|wrap| [false, true].map(|nearest| scene::Sampler { wrap, nearest }))
}

fn index(key: scene::Sampler) -> usize {
    let [u, v] = key.wrap.map(|wrap| match wrap {
        scene::Wrap::Repeat => 0,
        scene::Wrap::Mirror => 1,
        scene::Wrap::Clamp => 2,
    });
    (u * WRAPS.len() + v) * 2 + usize::from(key.nearest)
}

fn make(context: &Context, key: scene::Sampler) -> Result<vk::Sampler> {
    let [u, v] = key.wrap.map(|wrap| match wrap {
        scene::Wrap::Repeat => vk::SamplerAddressMode::REPEAT,
        scene::Wrap::Mirror => vk::SamplerAddressMode::MIRRORED_REPEAT,
        scene::Wrap::Clamp => vk::SamplerAddressMode::CLAMP_TO_EDGE,
    });
    let (filter, mipmap) = match key.nearest {
        true => (vk::Filter::NEAREST, vk::SamplerMipmapMode::NEAREST),
        false => (vk::Filter::LINEAR, vk::SamplerMipmapMode::LINEAR),
    };
    let anisotropy = max_anisotropy(context);
    let info = vk::SamplerCreateInfo::default()
        .mag_filter(filter)
        .min_filter(filter)
        .mipmap_mode(mipmap)
        .address_mode_u(u)
        .address_mode_v(v)
        .anisotropy_enable(!key.nearest && anisotropy > 1.0)
        .max_anisotropy(anisotropy.max(1.0))
        .max_lod(vk::LOD_CLAMP_NONE);
    let sampler =
        unsafe { context.device.create_sampler(&info, None) }.map_err(|e| vk_error("making a sampler", e))?;
    context.name(sampler, &format!("sampler {:?}", key));
    Ok(sampler)
}

/// Software rasterisers filter without anisotropy: llvmpipe walks every texel under a pixel's ellipse, which at grazing
/// angles is millions, and seems to hang.
fn max_anisotropy(context: &Context) -> f32 {
    if context.info.hardware.is_cpu() { 0.0 } else { context.limits.max_sampler_anisotropy.min(ANISOTROPY) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_has_its_own_place() {
        assert!(all().map(index).eq(0..18));
    }
}
