//! From a scene's octree to its layers of tables (Tegelaers section 7.2.2).
//!
//! ```text
//! tree ─ collect ─┬ branches by depth ─ structure hash ┐
//!                 ├ leaves by depth ── data hash ──────┼ tables one behind the other
//!                 └ indices ───────────────────────────┘
//! ```

use super::frame::OctreeFrame;
use super::linkless::{Child, HashTable, Layer, LinklessOctree, child_bits, child_cells};
use super::perfect_hash::{HashError, HashSettings, PerfectHash};
use super::settings::{OctreeError, OctreeSettings};
use super::tree::Node;
use glam::UVec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Keys of one table with what is stored for each.
pub(super) struct Entries<T> {
    /// Cells of the table's depth, each once.
    pub keys: Vec<UVec3>,
    /// What is stored for them.
    pub values: Vec<T>,
}

/// All that the tables of a tree hold.
pub(super) struct Collected {
    /// Branches from the starting depth on.
    pub structure: Vec<Entries<u16>>,
    /// Leaves with lights, by the depth above theirs.
    pub data: Vec<Entries<[u32; 2]>>,
    /// Runs of light indices.
    pub indices: Vec<u32>,
}

impl<T> Entries<T> {
    fn push(&mut self, key: UVec3, value: T) {
        self.keys.push(key);
        self.values.push(value);
    }
}

impl<T> Default for Entries<T> {
    fn default() -> Self {
        Self { keys: Vec::new(), values: Vec::new() }
    }
}

/// Walks a tree, depth first, and notes its branches and leaves.
struct Collector<'a> {
    frame: &'a OctreeFrame,
    /// Where a run with these lights begins, where runs are shared.
    runs: Option<HashMap<&'a [u32], u32>>,
    found: Collected,
}

impl Collected {
    /// What the tables of a tree hold; equal runs of indices once where they are shared.
    pub fn of(tree: &Node, frame: &OctreeFrame, share_runs: bool) -> Self {
        let layers = (frame.depth - frame.start_depth) as usize;
        let found = Self {
            structure: (0..layers).map(|_| Entries::default()).collect(),
            data: (0..layers).map(|_| Entries::default()).collect(),
            indices: Vec::new(),
        };
        let mut collector = Collector { frame, runs: share_runs.then(HashMap::new), found };
        collector.node(tree, 0, UVec3::ZERO);
        collector.found
    }
}

impl<'a> Collector<'a> {
    /// A node above the starting depth, or one whose children the layers hold: any of the starting depth, branches below.
    fn node(&mut self, node: &'a Node, depth: u32, cell: UVec3) {
        let children = node.children();
        let Some(layer) = depth.checked_sub(self.frame.start_depth) else {
            return child_cells(cell)
                .zip(children)
                .for_each(|(cell, child)| self.node(child, depth + 1, cell));
        };
        let bits = child_bits(children.into_iter().map(kind));
        self.found.structure[layer as usize].push(cell, bits);
        for (cell, child) in child_cells(cell).zip(children) {
            match child {
                Node::Branch(_) => self.node(child, depth + 1, cell),
                Node::Leaf(lights) if lights.is_empty() => {}
                Node::Leaf(lights) => {
                    let run = self.run(lights);
                    self.found.data[layer as usize].push(cell, run);
                }
            }
        }
    }

    /// The first index and the number of a leaf's lights.
    fn run(&mut self, lights: &'a [u32]) -> [u32; 2] {
        let next = self.found.indices.len() as u32;
        let first = match &mut self.runs {
            Some(runs) => *runs.entry(lights).or_insert(next),
            None => next,
        };
        if first == next {
            self.found.indices.extend_from_slice(lights);
        }
        [first, lights.len() as u32]
    }
}

/// What a node is as a child.
pub(super) fn kind(node: &Node) -> Child {
    match node {
        Node::Branch(_) => Child::Branch,
        Node::Leaf(lights) if lights.is_empty() => Child::Empty,
        Node::Leaf(_) => Child::Filled,
    }
}

/// A table's keys and what is stored for them, with their perfect hash.
pub(super) struct Stored<T> {
    /// Where keys lie.
    pub hash: PerfectHash,
    /// What is stored.
    pub entries: Entries<T>,
}

/// The tables of one layer.
pub(super) struct StoredLayer {
    /// Branches.
    pub structure: Stored<u16>,
    /// Leaves with lights, where there are some.
    pub data: Option<Stored<[u32; 2]>>,
}

/// The tables of a tree.
///
/// # Errors
/// There is no room for the indices or the tables, or no perfect hash was found.
pub(super) fn tables(
    tree: &Node,
    frame: OctreeFrame,
    settings: &OctreeSettings,
) -> Result<LinklessOctree, OctreeError> {
    let (layers, indices) = stored(tree, &frame, settings)?;
    assemble(frame, &layers, indices, settings)
}

/// What the tables of a tree hold, layer by layer, and the light indices.
///
/// # Errors
/// There is no room for the indices or a table, or no perfect hash was found.
pub(super) fn stored(
    tree: &Node,
    frame: &OctreeFrame,
    settings: &OctreeSettings,
) -> Result<(Vec<StoredLayer>, Vec<u32>), OctreeError> {
    let Collected { structure, data, indices } = Collected::of(tree, frame, settings.share_runs);
    let most = settings.limits.indices;
    if indices.len() > most {
        return Err(OctreeError::TooManyIndices { node: settings.node, most });
    }
    let layers: Vec<_> = structure.into_iter().zip(data).zip(frame.start_depth..).collect();
    let made = layers.into_par_iter().with_max_len(1).map(|((branches, leaves), depth)| {
        let hash = |keys, depth| perfect_hash(keys, depth, settings);
        let (structure, data) = rayon::join(|| hash(&branches.keys, depth), || hash(&leaves.keys, depth + 1));
        let structure = Stored { hash: structure?, entries: branches };
        let data = Stored { hash: data?, entries: leaves };
        Ok(StoredLayer { structure, data: (!data.entries.keys.is_empty()).then_some(data) })
    });
    // The first layer's error, whichever was met first.
    let made: Vec<Result<StoredLayer, OctreeError>> = made.collect();
    let layers = made.into_iter().collect::<Result<_, _>>()?;
    Ok((layers, indices))
}

/// All tables one behind the other.
///
/// # Errors
/// There is no room for them.
pub(super) fn assemble(
    frame: OctreeFrame,
    layers: &[StoredLayer],
    indices: Vec<u32>,
    settings: &OctreeSettings,
) -> Result<LinklessOctree, OctreeError> {
    let (mut structure, mut leaves, mut offsets) = (Vec::new(), Vec::new(), Vec::new());
    let layers = layers.iter().map(|layer| Layer {
        structure: append(&mut structure, &mut offsets, &layer.structure),
        data: layer.data.as_ref().map(|data| append(&mut leaves, &mut offsets, data)),
    });
    let octree = LinklessOctree { layers: layers.collect(), frame, structure, leaves, offsets, indices };
    let slots = octree.structure.len().max(octree.leaves.len()).max(octree.offsets.len());
    let most = settings.limits.slots;
    if slots > most {
        return Err(OctreeError::TooManySlots { node: settings.node, slots, most });
    }
    Ok(octree)
}

/// The perfect hash of the keys of a table; of none, that of a single slot.
///
/// # Errors
/// There is no room for it, or none was found.
pub(super) fn perfect_hash(
    keys: &[UVec3],
    depth: u32,
    settings: &OctreeSettings,
) -> Result<PerfectHash, OctreeError> {
    let most = settings.limits.slots;
    let how = HashSettings { seed: settings.seed, slack: settings.slack, most_slots: most };
    PerfectHash::build(keys, &how).map_err(|error| match error {
        HashError::TooLarge(slots) => OctreeError::TooManySlots { node: settings.node, slots, most },
        HashError::NotFound => OctreeError::NoHash { node: settings.node, depth, keys: keys.len() },
    })
}

/// Puts a table's slots and offsets behind those that are there.
fn append<T: Copy + Default>(
    slots: &mut Vec<T>,
    offsets: &mut Vec<[u8; 4]>,
    Stored { hash, entries }: &Stored<T>,
) -> HashTable {
    let table = HashTable {
        slots: slots.len() as u32,
        side: hash.side,
        offsets: offsets.len() as u32,
        offset_side: hash.offset_side,
        keys: entries.keys.len() as u32,
    };
    let first = slots.len();
    slots.resize(first + (hash.side as usize).pow(3), T::default());
    for (key, value) in entries.keys.iter().zip(&entries.values) {
        slots[first + hash.slot(*key)] = *value;
    }
    offsets.extend(hash.offsets.iter().map(|offset| [offset.x, offset.y, offset.z, 0]));
    table
}
