//! The variants of what stills draw; no replay makes them.

use super::{Output, PipelineStore, Variant};
use crate::Result;
use crate::draw_list::SurfaceKind;
use crate::layouts::Pipeline;
use crate::methods::Groups;
use crate::shading::{Shading, ShadingPipeline};
use crate::targets::TargetName;
use crate::texture_sets::TextureSet;
use crate::vk::{Blend, GraphicsDesc};
use ash::vk;
use std::mem::offset_of;
use std::sync::Arc;

/// A line in world space, as the vertex shader reads it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Line {
    /// One end of the line, world space, metres.
    pub from: [f32; 3],
    /// Other end of the line, world space, metres.
    pub to: [f32; 3],
    /// Linear colour of the line.
    pub tint: [f32; 3],
}

/// Bands between the poles of a light's sphere.
const RINGS: u32 = 12;
/// Slices around its axis.
const SEGMENTS: u32 = 24;
/// Vertices of such a sphere: two triangles a quad.
pub const SPHERE_VERTICES: u32 = 6 * RINGS * SEGMENTS;

/// All pipelines of a still.
pub struct DebugPipelines {
    /// Opaque and masked surfaces without their shading.
    pub clay: [Arc<Pipeline>; 2],
    /// Clusters of pixels: by the view's own lookup, by world position. Methods with lists alone have them.
    pub pixel_clusters: Option<[Arc<Pipeline>; 2]>,
    /// Lines: through everything, then where nothing hides them.
    pub lines: [Arc<Pipeline>; 2],
    /// Draws the influence volumes of lights.
    pub spheres: Arc<Pipeline>,
    /// Shows what a G-buffer holds, where shading is deferred.
    pub gbuffer_picture: Option<Arc<Pipeline>>,
    /// All pipelines, each once.
    pub all: Vec<Arc<Pipeline>>,
}

impl PipelineStore {
    /// The pipelines of stills of a variant, which counts. They draw over a prepass of their own.
    pub fn debug(&mut self, variant: &Variant) -> Result<DebugPipelines> {
        let deferred = variant.pipeline == ShadingPipeline::Deferred;
        let (shading, pipeline) = (Shading::Prepass, ShadingPipeline::Forward);
        let variant = &Variant { shading, pipeline, ..*variant };
        let defines = variant.defines();
        let clay = "debug/clay.frag";
        let clusters = "debug/pixel_clusters.comp";
        self.take_asked();
        let mut pipelines = DebugPipelines {
            clay: [
                self.graphics(
                    variant,
                    Some(clay),
                    Output::Shades(SurfaceKind::Opaque, TextureSet::BASE_COLOR),
                )?,
                self.graphics(
                    variant,
                    Some(clay),
                    Output::Shades(SurfaceKind::Masked, TextureSet::BASE_COLOR),
                )?,
            ],
            pixel_clusters: match variant.groups {
                Groups::Cells(_) | Groups::Leaves => Some([
                    self.compute(clusters, &defines.with("WORLD_LOOKUP", 0))?,
                    self.compute(clusters, &defines.with("WORLD_LOOKUP", 1))?,
                ]),
                Groups::Nothing => None,
            },
            lines: [self.lines(variant, true)?, self.lines(variant, false)?],
            spheres: self.spheres(variant)?,
            gbuffer_picture: deferred.then(|| self.gbuffer_picture(variant)).transpose()?,
            all: vec![],
        };
        pipelines.all = self.take_asked();
        Ok(pipelines)
    }

    fn lines(&mut self, variant: &Variant, hidden: bool) -> Result<Arc<Pipeline>> {
        let attribute = |(location, offset): (u32, usize)| vk::VertexInputAttributeDescription {
            location,
            binding: 0,
            format: vk::Format::R32G32B32_SFLOAT,
            offset: offset as u32,
        };
        let attributes =
            [(0, offset_of!(Line, from)), (1, offset_of!(Line, to)), (2, offset_of!(Line, tint))];
        let desc = GraphicsDesc {
            bindings: &[vk::VertexInputBindingDescription {
                binding: 0,
                stride: size_of::<Line>() as u32,
                input_rate: vk::VertexInputRate::INSTANCE,
            }],
            attributes: &attributes.map(attribute),
            cull_mode: vk::CullModeFlags::NONE,
            depth_compare: Some(if hidden { vk::CompareOp::ALWAYS } else { vk::CompareOp::GREATER_OR_EQUAL }),
            ..overlay(variant)
        };
        let defines = variant.defines().with("HIDDEN", u32::from(hidden));
        self.overlay_pipeline("debug/lines", &defines, desc)
    }

    fn spheres(&mut self, variant: &Variant) -> Result<Arc<Pipeline>> {
        let defines = variant
            .defines()
            .with("SPHERE_RINGS", RINGS)
            .with("SPHERE_SEGMENTS", SEGMENTS)
            .with("MIRRORS", u32::from(self.views.mirrors));
        let desc = GraphicsDesc { dynamic_facing: true, ..overlay(variant) };
        self.overlay_pipeline("debug/spheres", &defines, desc)
    }

    fn overlay_pipeline(
        &mut self,
        stem: &str,
        defines: &super::Defines,
        desc: GraphicsDesc,
    ) -> Result<Arc<Pipeline>> {
        self.once(format!("{stem} {defines:?}"), |store, number| {
            let vertex = store.shaders.compile(&format!("{stem}.vert"), &defines.0)?;
            let fragment = store.shaders.compile(&format!("{stem}.frag"), &defines.0)?;
            let desc = GraphicsDesc { vertex: &vertex, fragment: Some(&fragment), ..desc };
            store.rasterizing(desc, &[TargetName::Radiance], (stem, number))
        })
    }
}

/// Blended over the picture, hidden by the scene.
fn overlay(variant: &Variant) -> GraphicsDesc<'static> {
    GraphicsDesc {
        depth_compare: Some(vk::CompareOp::GREATER_OR_EQUAL),
        blend: Blend::Over,
        samples: vk::SampleCountFlags::from_raw(variant.samples),
        ..Default::default()
    }
}
