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

/// The perfect hashes of one layer.
pub(super) type Hashes = (PerfectHash, Option<PerfectHash>);

/// The tables of a tree.
///
/// # Errors
/// There is no room for the indices or the tables, or no perfect hash was found.
pub(super) fn tables(
    tree: &Node,
    frame: OctreeFrame,
    settings: &OctreeSettings,
) -> Result<LinklessOctree, OctreeError> {
    let collected = Collected::of(tree, &frame, settings.share_runs);
    let most = settings.limits.indices;
    if collected.indices.len() > most {
        return Err(OctreeError::TooManyIndices { node: settings.node, most });
    }
    let hashes = hashes(&collected, &frame, settings)?;
    let mut octree = LinklessOctree {
        frame,
        layers: Vec::with_capacity(hashes.len()),
        structure: Vec::new(),
        leaves: Vec::new(),
        offsets: Vec::new(),
        indices: collected.indices,
    };
    for ((structure, data), (branches, leaves)) in
        hashes.iter().zip(collected.structure.iter().zip(&collected.data))
    {
        let structure = append(&mut octree.structure, &mut octree.offsets, structure, branches);
        let data = data.as_ref().map(|hash| append(&mut octree.leaves, &mut octree.offsets, hash, leaves));
        octree.layers.push(Layer { structure, data });
    }
    let slots = octree.structure.len().max(octree.leaves.len()).max(octree.offsets.len());
    let most = settings.limits.slots;
    if slots > most {
        Err(OctreeError::TooManySlots { node: settings.node, slots, most })
    } else {
        Ok(octree)
    }
}

/// The perfect hashes of all layers, each made on a core of its own.
fn hashes(
    collected: &Collected,
    frame: &OctreeFrame,
    settings: &OctreeSettings,
) -> Result<Vec<Hashes>, OctreeError> {
    let structure = collected.structure.iter().map(|entries| &entries.keys);
    let data = collected.data.iter().map(|entries| &entries.keys);
    let depths = frame.start_depth..frame.depth;
    let wanted: Vec<(u32, &Vec<UVec3>)> =
        structure.zip(depths.clone()).map(|(keys, depth)| (depth, keys)).collect();
    let deeper = data.zip(depths).map(|(keys, depth)| (depth + 1, keys));
    // The deepest first: they take longest.
    let wanted: Vec<(u32, &Vec<UVec3>)> = wanted.into_iter().chain(deeper).rev().collect();
    let made: Vec<Option<PerfectHash>> = wanted
        .into_par_iter()
        .with_max_len(1)
        .map(|(depth, keys)| perfect_hash(keys, depth, settings))
        .collect::<Result<_, _>>()?;
    let mut made = made.into_iter().rev();
    let structure: Vec<PerfectHash> = made.by_ref().take(collected.structure.len()).flatten().collect();
    Ok(structure.into_iter().zip(made).collect())
}

/// The perfect hash of the keys of a table; `None` without keys.
///
/// # Errors
/// There is no room for it, or none was found.
pub(super) fn perfect_hash(
    keys: &[UVec3],
    depth: u32,
    settings: &OctreeSettings,
) -> Result<Option<PerfectHash>, OctreeError> {
    if keys.is_empty() {
        return Ok(None);
    }
    let most = settings.limits.slots;
    let how = HashSettings { seed: settings.seed, slack: settings.slack, most_slots: most };
    PerfectHash::build(keys, &how).map(Some).map_err(|error| match error {
        HashError::TooLarge(slots) => OctreeError::TooManySlots { node: settings.node, slots, most },
        HashError::NotFound => OctreeError::NoHash { node: settings.node, depth, keys: keys.len() },
    })
}

/// Puts a table's slots and offsets behind those that are there.
fn append<T: Copy + Default>(
    slots: &mut Vec<T>,
    offsets: &mut Vec<[u8; 4]>,
    hash: &PerfectHash,
    entries: &Entries<T>,
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
