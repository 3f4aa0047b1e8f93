//! Tables 4.3 to 4.6, and the frame times that the thesis prints beside those measured.

mod ranked;
mod ratios;
mod scenes;
mod sizes;
mod spread;

use super::evaluation::Evaluation;
use crate::report::results::ResultSet;
use crate::report::tables::Table;

/// The tables that have rows.
pub fn all(set: &ResultSet) -> Vec<Table> {
    let evaluations = Evaluation::all(set);
    let mut tables =
        vec![scenes::table(&evaluations), sizes::table(&evaluations), spread::table(&evaluations)];
    tables.extend(ranked::tables(set, &evaluations));
    tables.push(ratios::measured(&evaluations));
    tables.retain(|table| !table.rows.is_empty());
    // What is printed means something beside what was measured.
    if tables.iter().any(|table| table.id == ratios::MEASURED) {
        tables.push(ratios::printed());
    }
    tables
}

#[cfg(test)]
mod tests;
