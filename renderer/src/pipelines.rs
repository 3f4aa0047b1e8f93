//! Every shader variant, in one place, and the pipelines made from them.
//!
//! A variant is data: defines and specialization constants. Pipelines that several methods share are made once.

mod debug;
mod graphics;
mod variant;

pub use debug::{DebugPipelines, Line, SPHERE_VERTICES};
pub use variant::{Variant, lights_at_once};

use graphics::Output;
use variant::Defines;

use crate::Result;
use crate::assign::Assigner;
use crate::culling::Culling;
use crate::draw_list::SurfaceKind;
use crate::geometry::views::ViewSet;
use crate::layouts::{Layouts, Pipeline, PipelineLayout};
use crate::texture_sets::TextureSet;
use crate::vk::{self as gpu, Context, ShaderLibrary};
use ash::vk;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The three dispatches of a prefix sum, and the one that does without them.
pub struct ScanPipelines {
    /// Items to prefixes, where there are few.
    pub single: Arc<Pipeline>,
    /// Items to block sums.
    pub reduce: Arc<Pipeline>,
    /// Block sums to block offsets.
    pub block_offsets: Arc<Pipeline>,
    /// Block offsets and items to prefixes.
    pub apply: Arc<Pipeline>,
}

/// Visiting the cluster of every fragment.
pub struct MarkPipelines {
    /// From the depth buffer.
    pub depth: Arc<Pipeline>,
    /// From geometry, by [`SurfaceKind`].
    pub geometry: [Arc<Pipeline>; 3],
}

/// What clustered methods run besides.
pub struct ClusteredPipelines {
    /// Marking the clusters of fragments.
    pub mark: MarkPipelines,
    /// Counting the fragments of visible clusters.
    pub count_fragments: MarkPipelines,
    /// Prefix sum of the visibility words.
    pub compact: ScanPipelines,
    /// Every cluster as a visible one.
    pub list_clusters: Arc<Pipeline>,
    /// Lights into clustering space.
    pub transform_lights: Arc<Pipeline>,
    /// Empties what counting fills in any order.
    pub clear_lists: Arc<Pipeline>,
    /// Pairs that meet, to bits or lengths of lists.
    pub count_lights: Arc<Pipeline>,
    /// Lengths of lists, and the lists, from their bits.
    pub read_masks: [Arc<Pipeline>; 2],
    /// Prefix sum of the lengths.
    pub light_offsets: ScanPipelines,
    /// Pairs that meet, to the lists, in any order.
    pub assign_lights: Arc<Pipeline>,
    /// Sorts the lists.
    pub sort_lists: Arc<Pipeline>,
}

/// What assignment other than by brute force runs besides.
pub struct AcceleratedPipelines {
    /// Marks the blocks that hold visible clusters.
    pub mark_blocks: Arc<Pipeline>,
    /// Lights that may meet one.
    pub cull_lights: Arc<Pipeline>,
    /// Prefix sum of their bits.
    pub rank_lights: ScanPipelines,
    /// Those lights.
    pub list_candidates: Arc<Pipeline>,
    /// Counts the candidates of each group of visible clusters, and lists them.
    pub scatter_groups: [Arc<Pipeline>; 2],
    /// Prefix sum of the tiles they fill.
    pub group_tiles: ScanPipelines,
    /// Digits of each block of the sort.
    pub count_digits: Arc<Pipeline>,
    /// Their prefix sum.
    pub digit_offsets: ScanPipelines,
    /// Items by digit.
    pub reorder: Arc<Pipeline>,
    /// One depth of the hierarchy.
    pub build_nodes: Arc<Pipeline>,
}

/// All pipelines of one variant.
pub struct Pipelines {
    cull: Option<Arc<Pipeline>>,
    /// Prepass of opaque geometry.
    pub depth_opaque: Arc<Pipeline>,
    /// Prepass of masked geometry.
    pub depth_masked: Arc<Pipeline>,
    /// Forward shading, by [`SurfaceKind`] and by the textures of the material.
    pub shade: [BTreeMap<TextureSet, Arc<Pipeline>>; 3],
    /// What is known of each pixel, for images.
    pub pixel_maps: Arc<Pipeline>,
    clustered: Option<ClusteredPipelines>,
    accelerated: Option<AcceleratedPipelines>,
    all: Vec<Arc<Pipeline>>,
}

impl Pipelines {
    /// All of them, each once.
    pub fn all(&self) -> &[Arc<Pipeline>] {
        &self.all
    }

    /// Culls on the device; only its pass asks.
    pub fn cull(&self) -> &Pipeline {
        self.cull.as_ref().expect("stage cull runs where the device culls")
    }

    /// The clustered methods' pipelines; only their passes ask.
    pub fn clustered(&self) -> &ClusteredPipelines {
        self.clustered.as_ref().expect("a pass of clustered methods runs in a clustered method")
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
    /// Those asked for since [`Self::take_asked`], by their numbers.
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
        let clustered = variant.cells.map(|_| self.clustered(variant)).transpose()?;
        let accelerated = match variant.assigner {
            Assigner::Brute => None,
            Assigner::Hierarchy | Assigner::Scatter => Some(self.accelerated(variant)?),
        };
        let cull = match variant.culling {
            Culling::Cpu => None,
            Culling::Gpu => Some(self.compute("geometry/cull.comp", &Defines(vec![]))?),
        };
        let mut pipelines = Pipelines {
            cull,
            depth_opaque: self.graphics(variant, None, Output::Depth)?,
            depth_masked: self.graphics(variant, Some("geometry/alpha_test.frag"), Output::Depth)?,
            shade: self.shade(variant)?,
            pixel_maps: self.compute("measure/pixel_maps.comp", &variant.defines())?,
            clustered,
            accelerated,
            all: vec![],
        };
        pipelines.all = self.take_asked();
        Ok(pipelines)
    }

    fn shade(&mut self, variant: &Variant) -> Result<[BTreeMap<TextureSet, Arc<Pipeline>>; 3]> {
        let mut shade = [const { BTreeMap::new() }; 3];
        for (kind, sets) in SurfaceKind::ALL.into_iter().zip(self.texture_sets.clone()) {
            for set in sets {
                let output = Output::Shades(kind, set);
                let pipeline = self.graphics(variant, Some("shade/forward.frag"), output)?;
                shade[kind as usize].insert(set, pipeline);
            }
        }
        Ok(shade)
    }

    fn accelerated(&mut self, variant: &Variant) -> Result<AcceleratedPipelines> {
        let (defines, tests) = (&variant.list_defines(), &variant.test_defines());
        Ok(AcceleratedPipelines {
            mark_blocks: self.compute("cull/mark_blocks.comp", defines)?,
            cull_lights: self.compute("cull/cull_lights.comp", tests)?,
            rank_lights: self.scan(defines, "SCAN_LIGHTS")?,
            list_candidates: self.compute("cull/list_candidates.comp", tests)?,
            scatter_groups: self.both("assign/scatter_groups.comp", defines, "FILL_GROUPS")?,
            group_tiles: self.scan(defines, "SCAN_GROUPS")?,
            count_digits: self.compute("build/count_digits.comp", tests)?,
            digit_offsets: self.scan(defines, "SCAN_DIGITS")?,
            reorder: self.compute("build/reorder.comp", defines)?,
            build_nodes: self.compute("build/build_nodes.comp", tests)?,
        })
    }

    fn clustered(&mut self, variant: &Variant) -> Result<ClusteredPipelines> {
        let (defines, tests) = (variant.list_defines(), variant.test_defines());
        let assign = match variant.assigner {
            Assigner::Brute => "assign/brute.comp",
            Assigner::Hierarchy => "assign/hierarchy.comp",
            Assigner::Scatter => "assign/scatter.comp",
        };
        let [count_lights, assign_lights] = self.both(assign, &tests, "WRITE_LISTS")?;
        Ok(ClusteredPipelines {
            mark: self.mark(variant, false)?,
            count_fragments: self.mark(variant, true)?,
            compact: self.scan(&defines, "SCAN_VISIBILITY")?,
            list_clusters: self.compute("cluster/list_clusters.comp", &defines)?,
            transform_lights: self.compute("assign/transform_lights.comp", &defines)?,
            clear_lists: self.compute("assign/clear_lists.comp", &defines)?,
            count_lights,
            read_masks: self.both("assign/read_masks.comp", &defines, "WRITE_LISTS")?,
            light_offsets: self.scan(&defines, "SCAN_LIST_LENGTHS")?,
            assign_lights,
            sort_lists: self.compute("assign/sort_lists.comp", &defines)?,
        })
    }

    /// A compute shader twice: with `define` 0 and 1.
    fn both(&mut self, path: &str, defines: &Defines, define: &'static str) -> Result<[Arc<Pipeline>; 2]> {
        Ok([self.compute(path, &defines.with(define, 0))?, self.compute(path, &defines.with(define, 1))?])
    }

    fn mark(&mut self, variant: &Variant, count: bool) -> Result<MarkPipelines> {
        let output = |kind| if count { Output::Counts(kind) } else { Output::Marks(kind) };
        let defines = variant.defines().with("COUNT_FRAGMENTS", u32::from(count));
        Ok(MarkPipelines {
            depth: self.compute("cluster/mark_depth.comp", &defines)?,
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
