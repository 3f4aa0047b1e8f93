//! Numbers of the octrees that hashed methods built.

use crate::output::OctreeRow;
use crate::report::results::{BuiltOctree, Run};

/// Bytes of a light index.
const INDEX_BYTES: u64 = 4;
/// The tables of a depth, as the run names them.
pub const TABLES: [&str; 2] = ["structure", "data"];

/// What all steps of building took, milliseconds.
pub fn construction(run: &Run) -> Option<f64> {
    let built = run.octree.as_ref().filter(|built| !built.steps.is_empty())?;
    Some(built.steps.iter().map(|(_, ms)| ms).sum())
}

/// Depth of the deepest leaves.
pub fn depth(run: &Run) -> Option<f64> {
    run.octree.as_ref()?.tables.iter().map(|table| f64::from(table.depth)).reduce(f64::max)
}

/// Slots and offsets of all tables: m^3 + r^3 each.
pub fn texels(run: &Run) -> Option<f64> {
    let cube = |side: u32| f64::from(side).powi(3);
    sum(run, |table| cube(table.slot_side) + cube(table.offset_side))
}

/// Light indices of all leaves.
pub fn indices(run: &Run) -> Option<f64> {
    sum(run, |table| table.light_indices as f64)
}

/// Bytes of tables and light indices.
pub fn memory(run: &Run) -> Option<f64> {
    sum(run, bytes)
}

fn sum(run: &Run, of: impl Fn(&OctreeRow) -> f64) -> Option<f64> {
    let built = run.octree.as_ref().filter(|built| !built.tables.is_empty())?;
    Some(built.tables.iter().map(of).sum())
}

/// Bytes of a table with the light indices of its leaves.
pub fn bytes(table: &OctreeRow) -> f64 {
    (table.slot_bytes + table.offset_bytes + INDEX_BYTES * table.light_indices) as f64
}

impl BuiltOctree {
    /// Depths of tables, ascending.
    pub fn depths(&self) -> Vec<u32> {
        let mut depths: Vec<u32> = self.tables.iter().map(|table| table.depth).collect();
        depths.sort_unstable();
        depths.dedup();
        depths
    }

    /// The table of a name and depth.
    pub fn table(&self, name: &str, depth: u32) -> Option<&OctreeRow> {
        self.tables.iter().find(|table| table.table == name && table.depth == depth)
    }

    /// Bytes of what stands at a depth.
    pub fn bytes_at(&self, depth: u32) -> f64 {
        self.tables.iter().filter(|table| table.depth == depth).map(bytes).sum()
    }
}
