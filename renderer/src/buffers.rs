//! Every buffer that shaders see, declared once: names, GLSL, views, owners and sizes. Binding numbers, the declarations
//! that shaders include, buffers with their debug names, their texel views and the checks of limits follow.
//!
//! ```text
//! views ─┬─> cluster_bits ──scan──> word_ranks, visible_clusters ─┐
//! grid ──┘      (mark)                                            ├─> list_lengths ──scan──> list_offsets ───┐
//! lights ─────> light_volumes ────────────────────────────────────┘   (count_lights)                         │
//!               (transform_lights)             └──────────────────────────> light_indices (assign_lights) <──┘
//! ```
//!
//! World space, on the device, is relative to the frame's origin (see [`crate::origin`]). `slice_planes`, which the host
//! writes with `grid`, are the depths between the slices of a perspective grid, so that a fragment's slice and the planes
//! that lights are tested against are the same numbers, whatever a device makes of logarithms.
//!
//! Where bounds are measured, `views` and `grid` go to `cluster_bounds` once `visible_clusters` are there (bounds), and the
//! lists are made from these.
//!
//! Where cells are tested as boxes, `grid` and `slice_planes` go to `cluster_boxes` first (build_boxes), in frames whose
//! projection is not that of the last; the lists are made from these.
//!
//! Where the device culls, `views`, `instances`, `drawables` and `draw_order` go to `draw_commands` and
//! `drawn_instances` before all that (cull).
//!
//! Lists may be kept otherwise (see [`ListStore`](crate::assign::ListStore)): then brute force goes from `light_volumes` to
//! `light_indices` at once (collect), with `list_lengths` beside them, and nothing is summed. Visible clusters may get their
//! places from a counter, as `cluster_places` in place of `word_ranks`.
//!
//! All ways go to `list_lengths` by way of `light_masks` where these have room. Hierarchy and scatter first put the lights
//! that may meet a visible cluster into `candidates` (cull_lights: `block_bits`, `light_bits`); then the hierarchy makes
//! `sort_items`, `digit_counts`, `tree_volumes`, `tree_lights` and `light_nodes`, scatter `groups`, `packet_groups` and
//! `group_lights`. Rectangles go to `light_rectangles` instead of `light_volumes`. Meshes go from `mesh_frames` to `light_frames`, and with `mesh_vertices`
//! and `mesh_triangles` to `shell_ranges`.
//!
//! Visible clusters may be found by sorting the samples of tiles: `views` and `grid` go to `tile_counts` and `tile_slices`
//! (sort_tiles), and their prefix sum to `tile_offsets`, in place of `word_ranks`.
//!
//! Where lights are found by an octree, the host builds `octree` with its tables, and shading alone reads them: `octree_nodes` from
//! depth to depth, the last time `octree_leaves`, each by way of `octree_offsets`, and `octree_indices`.

mod info;
mod memory;
mod set;
mod sizes;

pub use info::{BufferInfo, BufferView, Element, Owner, Texels};
pub use memory::Copies;
pub use set::{BufferSet, set};
pub use sizes::ClusteringSizes;

use crate::gpu_interface::{
    BLOCK_WORDS, COUNTER_COUNT, Candidate, ClusterBox, ClusterGroup, ClusteringState, DISPATCH_COUNT,
    DispatchSize, GridData, InstanceData, LightData, LightNode, LightRectangle, LightVolume,
    MEASUREMENT_WORDS, MeshFrame, OctreeData, PixelData, SpotData,
};
use crate::measure::{OctreeSizes, Purpose};
use info::{buffer, bytes};

/// Declares the names and what they name.
macro_rules! buffers {
    ($($(#[$doc:meta])* $name:ident = $info:expr;)+) => {
        /// A buffer that shaders see.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        #[repr(u32)]
        pub enum BufferName { $($(#[$doc])* $name),+ }

        impl BufferName {
            /// All buffers, in the order of their bindings.
            pub const ALL: [Self; BUFFER_COUNT] = [$(Self::$name),+];
        }

        /// How many buffers shaders see.
        pub const BUFFER_COUNT: usize = [$(stringify!($name)),+].len();

        static BUFFERS: [BufferInfo; BUFFER_COUNT] = [$($info),+];
    };
}

buffers! {
    /// What rendering cameras see; of a uniform buffer llvmpipe reads a word once for all lanes, also where the flow of
    /// control has parted.
    Views = buffer("views", Owner::Frame).uniform("ViewData views[MAX_VIEWS]");
    /// The grid of a clustering.
    Grid = buffer("grid", Owner::ClusteringFrame).uniform("GridData grid").sized(|_| bytes::<GridData>(1))
        .serving(Purpose::Grouping);
    /// Depths between the slices of a perspective grid.
    SlicePlanes = buffer("slice_planes", Owner::ClusteringFrame)
        .storage("float slice_planes[]")
        .sized(|s| bytes::<f32>(s.slice_planes.into()))
        .serving(Purpose::Grouping);
    /// Lights, or candidates, in clustering space.
    LightVolumes = buffer("light_volumes", Owner::Clustering)
        .storage("LightVolume light_volumes[]")
        .texels("volume", Element::Struct(LightVolume::INFO))
        .sized(|s| bytes::<LightVolume>(s.volumes()));
    /// The cells in which each light is seen, where lights are handed to these.
    LightRectangles = buffer("light_rectangles", Owner::Clustering)
        .storage("LightRectangle light_rectangles[]")
        .texels("rectangle", Element::Struct(LightRectangle::INFO))
        .sized(|s| bytes::<LightRectangle>(s.rectangles()));
    /// Whether each cluster of the grid is visible, a bit a cluster.
    ClusterBits = buffer("cluster_bits", Owner::Clustering)
        .storage("uint cluster_bits[]")
        .sized(|s| bytes::<u32>(s.words()))
        .serving(Purpose::Grouping);
    /// Visible clusters before each word of bits, where ranks are their places.
    WordRanks = buffer("word_ranks", Owner::Clustering)
        .storage("uint word_ranks[]")
        .sized(|s| bytes::<u32>(s.ranked_words()))
        .serving(Purpose::Grouping);
    /// Place of each visible cluster of the grid, where a counter gave it.
    ClusterPlaces = buffer("cluster_places", Owner::Clustering)
        .storage("uint cluster_places[]")
        .sized(|s| bytes::<u32>(s.cluster_places()))
        .serving(Purpose::Grouping);
    /// How many clusters of each tile are visible, where the samples of tiles are sorted.
    TileCounts = buffer("tile_counts", Owner::Clustering)
        .storage("uint tile_counts[]")
        .sized(|s| bytes::<u32>(s.sorted_tiles()));
    /// The slices of the visible clusters of each tile, ascending; each tile has room for all of its slices.
    TileSlices = buffer("tile_slices", Owner::Clustering)
        .storage("uint tile_slices[]")
        .sized(|s| bytes::<u32>(s.sorted_slices()));
    /// Where the visible clusters of each tile begin among all, and where the last end, where the samples of tiles are sorted.
    TileOffsets = buffer("tile_offsets", Owner::Clustering)
        .storage("uint tile_offsets[]")
        .sized(|s| bytes::<u32>(s.tile_offsets()))
        .serving(Purpose::Grouping);
    /// Linear indices of the visible clusters; ascending where ranks are their places.
    VisibleClusters = buffer("visible_clusters", Owner::Clustering)
        .storage("uint visible_clusters[]")
        .sized(|s| bytes::<u32>(s.visible()))
        .serving(Purpose::Grouping);
    /// What the samples of each visible cluster take of its cell, where that is measured: the lowest words with all bits
    /// turned, then the highest.
    ClusterBounds = buffer("cluster_bounds", Owner::Clustering)
        .storage("uint cluster_bounds[]")
        .sized(|s| bytes::<u32>(s.bound_words()))
        .serving(Purpose::Grouping);
    /// Which ways the samples of each visible cluster face, a bit a cone of normals, where lights behind them are left out.
    ClusterCones = buffer("cluster_cones", Owner::Clustering)
        .storage("uint cluster_cones[]")
        .sized(|s| bytes::<u32>(s.cone_words()))
        .serving(Purpose::Grouping);
    /// The box around each cell of the grid, where that is tested against lights; it stays until the projection changes.
    ClusterBoxes = buffer("cluster_boxes", Owner::Clustering)
        .storage("ClusterBox cluster_boxes[]")
        .texels("cluster_box", Element::Struct(ClusterBox::INFO))
        .sized(|s| bytes::<ClusterBox>(s.boxes()))
        .serving(Purpose::Grouping);
    /// Sums of the blocks of a prefix sum.
    BlockSums = buffer("block_sums", Owner::Clustering)
        .storage("uint block_sums[]")
        .sized(|s| bytes::<u32>(s.scan_blocks()));
    /// How many lights each list has; in entries of a fixed size, how many it should have; nothing where lists are linked.
    ListLengths = buffer("list_lengths", Owner::Clustering)
        .storage("uint list_lengths[]")
        .sized(|s| bytes::<u32>(s.lengths()));
    /// Where each list begins, and in the store by offsets the total; the first node of each list where these are linked; nothing where
    /// lists have entries of a fixed size.
    ListOffsets = buffer("list_offsets", Owner::Clustering)
        .storage("uint list_offsets[]")
        .sized(|s| bytes::<u32>(s.offsets()))
        .serving(Purpose::Lists);
    /// The lights of the lists, or the pool of nodes that tell lights and next nodes.
    LightIndices = buffer("light_indices", Owner::Clustering)
        .storage("uint light_indices[]")
        .texels("index", Element::Word)
        .sized(|s| bytes::<u32>(s.light_index_words()))
        .serving(Purpose::Lists);
    /// What the device finds out: `new_state` is written, `state` is what earlier dispatches wrote.
    State = buffer("state", Owner::Clustering)
        .storage("ClusteringState new_state")
        .uniform("ClusteringState state")
        .sized(|_| bytes::<ClusteringState>(1));
    /// Sizes of indirect dispatches.
    Dispatches = buffer("dispatches", Owner::Clustering)
        .storage("DispatchSize dispatches[]")
        .sized(|_| bytes::<DispatchSize>(DISPATCH_COUNT.into()));
    /// 64-bit counters of atemporal runs.
    Counters = buffer("counters", Owner::Clustering)
        .storage("uint counters[]")
        .sized(|s| s.counted(bytes::<u64>(COUNTER_COUNT as u64)));
    /// Fragments of each visible cluster, or of each slot for leaves of an octree, in atemporal runs.
    VisibleFragments = buffer("visible_fragments", Owner::Clustering)
        .storage("uint visible_fragments[]")
        .sized(|s| s.counted(bytes::<u32>(s.visible() + u64::from(s.capacities.octree.leaves))));
    /// Fragments by how many lights were evaluated for them, in atemporal runs.
    LightsPerFragment = buffer("lights_per_fragment", Owner::Clustering)
        .storage("uint lights_per_fragment[]")
        .sized(|s| s.counted(bytes::<u32>(u64::from(s.lights) + 1)));
    /// What is known of each pixel of a view, in atemporal runs.
    Pixels = buffer("pixels", Owner::Clustering)
        .storage("PixelData pixels[]")
        .sized(|s| s.counted(bytes::<PixelData>(s.pixels)));
    /// What the self-test measures, in atemporal runs.
    Measurements = buffer("measurements", Owner::Clustering)
        .storage("uint measurements[]")
        .sized(|s| s.counted(bytes::<u32>(MEASUREMENT_WORDS)));
    /// The scene's instances, in drawing order.
    Instances = buffer("instances", Owner::Scene)
        .storage("InstanceData instances[]")
        .texels("instance", Element::Struct(InstanceData::INFO));
    /// Bits of the lists, a bit a light.
    LightMasks = buffer("light_masks", Owner::Clustering)
        .storage("uint light_masks[]")
        .texels("mask", Element::Word)
        .sized(|s| bytes::<u32>(s.mask_words()));
    /// Key and candidate, in two halves.
    SortItems = buffer("sort_items", Owner::Clustering)
        .storage("uvec2 sort_items[]")
        .sized(|s| bytes::<[u32; 2]>(2 * s.tree_lights()));
    /// Number of items of the sort by digit, then by block.
    DigitCounts = buffer("digit_counts", Owner::Clustering)
        .storage("uint digit_counts[]")
        .sized(|s| bytes::<u32>(s.digit_counts()));
    /// `light_volumes` in the order of the hierarchy.
    TreeVolumes = buffer("tree_volumes", Owner::Clustering)
        .storage("LightVolume tree_volumes[]")
        .texels("tree_volume", Element::Struct(LightVolume::INFO))
        .sized(|s| bytes::<LightVolume>(s.tree_lights()));
    /// The candidate of each of `tree_volumes`, by its number.
    TreeLights = buffer("tree_lights", Owner::Clustering)
        .storage("uint tree_lights[]")
        .sized(|s| bytes::<u32>(s.tree_lights()));
    /// The nodes of the hierarchy.
    LightNodes = buffer("light_nodes", Owner::Clustering)
        .storage("LightNode light_nodes[]")
        .texels("node", Element::Struct(LightNode::INFO))
        .sized(|s| bytes::<LightNode>(s.nodes()));
    /// Scatter's groups of visible clusters.
    Groups = buffer("groups", Owner::Clustering)
        .storage("ClusterGroup groups[]")
        .sized(|s| bytes::<ClusterGroup>(s.groups()));
    /// The group of each packet of lights.
    PacketGroups = buffer("packet_groups", Owner::Clustering)
        .storage("uint packet_groups[]")
        .sized(|s| bytes::<u32>(s.group_packets()));
    /// The candidates of each group, in whole packets.
    GroupLights = buffer("group_lights", Owner::Clustering)
        .storage("uint group_lights[]")
        .sized(|s| bytes::<u32>(s.group_lights()));
    /// Blocks that hold visible clusters, a bit each.
    BlockBits = buffer("block_bits", Owner::Clustering)
        .storage("uint block_bits[]")
        .texels("block", Element::Word)
        .sized(|s| bytes::<u32>(s.for_culled_lights(BLOCK_WORDS.into())));
    /// Lights that may meet a visible cluster, a bit each; behind them, how many each block of lights has.
    LightBits = buffer("light_bits", Owner::Clustering)
        .storage("uint light_bits[]")
        .sized(|s| bytes::<u32>(s.culled_light_words()));
    /// Lights that may meet a visible cluster, ascending.
    Candidates = buffer("candidates", Owner::Clustering)
        .storage("Candidate candidates[]")
        .texels("candidate", Element::Struct(Candidate::INFO))
        .sized(|s| bytes::<Candidate>(s.for_culled_lights(s.lights.into())));
    /// Lights of the frame, world space.
    Lights = buffer("lights", Owner::Engine)
        .texels("light", Element::Struct(LightData::INFO))
        .sized(|s| bytes::<LightData>(s.lights.into()))
        .serving(Purpose::Lights);
    /// Cones of the lights of the frame, where some have one.
    Spots = buffer("spots", Owner::Engine)
        .texels("spot", Element::Struct(SpotData::INFO))
        .sized(|s| bytes::<SpotData>(s.cones()))
        .serving(Purpose::Lights);
    /// What takes the template of the mesh around each light to world space, where meshes are rasterised.
    MeshFrames = buffer("mesh_frames", Owner::Engine)
        .storage("MeshFrame mesh_frames[]")
        .sized(|s| bytes::<MeshFrame>(s.meshes()))
        .serving(Purpose::Lights);
    /// Vertices of the templates of meshes: of points, then of spots.
    MeshVertices = buffer("mesh_vertices", Owner::Scene).storage("vec4 mesh_vertices[]");
    /// Triangles of the templates of meshes, three numbers of vertices of 10 bits each: of points, then of spots.
    MeshTriangles = buffer("mesh_triangles", Owner::Scene).storage("uint mesh_triangles[]");
    /// What takes templates to clustering space, grown by what covers rounding.
    LightFrames = buffer("light_frames", Owner::Clustering)
        .storage("MeshFrame light_frames[]")
        .sized(|s| bytes::<MeshFrame>(s.meshes()));
    /// The slices of each tile in which the mesh around each light lies: the first, and in the upper half how many lie behind the last.
    ShellRanges = buffer("shell_ranges", Owner::Clustering)
        .storage("uint shell_ranges[]")
        .sized(|s| bytes::<u32>(s.shell_tiles()));
    /// The slices of those tiles as layers of images had them, two tiles a word: 8 bits of the first slice, and 8 of how many lie behind
    /// the last.
    ShellTexels = buffer("shell_texels", Owner::Clustering)
        .storage("uint shell_texels[]")
        .sized(|s| bytes::<[u8; 2]>(s.shell_texels()));
    /// Boxes around the scene's models, in drawing order.
    ModelBoxes = buffer("model_boxes", Owner::Scene).storage("ModelBox model_boxes[]");
    /// What is drawn of the scene where the device culls.
    Drawables = buffer("drawables", Owner::Scene).storage("DrawCommand drawables[]");
    /// How many drawables there are, and the order of the transparent ones.
    DrawOrder = buffer("draw_order", Owner::Frame).storage("DrawCounts draw_counts; uint draw_order[]");
    /// What stage `cull` lets through of the drawables: a part for each view, and one for all at once.
    DrawCommands = buffer("draw_commands", Owner::Session).storage("DrawCommand draw_commands[]");
    /// The instances that those draw.
    DrawnInstances = buffer("drawn_instances", Owner::Session).storage("uint drawn_instances[]");
    /// Where an octree over the lights lies, and its tables.
    Octree = buffer("octree", Owner::ClusteringFrame)
        .uniform("OctreeData octree")
        .sized(|s| bytes::<OctreeData>(s.has_octree.into()))
        .serving(Purpose::Grouping);
    /// Branches of an octree: of each child x + 2 y + 4 z, in bit 0 and up whether it is a leaf, in bit 8 and up whether it is
    /// filled.
    OctreeNodes = buffer("octree_nodes", Owner::Clustering)
        .texels("octree_node", Element::Half)
        .sized(|s| OctreeSizes::NODE_BYTES * u64::from(s.capacities.octree.nodes))
        .serving(Purpose::Grouping);
    /// Offsets of the hashes of an octree, x, y, z.
    OctreeOffsets = buffer("octree_offsets", Owner::Clustering)
        .texels("octree_offset", Element::Bytes)
        .sized(|s| OctreeSizes::OFFSET_BYTES * u64::from(s.capacities.octree.offsets))
        .serving(Purpose::Grouping);
    /// Filled leaves of an octree: where the list of each begins, and its length.
    OctreeLeaves = buffer("octree_leaves", Owner::Clustering)
        .texels("octree_leaf", Element::Pair)
        .sized(|s| OctreeSizes::LEAF_BYTES * u64::from(s.capacities.octree.leaves))
        .serving(Purpose::Lists);
    /// The lights of the leaves of an octree.
    OctreeIndices = buffer("octree_indices", Owner::Clustering)
        .texels("octree_index", Element::Word)
        .sized(|s| OctreeSizes::INDEX_BYTES * u64::from(s.capacities.octree.indices))
        .serving(Purpose::Lists);
}

impl BufferName {
    /// All that is declared of the buffer.
    pub fn info(self) -> &'static BufferInfo {
        &BUFFERS[self as usize]
    }

    /// The binding of one way to read it; not every binding is taken.
    pub fn binding(self, view: BufferView) -> u32 {
        BufferView::COUNT * self as u32 + view as u32
    }

    /// What a binding stands for.
    pub fn bound_at(binding: u32) -> Option<(Self, BufferView)> {
        let name = Self::ALL.get((binding / BufferView::COUNT) as usize)?;
        Some((*name, BufferView::ALL[(binding % BufferView::COUNT) as usize]))
    }
}

/// Declarations of all buffers, and functions that read what is viewed as texels, in GLSL.
pub fn glsl() -> String {
    BufferName::ALL.into_iter().map(BufferName::glsl).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_binding_says_whose_it_is() {
        for name in BufferName::ALL {
            for view in BufferView::ALL {
                assert_eq!(BufferName::bound_at(name.binding(view)), Some((name, view)));
            }
        }
        assert_eq!(BufferName::bound_at(BufferView::COUNT * BUFFER_COUNT as u32), None);
    }

    #[test]
    fn names_differ_and_whoever_makes_a_clusterings_buffer_knows_its_size() {
        let mut names: Vec<_> = BufferName::ALL.iter().map(|name| name.info().name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), BUFFER_COUNT);
        for name in BufferName::ALL {
            let owned = matches!(name.info().owner, Owner::Clustering | Owner::ClusteringFrame);
            assert!(!owned || name.info().size.is_some(), "{name:?}");
        }
    }

    #[test]
    fn a_struct_that_is_read_as_texels_has_a_function_that_reads_it() {
        let text = glsl();
        assert!(text.contains("LightData read_light(uint index)"), "{text}");
        assert!(text.contains("uniform utextureBuffer candidate_texels;"), "{text}");
        assert!(text.contains("readonly buffer InstancesBuffer { InstanceData instances[]; };"), "{text}");
    }
}
