//! Makes what views are rendered into.

use crate::Result;
use crate::config::Config;
use crate::methods::Method;
use crate::passes::{ColorTarget, ImageLayer, ViewTargets};
use crate::shading::ShadingPipeline;
use crate::targets::{DEPTH_FORMAT, TARGET_COUNT, TargetName, filled};
use crate::vk::{Context, Image, ImageDesc};
use ash::vk;
use std::sync::Arc;

/// Targets for each view that some run of a configuration draws into, bound by a set of `sets` each: images of its own, or with
/// multiview layers of shared ones.
pub fn make_targets(
    context: &Arc<Context>,
    config: &Config,
    sets: &[vk::DescriptorSet],
) -> Result<Vec<ViewTargets>> {
    let [width, height] = config.resolution;
    let images = |suffix, layers: usize| Images {
        context,
        suffix,
        drawn: drawn(config),
        desc: ImageDesc { width, height, layers: layers as u32, ..ImageDesc::default() },
        samples: vk::SampleCountFlags::from_raw(config.msaa),
    };
    if config.multiview {
        return images(String::new(), sets.len()).targets(sets);
    }
    let own = sets.chunks(1).enumerate().map(|(view, set)| images(format!("[{view}]"), 1).targets(set));
    Ok(own.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}

/// The colour targets that the runs of a configuration draw into.
fn drawn(config: &Config) -> &'static [TargetName] {
    match config.pipeline.contains(&ShadingPipeline::Deferred) {
        true => filled(config.methods.contains(&Method::Models)),
        false => &[TargetName::Radiance],
    }
}

/// What is drawn into, and what it is resolved to.
type ColorImages = (Arc<Image>, Option<Arc<Image>>);

/// Makes images that some views share, a layer each.
struct Images<'a> {
    context: &'a Arc<Context>,
    /// What follows the names of images.
    suffix: String,
    /// Colour targets that are made.
    drawn: &'static [TargetName],
    /// Their size.
    desc: ImageDesc,
    /// Samples a pixel of what is drawn into.
    samples: vk::SampleCountFlags,
}

impl Images<'_> {
    fn targets(&self, sets: &[vk::DescriptorSet]) -> Result<Vec<ViewTargets>> {
        let depth = self.depth()?;
        let mut colors: [Option<ColorImages>; TARGET_COUNT] = Default::default();
        for &name in self.drawn {
            colors[name as usize] = Some(self.color(name)?);
        }
        let target = |(index, &set): (usize, &vk::DescriptorSet)| {
            let color = |(drawn, resolved): &ColorImages| ColorTarget {
                drawn: ImageLayer::new(drawn, index),
                resolved: resolved.as_ref().map(|image| ImageLayer::new(image, index)),
            };
            let colors = colors.each_ref().map(|images| images.as_ref().map(color));
            let targets = ViewTargets { depth: ImageLayer::new(&depth, index), set, colors };
            self.write_set(&targets);
            targets
        };
        Ok(sets.iter().enumerate().map(target).collect())
    }

    /// Binds what shaders sample of a view's targets. What is not made is not bound, and no shader of the session asks for it.
    fn write_set(&self, targets: &ViewTargets) {
        self.write_image(targets.set, 0, (targets.depth.view, vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL));
        for &name in self.drawn.iter().filter(|name| name.is_sampled()) {
            let image = (targets[name].drawn.view, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
            self.write_image(targets.set, name.binding(), image);
        }
    }

    fn write_image(
        &self,
        set: vk::DescriptorSet,
        binding: u32,
        (view, layout): (vk::ImageView, vk::ImageLayout),
    ) {
        let info = [vk::DescriptorImageInfo::default().image_view(view).image_layout(layout)];
        let write = vk::WriteDescriptorSet::default()
            .dst_set(set)
            .dst_binding(binding)
            .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
            .image_info(&info);
        unsafe { self.context.device.update_descriptor_sets(&[write], &[]) };
    }

    fn depth(&self) -> Result<Arc<Image>> {
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let (samples, aspect) = (self.samples, vk::ImageAspectFlags::DEPTH);
        self.image("depth", ImageDesc { format: DEPTH_FORMAT, samples, usage, aspect, ..self.desc })
    }

    /// What is drawn into, and with MSAA what it is resolved to.
    fn color(&self, name: TargetName) -> Result<ColorImages> {
        use vk::ImageUsageFlags as U;
        let info = name.info();
        let resolves = info.resolved && self.samples != vk::SampleCountFlags::TYPE_1;
        let desc = ImageDesc { format: info.format, ..self.desc };
        let source = if resolves { U::TRANSFER_SRC } else { U::empty() };
        let usage = U::COLOR_ATTACHMENT | source | info.usage;
        let drawn = self.image(info.name, ImageDesc { samples: self.samples, usage, ..desc })?;
        // An image view needs a use that may have one.
        let usage = U::TRANSFER_DST | U::SAMPLED | info.usage;
        let resolved = resolves
            .then(|| self.image(&format!("resolved {}", info.name), ImageDesc { usage, ..desc }))
            .transpose()?;
        Ok((drawn, resolved))
    }

    fn image(&self, name: &str, desc: ImageDesc) -> Result<Arc<Image>> {
        Image::new(self.context, &format!("{name}{}", self.suffix), desc).map(Arc::new)
    }
}
