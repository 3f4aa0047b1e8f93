//! The thesis's ratios, and what octrees take step by step and layer by layer.

mod octree;
mod ratios;

use super::evaluation::Evaluation;
use crate::report::results::ResultSet;
use crate::report::tables::Table;

/// The tables that have rows.
pub fn all(set: &ResultSet) -> Vec<Table> {
    let evaluations = Evaluation::all(set);
    let all = [ratios::table(&evaluations), octree::building(&evaluations), octree::layers(&evaluations)];
    all.into_iter().filter(|table| !table.rows.is_empty()).collect()
}
