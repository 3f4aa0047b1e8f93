//! The one pipeline layout: storage buffers, a material's textures, a view's depth; the numbers of view and step pushed.

use crate::gpu_interface::BUFFERS;
use crate::vk::Context;
use crate::{Error, Result};
use ash::vk;
use std::sync::Arc;

/// Textures of a material.
pub const MATERIAL_TEXTURES: u32 = 5;

/// Descriptor set layouts and the pipeline layout over them.
pub struct Layouts {
    context: Arc<Context>,
    /// [`crate::gpu_interface::SET_BUFFERS`].
    pub buffers: vk::DescriptorSetLayout,
    /// [`crate::gpu_interface::SET_MATERIAL`].
    pub material: vk::DescriptorSetLayout,
    /// [`crate::gpu_interface::SET_DEPTH`].
    pub depth: vk::DescriptorSetLayout,
    /// All of them, with the push constants `view` and `step`, four bytes each.
    pub pipeline: vk::PipelineLayout,
}

impl Layouts {
    /// Makes the layouts; the device must allow that many storage buffers per stage.
    pub fn new(context: &Arc<Context>) -> Result<Self> {
        let needed = BUFFERS.len() as u32;
        let have = context.limits.max_per_stage_storage_buffers;
        if have < needed {
            return Err(Error::Device(format!(
                "{} binds {have} storage buffers per shader stage, {needed} are needed: choose another device",
                context.info.name
            )));
        }
        let buffers = set_layout(context, vk::DescriptorType::STORAGE_BUFFER, needed, "buffers")?;
        let material = set_layout(
            context,
            vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
            MATERIAL_TEXTURES,
            "material textures",
        )?;
        let depth = set_layout(context, vk::DescriptorType::SAMPLED_IMAGE, 1, "depth image")?;
        let sets = [buffers, material, depth];
        let push = [vk::PushConstantRange::default().stage_flags(vk::ShaderStageFlags::ALL).size(8)];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&push);
        let pipeline = unsafe { context.device.create_pipeline_layout(&info, None) }
            .map_err(|e| Error::Device(format!("cannot create the pipeline layout: {e}")))?;
        context.name(pipeline, "pipeline layout");
        Ok(Self { context: context.clone(), buffers, material, depth, pipeline })
    }
}

impl Drop for Layouts {
    fn drop(&mut self) {
        let device = &self.context.device;
        unsafe {
            device.destroy_pipeline_layout(self.pipeline, None);
            for set in [self.buffers, self.material, self.depth] {
                device.destroy_descriptor_set_layout(set, None);
            }
        }
    }
}

fn set_layout(
    context: &Context,
    kind: vk::DescriptorType,
    count: u32,
    name: &str,
) -> Result<vk::DescriptorSetLayout> {
    let bindings: Vec<_> = (0..count)
        .map(|binding| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(kind)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::ALL)
        })
        .collect();
    let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
    let layout = unsafe { context.device.create_descriptor_set_layout(&info, None) }
        .map_err(|e| Error::Device(format!("cannot create the descriptor set layout '{name}': {e}")))?;
    context.name(layout, name);
    Ok(layout)
}

/// A pool of sets of one layout, all allocated at once and freed together.
pub struct DescriptorSets {
    context: Arc<Context>,
    pool: vk::DescriptorPool,
    /// As many as asked for.
    pub sets: Vec<vk::DescriptorSet>,
}

impl DescriptorSets {
    /// `count` sets of `layout`, each with `descriptors` descriptors of `kind`, named `name` and their position.
    pub fn new(
        context: &Arc<Context>,
        name: &str,
        layout: vk::DescriptorSetLayout,
        (kind, descriptors): (vk::DescriptorType, u32),
        count: usize,
    ) -> Result<Self> {
        let failed = |e: vk::Result| Error::Device(format!("cannot allocate {count} descriptor sets: {e}"));
        let count = count.max(1);
        let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: descriptors * count as u32 }];
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(count as u32).pool_sizes(&sizes);
        let pool = unsafe { context.device.create_descriptor_pool(&info, None) }.map_err(failed)?;
        context.name(pool, name);
        let mut this = Self { context: context.clone(), pool, sets: vec![] };
        let layouts = vec![layout; count];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
        this.sets = unsafe { context.device.allocate_descriptor_sets(&info) }.map_err(failed)?;
        for (index, &set) in this.sets.iter().enumerate() {
            context.name(set, &format!("{name} {index}"));
        }
        Ok(this)
    }
}

impl Drop for DescriptorSets {
    fn drop(&mut self) {
        unsafe { self.context.device.destroy_descriptor_pool(self.pool, None) };
    }
}

/// Points every binding of a buffer set to a whole buffer, in the order of [`BUFFERS`].
pub fn write_buffer_set(context: &Context, set: vk::DescriptorSet, buffers: &[vk::Buffer; BUFFERS.len()]) {
    let infos = buffers
        .map(|buffer| [vk::DescriptorBufferInfo::default().buffer(buffer).offset(0).range(vk::WHOLE_SIZE)]);
    let writes: Vec<_> = infos
        .iter()
        .enumerate()
        .map(|(binding, info)| {
            vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(binding as u32)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(info)
        })
        .collect();
    unsafe { context.device.update_descriptor_sets(&writes, &[]) };
}
