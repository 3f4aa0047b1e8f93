//! A variant as data: what shaders are specialised for, and the defines that follow.

use super::Output;
use crate::assign::{
    Assigner, ClusterBounds, Clusters, Compaction, Conservative, ListStore, Marking, MeshDetail,
};
use crate::culling::Culling;
use crate::draw_list::SurfaceKind;
use crate::geometry::{
    CellShape, ConeTest, NormalCones, Separators, Sharing, SliceLaw, SphereTest, VolumeTest,
};
use crate::lights::Attenuation;
use crate::material::MaterialModel;
use crate::methods::Groups;
use crate::shading::{Shading, ShadingPipeline};
use crate::texture_sets::TextureSet;

/// What a run's shaders are specialised for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    /// How shading walks the lights of a fragment: a file of this name in `lookup`.
    pub lookup: &'static str,
    /// What fragments that share a list are grouped by.
    pub groups: Groups,
    /// How views share clusterings.
    pub sharing: Sharing,
    /// Which clusters get lists.
    pub clusters: Clusters,
    /// What of a cluster is tested against lights.
    pub bounds: ClusterBounds,
    /// Into which cones the normals of a cluster are told apart, to leave lights out.
    pub normal_cones: NormalCones,
    /// How visible clusters get their places.
    pub compaction: Compaction,
    /// Side of the tiles that are sorted for it, pixels; 0 where none are.
    pub sorted_tile: u32,
    /// How the lists lie in memory.
    pub lists: ListStore,
    /// Where slices begin.
    pub slices: SliceLaw,
    /// Whether a geometric slice is found by adding a constant to a logarithm.
    pub adds_bias: bool,
    /// Samples per pixel.
    pub samples: u32,
    /// Where instances are culled.
    pub culling: Culling,
    /// Whether geometry passes draw all views at once.
    pub multiview: bool,
    /// Marking from depth shades per sample, marking from geometry per fragment.
    pub marking: Marking,
    /// How the lists are built.
    pub assigner: Assigner,
    /// How meshes around lights are rasterised, where these are kept.
    pub conservative: Conservative,
    /// How fine they are.
    pub mesh_detail: MeshDetail,
    /// What decides who is on them; no cones are asked where there are none.
    pub test: VolumeTest,
    /// Lights that shading evaluates in one turn of its loop.
    pub lights_at_once: u32,
    /// How surfaces are drawn.
    pub shading: Shading,
    /// Who evaluates lights for opaque and masked ones.
    pub pipeline: ShadingPipeline,
    /// How lights fade.
    pub attenuation: Attenuation,
    /// What surfaces are made of.
    pub material: MaterialModel,
    /// Whether some lights have cones.
    pub spots: bool,
    /// Whether counters are compiled in: the atemporal run.
    pub counting: bool,
}

/// Lights that shading evaluates in one turn of its loop, where a run has `lights` at most and lists or none. Several cost
/// less each, and lavapipe ends a shader's loops after 65 535 turns, in silence; but it runs a turn also where there are no
/// lights.
pub fn lights_at_once(has_lists: bool, lights: u32) -> u32 {
    match has_lists {
        false if lights < 16 => 1,
        false => 16,
        true if lights <= 512 => 1,
        true => 4,
    }
}

impl Variant {
    /// What cells look like; `None` where there are none.
    pub(super) fn cells(&self) -> Option<CellShape> {
        self.groups.cells()
    }

    /// Whether groups are models, which fragments know and depth does not tell.
    pub(super) fn has_models(&self) -> bool {
        self.cells() == Some(CellShape::Model)
    }

    /// Whether fragments run once per sample, so that they lie where the depth buffer says.
    pub(super) fn per_sample(&self) -> bool {
        self.samples > 1 && self.marking == Marking::Depth
    }

    /// Whether a graphics pipeline draws all views at once: the prepass, and what is shaded in any order through the one
    /// clustering that all views share.
    pub(super) fn draws_all_views(&self, output: Output) -> bool {
        let one_clustering = self.sharing == Sharing::Encl;
        self.multiview
            && match output {
                Output::Depth | Output::Fills(..) => true,
                Output::Shades(kind, _) => one_clustering && kind != SurfaceKind::Transparent,
                Output::Visits(..) | Output::Faces(..) | Output::Sees(_) => false,
            }
    }

    /// Whether a pipeline shades, or keeps, what may be hidden in the end.
    pub(super) fn overdraws(&self, output: Output) -> bool {
        use SurfaceKind::{Masked, Opaque};
        self.shading == Shading::Overdraw
            && matches!(output, Output::Shades(Opaque | Masked, _) | Output::Fills(..))
    }

    /// Whether shading counts fragments that may be hidden in the end.
    pub(super) fn counts_hidden(&self) -> bool {
        (self.shading, self.pipeline) == (Shading::Overdraw, ShadingPipeline::Forward) && self.counting
    }

    /// Whether a pipeline writes depth. What is cut out must leave none, for which shading gives up the early tests that
    /// counters need: masked surfaces are counted without leaving any.
    pub(super) fn writes_depth(&self, output: Output) -> bool {
        let counts_masked = self.counting && matches!(output, Output::Shades(SurfaceKind::Masked, _));
        output == Output::Depth || self.overdraws(output) && !counts_masked
    }

    /// The textures that shading samples of surfaces of a kind, of those that their materials have.
    pub(super) fn sampled(&self, kind: SurfaceKind, textures: TextureSet) -> TextureSet {
        let reads_alpha = match kind {
            SurfaceKind::Opaque => false,
            SurfaceKind::Masked => self.overdraws(Output::Shades(kind, textures)),
            SurfaceKind::Transparent => true,
        };
        self.material.sampled(textures, reads_alpha)
    }

    /// The textures that tell the shading normals of surfaces of a kind, of those that their materials have.
    pub(super) fn sampled_for_normals(&self, kind: SurfaceKind, textures: TextureSet) -> TextureSet {
        self.sampled(kind, textures).and(TextureSet::NORMAL)
    }

    /// Whether fragments of a kind of surface are shaded.
    pub(super) fn shades(&self, kind: SurfaceKind) -> bool {
        self.pipeline == ShadingPipeline::Forward || kind == SurfaceKind::Transparent
    }

    /// What draws surfaces of a kind into the picture: with overdraw masked ones are counted by other pipelines.
    pub(super) fn drawing(&self, kind: SurfaceKind) -> Self {
        let counted_apart = self.shading == Shading::Overdraw && kind == SurfaceKind::Masked;
        Self { counting: self.counting && !counted_apart, ..*self }
    }

    /// The defines of every shader of this variant.
    pub(super) fn defines(&self) -> Defines {
        let space = match self.cells() {
            Some(CellShape::Frustum | CellShape::BoxedFrustum) | None => "SPACE_PERSPECTIVE",
            Some(CellShape::Box) => "SPACE_ORTHOGRAPHIC",
            Some(CellShape::Model) => "SPACE_MODEL",
        };
        let clusters = match self.clusters {
            Clusters::Visible => "CLUSTERS_VISIBLE",
            Clusters::All => "CLUSTERS_ALL",
        };
        let bounds = match self.bounds {
            ClusterBounds::Cell => "BOUNDS_CELL",
            ClusterBounds::Depth => "BOUNDS_DEPTH",
            ClusterBounds::Box => "BOUNDS_BOX",
        };
        let compaction = match self.compaction {
            Compaction::Ranks => "COMPACTION_RANKS",
            Compaction::Atomic => "COMPACTION_ATOMIC",
            Compaction::Sort => "COMPACTION_SORT",
        };
        let lists = match self.lists {
            ListStore::Offsets => "LISTS_OFFSETS",
            ListStore::Fixed(_) => "LISTS_FIXED",
            ListStore::Capped(_) => "LISTS_CAPPED",
            ListStore::Linked(_) => "LISTS_LINKED",
        };
        self.surface_defines()
            .with("LOOKUP", self.lookup)
            .with("SPACE", space)
            .with("CLUSTERS", clusters)
            .with("BOUNDS", bounds)
            .with("COMPACTION", compaction)
            .with("LISTS", lists)
            .with("NODE_WORDS", self.lists.links().map_or(0, |links| links.node.words()))
            .with("SLICES", self.slices_define())
            .with("LEAVES", u32::from(self.groups == Groups::Leaves))
            .with("SPOTS", u32::from(self.spots))
            .with("COUNTERS", u32::from(self.counting))
    }

    /// The defines of what draws surfaces, or samples what was drawn, whatever the method.
    pub(super) fn surface_defines(&self) -> Defines {
        let material = match self.material {
            MaterialModel::Textured => "MATERIAL_TEXTURED",
            MaterialModel::White => "MATERIAL_WHITE",
        };
        Defines(vec![])
            .with("SAMPLES", self.samples)
            .with("PER_SAMPLE", u32::from(self.per_sample()))
            .with("MATERIAL", material)
    }

    /// The two geometric laws differ in numbers alone.
    fn slices_define(&self) -> &'static str {
        match self.slices {
            SliceLaw::Geometric | SliceLaw::Cubes if self.adds_bias => "SLICES_GEOMETRIC_BIASED",
            SliceLaw::Geometric | SliceLaw::Cubes => "SLICES_GEOMETRIC",
            SliceLaw::SecondPlane { .. } => "SLICES_SECOND_PLANE",
            SliceLaw::Linear => "SLICES_LINEAR",
            SliceLaw::UniformNdc => "SLICES_UNIFORM_NDC",
            SliceLaw::UniformView => "SLICES_UNIFORM_VIEW",
        }
    }

    /// Whether the boxes around the pieces of a frustum are tested, as they are kept.
    pub(super) fn is_boxed(&self) -> bool {
        !self.assigner.rasterises() && self.cells().is_some_and(|cells| cells.keeps_boxes(self.test.sphere))
    }

    /// Definitions for shaders that build lists.
    pub(super) fn list_defines(&self) -> Defines {
        let assigner = match self.assigner {
            Assigner::Brute => "ASSIGN_BRUTE",
            Assigner::Hierarchy => "ASSIGN_HIERARCHY",
            Assigner::Scatter => "ASSIGN_SCATTER",
            Assigner::Rectangles => "ASSIGN_RECTANGLES",
            Assigner::Raster => "ASSIGN_RASTER",
            Assigner::RasterCount => "ASSIGN_RASTER_COUNT",
        };
        self.defines().with("ASSIGN", assigner)
    }

    /// What is asked of cones.
    fn cone_define(&self) -> &'static str {
        match self.test.cone {
            ConeTest::Separating => "CONES_SEPARATING",
            ConeTest::Exact => "CONES_EXACT",
            ConeTest::Unasked => "CONES_UNASKED",
        }
    }

    /// The same with those of what asks normals.
    pub(super) fn normal_cone_defines(&self, defines: &Defines) -> Defines {
        let cones = self.normal_cones;
        defines.with("NORMAL_CONES", cones).with("CONE_SPREADS", cones.glsl_spreads())
    }

    /// Definitions for shaders that ask what a volume meets.
    pub(super) fn test_defines(&self) -> Defines {
        let test = self.test.sphere;
        let boxes = self.cells() == Some(CellShape::Box);
        let nearest = matches!(test, SphereTest::Exact | SphereTest::Box);
        // Planes are cheaper than the nearest point, but for boxes.
        let pieces = matches!(self.cells(), Some(CellShape::Frustum | CellShape::BoxedFrustum));
        let half_spaces = test.asks(Separators::HALF_SPACES) || nearest && pieces && !self.is_boxed();
        let [edges, nearest_vertex, normals, vertices] =
            [Separators::EDGES, Separators::NEAREST_VERTEX, Separators::NORMALS, Separators::VERTICES]
                .map(|separators| test.asks(separators));
        self.normal_cone_defines(&self.list_defines())
            .with("TEST_HS", u32::from(half_spaces))
            .with("TEST_SAT_E", u32::from(edges))
            .with("TEST_SAT_N", u32::from(nearest_vertex))
            .with("TEST_SAT_P", u32::from(normals))
            .with("TEST_SAT_V", u32::from(vertices))
            .with("TEST_NEAREST", u32::from(nearest))
            .with("TEST_MM", u32::from(test == SphereTest::Projected))
            .with("CONES", self.cone_define())
            .with("BOXED", u32::from(self.is_boxed()))
            .with("TEST_BOUNDED", u32::from(test.is_bounded(boxes) && !self.has_models()))
    }
}

/// Names and values that a shader is compiled with.
#[derive(Debug, Clone)]
pub(super) struct Defines(pub(super) Vec<(&'static str, String)>);

impl Defines {
    pub(super) fn with(&self, name: &'static str, value: impl ToString) -> Self {
        let mut defines = self.0.clone();
        defines.push((name, value.to_string()));
        Self(defines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_loop_over_all_lights_reaches_the_turns_that_lavapipe_ends_it_after() {
        for lights in [0, 1, 15, 16, 512, 513, 65_535, 1_000_000] {
            let at_once = lights_at_once(false, lights);
            assert!(at_once > 0 && lights.div_ceil(at_once) < 65_535, "{lights} lights, {at_once} at once");
        }
    }
}
