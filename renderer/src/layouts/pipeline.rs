//! A pipeline with its layout and what its shaders use.

use super::{Layouts, Uses, failed, set_layout};
use crate::Result;
use crate::buffers::{BUFFER_COUNT, BufferSet};
use crate::gpu_interface::Push;
use crate::targets::TargetName;
use crate::vk::{self as gpu, Context, c_string};
use ash::vk;
use std::ffi::CString;
use std::sync::Arc;

/// Size of what shaders are told by push constants.
const PUSH_BYTES: u32 = size_of::<Push>() as u32;

/// The layout of one pipeline: of the buffers, only those that its shaders use.
pub struct PipelineLayout {
    context: Arc<Context>,
    /// Vulkan handle, for making and binding the pipeline.
    pub handle: vk::PipelineLayout,
    /// Layout of the pipeline's set of buffers.
    pub buffers: vk::DescriptorSetLayout,
    /// What the pipeline's shaders use.
    pub uses: Uses,
}

impl PipelineLayout {
    /// The layout for the shaders of some stages, by their SPIR-V.
    ///
    /// # Errors
    /// The device binds too few storage buffers, or is out of memory.
    pub fn new(
        context: &Arc<Context>,
        layouts: &Layouts,
        name: &str,
        stages: &[(vk::ShaderStageFlags, &[u32])],
    ) -> Result<Self> {
        let uses = Uses::new(name, stages)?;
        uses.check(name, &context.info.name, context.limits.max_per_stage_storage_buffers)?;
        let bindings: Vec<_> = uses
            .views
            .iter()
            .map(|(&(buffer, view), &stages)| (buffer.binding(view), view.descriptor(), stages))
            .collect();
        let buffers = set_layout(context, &bindings, name)?;
        let mut this = Self { context: context.clone(), handle: vk::PipelineLayout::null(), buffers, uses };
        let sets = [buffers, layouts.material, layouts.targets];
        let push = [vk::PushConstantRange::default().stage_flags(vk::ShaderStageFlags::ALL).size(PUSH_BYTES)];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&push);
        this.handle = unsafe { context.device.create_pipeline_layout(&info, None) }
            .map_err(|e| failed("pipeline layout", name, e))?;
        context.name(this.handle, name);
        Ok(this)
    }
}

impl Drop for PipelineLayout {
    fn drop(&mut self) {
        let device = &self.context.device;
        unsafe {
            device.destroy_pipeline_layout(self.handle, None);
            device.destroy_descriptor_set_layout(self.buffers, None);
        }
    }
}

/// A pipeline that passes bind by what it is given to work on.
pub struct Pipeline {
    /// Vulkan handle, for binding.
    pub handle: vk::Pipeline,
    /// Layout that the pipeline is bound with.
    pub layout: PipelineLayout,
    /// Path of the shader that names the pipeline.
    pub name: String,
    /// What tools for captures show.
    pub label: CString,
    /// The colour targets that it draws into, in the order of its fragment shader's locations.
    pub targets: &'static [TargetName],
    /// Number of the pipeline among all, by which its descriptor sets are found.
    pub number: usize,
    _pipeline: gpu::Pipeline,
}

impl Pipeline {
    /// The name without folder and extension.
    pub fn stem(&self) -> &str {
        let file = self.name.rsplit('/').next().unwrap_or_default();
        file.split('.').next().unwrap_or_default()
    }

    /// Pipeline `number` of the program, which draws into no colour target.
    pub fn new(pipeline: gpu::Pipeline, layout: PipelineLayout, name: &str, number: usize) -> Self {
        let (name, label) = (name.to_owned(), c_string(name));
        Self { handle: pipeline.handle, layout, name, label, targets: &[], number, _pipeline: pipeline }
    }

    /// This pipeline, made for these colour targets.
    pub fn drawing_into(self, targets: &'static [TargetName]) -> Self {
        Self { targets, ..self }
    }

    /// What the pipeline's shaders use.
    pub fn uses(&self) -> &Uses {
        &self.layout.uses
    }
}

/// The buffers of one clustering in one frame in flight, and the sets that bind them.
#[derive(Clone, Copy)]
pub struct BoundBuffers<'a> {
    /// Vulkan buffers, in the order of [`crate::buffers::BufferName::ALL`].
    pub handles: &'a [vk::Buffer; BUFFER_COUNT],
    /// Descriptor sets, by the number of the pipeline.
    pub sets: &'a [vk::DescriptorSet],
    /// Buffers that the way at hand leaves empty: nothing is read from or written to them.
    pub empty: BufferSet,
}
