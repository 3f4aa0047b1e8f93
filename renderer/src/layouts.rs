//! The one pipeline layout: buffers, a material's textures, a view's depth; the numbers of view and step pushed.

use crate::gpu_interface::{BUFFERS, TEXELS, UNIFORMS};
use crate::vk::{Buffer, Context, TexelView};
use crate::{Error, Result};
use ash::vk;
use std::sync::Arc;

/// Of view and step.
const PUSH_BYTES: u32 = 8;

/// Textures of a material; its data are bound behind them.
pub const MATERIAL_TEXTURES: u32 = 5;

/// What set [`crate::gpu_interface::SET_BUFFERS`] holds, in the order of its bindings.
pub const BUFFER_SET: [(vk::DescriptorType, u32); 3] = [
    (vk::DescriptorType::STORAGE_BUFFER, BUFFERS.len() as u32),
    (vk::DescriptorType::UNIFORM_TEXEL_BUFFER, TEXELS.len() as u32),
    (vk::DescriptorType::UNIFORM_BUFFER, UNIFORMS.len() as u32),
];

/// What set [`crate::gpu_interface::SET_MATERIAL`] holds.
pub const MATERIAL_SET: [(vk::DescriptorType, u32); 2] = [
    (vk::DescriptorType::COMBINED_IMAGE_SAMPLER, MATERIAL_TEXTURES),
    (vk::DescriptorType::UNIFORM_BUFFER, 1),
];

/// What set [`crate::gpu_interface::SET_DEPTH`] holds.
pub const DEPTH_SET: [(vk::DescriptorType, u32); 1] = [(vk::DescriptorType::SAMPLED_IMAGE, 1)];

/// Descriptor set layouts and the pipeline layout over them.
pub struct Layouts {
    context: Arc<Context>,
    /// [`crate::gpu_interface::SET_BUFFERS`].
    pub buffers: vk::DescriptorSetLayout,
    /// [`crate::gpu_interface::SET_MATERIAL`].
    pub material: vk::DescriptorSetLayout,
    /// [`crate::gpu_interface::SET_DEPTH`].
    pub depth: vk::DescriptorSetLayout,
    /// All of them, with the push constants that [`crate::gpu_interface::glsl`] declares.
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
        let buffers = set_layout(context, &BUFFER_SET, "buffers")?;
        let material = set_layout(context, &MATERIAL_SET, "material textures")?;
        let depth = set_layout(context, &DEPTH_SET, "depth image")?;
        let sets = [buffers, material, depth];
        let push = [vk::PushConstantRange::default().stage_flags(vk::ShaderStageFlags::ALL).size(PUSH_BYTES)];
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
    kinds: &[(vk::DescriptorType, u32)],
    name: &str,
) -> Result<vk::DescriptorSetLayout> {
    let of_bindings = kinds.iter().flat_map(|&(kind, count)| std::iter::repeat_n(kind, count as usize));
    let bindings: Vec<_> = (0..)
        .zip(of_bindings)
        .map(|(binding, kind)| {
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
    /// `count` sets of `layout`, each with so many descriptors of each kind, named `name` and their position.
    pub fn new(
        context: &Arc<Context>,
        name: &str,
        layout: vk::DescriptorSetLayout,
        kinds: &[(vk::DescriptorType, u32)],
        count: usize,
    ) -> Result<Self> {
        let failed = |e: vk::Result| Error::Device(format!("cannot allocate {count} descriptor sets: {e}"));
        let count = count.max(1);
        let size =
            |&(ty, each): &(_, u32)| vk::DescriptorPoolSize { ty, descriptor_count: each * count as u32 };
        let sizes: Vec<_> = kinds.iter().map(size).collect();
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

/// What the bindings of a buffer set are pointed to.
pub struct BufferSet<'a> {
    /// In the order of [`BUFFERS`].
    pub buffers: [&'a Buffer; BUFFERS.len()],
    /// In the order of [`TEXELS`].
    pub texels: &'a [TexelView; TEXELS.len()],
    /// In the order of [`UNIFORMS`].
    pub uniforms: [&'a Buffer; UNIFORMS.len()],
}

/// The whole of a buffer, for a descriptor.
fn whole(buffer: &Buffer) -> [vk::DescriptorBufferInfo; 1] {
    [vk::DescriptorBufferInfo::default().buffer(buffer.handle).offset(0).range(vk::WHOLE_SIZE)]
}

/// Points every binding of a buffer set to the whole of what it names.
pub fn write_buffer_set(context: &Context, set: vk::DescriptorSet, to: &BufferSet) {
    let (buffers, uniforms) = (to.buffers.map(whole), to.uniforms.map(whole));
    let views = to.texels.each_ref().map(|view| [view.handle]);
    let write = |binding: usize| vk::WriteDescriptorSet::default().dst_set(set).dst_binding(binding as u32);
    let storage = buffers.iter().enumerate().map(|(position, info)| {
        write(position).descriptor_type(vk::DescriptorType::STORAGE_BUFFER).buffer_info(info)
    });
    let texel = views.iter().enumerate().map(|(position, view)| {
        write(BUFFERS.len() + position)
            .descriptor_type(vk::DescriptorType::UNIFORM_TEXEL_BUFFER)
            .texel_buffer_view(view)
    });
    let uniform = uniforms.iter().enumerate().map(|(position, info)| {
        write(BUFFERS.len() + TEXELS.len() + position)
            .descriptor_type(vk::DescriptorType::UNIFORM_BUFFER)
            .buffer_info(info)
    });
    let writes: Vec<_> = storage.chain(texel).chain(uniform).collect();
    unsafe { context.device.update_descriptor_sets(&writes, &[]) };
}
