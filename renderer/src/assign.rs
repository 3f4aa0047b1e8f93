//! Ways of marking clusters and of light assignment, and the sizes of what the accelerated ones work with: pure, for
//! host and tests.
//!
//! All ways give the same lists. Brute force tests every visible cluster against every light. The others first drop the
//! lights whose cells hold nothing visible; what is left, the candidates, the hierarchy puts into a tree, built anew each
//! frame, down which each visible cluster goes, and scatter hands out to groups of visible clusters. Rectangles hand each light to
//! the clusters of the tiles in which it is seen. Meshes, which methods of their own rasterise, give lists of their own: of the clusters
//! that the mesh around each light meets.

mod conservative;
mod mesh_detail;
mod sorted_tiles;
mod store;

pub use conservative::{Conservative, check_layered_slices};
pub use mesh_detail::MeshDetail;
pub use sorted_tiles::{check_sorted_slices, check_sorted_tiles, sorted_keys, sorted_threads};
pub use store::{Compaction, Links, ListStore, MOST_CAPPED, MOST_FIXED, NODES_PER_CLUSTER, NodeLayout};

use crate::geometry::SphereTest;
use crate::gpu_interface::{ASSIGN_WORKGROUP, BLOCK_COLUMNS, LIGHT_BLOCK, SORT_BITS, TREE_WIDTH};
use crate::methods::Method;
use crate::nearest;
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Where the visible clusters of opaque and masked geometry are marked from (Gelderen section 5.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Marking {
    /// From the depth buffer, per sample; with MSAA, shading runs per sample too.
    Depth,
    /// From a second geometry pass with early depth tests, per fragment.
    Geometry,
}

/// Which clusters get light lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Clusters {
    /// Those that hold a fragment, which marking finds: sparse.
    Visible,
    /// Every cluster of the grid: dense. Nothing is marked.
    All,
}

impl fmt::Display for Clusters {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Visible => "visible",
            Self::All => "all",
        })
    }
}

impl FromStr for Clusters {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "choice of clusters")
    }
}

/// What of a cluster is tested against lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Bounds {
    /// Its cell of the grid.
    Implicit,
    /// What its samples take of the cell: explicit bounds (Enhuber section 3.2). A cluster without samples meets nothing.
    Measured,
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Implicit => "implicit",
            Self::Measured => "measured",
        })
    }
}

impl FromStr for Bounds {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "choice of bounds")
    }
}

/// What is kept of a cluster to be tested against lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClusterBounds {
    /// Nothing: the cell is tested.
    Cell,
    /// The depths of its samples: of tiles, whose sides the cell tells.
    Depth,
    /// The box of its samples.
    Box,
}

impl ClusterBounds {
    /// Words that are kept of a visible cluster.
    pub fn words(self) -> u64 {
        match self {
            Self::Cell => 0,
            Self::Depth => 2,
            Self::Box => 6,
        }
    }
}

/// How the light lists are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Assigner {
    /// Every visible cluster against every light: the reference.
    Brute,
    /// Every visible cluster down a tree of lights.
    Hierarchy,
    /// Every light to the groups of visible clusters near it.
    Scatter,
    /// Every light to the visible clusters in the rectangle of tiles in which it is seen, and between its depths (Tegelaers).
    Rectangles,
    /// Every light to the visible clusters that the mesh around it meets, tile by tile (Örtegren and Persson).
    Raster,
    /// The same, the mesh of one light at a time, without keeping where meshes lie.
    RasterCount,
}

impl Assigner {
    /// Whether lists are made of candidates: of the lights that may meet a visible cluster.
    pub fn culls_lights(self) -> bool {
        match self {
            Self::Hierarchy | Self::Scatter => true,
            Self::Brute | Self::Rectangles | Self::Raster | Self::RasterCount => false,
        }
    }

    /// Whether lights are handed to the clusters that the meshes around them meet, and not tested.
    pub fn rasterises(self) -> bool {
        matches!(self, Self::Raster | Self::RasterCount)
    }

    /// Whether it finds who meets whom by this test. A rectangle of tiles holds no lights but those that are seen in it.
    pub fn serves(self, test: SphereTest) -> bool {
        self != Self::Rectangles || test == SphereTest::Projected
    }
}

impl fmt::Display for Assigner {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Brute => "brute",
            Self::Hierarchy => "hierarchy",
            Self::Scatter => "scatter",
            Self::Rectangles => "rectangles",
            Self::Raster => "raster",
            Self::RasterCount => "raster-count",
        })
    }
}

/// What decides which way is cheapest: counts of one clustering in one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssignCounts {
    /// Number of lights.
    pub lights: u32,
    /// Clusters to build lists for.
    pub visible_clusters: u32,
    /// Lengths of all lists together.
    pub light_indices: u32,
    /// Packets of lights that scatter tests against a group of clusters each.
    pub packets: u32,
}

// Costs in tests of brute force, which takes about 0.8 ns a test on two cores of lavapipe, where `bench assign` measured
// them.

/// Cost of culling a light.
const COST_CULL_LIGHT: f64 = 12.0;
/// Cost of the dispatches of scatter that follow culling.
const COST_SCATTER: f64 = 1.2e6;
/// Cost of a packet of scatter, with the candidates that it takes to find it and the bits that it leaves: five times its tests.
const COST_PACKET: f64 = 5.0 * (ASSIGN_WORKGROUP * ASSIGN_WORKGROUP) as f64;
/// Cost of the dispatches that build the hierarchy.
const COST_HIERARCHY: f64 = 4e6;
/// Cost of a test by the hierarchy, whose threads each read nodes of their own.
const COST_NODE: f64 = 60.0;
/// Tests of the hierarchy for each light that it finds.
const NODES_FOUND: f64 = 7.0;
/// Tests of the hierarchy for each cluster on the way down.
const NODES_DESCENT: f64 = 90.0;

impl AssignCounts {
    fn cost(&self, assigner: Assigner) -> f64 {
        let [lights, visible, indices, packets] =
            [self.lights, self.visible_clusters, self.light_indices, self.packets].map(f64::from);
        match assigner {
            Assigner::Brute => lights * visible,
            Assigner::Scatter => COST_SCATTER + COST_CULL_LIGHT * lights + COST_PACKET * packets,
            Assigner::Hierarchy => {
                let nodes = NODES_FOUND * indices + NODES_DESCENT * visible;
                COST_HIERARCHY + COST_CULL_LIGHT * lights + COST_NODE * nodes
            }
            // They serve one test alone, or methods of their own, and are not chosen.
            Assigner::Rectangles | Assigner::Raster | Assigner::RasterCount => f64::INFINITY,
        }
    }
}

/// The way that a simple model of the work finds cheapest for the clusterings of a frame: the same for the same counts.
pub fn cheapest(clusterings: &[AssignCounts]) -> Assigner {
    let cost = |assigner| clusterings.iter().map(|counts| counts.cost(assigner)).sum::<f64>();
    let ways = [Assigner::Brute, Assigner::Scatter, Assigner::Hierarchy];
    ways.into_iter().min_by(|&a, &b| cost(a).total_cmp(&cost(b))).unwrap_or(Assigner::Brute)
}

/// Lights that brute force takes to lists in one pass, at most: each packet of 64 is a turn of a loop and up to 32 more, for two
/// lights each, and lavapipe ends a shader's loops after 65 535 turns of all of them.
const MOST_IN_ONE_PASS: u32 = 120_000;

/// Why brute force cannot take so many lights to lists that are kept so.
///
/// # Errors
/// Says how many it could.
pub fn check_one_pass(lists: ListStore, lights: u32) -> Result<(), String> {
    if lists.has_offsets() || lights <= MOST_IN_ONE_PASS {
        return Ok(());
    }
    Err(format!(
        "lists: brute force takes up to {MOST_IN_ONE_PASS} lights to {lists} in its one pass, and there are {lights}: use \
         --assign scatter, or --lists offsets"
    ))
}

/// Why a method cannot link its lists, or link so many lights.
///
/// # Errors
/// Says what can.
pub fn check_links(lists: ListStore, method: &Method, lights: u32) -> Result<(), String> {
    let Some(Links { node, .. }) = lists.links() else { return Ok(()) };
    if !method.is_rasterised() {
        return Err(format!(
            "lists: {lists} are of nodes that methods link which rasterise meshes, and {method} tests lights: use a method such as \
             raster-24-12-32-e, or --lists offsets, or exclude the run"
        ));
    }
    let most = node.most_lights();
    if lights > most {
        return Err(format!(
            "lists: {lists} serve up to {most} lights, and there are {lights}: use --lists offsets"
        ));
    }
    Ok(())
}

/// Bits of lists take at most this many words.
const MAX_MASK_WORDS: u64 = 16 << 20;

/// Words of bits for the lists of `visible` clusters, a bit per light, as far as they are kept at all.
pub fn mask_capacity(lights: u32, visible: u32) -> u64 {
    let packets = u64::from(lights.div_ceil(ASSIGN_WORKGROUP));
    let words_per_packet = u64::from(ASSIGN_WORKGROUP / 32);
    (u64::from(visible) * packets * words_per_packet).min(MAX_MASK_WORDS)
}

/// Lights of groups are listed as far as they take no more entries than this, or four a light.
const MIN_GROUP_CAPACITY: u64 = 1 << 20;

/// Entries for the lights of `groups` groups of visible clusters, each group's list filled up to whole packets.
pub fn group_capacity(lights: u32, groups: u64) -> u64 {
    let packet = u64::from(ASSIGN_WORKGROUP);
    let most = groups * u64::from(lights).next_multiple_of(packet);
    most.min((4 * u64::from(lights)).max(MIN_GROUP_CAPACITY)).next_multiple_of(packet)
}

/// Workgroups that cull lights: one even where there are none, which says so.
pub fn light_blocks(lights: u32) -> u32 {
    lights.div_ceil(LIGHT_BLOCK).max(1)
}

/// Clusters of a block, along each axis: a block's column has a word, and a block along z a bit.
pub fn block_size(dimensions: [u32; 3]) -> [u32; 3] {
    let most = [BLOCK_COLUMNS, BLOCK_COLUMNS, u32::BITS];
    std::array::from_fn(|axis| dimensions[axis].div_ceil(most[axis]))
}

/// Depth of a light hierarchy at which its places are the lights: at least 2, for the root itself is never made.
pub fn tree_depth(lights: u32) -> u32 {
    (2..).find(|&depth| u64::from(TREE_WIDTH).pow(depth) >= u64::from(lights)).unwrap_or(2)
}

/// Nodes of a light hierarchy: all depths above the lights, one behind the other.
pub fn tree_nodes(lights: u32) -> u64 {
    let width = u64::from(TREE_WIDTH);
    let above: u64 = (0..tree_depth(lights) - 1).map(|depth| width.pow(depth)).sum();
    above + u64::from(lights).div_ceil(width)
}

/// Bits of a Morton code.
const MORTON_BITS: u32 = 30;
/// Bits of a key beyond those that number the lights: so that few lights share a key.
const SPARE_KEY_BITS: u32 = 4;

/// Passes of the sort: enough bits of the Morton codes to tell most lights apart, and no more.
pub fn sort_passes(lights: u32) -> u32 {
    let bits = lights.max(2).ilog2() + 1 + SPARE_KEY_BITS;
    bits.div_ceil(SORT_BITS).min(MORTON_BITS / SORT_BITS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu_interface::MAX_TREE_DEPTH;

    #[test]
    fn lists_are_linked_where_meshes_are_rasterised_and_nodes_hold_the_lights() {
        let [tests, rasterises] = ["indi-persp-64", "raster-24-12-32-e"].map(|name| name.parse().unwrap());
        let check = |lists: &str, method, lights| check_links(lists.parse().unwrap(), method, lights);
        assert_eq!(check("offsets", &tests, u32::MAX), Ok(()));
        assert!(check("linked-64", &tests, 1).unwrap_err().contains("indi-persp-64 tests lights"));
        for (lists, most) in [("linked-64", 16_384), ("linked-32-unsorted", 4096)] {
            assert_eq!(check(lists, &rasterises, most), Ok(()));
            assert!(
                check(lists, &rasterises, most + 1).unwrap_err().contains(&format!("up to {most} lights"))
            );
        }
    }

    const COUNTS: [u32; 10] = [0, 1, 7, 8, 64, 65, 4096, 100_000, 1 << 20, u32::MAX];

    #[test]
    fn trees_hold_their_lights_and_no_more_depths_than_needed() {
        for lights in COUNTS {
            let depth = tree_depth(lights);
            assert!((2..=MAX_TREE_DEPTH).contains(&depth));
            assert!(u64::from(TREE_WIDTH).pow(depth) >= u64::from(lights));
            assert!(depth == 2 || u64::from(TREE_WIDTH).pow(depth - 1) < u64::from(lights));
            let parents = u64::from(lights).div_ceil(u64::from(TREE_WIDTH));
            assert!(
                (parents..parents + parents / 2 + 16).contains(&tree_nodes(lights).min(parents * 3 / 2 + 15))
            );
        }
    }

    #[test]
    fn keys_are_long_enough_and_fit_a_morton_code() {
        for lights in COUNTS {
            let bits = SORT_BITS * sort_passes(lights);
            assert!(bits <= MORTON_BITS && (bits >= 28 || 1u64 << bits >= u64::from(lights)));
        }
    }

    #[test]
    fn bits_cover_all_lights_within_their_bounds() {
        for (lights, visible) in [(0, 10), (1, 1), (1000, 1 << 14), (16_384, 1 << 20), (100_000, 100)] {
            let words = mask_capacity(lights, visible);
            assert!(words <= MAX_MASK_WORDS);
            assert!(words == MAX_MASK_WORDS || 32 * words >= u64::from(lights) * u64::from(visible));
        }
    }

    #[test]
    fn lights_of_groups_fill_whole_packets() {
        for (lights, groups) in [(1, 1), (65, 3), (1000, 256), (1_000_000, 256), (5, 0)] {
            let entries = group_capacity(lights, groups);
            assert_eq!(entries % u64::from(ASSIGN_WORKGROUP), 0);
            assert!(entries >= u64::from(lights) || groups == 0);
        }
    }

    #[test]
    fn blocks_cover_the_grid() {
        for dimensions in [[1, 1, 1], [16, 17, 33], [200, 113, 100], [65_536, 1, 2048]] {
            let size = block_size(dimensions);
            for (axis, most) in [BLOCK_COLUMNS, BLOCK_COLUMNS, 32].into_iter().enumerate() {
                assert!(size[axis] >= 1 && (dimensions[axis] - 1) / size[axis] < most);
            }
        }
    }

    #[test]
    fn rectangles_serve_their_own_test_alone() {
        for test in [SphereTest::HALF_SPACES, SphereTest::Exact, SphereTest::Box] {
            assert!(!Assigner::Rectangles.serves(test) && Assigner::Brute.serves(test));
        }
        assert!(Assigner::Rectangles.serves(SphereTest::Projected));
    }

    #[test]
    fn few_lights_are_assigned_by_brute_force_and_many_are_not() {
        let counts = |lights, light_indices, packets| {
            cheapest(&[AssignCounts { lights, visible_clusters: 850, light_indices, packets }])
        };
        assert_eq!(counts(1, 100, 1), Assigner::Brute);
        assert_eq!(counts(1000, 14_732, 44), Assigner::Brute);
        assert_eq!(counts(100_000, 1390, 14), Assigner::Scatter);
        assert_eq!(counts(100_000, 1390, 1_000_000), Assigner::Hierarchy);
        assert_eq!(cheapest(&[]), Assigner::Brute);
    }
}
