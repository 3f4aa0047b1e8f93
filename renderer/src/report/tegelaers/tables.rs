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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::tegelaers::testing::{costs, everything};
    use crate::report::testing::set;

    #[test]
    fn every_table_has_rows_and_a_number_or_gap_a_column() {
        let tables = all(&set(everything(costs)));
        let ids: Vec<&str> = tables.iter().map(|table| table.id).collect();
        assert_eq!(ids, ["tegelaers-ratios", "tegelaers-building", "tegelaers-layers"]);
        for table in &tables {
            let columns: usize = table.groups.iter().map(|(_, columns)| columns.len()).sum();
            for row in &table.rows {
                assert_eq!(
                    (row.labels.len(), row.numbers.len()),
                    (table.labels.len(), columns),
                    "{}",
                    table.id
                );
            }
            assert!(!table.caption.contains("  "), "{}", table.caption);
        }
        assert!(all(&set(vec![])).is_empty(), "what is printed alone is no table");
    }
}
