//! An octree as the device sees it.

use crate::clustering::SLACK_PER_METRE_BEYOND;
use crate::gpu_interface::{HashData, OCTREE_LAYERS, OctreeData, OctreeLayer};
use crate::measure::{OctreeSizes, OctreeTable, TableKind};
use crate::octree::{HashTable, Layer, LayerMemory, LinklessOctree, MOST_DEPTH};
use glam::DVec3;

/// What is added to every light's radius, metres, where no geometry, eye or light of a frame lies farther than `farthest` metres
/// from its origin: a power of two, so that a frame that differs little from the last asks for the same octree, and every frame
/// for its own, whichever were rendered before.
pub fn slack(farthest: f64) -> f64 {
    (SLACK_PER_METRE_BEYOND * farthest).log2().ceil().exp2()
}

/// How many entries the tables of an octree have.
pub fn table_sizes(octree: &LinklessOctree) -> OctreeSizes {
    let entries = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
    OctreeSizes {
        nodes: entries(octree.structure.len()),
        leaves: entries(octree.leaves.len()),
        offsets: entries(octree.offsets.len()),
        indices: entries(octree.indices.len()),
    }
}

/// What is told of the tables of an octree, by depth.
pub fn told_tables(octree: &LinklessOctree) -> Vec<OctreeTable> {
    let layers = octree.layers.iter().zip(octree.memory());
    let of_layer = |(layer, memory): (&Layer, LayerMemory)| {
        let structure = OctreeTable {
            kind: TableKind::Structure,
            depth: memory.depth,
            memory: memory.structure,
            light_indices: 0,
        };
        let data = layer.data.zip(memory.data).map(|(table, of_data)| OctreeTable {
            kind: TableKind::Data,
            depth: memory.depth + 1,
            memory: of_data,
            light_indices: lights_of(octree, &table),
        });
        [Some(structure), data]
    };
    layers.flat_map(of_layer).flatten().collect()
}

/// Lights of all leaves of a table.
fn lights_of(octree: &LinklessOctree, table: &HashTable) -> u64 {
    let first = table.slots as usize;
    let slots = &octree.leaves[first..first + (table.side as usize).pow(3)];
    slots.iter().map(|&[_, lights]| u64::from(lights)).sum()
}

/// What shaders read of an octree in a frame with this origin.
pub fn data(octree: &LinklessOctree, origin: DVec3) -> OctreeData {
    let frame = &octree.frame;
    let mut data = OctreeData {
        origin: (frame.origin - origin).as_vec3().to_array(),
        scale: (1.0 / frame.node) as f32,
        depth: frame.depth,
        start_depth: frame.start_depth,
        cells: f64::from(frame.depth).exp2() as f32,
        layers: [OctreeLayer::default(); OCTREE_LAYERS as usize],
    };
    for (layer, found) in data.layers.iter_mut().zip(&octree.layers) {
        *layer =
            OctreeLayer { branches: hash(&found.structure), leaves: found.data.as_ref().map_or(NONE, hash) };
    }
    data
}

/// The hash of no keys, which still has a side to divide by.
const NONE: HashData = HashData { slots: 0, side: 1, offsets: 0, offset_side: 1 };

fn hash(table: &HashTable) -> HashData {
    let HashTable { slots, side, offsets, offset_side, .. } = *table;
    HashData { slots, side, offsets, offset_side }
}

const _: () = assert!(MOST_DEPTH <= OCTREE_LAYERS);
