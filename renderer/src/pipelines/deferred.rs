//! The variants of deferred shading: what fills the G-buffer, and what shades what it holds.

use super::{Defines, Output, PipelineStore, Variant};
use crate::Result;
use crate::draw_list::SurfaceKind;
use crate::layouts::Pipeline;
use crate::targets::{TargetName, filled};
use crate::texture_sets::TextureSet;
use crate::vk::{Blend, GraphicsDesc};
use ash::vk;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The pipelines of deferred shading.
pub struct DeferredPipelines {
    /// Filling of the G-buffer with opaque and with masked surfaces, by the textures of the material.
    pub fill: [BTreeMap<TextureSet, Arc<Pipeline>>; 2],
    /// Shading of what the G-buffer holds.
    pub light: Arc<Pipeline>,
    /// The targets that make up the G-buffer.
    pub kept: &'static [TargetName],
}

impl PipelineStore {
    /// The pipelines of deferred shading of a variant.
    pub(super) fn deferred(&mut self, variant: &Variant) -> Result<DeferredPipelines> {
        let mut fill = |kind| {
            let sets = self.texture_sets[kind as usize].clone();
            let mut of = |set| {
                let sampled = variant.sampled(kind, set);
                self.graphics(variant, Some("shade/gbuffer.frag"), Output::Fills(kind, sampled))
            };
            sets.into_iter().map(|set| Ok((set, of(set)?))).collect::<Result<_>>()
        };
        Ok(DeferredPipelines {
            fill: [fill(SurfaceKind::Opaque)?, fill(SurfaceKind::Masked)?],
            light: self.light(variant)?,
            kept: &filled(variant.has_models())[1..],
        })
    }

    fn light(&mut self, variant: &Variant) -> Result<Arc<Pipeline>> {
        let defines = variant.defines().with("GBUFFER", 1).with("LIGHTS_AT_ONCE", variant.lights_at_once);
        let path = "shade/light.frag";
        self.once(format!("{path} {:?} {defines:?}", variant.attenuation), |store, number| {
            let spec = [(0, variant.attenuation as u32)];
            let desc = GraphicsDesc { spec: &spec, blend: Blend::Add, ..screen(variant) };
            store.screen((path, number), &defines, desc)
        })
    }

    /// What shows what a G-buffer holds.
    pub(super) fn gbuffer_picture(&mut self, variant: &Variant) -> Result<Arc<Pipeline>> {
        let (path, defines) = ("debug/gbuffer_picture.frag", variant.surface_defines());
        self.once(format!("{path} {defines:?}"), |store, number| {
            store.screen((path, number), &defines, screen(variant))
        })
    }

    /// A pipeline that draws over all pixels that show a surface.
    fn screen(
        &self,
        (path, number): (&str, usize),
        defines: &Defines,
        desc: GraphicsDesc,
    ) -> Result<Pipeline> {
        let vertex = self.shaders.compile("shade/screen.vert", &defines.0)?;
        let fragment = self.shaders.compile(path, &defines.0)?;
        let desc = GraphicsDesc { vertex: &vertex, fragment: Some(&fragment), ..desc };
        self.rasterizing(desc, &[TargetName::Radiance], (path, number))
    }
}

/// A triangle over all pixels, which lies where nothing is: whatever is seen is nearer.
fn screen(variant: &Variant) -> GraphicsDesc<'static> {
    GraphicsDesc {
        cull_mode: vk::CullModeFlags::NONE,
        depth_compare: Some(vk::CompareOp::LESS),
        samples: vk::SampleCountFlags::from_raw(variant.samples),
        sample_shading: variant.per_sample(),
        ..Default::default()
    }
}
