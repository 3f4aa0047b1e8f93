//! Counts of the street beside the golden ones, which are lavapipe's. Rasterisers agree but for edges: another one's counts
//! are told with their difference, lavapipe's own must be the same.

use super::frames::FRAME;
use super::{Context, Verdict};
use crate::measure::{ClusteringCounts, FrameCounts};
use crate::{Error, Result};

/// The golden counts: one row a method and frame.
const GOLDEN: &str = include_str!("../../../tests/data/golden/street.csv");

/// The methods that golden counts are of: the truth, and those of the default replay.
pub const GOLDEN_METHODS: [&str; 7] = [
    "all-lights",
    "indi-persp-64",
    "encl-persp-64",
    "indi-ortho-4",
    "encl-ortho-4",
    "indi-displ-64-32",
    "encl-displ-64-32",
];

/// The columns of golden counts.
pub const GOLDEN_COLUMNS: [&str; 9] = [
    "run",
    "frame",
    "clusters",
    "visible_clusters",
    "light_indices",
    "lighting_computations",
    "needed_computations",
    "fragments_shaded",
    "lists_hash",
];

/// A run's row of golden counts.
pub fn golden_row(run: &str, counts: &FrameCounts) -> String {
    let sum = |value: fn(&ClusteringCounts) -> u64| -> u64 { counts.clusterings.iter().map(value).sum() };
    let hashes: Vec<String> = counts.clusterings.iter().map(|c| format!("{:016x}", c.lists_hash)).collect();
    let numbers = [
        counts.frame.into(),
        counts.clusters(),
        sum(|c| c.visible_clusters),
        sum(|c| c.light_indices),
        counts.counters.lighting_computations,
        counts.counters.needed_computations,
        counts.counters.fragments_shaded,
    ];
    let fields = numbers.iter().map(u64::to_string).chain([hashes.join(" ")]);
    [run.to_owned()].into_iter().chain(fields).collect::<Vec<_>>().join(",")
}

/// Counts that are told beside the golden ones: place of the column, and words.
const TOLD: [(usize, &str); 5] = [
    (3, "visible clusters"),
    (4, "light indices"),
    (5, "lighting computations"),
    (6, "needed"),
    (7, "fragments"),
];

/// Whether the counts are the golden ones, and if not, by how much.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let golden: Vec<&str> = GOLDEN.lines().skip(1).filter(|row| is_of_frame(row)).collect();
    let looks = context.frames(1)?.looks.iter().filter(|look| GOLDEN_METHODS.contains(&look.method));
    let own: Vec<String> = looks.map(|look| golden_row(look.method, &look.counts)).collect();
    if own == golden {
        return Ok(Verdict::Fine(format!("all counts of {} methods are the golden ones", own.len())));
    }
    let told = TOLD.map(|(column, words)| {
        let (own, golden) = (total(&own, column), total(&golden, column));
        match (own, golden) {
            (Some(own), Some(golden)) => Ok(beside(words, own, golden)),
            _ => Err(Error::Internal("a golden count is no number".into())),
        }
    });
    let found = told.into_iter().collect::<Result<Vec<_>>>()?.join("; ");
    let lavapipe = context.device()?.name.contains("llvmpipe");
    Ok(if lavapipe { Verdict::Wrong(found) } else { Verdict::Note(found) })
}

fn is_of_frame(row: &str) -> bool {
    row.split(',').nth(1) == Some(&FRAME.to_string())
}

/// Sum of a column.
fn total(rows: &[impl AsRef<str>], column: usize) -> Option<u64> {
    rows.iter().map(|row| row.as_ref().split(',').nth(column)?.parse::<u64>().ok()).sum()
}

fn beside(words: &str, own: u64, golden: u64) -> String {
    let percent = 100.0 * (own as f64 / golden.max(1) as f64 - 1.0);
    format!("{words} {own} beside {golden} ({percent:+.3} %)")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_golden_counts_have_the_columns_that_rows_have() {
        let header = GOLDEN.lines().next().unwrap();
        assert_eq!(header, GOLDEN_COLUMNS.join(","));
        let row = golden_row("some-run", &FrameCounts { frame: 300, ..Default::default() });
        assert_eq!(row, "some-run,300,0,0,0,0,0,0,");
        let names = GOLDEN.lines().filter(|row| is_of_frame(row)).map(|row| row.split(',').next().unwrap());
        assert_eq!(names.collect::<Vec<_>>(), GOLDEN_METHODS);
        for (column, _) in TOLD {
            let rows: Vec<&str> = GOLDEN.lines().skip(1).collect();
            assert!(total(&rows, column).unwrap() > 0);
        }
    }

    #[test]
    fn differences_are_told_in_percent_of_the_golden_count() {
        assert_eq!(beside("fragments", 1010, 1000), "fragments 1010 beside 1000 (+1.000 %)");
    }
}
