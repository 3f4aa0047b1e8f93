//! The classes of tables 4.4 to 4.6, as rankings that are computed.

use crate::report::analysis;
use crate::report::enhuber::evaluation::{Evaluation, SEVEN};
use crate::report::results::ResultSet;
use crate::report::tables::{Row, Table};

/// Which criteria a table ranks by, and what is said of it.
struct Ranked {
    id: &'static str,
    title: &'static str,
    caption: &'static str,
    /// How the criteria's names begin.
    by: &'static [&'static str],
}

const TABLES: [Ranked; 3] = [
    Ranked {
        id: "enhuber-4.4",
        title: "Table 4.4: methods by variability",
        caption: "Computed: least first; of several scenes the worst decides. Neighbours share a class unless the 95 % interval of their \
                  difference excludes 0. The thesis's classes: SD low SC-E, SC-I; medium T-E, DC-I, G; high T-I, M. RSD low G, M, \
                  SC-E, SC-I; medium DC-I; high T-E, T-I.",
        by: &["SD", "RSD"],
    },
    Ranked {
        id: "enhuber-4.5",
        title: "Table 4.5: methods by speed",
        caption: "Computed: least first; of several scenes the worst decides. Neighbours share a class unless the 95 % interval of their \
                  difference excludes 0. The thesis's classes: 100 lights fast DC-I, G, T-I; medium T-E; slow SC-I, SC-E; very slow M. \
                  1000 fast T-E, SC-I, SC-E, DC-I, G; medium T-I; very slow M. 10 000 fast SC-E, SC-I; medium T-E; slow DC-I, G; very \
                  slow T-I, M.",
        by: &["mean time"],
    },
    Ranked {
        id: "enhuber-4.6",
        title: "Table 4.6: methods by slope and offset",
        caption: "Computed: least first; of several scenes the worst decides. Neighbours share a class unless the 95 % interval of their \
                  difference excludes 0. The thesis's classes: slope of assignment low M, SC-E, SC-I; medium T-E, T-I; high G, DC-I; of \
                  shading and of all low SC-E, SC-I; medium T-E; high DC-I, G; very high T-I; extreme M. Offset of assignment low \
                  DC-I, T-I, G, M; medium T-E; high SC-I, SC-E; of shading low M, T-I, G; medium T-E, DC-I; high SC-I, SC-E; of all \
                  low M, T-I, G, DC-I; medium T-E; high SC-I, SC-E.",
        by: &["slope", "offset"],
    },
];

/// The rankings of the methods that stand for the seven kinds.
pub fn tables(set: &ResultSet, evaluations: &[Evaluation<'_>]) -> Vec<Table> {
    let classes: Vec<Table> = evaluations.iter().map(|evaluation| classes(set, evaluation)).collect();
    let table = |ranked: Ranked| {
        let is_of = |row: &&Row| ranked.by.iter().any(|by| row.labels[0].starts_with(by));
        let rows = classes.iter().flat_map(|table| &table.rows).filter(is_of).cloned().collect();
        let Ranked { id, title, caption, .. } = ranked;
        let groups = classes.first().map(|table| table.groups.clone()).unwrap_or_default();
        Table { id, title, caption, labels: &["ranked by", "method", "worst scene"], groups, rows }
    };
    TABLES.into_iter().map(table).collect()
}

fn classes(set: &ResultSet, evaluation: &Evaluation<'_>) -> Table {
    let methods = evaluation.chosen_of(&SEVEN);
    analysis::classes(&evaluation.results(set, |run| methods.contains(&run.method)))
}
