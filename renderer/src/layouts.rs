//! Descriptor set layouts and sets: of a pipeline's buffers, of a material's textures, of a view's targets.

mod pipeline;
mod uses;

pub use pipeline::{BoundBuffers, Pipeline, PipelineLayout};
pub use uses::Uses;

use crate::targets::TARGET_COUNT;
use crate::vk::Context;
use crate::{Error, Result};
use ash::vk;
use std::sync::Arc;

/// Textures of a material; its data are bound behind them.
pub const MATERIAL_TEXTURES: u32 = 5;

/// What set [`crate::gpu_interface::SET_MATERIAL`] holds.
pub const MATERIAL_SET: [(vk::DescriptorType, u32); 2] = [
    (vk::DescriptorType::COMBINED_IMAGE_SAMPLER, MATERIAL_TEXTURES),
    (vk::DescriptorType::UNIFORM_BUFFER, 1),
];

/// What set [`crate::gpu_interface::SET_TARGETS`] holds: depth and colour targets.
pub const TARGETS_SET: [(vk::DescriptorType, u32); 1] =
    [(vk::DescriptorType::SAMPLED_IMAGE, 1 + TARGET_COUNT as u32)];

/// The descriptor set layouts that pipelines share.
pub struct Layouts {
    context: Arc<Context>,
    /// Layout of the descriptor set [`crate::gpu_interface::SET_MATERIAL`].
    pub material: vk::DescriptorSetLayout,
    /// Layout of the descriptor set [`crate::gpu_interface::SET_TARGETS`].
    pub targets: vk::DescriptorSetLayout,
}

impl Layouts {
    /// Makes the layouts that pipelines share.
    pub fn new(context: &Arc<Context>) -> Result<Self> {
        let material = set_layout(context, &dense(&MATERIAL_SET), "material textures")?;
        let targets = set_layout(context, &dense(&TARGETS_SET), "targets")?;
        Ok(Self { context: context.clone(), material, targets })
    }
}

impl Drop for Layouts {
    fn drop(&mut self) {
        for set in [self.material, self.targets] {
            unsafe { self.context.device.destroy_descriptor_set_layout(set, None) };
        }
    }
}

/// A binding: its number, what it holds, the stages that read it.
type SetBinding = (u32, vk::DescriptorType, vk::ShaderStageFlags);

/// Bindings one behind the other, for all stages.
fn dense(kinds: &[(vk::DescriptorType, u32)]) -> Vec<SetBinding> {
    let kinds = kinds.iter().flat_map(|&(kind, count)| std::iter::repeat_n(kind, count as usize));
    (0..).zip(kinds).map(|(binding, kind)| (binding, kind, vk::ShaderStageFlags::ALL)).collect()
}

fn set_layout(context: &Context, bindings: &[SetBinding], name: &str) -> Result<vk::DescriptorSetLayout> {
    let bindings: Vec<_> = bindings
        .iter()
        .map(|&(binding, kind, stages)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(kind)
                .descriptor_count(1)
                .stage_flags(stages)
        })
        .collect();
    let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
    let layout = unsafe { context.device.create_descriptor_set_layout(&info, None) }
        .map_err(|e| failed("descriptor set layout", name, e))?;
    context.name(layout, name);
    Ok(layout)
}

fn failed(what: &str, name: &str, result: vk::Result) -> Error {
    Error::Device(format!("cannot create the {what} '{name}': {result}"))
}

/// A pool of sets, all allocated at once and freed together.
pub struct DescriptorSets {
    context: Arc<Context>,
    pool: vk::DescriptorPool,
    /// Descriptor sets, as many as asked for.
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
        let count = count.max(1);
        let kinds: Vec<_> = kinds.iter().map(|&(kind, each)| (kind, each * count as u32)).collect();
        Self::of(context, name, &vec![layout; count], &kinds)
    }

    /// A set of each layout, together with so many descriptors of each kind, named `name` and their position.
    pub fn of(
        context: &Arc<Context>,
        name: &str,
        layouts: &[vk::DescriptorSetLayout],
        kinds: &[(vk::DescriptorType, u32)],
    ) -> Result<Self> {
        let failed =
            |e: vk::Result| Error::Device(format!("cannot allocate {} descriptor sets: {e}", layouts.len()));
        let size = |&(ty, descriptor_count): &(_, u32)| vk::DescriptorPoolSize { ty, descriptor_count };
        let sizes: Vec<_> = kinds.iter().filter(|kind| kind.1 > 0).map(size).collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(layouts.len() as u32).pool_sizes(&sizes);
        let pool = unsafe { context.device.create_descriptor_pool(&info, None) }.map_err(failed)?;
        context.name(pool, name);
        let mut this = Self { context: context.clone(), pool, sets: vec![] };
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(layouts);
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
