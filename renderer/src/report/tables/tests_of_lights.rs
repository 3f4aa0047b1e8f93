//! Tests of light against cluster: how many more lights each lists than the exact one, and what it costs.

use super::{Row, Table, assignment, assignment_interval, mean};
use crate::report::results::{ResultSet, Run, method_name, metric};
use crate::report::way::Way;

/// The test whose lists hold no light that does not meet its cluster.
const EXACT: &str = "exact";

/// Rows of every method and lighting that was run with the exact test and with another.
pub fn table(set: &ResultSet) -> Table {
    let mut rows = vec![];
    for setting in set.settings_once() {
        let mut runs: Vec<&Run> =
            set.runs.iter().filter(|run| run.setting.by(&setting.way) == *setting).collect();
        runs.sort_by_cached_key(|run| {
            (run.lighting.clone(), run.method.to_string(), run.setting.way.clone())
        });
        for same in runs.chunk_by(|a, b| (&a.lighting, a.method) == (&b.lighting, b.method)) {
            rows.extend(block(same));
        }
    }
    Table {
        id: "tests",
        title: "Tests of light against cluster",
        caption: "False positives are the light indices beyond those of the exact test, in per cent of them. Assignment \
                  is clustering without visibility, and lies within its ends in 95 % of repetitions. Means over frames.",
        labels: &["method", "lighting", "test", "assigned by"],
        groups: vec![
            ("light indices", &[""]),
            ("false positives %", &[""]),
            ("lighting computations", &[""]),
            ("assignment ms", &["", "low", "high"]),
        ],
        rows,
    }
}

/// The runs of one method under one lighting; no rows where the exact test or any other is missing.
fn block(runs: &[&Run]) -> Vec<Row> {
    let test = |run: &Run| run.setting.way.value("test", run.method);
    let exact = runs.iter().find(|run| test(run) == EXACT).and_then(|run| mean(run, metric::INDICES));
    let Some(exact) = exact.filter(|_| runs.iter().any(|run| test(run) != EXACT)) else { return vec![] };
    let row = |run: &&Run| {
        let indices = mean(run, metric::INDICES);
        let beyond = indices.filter(|_| exact > 0.0).map(|indices| 100.0 * (indices / exact - 1.0));
        Row {
            setting: run.setting.by(&Way::default()).to_string(),
            labels: vec![
                method_name(run.method, true),
                run.lighting.label.clone(),
                test(run),
                run.setting.way.value("assign", run.method),
            ],
            numbers: [indices, beyond, mean(run, metric::COMPUTATIONS), assignment(run)]
                .into_iter()
                .chain(assignment_interval(run))
                .collect(),
        }
    };
    runs.iter().map(row).collect()
}
