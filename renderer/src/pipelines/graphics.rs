//! The variants of what draws the scene.

use super::{Defines, PipelineStore, Variant, Visit};
use crate::Result;
use crate::culling::Culling;
use crate::draw_list::SurfaceKind;
use crate::layouts::{Pipeline, PipelineLayout};
use crate::scene::{TextureSlot, Vertex};
use crate::targets::{DEPTH_FORMAT, TargetName, filled};
use crate::texture_sets::TextureSet;
use crate::vk::{self as gpu, Blend, GraphicsDesc};
use ash::vk;
use std::mem::offset_of;
use std::sync::Arc;

/// How a graphics pipeline uses depth and colour targets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// The pipeline writes depth alone.
    Depth,
    /// Tests depth; visits the clusters of fragments.
    Visits(SurfaceKind, Visit),
    /// Tests depth; writes radiance, of which these textures are a part.
    Shades(SurfaceKind, TextureSet),
    /// Tests depth; fills the G-buffer, of which these textures are a part.
    Fills(SurfaceKind, TextureSet),
    /// Tests depth; gathers which way fragments face, which these textures tell.
    Faces(SurfaceKind, TextureSet),
    /// Tests depth; counts what is seen in the end.
    Sees(SurfaceKind),
}

impl Output {
    /// The colour targets it draws into, for groups that are models or others.
    fn targets(self, models: bool) -> &'static [TargetName] {
        match self {
            Self::Depth | Self::Visits(..) | Self::Faces(..) | Self::Sees(_) => &[],
            Self::Shades(..) => &[TargetName::Radiance],
            Self::Fills(..) => filled(models),
        }
    }

    /// What becomes of what is there in them.
    fn blend(self) -> Blend {
        match self {
            Self::Shades(SurfaceKind::Transparent, _) => Blend::Over,
            _ => Blend::Replace,
        }
    }
}

impl PipelineStore {
    /// A graphics pipeline that is `number` of the program, for depth and these colour targets; `desc` has its shaders
    /// already, and gets its formats here.
    pub(super) fn rasterizing(
        &self,
        desc: GraphicsDesc,
        targets: &'static [TargetName],
        (name, number): (&str, usize),
    ) -> Result<Pipeline> {
        let formats: Vec<_> = targets.iter().map(|target| target.info().format).collect();
        let desc = GraphicsDesc { depth_format: Some(DEPTH_FORMAT), color_formats: &formats, ..desc };
        let vertex = (vk::ShaderStageFlags::VERTEX, desc.vertex);
        let fragment = desc.fragment.map(|words| (vk::ShaderStageFlags::FRAGMENT, words));
        let stages: Vec<_> = [vertex].into_iter().chain(fragment).collect();
        let layout = PipelineLayout::new(&self.context, &self.layouts, name, &stages)?;
        let pipeline = gpu::graphics_pipeline(&self.context, layout.handle, &desc, name)?;
        Ok(Pipeline::new(pipeline, layout, name, number).drawing_into(targets))
    }

    /// A pipeline that draws the scene, with a fragment shader or depth alone.
    pub(super) fn graphics(
        &mut self,
        variant: &Variant,
        fragment: Option<&str>,
        output: Output,
    ) -> Result<Arc<Pipeline>> {
        let at_once = self.views.count > 1 && variant.draws_all_views(output);
        let views = if at_once { self.views.count } else { 0 };
        let defines = graphics_defines(variant, fragment.is_some(), output)
            .with("VIEWS", views)
            .with("MIRRORS", u32::from(self.views.mirrors));
        let key = format!("{fragment:?} {output:?} {:?} {defines:?}", variant.attenuation);
        self.once(key, |store, number| {
            let vertex = store.shaders.compile("geometry/surface.vert", &defines.0)?;
            let code = fragment.map(|path| store.shaders.compile(path, &defines.0)).transpose()?;
            let attributes =
                vertex_attributes(varyings(fragment.is_some(), output), textures(fragment.is_some(), output));
            let spec = [(0, variant.attenuation as u32)];
            let desc = GraphicsDesc {
                vertex: &vertex,
                fragment: code.as_deref().map(Vec::as_slice),
                spec: if matches!(output, Output::Shades(..)) { &spec } else { &[] },
                bindings: &[vk::VertexInputBindingDescription {
                    binding: 0,
                    stride: size_of::<Vertex>() as u32,
                    input_rate: vk::VertexInputRate::VERTEX,
                }],
                attributes: &attributes,
                dynamic_facing: true,
                depth_write: variant.writes_depth(output),
                depth_compare: Some(depth_compare(variant, output)),
                blend: output.blend(),
                samples: vk::SampleCountFlags::from_raw(variant.samples),
                sample_shading: variant.per_sample() && output != Output::Depth,
                ..Default::default()
            };
            let targets = output.targets(variant.has_models());
            store.rasterizing(desc, targets, (fragment.unwrap_or("geometry/surface.vert"), number))
        })
    }
}

fn graphics_defines(variant: &Variant, textured: bool, output: Output) -> Defines {
    let culling = match variant.culling {
        Culling::Cpu => "CULLING_CPU",
        Culling::Gpu => "CULLING_GPU",
    };
    let defines = match output {
        // It is the same for all methods but those of models.
        Output::Fills(..) => variant.surface_defines(),
        _ => variant.defines(),
    };
    let defines = defines
        .with("CULLING", culling)
        .with("VARYINGS", varyings(textured, output))
        .with("TEXTURES", textures(textured, output).bits())
        .with("MODELS", u32::from(variant.has_models() && output != Output::Depth));
    match output {
        Output::Depth => defines,
        Output::Visits(_, visit) => defines.with("VISIT", visit.define()),
        Output::Faces(..) => variant.normal_cone_defines(&defines),
        Output::Sees(kind) => defines.with("ALPHA_TEST", u32::from(kind == SurfaceKind::Masked)),
        Output::Fills(kind, _) => defines
            .with("OVERDRAW", u32::from(variant.overdraws(output)))
            .with("ALPHA_TEST", u32::from(variant.overdraws(output) && kind == SurfaceKind::Masked)),
        Output::Shades(kind, _) => defines
            .with("OVERDRAW", u32::from(variant.overdraws(output)))
            .with("ALPHA_TEST", u32::from(variant.overdraws(output) && kind == SurfaceKind::Masked))
            .with("TRANSPARENT", u32::from(kind == SurfaceKind::Transparent))
            .with("LIGHTS_AT_ONCE", variant.lights_at_once),
    }
}

/// What the vertex shader hands on: 0 nothing, 1 for the alpha test, 2 for shading.
fn varyings(textured: bool, output: Output) -> u32 {
    match output {
        Output::Depth => u32::from(textured),
        Output::Visits(..) => 0,
        Output::Sees(kind) => u32::from(kind == SurfaceKind::Masked),
        Output::Shades(..) | Output::Fills(..) | Output::Faces(..) => 2,
    }
}

/// The textures that a pipeline samples.
fn textures(textured: bool, output: Output) -> TextureSet {
    match output {
        Output::Depth if textured => TextureSet::BASE_COLOR,
        Output::Sees(SurfaceKind::Masked) => TextureSet::BASE_COLOR,
        Output::Depth | Output::Visits(..) | Output::Sees(_) => TextureSet::NONE,
        Output::Shades(_, set) | Output::Fills(_, set) | Output::Faces(_, set) => set,
    }
}

/// Depth is reversed; what the prepass drew is found again by equality, what is transparent lies before it. With overdraw, of
/// surfaces at one depth the last is seen, as it is where all of them are found again.
fn depth_compare(variant: &Variant, output: Output) -> vk::CompareOp {
    match output {
        Output::Depth => vk::CompareOp::GREATER,
        _ if variant.overdraws(output) => vk::CompareOp::GREATER_OR_EQUAL,
        Output::Visits(kind, _)
        | Output::Shades(kind, _)
        | Output::Fills(kind, _)
        | Output::Faces(kind, _)
        | Output::Sees(kind) => match kind {
            SurfaceKind::Transparent => vk::CompareOp::GREATER_OR_EQUAL,
            SurfaceKind::Opaque | SurfaceKind::Masked => vk::CompareOp::EQUAL,
        },
    }
}

fn vertex_attributes(varyings: u32, textures: TextureSet) -> Vec<vk::VertexInputAttributeDescription> {
    use vk::Format as F;
    let (uv, tangent) = (textures != TextureSet::NONE, textures.has(TextureSlot::Normal));
    let all = [
        (0, true, F::R32G32B32_SFLOAT, offset_of!(Vertex, position)),
        (1, varyings >= 2, F::R32G32B32_SFLOAT, offset_of!(Vertex, normal)),
        (2, varyings >= 2 && tangent, F::R32G32B32A32_SFLOAT, offset_of!(Vertex, tangent)),
        (3, varyings >= 1 && uv, F::R32G32_SFLOAT, offset_of!(Vertex, uv)),
        (4, varyings >= 1 && uv, F::R32G32_SFLOAT, offset_of!(Vertex, uv) + size_of::<[f32; 2]>()),
        (5, varyings >= 1, F::R8G8B8A8_UNORM, offset_of!(Vertex, color)),
    ];
    all.into_iter()
        .filter(|&(_, needed, ..)| needed)
        .map(|(location, _, format, offset)| vk::VertexInputAttributeDescription {
            location,
            binding: 0,
            format,
            offset: offset as u32,
        })
        .collect()
}
