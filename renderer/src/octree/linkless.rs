//! The octree without pointers (Tegelaers section 7.2): what the device looks lights up in.

use super::frame::OctreeFrame;
use super::perfect_hash::{offset_index, slot_index};
use super::tree::{child_cell, child_of_parent};
use glam::{DVec3, U8Vec3, UVec3};

/// Where the tables of one perfect hash lie among all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HashTable {
    /// First slot, in [`LinklessOctree::structure`] or [`LinklessOctree::leaves`].
    pub slots: u32,
    /// Slots along an axis, `m`.
    pub side: u32,
    /// First offset, in [`LinklessOctree::offsets`].
    pub offsets: u32,
    /// Offsets along an axis, `r`.
    pub offset_side: u32,
    /// How many keys are stored.
    pub keys: u32,
}

/// The tables of one depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layer {
    /// Branches of the layer's depth: what their children are.
    pub structure: HashTable,
    /// Leaves with lights, one deeper; `None` where there are none.
    pub data: Option<HashTable>,
}

/// Which lights reach each cell: layers from the starting depth on, each of two perfect hashes.
///
/// ```text
/// point ─ deepest cell q ─ layer i: structure[h(q >> (l - i))] ─ child (q >> (l - i - 1)) & 1 ─┬ branch ─ layer i + 1
///                                                                                          ├ empty leaf ─ no light
///                                                                 leaves[h(q >> (l - i - 1))] ─┴ filled leaf
///                                                                 (first, count) ─ indices
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LinklessOctree {
    /// Where cells lie.
    pub frame: OctreeFrame,
    /// Tables by depth: place k is depth `frame.start_depth + k`, the last `frame.depth - 1`.
    pub layers: Vec<Layer>,
    /// What branches' children are: bit x + 2y + 4z of the low byte says that it is a leaf, of the high byte that it has lights.
    pub structure: Vec<u16>,
    /// First index and number of indices of each leaf with lights.
    pub leaves: Vec<[u32; 2]>,
    /// Offsets of all tables; the fourth component is 0.
    pub offsets: Vec<[u8; 4]>,
    /// Light indices, ascending within a leaf.
    pub indices: Vec<u32>,
}

/// What a node's children are, as a slot of a structure table has it.
pub(super) fn child_bits(children: impl Iterator<Item = Child>) -> u16 {
    children.enumerate().fold(0, |bits, (at, child)| match child {
        Child::Branch => bits,
        Child::Empty => bits | 1 << at,
        Child::Filled => bits | 0x101 << at,
    })
}

/// What a child is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Child {
    /// Has children of its own.
    Branch,
    /// A leaf that no light reaches.
    Empty,
    /// A leaf with lights.
    Filled,
}

/// The child x + 2y + 4z of a node whose slot is `bits`.
pub(super) fn child_of(bits: u16, child: usize) -> Child {
    match (bits >> child & 1 != 0, bits >> (8 + child) & 1 != 0) {
        (false, _) => Child::Branch,
        (true, false) => Child::Empty,
        (true, true) => Child::Filled,
    }
}

impl LinklessOctree {
    /// Lights that may reach a point of the world: the twin of `lookup/hashed.glsl`.
    pub fn lights_at(&self, point: DVec3) -> &[u32] {
        self.frame.cell(point).map_or(&[], |cell| self.lights_of_cell(cell))
    }

    /// Lights that may reach a deepest cell.
    pub fn lights_of_cell(&self, cell: UVec3) -> &[u32] {
        self.leaf_of_cell(cell).map_or(&[], |leaf| {
            let [first, count] = self.leaves[leaf];
            &self.indices[first as usize..][..count as usize]
        })
    }

    /// The slot, in [`Self::leaves`], of the leaf with lights that holds a deepest cell; `None` where no light reaches it.
    pub fn leaf_of_cell(&self, cell: UVec3) -> Option<usize> {
        for (layer, depth) in self.layers.iter().zip(self.frame.start_depth..) {
            let below = self.frame.depth - depth - 1;
            let bits = self.structure[self.slot(&layer.structure, cell >> (below + 1))];
            let place = cell >> below;
            match child_of(bits, child_of_parent(place)) {
                Child::Branch => {}
                Child::Empty => return None,
                Child::Filled => return layer.data.map(|data| self.slot(&data, place)),
            }
        }
        None
    }

    /// The slot of a key, among all slots of the table's kind.
    pub(super) fn slot(&self, table: &HashTable, key: UVec3) -> usize {
        let [x, y, z, _] = self.offsets[table.offsets as usize + offset_index(key, table.offset_side)];
        table.slots as usize + slot_index(key, table.side, U8Vec3::new(x, y, z))
    }
}

/// Cells of the children of a cell, in order.
pub(super) fn child_cells(cell: UVec3) -> impl Iterator<Item = UVec3> {
    (0..8).map(move |child| child_cell(cell, child))
}
