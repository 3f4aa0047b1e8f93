//! Two-dimensional images that free themselves.

use super::context::Context;
use super::vk_error;
use crate::{Error, Result};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::sync::Arc;

/// What kind of image to make.
#[derive(Debug, Clone, Copy)]
pub struct ImageDesc {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Levels, at least 1.
    pub mip_levels: u32,
    /// Layers, at least 1.
    pub layers: u32,
    /// Format of a texel.
    pub format: vk::Format,
    /// Number of samples a texel.
    pub samples: vk::SampleCountFlags,
    /// Everything that the image is used for.
    pub usage: vk::ImageUsageFlags,
    /// Aspect that the image's view shows.
    pub aspect: vk::ImageAspectFlags,
    /// Whether each layer has a view of its own too.
    pub layer_views: bool,
}

impl Default for ImageDesc {
    /// A colour image of one level, one layer and one sample; size, format and usage must be set.
    fn default() -> Self {
        Self {
            width: 0,
            height: 0,
            mip_levels: 1,
            layers: 1,
            format: vk::Format::UNDEFINED,
            samples: vk::SampleCountFlags::TYPE_1,
            usage: vk::ImageUsageFlags::empty(),
            aspect: vk::ImageAspectFlags::COLOR,
            layer_views: true,
        }
    }
}

/// A device-local image with its memory, a view of all its levels and layers, and one of each layer where these are wanted. Its layout starts as UNDEFINED.
pub struct Image {
    /// Vulkan handle, for commands.
    pub handle: vk::Image,
    /// All levels and layers, of [`Image::aspect`]; an array where there are several layers.
    pub view: vk::ImageView,
    /// All levels of each layer; none where they were not wanted.
    pub layer_views: Vec<vk::ImageView>,
    /// Format of a texel.
    pub format: vk::Format,
    /// Size of level 0, texels.
    pub extent: vk::Extent2D,
    /// Number of mip levels.
    pub mip_levels: u32,
    /// Number of layers.
    pub layers: u32,
    /// Number of samples a texel.
    pub samples: vk::SampleCountFlags,
    /// What the view shows.
    pub aspect: vk::ImageAspectFlags,
    allocation: Option<Allocation>,
    context: Arc<Context>,
}

impl Image {
    /// Makes the image and its view.
    ///
    /// # Errors
    /// [`Error::Device`] when the size, format or sample count is over what the device has, or the memory is out.
    pub fn new(context: &Arc<Context>, name: &str, desc: ImageDesc) -> Result<Self> {
        check(context, name, &desc)?;
        let ImageDesc { width, height, mip_levels, layers, format, samples, usage, aspect, layer_views } =
            desc;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(mip_levels)
            .array_layers(layers)
            .samples(samples)
            .usage(usage);
        let handle = unsafe { context.device.create_image(&info, None) }
            .map_err(|e| vk_error(&format!("{name}: making an image of {width}x{height} texels"), e))?;
        context.name(handle, name);
        let mut image = Self {
            handle,
            view: vk::ImageView::null(),
            layer_views: vec![],
            format,
            extent: vk::Extent2D { width, height },
            mip_levels,
            layers,
            samples,
            aspect,
            allocation: None,
            context: context.clone(),
        };
        image.bind(name)?;
        image.make_views(name, layer_views)?;
        Ok(image)
    }

    /// All levels and layers, for barriers and views.
    pub fn range(&self) -> vk::ImageSubresourceRange {
        let range = vk::ImageSubresourceRange::default().aspect_mask(self.aspect);
        range.level_count(self.mip_levels).layer_count(self.layers)
    }

    fn bind(&mut self, name: &str) -> Result<()> {
        let device = &self.context.device;
        let allocation = self.context.allocate(&AllocationCreateDesc {
            name,
            requirements: unsafe { device.get_image_memory_requirements(self.handle) },
            location: MemoryLocation::GpuOnly,
            linear: false,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        })?;
        let bound =
            unsafe { device.bind_image_memory(self.handle, allocation.memory(), allocation.offset()) };
        self.allocation = Some(allocation);
        bound.map_err(|e| vk_error(&format!("{name}: binding memory"), e))
    }

    fn make_views(&mut self, name: &str, of_layers: bool) -> Result<()> {
        let kind =
            if self.layers > 1 { vk::ImageViewType::TYPE_2D_ARRAY } else { vk::ImageViewType::TYPE_2D };
        self.view = self.make_view(name, kind, self.range())?;
        for layer in 0..if of_layers { self.layers } else { 0 } {
            let range = self.range().base_array_layer(layer).layer_count(1);
            let view = self.make_view(&format!("{name} layer {layer}"), vk::ImageViewType::TYPE_2D, range)?;
            self.layer_views.push(view);
        }
        Ok(())
    }

    fn make_view(
        &self,
        name: &str,
        kind: vk::ImageViewType,
        range: vk::ImageSubresourceRange,
    ) -> Result<vk::ImageView> {
        let info = vk::ImageViewCreateInfo::default()
            .image(self.handle)
            .view_type(kind)
            .format(self.format)
            .subresource_range(range);
        let view = unsafe { self.context.device.create_image_view(&info, None) }
            .map_err(|e| vk_error(&format!("{name}: making an image view"), e))?;
        self.context.name(view, name);
        Ok(view)
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        unsafe {
            for view in self.layer_views.drain(..).chain([self.view]) {
                self.context.device.destroy_image_view(view, None);
            }
            self.context.device.destroy_image(self.handle, None);
        }
        if let Some(allocation) = self.allocation.take() {
            self.context.free(allocation);
        }
    }
}

/// Asks the device about this very combination, beyond the general limits.
fn check(context: &Context, name: &str, desc: &ImageDesc) -> Result<()> {
    let ImageDesc { width, height, mip_levels, layers, format, samples, usage, .. } = *desc;
    let on = &context.info.name;
    let side = context.limits.max_image_dimension_2d;
    if !(1..=side).contains(&width) || !(1..=side).contains(&height) {
        return Err(Error::Device(format!(
            "{name}: {width}x{height} texels, each side must be 1 to {side} on {on}"
        )));
    }
    let properties = context.image_format_properties(format, usage).map_err(|e| match e {
        vk::Result::ERROR_FORMAT_NOT_SUPPORTED => {
            Error::Device(format!("{name}: {on} has no {format:?} images used as {usage:?}"))
        }
        other => vk_error(&format!("{name}: asking for image limits"), other),
    })?;
    let vk::Extent3D { width: w, height: h, .. } = properties.max_extent;
    if width > w || height > h {
        return Err(Error::Device(format!(
            "{name}: {width}x{height} texels of {format:?}, {on} has at most {w}x{h}"
        )));
    }
    if !properties.sample_counts.contains(samples) {
        let count = samples.as_raw();
        return Err(Error::Device(format!(
            "{name}: {on} has no {format:?} images of {count} samples a texel"
        )));
    }
    if !(1..=properties.max_mip_levels).contains(&mip_levels) {
        let most = properties.max_mip_levels;
        return Err(Error::Device(format!("{name}: {mip_levels} mip levels, {on} has 1 to {most}")));
    }
    if !(1..=properties.max_array_layers).contains(&layers) {
        let most = properties.max_array_layers;
        return Err(Error::Device(format!("{name}: {layers} layers, {on} has 1 to {most}")));
    }
    Ok(())
}
