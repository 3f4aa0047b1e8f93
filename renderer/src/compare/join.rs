//! Joining runs by configuration, and the exact comparison of their counters.

use super::read::{self, Counters, RunEntry};
use super::{Comparison, CounterComparison, ResultSet, RunComparison, Spread, times};
use crate::{Error, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Tables beside `frames.csv` that hold counters alone.
const TABLES: [&str; 2] = ["clusterings.csv", "histograms.csv"];

pub(super) fn join(a: &Path, b: &Path) -> Result<Comparison> {
    let [mut runs_a, mut runs_b] = [read::find_runs(a)?, read::find_runs(b)?];
    // Lists are the same by every way of assignment: results by one way compare with results by another.
    if has_several_ways(&runs_a) || has_several_ways(&runs_b) {
        runs_a.iter_mut().chain(&mut runs_b).for_each(RunEntry::tell_ways_apart);
    }
    check_distinct(a, &runs_a)?;
    check_distinct(b, &runs_b)?;
    let twin = |run: &RunEntry, others: &[RunEntry]| others.iter().position(|o| o.identity == run.identity);
    let mut runs = vec![];
    let mut missing_in_b = vec![];
    for run in &runs_a {
        match twin(run, &runs_b) {
            Some(other) => runs.push(compare_runs(run, &runs_b[other])?),
            None => missing_in_b.push(run.label.clone()),
        }
    }
    let missing_in_a =
        runs_b.iter().filter(|run| twin(run, &runs_a).is_none()).map(|run| run.label.clone()).collect();
    Ok(Comparison { a: result_set(a, &runs_a), b: result_set(b, &runs_b), runs, missing_in_a, missing_in_b })
}

fn has_several_ways(runs: &[RunEntry]) -> bool {
    runs.iter().any(|run| run.assign != runs[0].assign)
}

fn check_distinct(directory: &Path, runs: &[RunEntry]) -> Result<()> {
    let mut seen = BTreeMap::new();
    for run in runs {
        if let Some(earlier) = seen.insert(&run.identity, run) {
            return Err(Error::file(
                directory,
                format!(
                    "{} and {} are runs of one configuration: compare directories in which each has one run",
                    earlier.directory.display(),
                    run.directory.display()
                ),
            ));
        }
    }
    Ok(())
}

fn result_set(directory: &Path, runs: &[RunEntry]) -> ResultSet {
    let distinct = |get: fn(&RunEntry) -> &String| {
        let all: BTreeSet<&String> = runs.iter().map(get).collect();
        all.into_iter().cloned().collect()
    };
    ResultSet {
        directory: directory.display().to_string(),
        runs: runs.len(),
        programs: distinct(|run| &run.program),
        devices: distinct(|run| &run.device),
    }
}

fn compare_runs(a: &RunEntry, b: &RunEntry) -> Result<RunComparison> {
    let [counters_a, counters_b] = [read::counters(&a.directory)?, read::counters(&b.directory)?];
    let frames: BTreeSet<u32> =
        counters_a.frames.keys().filter(|frame| counters_b.frames.contains_key(frame)).copied().collect();
    let missing = |side: &Counters| side.frames.keys().filter(|f| !frames.contains(f)).copied().collect();
    let mut counters = compare_counters(&counters_a, &counters_b, &frames);
    for table in TABLES {
        counters.push(compare_tables(table, a, b, &frames)?);
    }
    Ok(RunComparison {
        run: a.label.clone(),
        frames: frames.len(),
        frames_missing_in_a: missing(&counters_b),
        frames_missing_in_b: missing(&counters_a),
        counters,
        times: times::compare(&a.directory, &b.directory, &frames)?,
    })
}

/// A row a counter of either side; one that a side lacks counts as 0 there.
fn compare_counters(a: &Counters, b: &Counters, frames: &BTreeSet<u32>) -> Vec<CounterComparison> {
    let added = b.columns.iter().filter(|column| !a.columns.contains(column));
    a.columns
        .iter()
        .chain(added)
        .map(|metric| {
            let values = |side: &Counters| -> Vec<u64> {
                let column = side.columns.iter().position(|name| name == metric);
                frames.iter().map(|frame| column.map_or(0, |column| side.frames[frame][column])).collect()
            };
            compare_values(metric, frames, &values(a), &values(b))
        })
        .collect()
}

fn compare_values(metric: &str, frames: &BTreeSet<u32>, a: &[u64], b: &[u64]) -> CounterComparison {
    let pairs = || a.iter().zip(b);
    let differing = || frames.iter().zip(pairs()).filter(|(_, (a, b))| a != b);
    let ratios: Option<Vec<f64>> = pairs().map(|(&a, &b)| ratio(a, b)).collect();
    let (sum_a, sum_b) = (a.iter().sum(), b.iter().sum());
    CounterComparison {
        metric: metric.to_owned(),
        a: Some(sum_a),
        b: Some(sum_b),
        ratio: ratio(sum_a, sum_b),
        over_frames: ratios.and_then(Spread::of),
        frames_differing: differing().count(),
        first_difference: differing().next().map(|(&frame, _)| frame),
    }
}

/// B over A; 1 where both are 0.
fn ratio(a: u64, b: u64) -> Option<f64> {
    if a == b { Some(1.0) } else { (a != 0).then(|| b as f64 / a as f64) }
}

fn compare_tables(
    table: &str,
    a: &RunEntry,
    b: &RunEntry,
    frames: &BTreeSet<u32>,
) -> Result<CounterComparison> {
    let [a, b] = [read::rows_by_frame(&a.directory, table)?, read::rows_by_frame(&b.directory, table)?];
    let differing: Vec<u32> = frames.iter().filter(|frame| a.get(frame) != b.get(frame)).copied().collect();
    Ok(CounterComparison {
        metric: table.to_owned(),
        a: None,
        b: None,
        ratio: None,
        over_frames: None,
        frames_differing: differing.len(),
        first_difference: differing.first().copied(),
    })
}
