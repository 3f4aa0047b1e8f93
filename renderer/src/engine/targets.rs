//! Makes what views are rendered into.

use crate::Result;
use crate::config::Config;
use crate::passes::{ColorTarget, ImageLayer, ViewTargets};
use crate::targets::{DEPTH_FORMAT, TargetName};
use crate::vk::{Context, Image, ImageDesc};
use ash::vk;
use std::sync::Arc;

/// Targets for each view, whose depths `depth_sets` name: images of its own, or with multiview layers of shared ones.
pub fn make_targets(
    context: &Arc<Context>,
    config: &Config,
    depth_sets: &[vk::DescriptorSet],
) -> Result<Vec<ViewTargets>> {
    let [width, height] = config.resolution;
    let images = |suffix, layers: usize| Images {
        context,
        suffix,
        desc: ImageDesc { width, height, layers: layers as u32, ..ImageDesc::default() },
        samples: vk::SampleCountFlags::from_raw(config.msaa),
    };
    if config.multiview {
        return images(String::new(), depth_sets.len()).targets(depth_sets);
    }
    let sets = depth_sets.chunks(1).enumerate();
    let own = sets.map(|(view, set)| images(format!("[{view}]"), 1).targets(set));
    Ok(own.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}

/// Makes images that some views share, a layer each.
struct Images<'a> {
    context: &'a Arc<Context>,
    /// What follows the names of images.
    suffix: String,
    /// Their size.
    desc: ImageDesc,
    /// Samples a pixel of what is drawn into.
    samples: vk::SampleCountFlags,
}

impl Images<'_> {
    fn targets(&self, depth_sets: &[vk::DescriptorSet]) -> Result<Vec<ViewTargets>> {
        let depth = self.depth()?;
        let colors = TargetName::ALL.map(|name| self.color(name));
        let colors = colors.into_iter().collect::<Result<Vec<_>>>()?;
        let target = |(index, &depth_set): (usize, &vk::DescriptorSet)| {
            let depth = ImageLayer::new(&depth, index);
            write_depth_set(self.context, depth_set, depth.view);
            let color = |(drawn, resolved): &(Arc<Image>, Option<Arc<Image>>)| ColorTarget {
                drawn: ImageLayer::new(drawn, index),
                resolved: resolved.as_ref().map(|image| ImageLayer::new(image, index)),
            };
            ViewTargets { depth, depth_set, colors: colors.iter().map(color).collect() }
        };
        Ok(depth_sets.iter().enumerate().map(target).collect())
    }

    fn depth(&self) -> Result<Arc<Image>> {
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let (samples, aspect) = (self.samples, vk::ImageAspectFlags::DEPTH);
        self.image("depth", ImageDesc { format: DEPTH_FORMAT, samples, usage, aspect, ..self.desc })
    }

    /// What is drawn into, and with MSAA what it is resolved to.
    fn color(&self, name: TargetName) -> Result<(Arc<Image>, Option<Arc<Image>>)> {
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

fn write_depth_set(context: &Context, set: vk::DescriptorSet, view: vk::ImageView) {
    let info = [vk::DescriptorImageInfo::default()
        .image_view(view)
        .image_layout(vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL)];
    let write = vk::WriteDescriptorSet::default()
        .dst_set(set)
        .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
        .image_info(&info);
    unsafe { context.device.update_descriptor_sets(&[write], &[]) };
}
