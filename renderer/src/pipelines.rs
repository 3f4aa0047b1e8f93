//! Every shader variant, in one place, and the pipelines made from them.
//!
//! A variant is data: defines and specialization constants. Pipelines that several methods share are made once.

mod debug;
mod deferred;
mod graphics;
mod lists;
mod probes;
mod raster;
mod variant;

pub use debug::{DebugPipelines, Line, SPHERE_VERTICES};
pub use deferred::DeferredPipelines;
pub use lists::{AcceleratedPipelines, ClusteredPipelines};
pub use raster::{RasterPipelines, Shells};
pub use variant::{Variant, lights_at_once};

use graphics::Output;
use lists::twice;
use variant::Defines;

use crate::Result;
use crate::assign::{Assigner, ClusterBounds};
use crate::culling::Culling;
use crate::draw_list::SurfaceKind;
use crate::geometry::views::ViewSet;
use crate::layouts::{Layouts, Pipeline, PipelineLayout};
use crate::methods::Groups;
use crate::shading::ShadingPipeline;
use crate::texture_sets::TextureSet;
use crate::vk::{self as gpu, Context, ShaderLibrary};
use ash::vk;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The three dispatches of a prefix sum, and the one that does without them.
pub struct ScanPipelines {
    /// Takes few items to prefixes in one workgroup.
    pub single: Arc<Pipeline>,
    /// Takes items to sums of blocks.
    pub reduce: Arc<Pipeline>,
    /// Block sums to block offsets.
    pub block_offsets: Arc<Pipeline>,
    /// Block offsets and items to prefixes.
    pub apply: Arc<Pipeline>,
}

/// What is done with the cluster of every fragment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Visit {
    /// The cluster becomes visible.
    Mark,
    /// The fragment is counted.
    Count,
    /// The cluster's bounds come to hold the fragment.
    Bounds,
}

impl Visit {
    fn define(self) -> &'static str {
        match self {
            Self::Mark => "VISIT_MARK",
            Self::Count => "VISIT_COUNT",
            Self::Bounds => "VISIT_BOUNDS",
        }
    }
}

/// Visiting the cluster of every fragment.
pub struct VisitPipelines {
    /// Visits the clusters of what the depth buffer holds; `None` where that does not tell them.
    pub depth: Option<Arc<Pipeline>>,
    /// Visit clusters from geometry, by [`SurfaceKind`].
    pub geometry: [Arc<Pipeline>; 3],
}

/// All pipelines of one variant.
pub struct Pipelines {
    cull: Option<Arc<Pipeline>>,
    /// Prepass of opaque geometry.
    pub depth_opaque: Arc<Pipeline>,
    /// Prepass of masked geometry.
    pub depth_masked: Arc<Pipeline>,
    /// Forward shading, by [`SurfaceKind`] and by the textures of the material; deferred, of transparent ones alone.
    pub shade: [BTreeMap<TextureSet, Arc<Pipeline>>; 3],
    /// Counting masked surfaces with overdraw, by the textures of the material, where all is counted.
    pub count_masked: Option<BTreeMap<TextureSet, Arc<Pipeline>>>,
    /// Counting what of opaque and masked surfaces is seen in the end, with overdraw where all is counted.
    pub seen: Option<[Arc<Pipeline>; 2]>,
    /// What is known of each pixel, for images.
    pub pixel_maps: Arc<Pipeline>,
    /// How much depth jumps from pixel to pixel, where all is counted.
    pub depth_steps: Option<Arc<Pipeline>>,
    /// The model of each pixel, of opaque and of masked surfaces, where groups are models and all is counted.
    pub pixel_models: Option<[Arc<Pipeline>; 2]>,
    deferred: Option<DeferredPipelines>,
    clustered: Option<ClusteredPipelines>,
    count_fragments: Option<VisitPipelines>,
    bounds: Option<VisitPipelines>,
    cones: Option<[BTreeMap<TextureSet, Arc<Pipeline>>; 3]>,
    build_boxes: Option<Arc<Pipeline>>,
    accelerated: Option<AcceleratedPipelines>,
    all: Vec<Arc<Pipeline>>,
}

impl Pipelines {
    /// All pipelines, each once.
    pub fn all(&self) -> &[Arc<Pipeline>] {
        &self.all
    }

    /// Culls on the device; only its pass asks.
    pub fn cull(&self) -> &Pipeline {
        self.cull.as_ref().expect("stage cull runs where the device culls")
    }

    /// Deferred shading; only its passes ask.
    pub fn deferred(&self) -> &DeferredPipelines {
        self.deferred.as_ref().expect("stages gbuffer and light run where shading is deferred")
    }

    /// The clustered methods' pipelines; only their passes ask.
    pub fn clustered(&self) -> &ClusteredPipelines {
        self.clustered.as_ref().expect("a pass of clustered methods runs in a clustered method")
    }

    /// Counts the fragments of groups with lists; only its pass asks.
    pub fn count_fragments(&self) -> &VisitPipelines {
        self.count_fragments
            .as_ref()
            .expect("fragments of groups are counted where all is counted, and groups have lists")
    }

    /// Measures the bounds of visible clusters; only its pass asks.
    pub fn bounds(&self) -> &VisitPipelines {
        self.bounds.as_ref().expect("stage bounds runs where bounds are measured")
    }

    /// Gather which way fragments face, by [`SurfaceKind`] and by the textures of the material; only their pass asks.
    pub fn cones(&self) -> &[BTreeMap<TextureSet, Arc<Pipeline>>; 3] {
        self.cones.as_ref().expect("stage cones runs where normals are told apart")
    }

    /// Makes the boxes around cells; `None` where they are not tested.
    pub fn build_boxes(&self) -> Option<&Pipeline> {
        self.build_boxes.as_deref()
    }

    /// What assignment other than by brute force runs; only its passes ask.
    pub fn accelerated(&self) -> &AcceleratedPipelines {
        self.accelerated.as_ref().expect("a pass of accelerated assignment runs with it")
    }
}

/// Makes pipelines, each once.
pub struct PipelineStore {
    context: Arc<Context>,
    layouts: Arc<Layouts>,
    shaders: ShaderLibrary,
    views: ViewSet,
    texture_sets: [BTreeSet<TextureSet>; 3],
    made: BTreeMap<String, Arc<Pipeline>>,
    /// Pipelines asked for since [`Self::take_asked`], by their numbers.
    asked: BTreeMap<usize, Arc<Pipeline>>,
}

impl PipelineStore {
    /// An empty store, for pipelines that draw `views` of surfaces with these textures, by [`SurfaceKind`].
    pub fn new(
        context: &Arc<Context>,
        layouts: &Arc<Layouts>,
        shaders: ShaderLibrary,
        (views, texture_sets): (ViewSet, [BTreeSet<TextureSet>; 3]),
    ) -> Self {
        Self {
            context: context.clone(),
            layouts: layouts.clone(),
            shaders,
            views,
            texture_sets,
            made: BTreeMap::new(),
            asked: BTreeMap::new(),
        }
    }

    /// The pipelines asked for since the last call, each once.
    fn take_asked(&mut self) -> Vec<Arc<Pipeline>> {
        std::mem::take(&mut self.asked).into_values().collect()
    }

    /// The pipeline of `key`, by `make` where there is none yet, from the number of the new one.
    fn once(
        &mut self,
        key: String,
        make: impl FnOnce(&Self, usize) -> Result<Pipeline>,
    ) -> Result<Arc<Pipeline>> {
        let pipeline = match self.made.get(&key) {
            Some(made) => made.clone(),
            None => Arc::new(make(self, self.made.len())?),
        };
        self.made.insert(key, pipeline.clone());
        self.asked.insert(pipeline.number, pipeline.clone());
        Ok(pipeline)
    }

    /// All pipelines of a variant.
    pub fn pipelines(&mut self, variant: &Variant) -> Result<Pipelines> {
        self.asked.clear();
        let clustered = variant.cells().map(|_| self.clustered(variant)).transpose()?;
        let counts_groups = variant.counting && variant.groups != Groups::Nothing;
        let count_fragments = counts_groups.then(|| self.visit(variant, Visit::Count)).transpose()?;
        let bounds = match variant.bounds {
            ClusterBounds::Cell => None,
            ClusterBounds::Depth | ClusterBounds::Box => Some(self.visit(variant, Visit::Bounds)?),
        };
        let cones = variant.normal_cones.are_on().then(|| self.cones(variant)).transpose()?;
        let build_boxes = match variant.is_boxed() {
            true => Some(self.compute("cluster/build_boxes.comp", &variant.test_defines())?),
            false => None,
        };
        let accelerated = match variant.assigner {
            Assigner::Brute | Assigner::Rectangles | Assigner::Raster | Assigner::RasterCount => None,
            Assigner::Hierarchy | Assigner::Scatter => Some(self.accelerated(variant)?),
        };
        let cull = match variant.culling {
            Culling::Cpu => None,
            Culling::Gpu => Some(self.compute("geometry/cull.comp", &Defines(vec![]))?),
        };
        let counts_hidden = variant.counts_hidden();
        let deferred = match variant.pipeline {
            ShadingPipeline::Forward => None,
            ShadingPipeline::Deferred => Some(self.deferred(variant)?),
        };
        let mut pipelines = Pipelines {
            cull,
            depth_opaque: self.graphics(variant, None, Output::Depth)?,
            depth_masked: self.graphics(variant, Some("geometry/alpha_test.frag"), Output::Depth)?,
            shade: self.shade(variant)?,
            count_masked: counts_hidden.then(|| self.shade_kind(variant, SurfaceKind::Masked)).transpose()?,
            seen: counts_hidden.then(|| self.seen(variant)).transpose()?,
            pixel_maps: self.compute("measure/pixel_maps.comp", &variant.defines())?,
            depth_steps: self.depth_steps(variant)?,
            pixel_models: self.pixel_models(variant)?,
            deferred,
            clustered,
            count_fragments,
            bounds,
            cones,
            build_boxes,
            accelerated,
            all: vec![],
        };
        pipelines.all = self.take_asked();
        Ok(pipelines)
    }

    fn shade(&mut self, variant: &Variant) -> Result<[BTreeMap<TextureSet, Arc<Pipeline>>; 3]> {
        let [opaque, masked, transparent] = SurfaceKind::ALL;
        let mut of = |kind| match variant.shades(kind) {
            true => self.shade_kind(&variant.drawing(kind), kind),
            false => Ok(BTreeMap::new()),
        };
        Ok([of(opaque)?, of(masked)?, of(transparent)?])
    }

    /// Shading of a kind of surface, by the textures of its materials.
    fn shade_kind(
        &mut self,
        variant: &Variant,
        kind: SurfaceKind,
    ) -> Result<BTreeMap<TextureSet, Arc<Pipeline>>> {
        let sets = self.texture_sets[kind as usize].clone();
        let mut of = |set| {
            let sampled = variant.sampled(kind, set);
            self.graphics(variant, Some("shade/forward.frag"), Output::Shades(kind, sampled))
        };
        sets.into_iter().map(|set| Ok((set, of(set)?))).collect()
    }

    fn cones(&mut self, variant: &Variant) -> Result<[BTreeMap<TextureSet, Arc<Pipeline>>; 3]> {
        let mut of = |kind| {
            let sets = self.texture_sets[kind as usize].clone();
            let mut of = |set| {
                let output = Output::Faces(kind, variant.sampled_for_normals(kind, set));
                self.graphics(variant, Some("cluster/mark_cones.frag"), output)
            };
            sets.into_iter().map(|set| Ok((set, of(set)?))).collect::<Result<_>>()
        };
        let [opaque, masked, transparent] = SurfaceKind::ALL;
        Ok([of(opaque)?, of(masked)?, of(transparent)?])
    }

    fn seen(&mut self, variant: &Variant) -> Result<[Arc<Pipeline>; 2]> {
        let mut of = |kind| self.graphics(variant, Some("measure/seen.frag"), Output::Sees(kind));
        Ok([of(SurfaceKind::Opaque)?, of(SurfaceKind::Masked)?])
    }

    fn depth_steps(&mut self, variant: &Variant) -> Result<Option<Arc<Pipeline>>> {
        // It is the same for all methods.
        let defines = Defines(vec![]).with("SAMPLES", variant.samples).with("COUNTERS", 1);
        variant.counting.then(|| self.compute("measure/depth_steps.comp", &defines)).transpose()
    }

    fn pixel_models(&mut self, variant: &Variant) -> Result<Option<[Arc<Pipeline>; 2]>> {
        let mut of = |kind| {
            self.graphics(variant, Some("measure/pixel_models.frag"), Output::Visits(kind, Visit::Count))
        };
        match variant.has_models() && variant.counting {
            true => Ok(Some([of(SurfaceKind::Opaque)?, of(SurfaceKind::Masked)?])),
            false => Ok(None),
        }
    }

    fn visit(&mut self, variant: &Variant, visit: Visit) -> Result<VisitPipelines> {
        let defines = variant.defines().with("VISIT", visit.define());
        let output = |kind| Output::Visits(kind, visit);
        let from_depth = match (visit, variant.bounds) {
            (Visit::Bounds, ClusterBounds::Depth) => "cluster/tile_depths.comp",
            _ => "cluster/mark_depth.comp",
        };
        Ok(VisitPipelines {
            depth: match variant.has_models() {
                true => None,
                false => Some(self.compute(from_depth, &defines)?),
            },
            geometry: self.per_kind(variant, "cluster/mark_geometry.frag", output)?,
        })
    }

    fn scan(&mut self, defines: &Defines, items: &str) -> Result<ScanPipelines> {
        let defines = defines.with("SCAN_ITEMS", items);
        Ok(ScanPipelines {
            single: self.compute("scan/single.comp", &defines)?,
            reduce: self.compute("scan/reduce.comp", &defines)?,
            block_offsets: self.compute("scan/block_offsets.comp", &defines)?,
            apply: self.compute("scan/apply.comp", &defines)?,
        })
    }

    fn per_kind(
        &mut self,
        variant: &Variant,
        fragment: &str,
        output: impl Fn(SurfaceKind) -> Output,
    ) -> Result<[Arc<Pipeline>; 3]> {
        let [opaque, masked, transparent] = SurfaceKind::ALL;
        Ok([
            self.graphics(variant, Some(fragment), output(opaque))?,
            self.graphics(variant, Some(fragment), output(masked))?,
            self.graphics(variant, Some(fragment), output(transparent))?,
        ])
    }

    fn compute(&mut self, path: &str, defines: &Defines) -> Result<Arc<Pipeline>> {
        self.once(format!("{path} {defines:?}"), |store, number| {
            let spirv = store.shaders.compile(path, &defines.0)?;
            let stages = [(vk::ShaderStageFlags::COMPUTE, spirv.as_slice())];
            let layout = PipelineLayout::new(&store.context, &store.layouts, path, &stages)?;
            let pipeline = gpu::compute_pipeline(&store.context, layout.handle, &spirv, path, &[])?;
            Ok(Pipeline::new(pipeline, layout, path, number))
        })
    }
}
