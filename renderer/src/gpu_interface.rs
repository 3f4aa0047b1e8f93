//! What host and shaders share but buffers (see [`crate::buffers`]): structs and constants, each declared once here and
//! generated into `generated/gpu_interface.glsl`, which every shader includes.

mod structs;

pub use structs::{
    Candidate, ClusterBox, ClusterGroup, ClusteringState, DispatchSize, DrawCommand, DrawCounts, GridData,
    HashData, InstanceData, LightData, LightNode, LightRectangle, LightVolume, MaterialData, MeshFrame,
    ModelBox, OctreeData, OctreeLayer, PixelData, Push, SpotData, ViewData,
};

use crate::geometry::VolumeKind;
use crate::gpu_types::StructInfo;
use crate::lights::Attenuation;
use crate::measure::DeviceCounts;
use crate::scene::TextureSlot;
use std::fmt::Write as _;

/// Descriptor set of a pipeline's buffers, as storage, texels or uniforms.
pub const SET_BUFFERS: u32 = 0;
/// Descriptor set of a material: its five textures and its [`MaterialData`].
pub const SET_MATERIAL: u32 = 1;
/// Descriptor set of a view's targets: its depth image, and behind it its colour targets, of which shaders sample some.
pub const SET_TARGETS: u32 = 2;
/// Rendering cameras of a frame, at most: a uniform buffer of 16 KiB, which every device binds, holds them.
pub const MAX_VIEWS: u32 = 32;
/// Threads of a workgroup of the prefix sum.
pub const SCAN_WORKGROUP: u32 = 256;
/// Items that a workgroup of the prefix sum takes.
pub const SCAN_BLOCK: u32 = 1024;
/// Threads of a workgroup of the assignment passes; visible clusters of a group, lights of a packet.
pub const ASSIGN_WORKGROUP: u32 = 64;
/// Lights that a workgroup of their culling takes: a word of bits a thread.
pub const LIGHT_BLOCK: u32 = 32 * ASSIGN_WORKGROUP;
/// Threads of a workgroup that measures the depths of a tile.
pub const TILE_WORKGROUP: u32 = 64;
/// Threads of a workgroup of culling.
pub const CULL_WORKGROUP: u32 = 64;
/// Packets of lights along x of a dispatch; more go along y.
pub const PACKET_ROW: u32 = 1 << 15;
/// Tiles that a workgroup takes of those of a light's mesh, at most.
pub const MESH_TILES: u32 = 32 * ASSIGN_WORKGROUP;
/// Lists along x of a dispatch with a workgroup a list; more go along y.
pub const LIST_ROW: u32 = 1 << 15;
/// Blocks of clusters along x and y, at most; along z there are up to 32, a bit each.
pub const BLOCK_COLUMNS: u32 = 16;
/// Words of all columns of blocks, with the coarser ones behind them, two by two joined, down to one. Behind these lie the
/// highest and the lowest visible cell.
const BLOCK_EXTREMES: u32 = (4 * BLOCK_COLUMNS * BLOCK_COLUMNS - 1) / 3;
/// Words of all blocks of clusters, with the highest and the lowest visible cell.
pub const BLOCK_WORDS: u32 = BLOCK_EXTREMES + 6;
/// Groups of clusters that one thread takes a candidate to.
pub const GROUP_CHUNK: u32 = 16;
/// Slices of a grid whose tiles are sorted, at most.
pub const SORT_TILE_SLICES: u32 = 2048;
/// Threads of a cluster, among which the hierarchy's subtrees are dealt out.
pub const TREE_SPLIT: u32 = 8;
/// Index of the dispatch size with a thread a list.
pub const DISPATCH_LISTS: u32 = 0;
/// Index of the dispatch size with a thread a list where light bits fit, else nothing.
pub const DISPATCH_MASKED: u32 = 1;
/// Index of the dispatch size with a workgroup a list where light bits do not fit, else nothing.
pub const DISPATCH_UNMASKED: u32 = 2;
/// Index of the dispatch size that finds who meets whom.
pub const DISPATCH_MEET: u32 = 3;
/// Index of the dispatch size that finds once more who meets whom where light bits do not fit, else nothing.
pub const DISPATCH_MEET_AGAIN: u32 = 4;
/// Index of the dispatch size of the prefix sum over list lengths.
pub const DISPATCH_SCAN: u32 = 5;
/// Index of the dispatch size that takes candidates to groups.
pub const DISPATCH_GROUPS: u32 = 6;
/// Index of the dispatch size of the sort.
pub const DISPATCH_SORT: u32 = 7;
/// Index of the dispatch size of the prefix sums of the sort.
pub const DISPATCH_SORT_SCAN: u32 = 8;
/// Index of the first of the dispatch sizes of the light hierarchy's depths.
pub const DISPATCH_NODES: u32 = 9;
/// How many sizes of indirect dispatches there are.
pub const DISPATCH_COUNT: u32 = DISPATCH_NODES + MAX_TREE_DEPTH;
/// Children of a node of the light hierarchy, a power of two.
pub const TREE_WIDTH: u32 = 8;
/// A hierarchy this deep holds more lights than 32 bits count.
pub const MAX_TREE_DEPTH: u32 = 11;
/// Bits of a key that one pass of the sort orders by.
pub const SORT_BITS: u32 = 7;
/// How many values the digit of a key has that one pass of the sort orders by.
pub const SORT_DIGITS: u32 = 1 << SORT_BITS;
/// Items that one thread of the sort takes.
pub const SORT_BLOCK: u32 = 128;

/// Most layers of an octree.
pub const OCTREE_LAYERS: u32 = 24;

/// Words that the self-test measures into.
pub const MEASUREMENT_WORDS: u64 = 4096;

/// How many 64-bit counters the atemporal run has: as many as [`DeviceCounts`] has fields.
pub const COUNTER_COUNT: usize = DeviceCounts::NAMES.len();

const CONSTANTS: [(&str, u32); 34] = [
    ("SET_BUFFERS", SET_BUFFERS),
    ("SET_MATERIAL", SET_MATERIAL),
    ("SET_TARGETS", SET_TARGETS),
    ("MAX_VIEWS", MAX_VIEWS),
    ("SCAN_WORKGROUP", SCAN_WORKGROUP),
    ("SCAN_BLOCK", SCAN_BLOCK),
    ("ASSIGN_WORKGROUP", ASSIGN_WORKGROUP),
    ("MESH_TILES", MESH_TILES),
    ("LIGHT_BLOCK", LIGHT_BLOCK),
    ("TILE_WORKGROUP", TILE_WORKGROUP),
    ("PACKET_ROW", PACKET_ROW),
    ("LIST_ROW", LIST_ROW),
    ("BLOCK_COLUMNS", BLOCK_COLUMNS),
    ("BLOCK_EXTREMES", BLOCK_EXTREMES),
    ("GROUP_CHUNK", GROUP_CHUNK),
    ("SORT_TILE_SLICES", SORT_TILE_SLICES),
    ("TREE_SPLIT", TREE_SPLIT),
    ("DISPATCH_LISTS", DISPATCH_LISTS),
    ("DISPATCH_MASKED", DISPATCH_MASKED),
    ("DISPATCH_UNMASKED", DISPATCH_UNMASKED),
    ("DISPATCH_MEET", DISPATCH_MEET),
    ("DISPATCH_MEET_AGAIN", DISPATCH_MEET_AGAIN),
    ("CULL_WORKGROUP", CULL_WORKGROUP),
    ("DISPATCH_SCAN", DISPATCH_SCAN),
    ("DISPATCH_GROUPS", DISPATCH_GROUPS),
    ("DISPATCH_SORT", DISPATCH_SORT),
    ("DISPATCH_SORT_SCAN", DISPATCH_SORT_SCAN),
    ("DISPATCH_NODES", DISPATCH_NODES),
    ("TREE_WIDTH", TREE_WIDTH),
    ("MAX_TREE_DEPTH", MAX_TREE_DEPTH),
    ("SORT_BITS", SORT_BITS),
    ("SORT_DIGITS", SORT_DIGITS),
    ("SORT_BLOCK", SORT_BLOCK),
    ("OCTREE_LAYERS", OCTREE_LAYERS),
];

/// Textures of a material, by the names that shaders call them.
const TEXTURE_SLOTS: [(&str, TextureSlot); 5] = [
    ("BASE_COLOR", TextureSlot::BaseColor),
    ("METALLIC_ROUGHNESS", TextureSlot::MetallicRoughness),
    ("NORMAL", TextureSlot::Normal),
    ("OCCLUSION", TextureSlot::Occlusion),
    ("EMISSIVE", TextureSlot::Emissive),
];

/// Every shared struct; one comes after those it contains.
const STRUCTS: [StructInfo; 23] = [
    ViewData::INFO,
    GridData::INFO,
    HashData::INFO,
    OctreeLayer::INFO,
    OctreeData::INFO,
    ClusterBox::INFO,
    LightNode::INFO,
    LightVolume::INFO,
    MeshFrame::INFO,
    LightRectangle::INFO,
    LightData::INFO,
    SpotData::INFO,
    MaterialData::INFO,
    InstanceData::INFO,
    ModelBox::INFO,
    DrawCommand::INFO,
    DrawCounts::INFO,
    ClusteringState::INFO,
    DispatchSize::INFO,
    PixelData::INFO,
    ClusterGroup::INFO,
    Candidate::INFO,
    Push::INFO,
];

/// Names of what shader variants choose among; the value is the position.
const VARIANT_NAMES: [&[&str]; 13] = [
    &["SPACE_PERSPECTIVE", "SPACE_ORTHOGRAPHIC", "SPACE_MODEL"],
    &["SCAN_VISIBILITY", "SCAN_LIST_LENGTHS", "SCAN_DIGITS", "SCAN_GROUPS", "SCAN_TILES"],
    &[
        "ASSIGN_BRUTE",
        "ASSIGN_HIERARCHY",
        "ASSIGN_SCATTER",
        "ASSIGN_RECTANGLES",
        "ASSIGN_RASTER",
        "ASSIGN_RASTER_COUNT",
    ],
    &["CLUSTERS_VISIBLE", "CLUSTERS_ALL"],
    &[
        "SLICES_GEOMETRIC",
        "SLICES_GEOMETRIC_BIASED",
        "SLICES_SECOND_PLANE",
        "SLICES_LINEAR",
        "SLICES_UNIFORM_NDC",
        "SLICES_UNIFORM_VIEW",
    ],
    &["LISTS_OFFSETS", "LISTS_FIXED", "LISTS_CAPPED", "LISTS_LINKED"],
    &["COMPACTION_RANKS", "COMPACTION_ATOMIC", "COMPACTION_SORT"],
    &["CULLING_CPU", "CULLING_GPU"],
    &["BOUNDS_CELL", "BOUNDS_DEPTH", "BOUNDS_BOX"],
    &["CONES_UNASKED", "CONES_SEPARATING", "CONES_EXACT"],
    &["MESH_SPHERE", "MESH_SPOT"],
    &["VISIT_MARK", "VISIT_COUNT", "VISIT_BOUNDS"],
    &["MATERIAL_TEXTURED", "MATERIAL_WHITE"],
];

/// The part of the include that declares all of this to shaders.
pub fn glsl() -> String {
    let mut text = String::from(
        "#pragma once\n#extension GL_EXT_scalar_block_layout : require\n#extension GL_EXT_samplerless_texture_functions : require\n",
    );
    for (name, value) in CONSTANTS {
        let _ = writeln!(text, "#define {name} {value}");
    }
    for (name, slot) in TEXTURE_SLOTS {
        let _ = writeln!(text, "#define {name} {}", slot as u32);
    }
    for names in VARIANT_NAMES {
        for (value, name) in names.iter().enumerate() {
            let _ = writeln!(text, "#define {name} {value}");
        }
    }
    for (place, name) in DeviceCounts::NAMES.iter().enumerate() {
        let _ = writeln!(text, "const uint COUNTER_{} = {place};", name.to_uppercase());
    }
    for attenuation in Attenuation::ALL {
        let name = attenuation.to_string().to_uppercase();
        let _ = writeln!(text, "const uint ATTENUATION_{name} = {};", attenuation as u32);
    }
    for kind in VolumeKind::ALL {
        let _ = writeln!(text, "const uint VOLUME_{} = {};", kind.name().to_uppercase(), kind as u32);
    }
    for structure in STRUCTS {
        text.push_str(&structure.glsl());
        text.push('\n');
    }
    text.push_str("layout(push_constant, scalar) uniform PushConstants { Push push; };\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn structs_have_the_offsets_that_shaders_see() {
        crate::gpu_types::tests::assert_layouts(&STRUCTS);
    }
}
