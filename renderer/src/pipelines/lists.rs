//! The pipelines that build light lists: an entry each says what it is, and how it is made.

use super::{Defines, PipelineStore, RasterPipelines, ScanPipelines, Variant, Visit, VisitPipelines};
use crate::Result;
use crate::assign::{Assigner, Compaction, ListStore, sorted_keys, sorted_threads};
use crate::layouts::Pipeline;
use std::sync::Arc;

/// What the pipelines of a variant are made of.
struct Maker<'a> {
    store: &'a mut PipelineStore,
    variant: &'a Variant,
    /// Defines of shaders that build lists.
    defines: Defines,
    /// Defines of shaders that ask what a volume meets.
    tests: Defines,
}

impl Maker<'_> {
    fn lists(&mut self, path: &str) -> Result<Arc<Pipeline>> {
        self.store.compute(path, &self.defines)
    }

    fn tests(&mut self, path: &str) -> Result<Arc<Pipeline>> {
        self.store.compute(path, &self.tests)
    }

    /// A shader that builds lists, twice: with `define` 0 and 1.
    fn both(&mut self, path: &str, define: &'static str) -> Result<[Arc<Pipeline>; 2]> {
        twice(self.store, path, &self.defines, define)
    }

    /// What takes lights to lists in one pass, where there is such.
    fn collect(&mut self) -> Result<Option<Arc<Pipeline>>> {
        let Variant { assigner, lists, .. } = *self.variant;
        let kept = match lists {
            ListStore::Offsets | ListStore::Linked(_) => return Ok(None),
            // They lie in memory at once.
            ListStore::Fixed(_) => 0,
            ListStore::Capped(lights) => lights,
        };
        let defines = self.tests.with("KEPT_LIGHTS", kept);
        let path = "assign/collect.comp";
        (assigner == Assigner::Brute).then(|| self.store.compute(path, &defines)).transpose()
    }

    /// Counting clusters into places, and what follows from their number, where that is how they get them.
    fn take_places(&mut self) -> Result<Option<[Arc<Pipeline>; 2]>> {
        match self.variant.compaction {
            Compaction::Ranks | Compaction::Sort => Ok(None),
            Compaction::Atomic => Ok(Some([
                self.lists("cluster/take_places.comp")?,
                self.lists("cluster/publish_places.comp")?,
            ])),
        }
    }

    /// Sorting the samples of tiles, and the prefix sum of their clusters, where that finds the visible ones.
    fn sort_tiles(&mut self) -> Result<Option<TilePipelines>> {
        let Variant { compaction, sorted_tile, samples, .. } = *self.variant;
        if compaction != Compaction::Sort {
            return Ok(None);
        }
        let keys = sorted_keys(sorted_tile, samples);
        let defines = self.defines.with("TILE_PIXELS", sorted_tile).with("TILE_KEYS", keys);
        let defines = defines.with("TILE_THREADS", sorted_threads(keys));
        let sort_tiles = self.store.compute("cluster/sort_tiles.comp", &defines)?;
        Ok(Some(TilePipelines { sort_tiles, tile_offsets: self.scan("SCAN_TILES")? }))
    }

    /// Finding the cells in which lights are seen, where lights are handed to these.
    fn light_rectangles(&mut self) -> Result<Option<Arc<Pipeline>>> {
        let wanted = self.variant.assigner == Assigner::Rectangles;
        wanted.then(|| self.tests("assign/light_rectangles.comp")).transpose()
    }

    /// Finding where meshes around lights lie, where these are rasterised.
    fn raster(&mut self) -> Result<Option<RasterPipelines>> {
        self.store.raster(self.variant)
    }

    /// What finds the pairs that meet: counts or links them, and writes lists. Of meshes, points and spots apart.
    fn meet(&mut self) -> Result<Vec<[Arc<Pipeline>; 2]>> {
        let path = meet(self.variant.assigner);
        match self.variant.assigner.rasterises() {
            true => self.store.fills(self.variant, path),
            false => Ok(vec![twice(self.store, path, &self.tests, "WRITE_LISTS")?]),
        }
    }

    fn scan(&mut self, items: &str) -> Result<ScanPipelines> {
        self.store.scan(&self.defines, items)
    }

    fn visit(&mut self, visit: Visit) -> Result<VisitPipelines> {
        self.store.visit(self.variant, visit)
    }
}

/// Sorts the samples of tiles by their slices, and lists the clusters that hold some.
pub struct TilePipelines {
    /// The slices of each tile.
    pub sort_tiles: Arc<Pipeline>,
    /// Prefix sum of their numbers.
    pub tile_offsets: ScanPipelines,
}

/// A shader twice: with `define` 0 and 1.
pub(super) fn twice(
    store: &mut PipelineStore,
    path: &str,
    defines: &Defines,
    define: &'static str,
) -> Result<[Arc<Pipeline>; 2]> {
    Ok([store.compute(path, &defines.with(define, 0))?, store.compute(path, &defines.with(define, 1))?])
}

/// A struct of pipelines and the function that makes them, from one list.
macro_rules! pipelines {
    (
        $(#[$about:meta])*
        pub struct $name:ident, made by $make:ident with $maker:ident {
            $($(#[$doc:meta])* $field:ident: $kind:ty = $made:expr;)*
        }
    ) => {
        $(#[$about])*
        pub struct $name {
            $($(#[$doc])* pub $field: $kind,)*
        }

        impl PipelineStore {
            pub(super) fn $make(&mut self, variant: &Variant) -> Result<$name> {
                let (defines, tests) = (variant.list_defines(), variant.test_defines());
                let $maker = &mut Maker { store: self, variant, defines, tests };
                Ok($name { $($field: $made?,)* })
            }
        }
    };
}

pipelines! {
    /// What methods with clusters run.
    pub struct ClusteredPipelines, made by clustered with make {
        /// Marking the clusters of fragments.
        mark: VisitPipelines = make.visit(Visit::Mark);
        /// Prefix sum of the visibility words.
        compact: ScanPipelines = make.scan("SCAN_VISIBILITY");
        /// Places for visible clusters by a counter, and what follows from their number.
        take_places: Option<[Arc<Pipeline>; 2]> = make.take_places();
        /// Visible clusters by sorting the samples of tiles.
        sort_tiles: Option<TilePipelines> = make.sort_tiles();
        /// Every cluster as a visible one.
        list_clusters: Arc<Pipeline> = make.lists("cluster/list_clusters.comp");
        /// Takes lights into clustering space.
        transform_lights: Arc<Pipeline> = make.lists("assign/transform_lights.comp");
        /// The cells in which each light is seen.
        light_rectangles: Option<Arc<Pipeline>> = make.light_rectangles();
        /// Where the meshes around lights lie.
        raster: Option<RasterPipelines> = make.raster();
        /// Empties what counting fills in any order.
        clear_lists: Arc<Pipeline> = make.lists("assign/clear_lists.comp");
        /// Pairs of light and cluster that meet: to bits or lengths of lists, and once more, to the lists, in any order.
        /// Of meshes, those of points, then those of spots.
        meet: Vec<[Arc<Pipeline>; 2]> = make.meet();
        /// Lengths of lists, and the lists, from their bits.
        read_masks: [Arc<Pipeline>; 2] = make.both("assign/read_masks.comp", "WRITE_LISTS");
        /// Lights to lists by brute force in one pass.
        collect: Option<Arc<Pipeline>> = make.collect();
        /// Prefix sum of the lengths of lists.
        light_offsets: ScanPipelines = make.scan("SCAN_LIST_LENGTHS");
        /// Sorts the lists of lights.
        sort_lists: Arc<Pipeline> = make.lists("assign/sort_lists.comp");
    }
}

pipelines! {
    /// What hierarchy and scatter run more than brute force does.
    pub struct AcceleratedPipelines, made by accelerated with make {
        /// Marks the blocks that hold visible clusters.
        mark_blocks: Arc<Pipeline> = make.lists("cull/mark_blocks.comp");
        /// A bit for each light that may meet a visible cluster: a candidate.
        cull_lights: Arc<Pipeline> = make.tests("cull/cull_lights.comp");
        /// Lists the candidates.
        list_candidates: Arc<Pipeline> = make.tests("cull/list_candidates.comp");
        /// Counts the candidates of each group of visible clusters, and lists them.
        scatter_groups: [Arc<Pipeline>; 2] = make.both("assign/scatter_groups.comp", "FILL_GROUPS");
        /// Prefix sum of the packets that the candidates of groups fill.
        group_packets: ScanPipelines = make.scan("SCAN_GROUPS");
        /// Counts the digits of each block of the sort.
        count_digits: Arc<Pipeline> = make.tests("build/count_digits.comp");
        /// Prefix sum of the digits' counts.
        digit_offsets: ScanPipelines = make.scan("SCAN_DIGITS");
        /// Moves the items of the sort to their digit's place.
        reorder: Arc<Pipeline> = make.lists("build/reorder.comp");
        /// Makes one depth of the hierarchy.
        build_nodes: Arc<Pipeline> = make.tests("build/build_nodes.comp");
    }
}

impl ClusteredPipelines {
    /// Gives visible clusters their places by a counter; only its pass asks.
    pub fn take_places(&self) -> &[Arc<Pipeline>; 2] {
        self.take_places.as_ref().expect("a counter gives places where compaction is atomic")
    }

    /// Finds visible clusters by sorting the samples of tiles; only its passes ask.
    pub fn sort_tiles(&self) -> &TilePipelines {
        self.sort_tiles.as_ref().expect("tiles are sorted where compaction is by sorting them")
    }

    /// Finds the cells in which lights are seen; only its pass asks.
    pub fn light_rectangles(&self) -> &Pipeline {
        self.light_rectangles.as_ref().expect("lights have rectangles where these are how they are assigned")
    }

    /// Finds where meshes around lights lie; only its pass asks.
    pub fn raster(&self) -> &RasterPipelines {
        self.raster.as_ref().expect("meshes are rasterised where that is how lights are assigned")
    }

    /// Takes lights to lists in one pass; only that asks.
    pub fn collect(&self) -> &Pipeline {
        self.collect.as_ref().expect("one pass makes lists by brute force that no lengths place")
    }
}

/// What finds the pairs that meet.
fn meet(assigner: Assigner) -> &'static str {
    match assigner {
        Assigner::Brute => "assign/brute.comp",
        Assigner::Hierarchy => "assign/hierarchy.comp",
        Assigner::Scatter => "assign/scatter.comp",
        Assigner::Rectangles => "assign/rectangles.comp",
        Assigner::Raster => "raster/fill.comp",
        Assigner::RasterCount => "raster/count.comp",
    }
}
