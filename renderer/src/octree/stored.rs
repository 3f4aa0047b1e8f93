//! What the tables of an octree hold, by walking them from the starting depth down: they keep no keys.

use super::linkless::{Child, LinklessOctree, child_cells, child_of};
use glam::UVec3;

/// What a stored node is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoredKind {
    /// A branch, or a node of the starting depth; its slot is in [`LinklessOctree::structure`].
    Branch,
    /// A leaf with lights; its slot is in [`LinklessOctree::leaves`].
    Leaf,
}

/// A node that a table holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StoredNode {
    /// What it is.
    pub kind: StoredKind,
    /// Its depth.
    pub depth: u32,
    /// Its cell, in nodes of its depth.
    pub cell: UVec3,
    /// Its slot, among all slots of its kind.
    pub slot: usize,
}

impl LinklessOctree {
    /// All nodes that the tables hold, branches before what is below them.
    pub fn stored_nodes(&self) -> Vec<StoredNode> {
        let mut found = Vec::with_capacity(self.structure.len() + self.leaves.len());
        let side = 1_u32 << self.frame.start_depth;
        for z in 0..side {
            for y in 0..side {
                for x in 0..side {
                    self.walk(0, UVec3::new(x, y, z), &mut found);
                }
            }
        }
        found
    }

    /// The node of a layer that a cell is, and all below it.
    fn walk(&self, layer: usize, cell: UVec3, found: &mut Vec<StoredNode>) {
        let (tables, depth) = (&self.layers[layer], self.frame.start_depth + layer as u32);
        let slot = self.slot(&tables.structure, cell);
        found.push(StoredNode { kind: StoredKind::Branch, depth, cell, slot });
        for (child, cell) in child_cells(cell).enumerate() {
            match (child_of(self.structure[slot], child), &tables.data) {
                (Child::Branch, _) => self.walk(layer + 1, cell, found),
                (Child::Filled, Some(data)) => {
                    let (kind, slot) = (StoredKind::Leaf, self.slot(data, cell));
                    found.push(StoredNode { kind, depth: depth + 1, cell, slot });
                }
                (Child::Filled, None) | (Child::Empty, _) => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::OctreeSettings;
    use super::*;
    use crate::geometry::LightVolume;
    use glam::DVec3;
    use std::collections::BTreeSet;

    #[test]
    fn every_key_is_found_once_and_where_a_lookup_finds_it() {
        let sphere = |x: f64, radius| LightVolume::sphere(DVec3::new(x, 0.5 * x, 1.0), radius);
        let lights = [sphere(0.0, 3.0), sphere(4.0, 2.0), sphere(-7.0, 1.5)];
        for start in [0, 2] {
            let built = LinklessOctree::build(&lights, &OctreeSettings::new(0.5, start)).unwrap();
            let octree = built.octree;
            let stored = octree.stored_nodes();
            for (kind, keys) in [
                (StoredKind::Branch, octree.layers.iter().map(|layer| layer.structure.keys).sum::<u32>()),
                (
                    StoredKind::Leaf,
                    octree.layers.iter().filter_map(|layer| layer.data).map(|data| data.keys).sum(),
                ),
            ] {
                let of_kind = stored.iter().filter(|node| node.kind == kind);
                let slots: BTreeSet<usize> = of_kind.map(|node| node.slot).collect();
                assert_eq!(slots.len(), keys as usize, "{kind:?} from {start} on");
            }
            for leaf in stored.iter().filter(|node| node.kind == StoredKind::Leaf) {
                let cell = leaf.cell << (octree.frame.depth - leaf.depth);
                assert_eq!(octree.leaf_of_cell(cell), Some(leaf.slot));
            }
        }
    }
}
