//! A scene on the device: vertices, indices, materials, instances, textures.

use crate::Result;
use crate::buffers::BufferName;
use crate::draw_list::{Batch, Batches};
use crate::drawables::Drawables;
use crate::gpu_interface::{InstanceData, MaterialData};
use crate::layouts::{DescriptorSets, Layouts, MATERIAL_SET, MATERIAL_TEXTURES};
use crate::placements::{Placement, middle, model_boxes, near_vertices, placements};
use crate::scene::{Image, Material, Sampler, Scene, TextureRef, TextureSlot, Wrap};
use crate::texture_sets::TextureSet;
use crate::vk::{self as gpu, Buffer, Context, SamplerCache};
use ash::vk;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

/// A scene ready to draw.
pub struct GpuScene {
    /// Vertices of all primitives, each a [`crate::scene::Vertex`].
    pub vertices: Buffer,
    /// 32-bit indices of all primitives.
    pub indices: Buffer,
    /// [`crate::gpu_interface::InstanceData`] in drawing order, relative to `origin`.
    pub instances: Buffer,
    /// Origin of the frames that can be drawn now (see [`crate::origin`]), metres.
    pub origin: DVec3,
    /// Lowest and highest corner of all geometry in the world, metres; `None` without any.
    pub bounds: Option<(DVec3, DVec3)>,
    /// No instance reaches farther from `origin`, metres.
    pub reach: f64,
    placements: Vec<Placement>,
    /// [`crate::gpu_interface::ModelBox`] in drawing order.
    pub model_boxes: Buffer,
    /// Draw commands of all drawables, as [`Drawables::all`] has them.
    pub drawables: Buffer,
    /// What can be drawn at once.
    pub batches: Vec<Batch>,
    /// The textures of each material.
    pub material_sets: Vec<vk::DescriptorSet>,
    /// Which textures each material samples.
    pub texture_sets: Vec<TextureSet>,
    _materials: Buffer,
    _sets: DescriptorSets,
    _textures: Vec<gpu::Image>,
    _samplers: SamplerCache,
}

impl GpuScene {
    /// Uploads `scene`: its instances in the order of `batches`, and the draw commands of `drawables`.
    pub fn new(
        context: &Arc<Context>,
        layouts: &Layouts,
        scene: &Scene,
        (batches, drawables): (&Batches, &Drawables),
    ) -> Result<Self> {
        let (materials, stride) = materials(context, &scene.materials)?;
        let placements = placements(scene, batches);
        let instances = instance_data(&placements, DVec3::ZERO);
        let samplers = SamplerCache::new(context)?;
        let mut textures = gpu::upload_textures(context, &scene.images)?;
        textures.extend(gpu::upload_textures(context, &neutral_images())?);
        let sets =
            DescriptorSets::new(context, "material", layouts.material, &MATERIAL_SET, scene.materials.len())?;
        for (number, (material, &set)) in (0..).zip(scene.materials.iter().zip(&sets.sets)) {
            context.name(set, &material.name);
            write_textures(context, set, material, &textures, &samplers);
            write_data(context, set, &materials, number * stride);
        }
        Ok(Self {
            vertices: Buffer::with_data(
                context,
                "vertices",
                vk::BufferUsageFlags::VERTEX_BUFFER,
                &near_vertices(scene),
            )?,
            indices: Buffer::with_data(
                context,
                "indices",
                vk::BufferUsageFlags::INDEX_BUFFER,
                &scene.indices,
            )?,
            instances: Buffer::with_data(
                context,
                "instances",
                BufferName::Instances.info().usage(),
                &instances,
            )?,
            origin: DVec3::ZERO,
            bounds: scene.bounds(),
            reach: reach(&placements, DVec3::ZERO),
            placements,
            model_boxes: Buffer::with_data(
                context,
                "model boxes",
                BufferName::ModelBoxes.info().usage(),
                &model_boxes(scene, batches, middle(scene.bounds())),
            )?,
            drawables: Buffer::with_data(
                context,
                "drawables",
                BufferName::Drawables.info().usage(),
                &drawables.all,
            )?,
            batches: batches.batches.clone(),
            material_sets: sets.sets.clone(),
            texture_sets: scene.materials.iter().map(TextureSet::of).collect(),
            _materials: materials,
            _sets: sets,
            _textures: textures,
            _samplers: samplers,
        })
    }

    /// How many models there are: instances that are drawn.
    pub fn models(&self) -> u32 {
        self.placements.len() as u32
    }

    /// Places the instances relative to another origin, once every frame in flight has ended. Origins are coarse: this is
    /// rare.
    ///
    /// # Errors
    /// The device fails.
    pub fn move_origin(&mut self, context: &Arc<Context>, origin: DVec3) -> Result<()> {
        context.wait_idle()?;
        self.instances.fill(&instance_data(&self.placements, origin))?;
        (self.origin, self.reach) = (origin, reach(&self.placements, origin));
        Ok(())
    }
}

fn instance_data(placements: &[Placement], origin: DVec3) -> Vec<InstanceData> {
    placements.par_iter().map(|placement| placement.data(origin)).collect()
}

fn reach(placements: &[Placement], origin: DVec3) -> f64 {
    placements.iter().map(|placement| placement.reach(origin)).fold(0.0, f64::max)
}

/// The data of all materials, with the bytes from one to the next.
fn materials(context: &Arc<Context>, materials: &[Material]) -> Result<(Buffer, u64)> {
    let alignment = context.limits.min_uniform_buffer_offset_alignment.max(1) as usize;
    let stride = size_of::<MaterialData>().next_multiple_of(alignment);
    let mut bytes = vec![0u8; stride * materials.len()];
    for (place, material) in bytes.chunks_mut(stride).zip(materials) {
        place[..size_of::<MaterialData>()].copy_from_slice(bytemuck::bytes_of(&material_data(material)));
    }
    let usage = vk::BufferUsageFlags::UNIFORM_BUFFER;
    Ok((Buffer::with_data(context, "materials", usage, &bytes)?, stride as u64))
}

fn material_data(material: &Material) -> MaterialData {
    let mut uv_sets = 0;
    let mut uv_rows = [[0.0; 3]; 10];
    for (slot, texture) in material.textures.iter().enumerate() {
        let [row0, row1] = texture.map_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], |t| t.uv_transform);
        uv_sets |= texture.map_or(0, |t| t.uv_set) << slot;
        (uv_rows[2 * slot], uv_rows[2 * slot + 1]) = (row0, row1);
    }
    MaterialData {
        base_color: material.base_color,
        emissive: material.emissive,
        metallic: material.metallic,
        roughness: material.roughness,
        normal_scale: normal_scale(material),
        occlusion_strength: material.occlusion_strength,
        alpha_cutoff: material.alpha_cutoff,
        uv_sets,
        unlit: material.unlit.into(),
        uv_rows,
    }
}

/// No normal map leaves the normal as it is: 8 bits have no exact zero for a neutral texture to hold.
fn normal_scale(material: &Material) -> f32 {
    if material.textures[TextureSlot::Normal as usize].is_some() { material.normal_scale } else { 0.0 }
}

/// Stand-ins for absent textures, appended to the scene's: white, then the flat normal.
fn neutral_images() -> [Image; 2] {
    let texel = |name: &str, rgba: [u8; 4]| Image {
        name: name.into(),
        width: 1,
        height: 1,
        srgb: false,
        mips: vec![rgba.to_vec()],
    };
    [texel("white", [255; 4]), texel("flat normal", [128, 128, 255, 255])]
}

fn write_data(context: &Context, set: vk::DescriptorSet, materials: &Buffer, offset: u64) {
    let info = [vk::DescriptorBufferInfo::default()
        .buffer(materials.handle)
        .offset(offset)
        .range(size_of::<MaterialData>() as u64)];
    let write = vk::WriteDescriptorSet::default()
        .dst_set(set)
        .dst_binding(MATERIAL_TEXTURES)
        .descriptor_type(vk::DescriptorType::UNIFORM_BUFFER)
        .buffer_info(&info);
    unsafe { context.device.update_descriptor_sets(&[write], &[]) };
}

fn write_textures(
    context: &Context,
    set: vk::DescriptorSet,
    material: &Material,
    textures: &[gpu::Image],
    samplers: &SamplerCache,
) {
    let neutral = [0, 0, 1, 0, 0].map(|which| textures.len() - 2 + which);
    let plain = Sampler { wrap: [Wrap::Repeat; 2], nearest: false };
    let infos: Vec<_> = material
        .textures
        .iter()
        .zip(neutral)
        .map(|(texture, neutral)| {
            let image = texture.map_or(neutral, |TextureRef { image, .. }| image as usize);
            [vk::DescriptorImageInfo::default()
                .image_view(textures[image].view)
                .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)
                .sampler(samplers.get(texture.map_or(plain, |t| t.sampler)))]
        })
        .collect();
    let writes: Vec<_> = infos
        .iter()
        .enumerate()
        .map(|(binding, info)| {
            vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(binding as u32)
                .descriptor_type(vk::DescriptorType::COMBINED_IMAGE_SAMPLER)
                .image_info(info)
        })
        .collect();
    unsafe { context.device.update_descriptor_sets(&writes, &[]) };
}
