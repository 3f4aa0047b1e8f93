//! Compute and graphics pipelines.

use super::context::Context;
use super::vk_error;
use crate::Result;
use ash::vk;
use std::ffi::CStr;
use std::sync::Arc;

const ENTRY_POINT: &CStr = c"main";

/// A pipeline that destroys itself. Its layout is the caller's.
pub struct Pipeline {
    /// Vulkan handle, for binding.
    pub handle: vk::Pipeline,
    context: Arc<Context>,
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        unsafe { self.context.device.destroy_pipeline(self.handle, None) };
    }
}

/// A compute pipeline from the entry point `main`; `spec` holds (constant id, 32-bit value), a bool as 0 or 1, a float
/// as its bits.
pub fn compute_pipeline(
    context: &Arc<Context>,
    layout: vk::PipelineLayout,
    spirv: &[u32],
    name: &str,
    spec: &[(u32, u32)],
) -> Result<Pipeline> {
    let module = Module::new(context, spirv, name)?;
    let constants = Constants::new(spec);
    let specialization = constants.info();
    let stage = module.stage(vk::ShaderStageFlags::COMPUTE, &specialization);
    let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
    let made = unsafe { context.device.create_compute_pipelines(vk::PipelineCache::null(), &[info], None) };
    finish(context, made, name)
}

/// What becomes of what a pipeline draws over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Blend {
    /// It is replaced.
    Replace,
    /// The source lies over it by its (not premultiplied) alpha; alpha accumulates coverage.
    Over,
    /// The source's colour is added; alpha remains.
    Add,
    /// Of each component the least of both remains.
    Least,
}

/// What a graphics pipeline does but for its shaders. Start from [`Default`].
#[derive(Clone, Copy)]
pub struct GraphicsDesc<'a> {
    /// SPIR-V of the vertex shader.
    pub vertex: &'a [u32],
    /// SPIR-V of the fragment shader; `None` writes depth alone.
    pub fragment: Option<&'a [u32]>,
    /// Specialization constants of both stages, as in [`compute_pipeline`].
    pub spec: &'a [(u32, u32)],
    /// Layouts of the vertex buffers.
    pub bindings: &'a [vk::VertexInputBindingDescription],
    /// Attributes read from the vertex buffers.
    pub attributes: &'a [vk::VertexInputAttributeDescription],
    /// Faces left out. Counter-clockwise is front.
    pub cull_mode: vk::CullModeFlags,
    /// Makes cull mode and front face dynamic states, which the caller then sets before each draw.
    pub dynamic_facing: bool,
    /// Whether depth is written.
    pub depth_write: bool,
    /// Depth test; `None` passes all, and leaves depth unwritten.
    pub depth_compare: Option<vk::CompareOp>,
    /// Format of the depth attachment, `None` without one.
    pub depth_format: Option<vk::Format>,
    /// Formats of the colour attachments, in the order of the fragment shader's locations.
    pub color_formats: &'a [vk::Format],
    /// What becomes of what is there, in every attachment.
    pub blend: Blend,
    /// Samples of the attachments.
    pub samples: vk::SampleCountFlags,
    /// Draws into every pixel that a triangle may touch; needs the limit `conservative_rasterization`.
    pub conservative: bool,
    /// Runs the fragment shader once per sample; needs the limit `sample_rate_shading`.
    pub sample_shading: bool,
}

impl Default for GraphicsDesc<'_> {
    /// No shaders, attachments or vertex input; back faces culled, one sample, nothing tested, written or blended.
    fn default() -> Self {
        Self {
            vertex: &[],
            fragment: None,
            spec: &[],
            bindings: &[],
            attributes: &[],
            cull_mode: vk::CullModeFlags::BACK,
            dynamic_facing: false,
            depth_write: false,
            depth_compare: None,
            depth_format: None,
            color_formats: &[],
            blend: Blend::Replace,
            samples: vk::SampleCountFlags::TYPE_1,
            conservative: false,
            sample_shading: false,
        }
    }
}

/// A triangle-list pipeline for dynamic rendering, with dynamic viewport and scissor.
///
/// The front face is counter-clockwise as seen on the screen. The viewport has a negative height, so that +Y stays up
/// (Vulkan 1.3, section "Controlling the Viewport") and what is counter-clockwise in the world is so on the screen.
pub fn graphics_pipeline(
    context: &Arc<Context>,
    layout: vk::PipelineLayout,
    desc: &GraphicsDesc<'_>,
    name: &str,
) -> Result<Pipeline> {
    let vertex = Module::new(context, desc.vertex, name)?;
    let fragment = desc.fragment.map(|spirv| Module::new(context, spirv, name)).transpose()?;
    let constants = Constants::new(desc.spec);
    let specialization = constants.info();
    let mut stages = vec![vertex.stage(vk::ShaderStageFlags::VERTEX, &specialization)];
    stages
        .extend(fragment.iter().map(|module| module.stage(vk::ShaderStageFlags::FRAGMENT, &specialization)));

    let input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(desc.bindings)
        .vertex_attribute_descriptions(desc.attributes);
    let assembly =
        vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
    let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
    let mut conservative = vk::PipelineRasterizationConservativeStateCreateInfoEXT::default()
        .conservative_rasterization_mode(vk::ConservativeRasterizationModeEXT::OVERESTIMATE);
    let mut raster = vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(desc.cull_mode)
        .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
        .line_width(1.0);
    if desc.conservative {
        raster = raster.push_next(&mut conservative);
    }
    let multisample = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(desc.samples)
        .sample_shading_enable(desc.sample_shading)
        .min_sample_shading(1.0);
    let depth = vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(desc.depth_compare.is_some())
        .depth_write_enable(desc.depth_write)
        .depth_compare_op(desc.depth_compare.unwrap_or(vk::CompareOp::ALWAYS));
    let attachments = vec![blend_state(desc.blend); desc.color_formats.len()];
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
    let dynamic_states = [
        vk::DynamicState::VIEWPORT,
        vk::DynamicState::SCISSOR,
        vk::DynamicState::FRONT_FACE,
        vk::DynamicState::CULL_MODE,
    ];
    let dynamic_count = if desc.dynamic_facing { 4 } else { 2 };
    let dynamic =
        vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic_states[..dynamic_count]);
    let mut rendering = vk::PipelineRenderingCreateInfo::default()
        .color_attachment_formats(desc.color_formats)
        .depth_attachment_format(desc.depth_format.unwrap_or(vk::Format::UNDEFINED));
    let info = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&multisample)
        .depth_stencil_state(&depth)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(layout)
        .push_next(&mut rendering);
    let made = unsafe { context.device.create_graphics_pipelines(vk::PipelineCache::null(), &[info], None) };
    finish(context, made, name)
}

fn blend_state(blend: Blend) -> vk::PipelineColorBlendAttachmentState {
    use vk::BlendFactor as F;
    let [color, alpha] = match blend {
        Blend::Replace => [[F::ONE, F::ZERO]; 2],
        Blend::Over => [[F::SRC_ALPHA, F::ONE_MINUS_SRC_ALPHA], [F::ONE, F::ONE_MINUS_SRC_ALPHA]],
        Blend::Add => [[F::ONE, F::ONE], [F::ZERO, F::ONE]],
        // Factors do not bear on the least of two.
        Blend::Least => [[F::ONE, F::ONE]; 2],
    };
    let operation = if blend == Blend::Least { vk::BlendOp::MIN } else { vk::BlendOp::ADD };
    vk::PipelineColorBlendAttachmentState::default()
        .blend_enable(blend != Blend::Replace)
        .src_color_blend_factor(color[0])
        .dst_color_blend_factor(color[1])
        .color_blend_op(operation)
        .src_alpha_blend_factor(alpha[0])
        .dst_alpha_blend_factor(alpha[1])
        .alpha_blend_op(operation)
        .color_write_mask(vk::ColorComponentFlags::RGBA)
}

type Made = std::result::Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>;

fn finish(context: &Arc<Context>, made: Made, name: &str) -> Result<Pipeline> {
    let pipelines = made.map_err(|(_, e)| vk_error(&format!("{name}: making the pipeline"), e))?;
    let handle = pipelines[0];
    context.name(handle, name);
    Ok(Pipeline { handle, context: context.clone() })
}

/// A shader module, needed only until its pipeline is made.
struct Module<'a> {
    handle: vk::ShaderModule,
    context: &'a Context,
}

impl<'a> Module<'a> {
    fn new(context: &'a Context, spirv: &[u32], name: &str) -> Result<Self> {
        let info = vk::ShaderModuleCreateInfo::default().code(spirv);
        let handle = unsafe { context.device.create_shader_module(&info, None) }
            .map_err(|e| vk_error(&format!("{name}: making the shader module"), e))?;
        context.name(handle, name);
        Ok(Self { handle, context })
    }

    fn stage<'b>(
        &self,
        stage: vk::ShaderStageFlags,
        specialization: &'b vk::SpecializationInfo<'b>,
    ) -> vk::PipelineShaderStageCreateInfo<'b> {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(stage)
            .module(self.handle)
            .name(ENTRY_POINT)
            .specialization_info(specialization)
    }
}

impl Drop for Module<'_> {
    fn drop(&mut self) {
        unsafe { self.context.device.destroy_shader_module(self.handle, None) };
    }
}

/// Specialization constants in Vulkan's form.
struct Constants {
    entries: Vec<vk::SpecializationMapEntry>,
    values: Vec<u32>,
}

impl Constants {
    fn new(spec: &[(u32, u32)]) -> Self {
        let entry = |(index, &(constant_id, _)): (usize, &(u32, u32))| vk::SpecializationMapEntry {
            constant_id,
            offset: (index * size_of::<u32>()) as u32,
            size: size_of::<u32>(),
        };
        Self {
            entries: spec.iter().enumerate().map(entry).collect(),
            values: spec.iter().map(|s| s.1).collect(),
        }
    }

    fn info(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(bytemuck::cast_slice(&self.values))
    }
}
