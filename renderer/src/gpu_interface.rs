//! What host and shaders share: structs, buffers, constants, each declared once here and generated into
//! `generated/gpu_interface.glsl`, which every shader includes.
//!
//! ```text
//! views ─┬─> cluster_bits ──scan──> word_ranks, visible_clusters ─┐
//! grid ──┘      (mark)                                            ├─> list_lengths ──scan──> list_offsets ───┐
//! lights ─────> light_spheres ────────────────────────────────────┘   (count_lights)                         │
//!               (transform_lights)             └──────────────────────────> light_indices (assign_lights) <──┘
//! ```
//!
//! World space, on the device, is relative to the frame's origin (see [`crate::origin`]). `slice_planes`, which the host
//! writes with `grid`, are the depths between the slices of a perspective grid, so that a fragment's slice and the planes
//! that lights are tested against are the same numbers, whatever a device makes of logarithms.
//!
//! Where the device culls, `views`, `instances`, `draw_slots` and `draw_order` go to `draw_commands` and
//! `drawn_instances` before all that (cull).
//!
//! All ways go to `list_lengths` by way of `light_masks` where these have room. Hierarchy and scatter first put the lights
//! that may meet a visible cluster into `candidates` (cull_lights: `block_bits`, `light_bits`); then the hierarchy makes
//! `sort_items`, `digit_counts`, `tree_spheres`, `tree_lights` and `light_nodes`, scatter `groups`, `tile_groups` and
//! `group_lights`.

mod structs;

pub use structs::{
    Candidate, ClusterGroup, ClusteringState, DispatchSize, DrawCommand, DrawCounts, GridData, InstanceData,
    LightData, LightNode, MaterialData, PixelData, ViewData,
};

use crate::lights::Attenuation;
use crate::measure::DeviceCounts;
use ash::vk;
use std::fmt::Write as _;

/// A storage buffer of descriptor set 0; the discriminant is its binding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
#[allow(missing_docs)] // each is described by its row of BUFFERS
pub enum Binding {
    LightSpheres,
    ClusterBits,
    WordRanks,
    VisibleClusters,
    BlockSums,
    ListLengths,
    ListOffsets,
    LightIndices,
    State,
    Dispatches,
    Counters,
    VisibleFragments,
    LightsPerFragment,
    Pixels,
    Instances,
    LightMasks,
    SortItems,
    DigitCounts,
    TreeSpheres,
    TreeLights,
    LightNodes,
    BlockBits,
    LightBits,
    Candidates,
    DrawSlots,
    DrawOrder,
    DrawCommands,
    DrawnInstances,
    SlicePlanes,
}

/// Every buffer as (binding, access, GLSL member).
pub const BUFFERS: [(Binding, &str, &str); 29] = [
    (Binding::LightSpheres, "", "vec4 light_spheres[]"),
    (Binding::ClusterBits, "", "uint cluster_bits[]"),
    (Binding::WordRanks, "", "uint word_ranks[]"),
    (Binding::VisibleClusters, "", "uint visible_clusters[]"),
    (Binding::BlockSums, "", "uint block_sums[]"),
    (Binding::ListLengths, "", "uint list_lengths[]"),
    (Binding::ListOffsets, "", "uint list_offsets[]"),
    (Binding::LightIndices, "", "uint light_indices[]"),
    (Binding::State, "", "ClusteringState new_state"),
    (Binding::Dispatches, "", "DispatchSize dispatches[]"),
    (Binding::Counters, "", "uint counters[]"),
    (Binding::VisibleFragments, "", "uint visible_fragments[]"),
    (Binding::LightsPerFragment, "", "uint lights_per_fragment[]"),
    (Binding::Pixels, "", "PixelData pixels[]"),
    (Binding::Instances, "readonly", "InstanceData instances[]"),
    (Binding::LightMasks, "", "uint light_masks[]"),
    (Binding::SortItems, "", "uvec2 sort_items[]"),
    (Binding::DigitCounts, "", "uint digit_counts[]"),
    (Binding::TreeSpheres, "", "vec4 tree_spheres[]"),
    (Binding::TreeLights, "", "uint tree_lights[]"),
    (Binding::LightNodes, "", "LightNode light_nodes[]"),
    (Binding::BlockBits, "", "uint block_bits[]"),
    (Binding::LightBits, "", "uint light_bits[]"),
    (Binding::Candidates, "", "Candidate candidates[]"),
    (Binding::DrawSlots, "readonly", "DrawCommand draw_slots[]"),
    (Binding::DrawOrder, "readonly", "DrawCounts draw_counts; uint draw_order[]"),
    (Binding::DrawCommands, "", "DrawCommand draw_commands[]"),
    (Binding::DrawnInstances, "", "uint drawn_instances[]"),
    (Binding::SlicePlanes, "readonly", "float slice_planes[]"),
];

/// Views of buffers as arrays of texels, as (buffer, GLSL declaration, format); bound behind [`BUFFERS`].
///
/// What a loop reads with an index of each thread's own is read through these: llvmpipe fetches a texel for all lanes at
/// once, where it takes storage buffers lane by lane and word by word.
pub const TEXELS: [(&str, &str, vk::Format); 9] = [
    ("lights", "textureBuffer light_texels", FLOATS),
    ("instances", "textureBuffer instance_texels", FLOATS),
    ("light_spheres", "textureBuffer sphere_texels", FLOATS),
    ("light_indices", "utextureBuffer index_texels", WORD),
    ("light_masks", "utextureBuffer mask_texels", WORD),
    ("block_bits", "utextureBuffer block_texels", WORD),
    ("candidates", "utextureBuffer candidate_texels", WORDS),
    ("tree_spheres", "textureBuffer tree_texels", FLOATS),
    ("light_nodes", "textureBuffer node_texels", FLOATS),
];

const FLOATS: vk::Format = vk::Format::R32G32B32A32_SFLOAT;
const WORD: vk::Format = vk::Format::R32_UINT;
const WORDS: vk::Format = vk::Format::R32G32B32A32_UINT;

/// What all threads read alike, as GLSL members of uniform buffers; bound behind [`TEXELS`].
///
/// Of a uniform buffer llvmpipe reads a word once for all lanes, also where the flow of control has parted.
/// `state` is what earlier dispatches wrote to `new_state`.
pub const UNIFORMS: [&str; 3] = ["ViewData views[MAX_VIEWS]", "GridData grid", "ClusteringState state"];

/// What scatter keeps in buffers of the hierarchy, which never runs beside it: devices bind few buffers.
const ALIASES: [(Binding, &str); 3] = [
    (Binding::DigitCounts, "uint tile_groups[]"),
    (Binding::TreeLights, "uint group_lights[]"),
    (Binding::LightNodes, "ClusterGroup groups[]"),
];

/// Descriptor set of the storage buffers, of what views some of them as texels, and of the uniform buffers.
pub const SET_BUFFERS: u32 = 0;
/// Descriptor set of a material: its five textures and its [`MaterialData`].
pub const SET_MATERIAL: u32 = 1;
/// Descriptor set of a view's depth image.
pub const SET_DEPTH: u32 = 2;
/// Rendering cameras of a frame, at most: a uniform buffer of 16 KiB, which every device binds, holds them.
pub const MAX_VIEWS: u32 = 32;
/// Threads of a workgroup of the prefix sum.
pub const SCAN_GROUP: u32 = 256;
/// Items that such a workgroup takes.
pub const SCAN_BLOCK: u32 = 1024;
/// Threads of a workgroup of the assignment passes; visible clusters of a group, lights of a tile.
pub const ASSIGN_GROUP: u32 = 64;
/// Threads of a workgroup of culling.
pub const CULL_GROUP: u32 = 64;
/// Tiles along x of a dispatch; more go along y.
pub const TILE_ROW: u32 = 1 << 15;
/// The same of lists that have a workgroup each.
pub const LIST_ROW: u32 = 1 << 15;
/// Blocks of clusters along x and y, at most; along z there are up to 32, a bit each.
pub const BLOCK_COLUMNS: u32 = 16;
/// Words of all columns of blocks, with the coarser ones behind them, two by two joined, down to one. Behind these lie the
/// highest and the lowest visible cell.
const BLOCK_EXTREMES: u32 = (4 * BLOCK_COLUMNS * BLOCK_COLUMNS - 1) / 3;
/// All words of blocks.
pub const BLOCK_WORDS: u32 = BLOCK_EXTREMES + 6;
/// Groups that one thread takes a candidate to.
pub const GROUP_CHUNK: u32 = 16;
/// Threads of a cluster, among which the hierarchy's subtrees are dealt out.
pub const TREE_SPLIT: u32 = 8;
/// Slot of the dispatch size with a thread a list.
pub const DISPATCH_LISTS: u32 = 0;
/// The same where light bits fit, else nothing.
pub const DISPATCH_MASKED: u32 = 1;
/// Slot of the dispatch size with a workgroup a list where they do not fit, else nothing.
pub const DISPATCH_UNMASKED: u32 = 2;
/// Slot of the dispatch size that finds who meets whom.
pub const DISPATCH_MEET: u32 = 3;
/// The same once more where light bits do not fit, else nothing.
pub const DISPATCH_MEET_AGAIN: u32 = 4;
/// Slot of the dispatch size of the prefix sum over list lengths.
pub const DISPATCH_SCAN: u32 = 5;
/// Slot of the dispatch size that takes candidates to groups.
pub const DISPATCH_GROUPS: u32 = 6;
/// Slot of the dispatch size of the sort.
pub const DISPATCH_SORT: u32 = 7;
/// Slot of the dispatch size of its prefix sums.
pub const DISPATCH_SORT_SCAN: u32 = 8;
/// First slot of the dispatch sizes of the light hierarchy's depths.
pub const DISPATCH_NODES: u32 = 9;
/// How many slots there are.
pub const DISPATCH_COUNT: u32 = DISPATCH_NODES + MAX_TREE_DEPTH;
/// Children of a node of the light hierarchy, a power of two.
pub const TREE_WIDTH: u32 = 8;
/// A hierarchy this deep holds more lights than 32 bits count.
pub const MAX_TREE_DEPTH: u32 = 11;
/// Bits of a key that one pass of the sort orders by.
pub const SORT_BITS: u32 = 7;
/// Values of those bits.
pub const SORT_DIGITS: u32 = 1 << SORT_BITS;
/// Items that one thread of the sort takes.
pub const SORT_BLOCK: u32 = 128;

/// Bytes of a texel of four words.
const TEXEL_BYTES: u32 = 16;

/// How many 64-bit counters the atemporal run has: those of [`DeviceCounts`].
pub const COUNTER_COUNT: usize = DeviceCounts::NAMES.len();

const CONSTANTS: [(&str, u32); 31] = [
    ("SET_BUFFERS", SET_BUFFERS),
    ("SET_MATERIAL", SET_MATERIAL),
    ("SET_DEPTH", SET_DEPTH),
    ("MAX_VIEWS", MAX_VIEWS),
    ("SCAN_GROUP", SCAN_GROUP),
    ("SCAN_BLOCK", SCAN_BLOCK),
    ("ASSIGN_GROUP", ASSIGN_GROUP),
    ("TILE_ROW", TILE_ROW),
    ("LIST_ROW", LIST_ROW),
    ("BLOCK_COLUMNS", BLOCK_COLUMNS),
    ("BLOCK_EXTREMES", BLOCK_EXTREMES),
    ("GROUP_CHUNK", GROUP_CHUNK),
    ("TREE_SPLIT", TREE_SPLIT),
    ("DISPATCH_LISTS", DISPATCH_LISTS),
    ("DISPATCH_MASKED", DISPATCH_MASKED),
    ("DISPATCH_UNMASKED", DISPATCH_UNMASKED),
    ("DISPATCH_MEET", DISPATCH_MEET),
    ("DISPATCH_MEET_AGAIN", DISPATCH_MEET_AGAIN),
    ("CULL_GROUP", CULL_GROUP),
    ("DISPATCH_SCAN", DISPATCH_SCAN),
    ("DISPATCH_GROUPS", DISPATCH_GROUPS),
    ("DISPATCH_SORT", DISPATCH_SORT),
    ("DISPATCH_SORT_SCAN", DISPATCH_SORT_SCAN),
    ("DISPATCH_NODES", DISPATCH_NODES),
    ("TREE_WIDTH", TREE_WIDTH),
    ("SORT_BITS", SORT_BITS),
    ("SORT_DIGITS", SORT_DIGITS),
    ("SORT_BLOCK", SORT_BLOCK),
    ("LIGHT_TEXELS", size_of::<LightData>() as u32 / TEXEL_BYTES),
    ("INSTANCE_TEXELS", size_of::<InstanceData>() as u32 / TEXEL_BYTES),
    ("NODE_TEXELS", size_of::<LightNode>() as u32 / TEXEL_BYTES),
];

/// Names of what shader variants choose among; the value is the position.
const VARIANT_NAMES: [&[&str]; 5] = [
    &["SPACE_PERSPECTIVE", "SPACE_ORTHOGRAPHIC"],
    &["SCAN_VISIBILITY", "SCAN_LIST_LENGTHS", "SCAN_DIGITS", "SCAN_LIGHTS", "SCAN_GROUPS"],
    &["ASSIGN_BRUTE", "ASSIGN_HIERARCHY", "ASSIGN_SCATTER"],
    &["LOOKUP_ALL_LIGHTS", "LOOKUP_CLUSTERED"],
    &["CULLING_CPU", "CULLING_GPU"],
];

/// The include that declares all of this to shaders.
pub fn glsl() -> String {
    let mut text = String::from(
        "#pragma once\n#extension GL_EXT_scalar_block_layout : require\n#extension GL_EXT_samplerless_texture_functions : require\n",
    );
    for (name, value) in CONSTANTS {
        let _ = writeln!(text, "#define {name} {value}");
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
    for structure in [
        ViewData::GLSL,
        GridData::GLSL,
        LightNode::GLSL,
        LightData::GLSL,
        MaterialData::GLSL,
        InstanceData::GLSL,
        DrawCommand::GLSL,
        DrawCounts::GLSL,
        ClusteringState::GLSL,
        DispatchSize::GLSL,
        PixelData::GLSL,
        ClusterGroup::GLSL,
        Candidate::GLSL,
    ] {
        text.push_str(structure);
        text.push('\n');
    }
    for (binding, access, member) in BUFFERS {
        let number = binding as u32;
        let _ = writeln!(
            text,
            "layout(set = SET_BUFFERS, binding = {number}, scalar) {access} buffer Buffer{number} {{ {member}; }};"
        );
    }
    for (position, (_, declaration, _)) in TEXELS.iter().enumerate() {
        let number = BUFFERS.len() + position;
        let _ = writeln!(text, "layout(set = SET_BUFFERS, binding = {number}) uniform {declaration};");
    }
    for (position, member) in UNIFORMS.iter().enumerate() {
        let number = BUFFERS.len() + TEXELS.len() + position;
        let _ = writeln!(
            text,
            "layout(set = SET_BUFFERS, binding = {number}, scalar) uniform Uniform{number} {{ {member}; }};"
        );
    }
    for (binding, member) in ALIASES {
        let number = binding as u32;
        let _ = writeln!(
            text,
            "layout(set = SET_BUFFERS, binding = {number}, scalar) buffer Alias{number} {{ {member}; }};"
        );
    }
    text.push_str("layout(push_constant) uniform PushConstants { uint view; uint step; } push;\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn structs_have_the_offsets_that_shaders_see() {
        crate::gpu_types::tests::assert_layouts(&[
            ViewData::INFO,
            GridData::INFO,
            LightNode::INFO,
            LightData::INFO,
            MaterialData::INFO,
            InstanceData::INFO,
            DrawCommand::INFO,
            DrawCounts::INFO,
            ClusteringState::INFO,
            DispatchSize::INFO,
            PixelData::INFO,
            ClusterGroup::INFO,
            Candidate::INFO,
        ]);
    }

    #[test]
    fn buffers_are_listed_in_the_order_of_their_bindings() {
        for (position, (binding, ..)) in BUFFERS.iter().enumerate() {
            assert_eq!(*binding as usize, position);
        }
    }
}
