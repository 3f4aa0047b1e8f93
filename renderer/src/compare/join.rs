//! Joining runs by configuration, and the exact comparison of their counters.

use super::read::{self, Identity, RunEntry};
use super::{Comparison, CounterComparison, ResultSet, RunComparison, Spread, images, times};
use crate::Result;
use crate::output::{ClusteringRow, FrameRow, HistogramRow, Older, Row, check_run, newest_of_each};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Joins and compares two sets; with `pictures`, those of differences of images go there.
pub(super) fn join(a: &Path, b: &Path, pictures: Option<&Path>) -> Result<Comparison> {
    let [mut runs_a, mut runs_b] = [read::find_runs(a)?, read::find_runs(b)?];
    // Results of earlier versions do not know what their lights file held.
    let known = |run: &RunEntry| run.lights_file.as_ref().is_none_or(|(_, sha256)| sha256.is_some());
    let by_content = runs_a.iter().chain(&runs_b).all(known);
    runs_a.iter_mut().chain(&mut runs_b).for_each(|run| run.tell_by_lights(by_content));
    let older = [keep_newest(&mut runs_a), keep_newest(&mut runs_b)].concat();
    runs_a.iter().chain(&runs_b).try_for_each(|run| check_run(&run.directory))?;
    if has_twins(&runs_a) || has_twins(&runs_b) {
        runs_a.iter_mut().chain(&mut runs_b).for_each(RunEntry::tell_by_way);
    }
    let twin = |run: &RunEntry, others: &[RunEntry]| others.iter().position(|o| o.identity == run.identity);
    let mut runs = vec![];
    let mut missing_in_b = vec![];
    for run in &runs_a {
        match twin(run, &runs_b) {
            Some(other) => {
                let pictures = pictures.map(|out| images::directory_of(out, a, &run.directory));
                runs.push(compare_runs(run, &runs_b[other], pictures.as_deref())?);
            }
            None => missing_in_b.push(run.label.clone()),
        }
    }
    let missing_in_a =
        runs_b.iter().filter(|run| twin(run, &runs_a).is_none()).map(|run| run.label.clone()).collect();
    let [a, b] = [result_set(a, &runs_a), result_set(b, &runs_b)];
    Ok(Comparison { a, b, older, runs, missing_in_a, missing_in_b })
}

/// Whether two runs differ in their ways alone.
fn has_twins(runs: &[RunEntry]) -> bool {
    let distinct: BTreeSet<&Identity> = runs.iter().map(|run| &run.identity).collect();
    distinct.len() < runs.len()
}

/// Of runs that were asked to do the same, in the same way, leaves the newest; says which were older.
fn keep_newest(runs: &mut Vec<RunEntry>) -> Vec<Older> {
    let key = |run: &RunEntry| ((run.identity.clone(), run.way.clone()), run.age.clone());
    let newest = newest_of_each(&runs.iter().map(key).collect::<Vec<_>>());
    let directory = |index: usize| runs[index].directory.display().to_string();
    let pairs = newest.iter().enumerate().filter(|(index, newest)| index != *newest);
    let older =
        pairs.map(|(index, &newest)| Older { run: directory(index), newer: directory(newest) }).collect();
    let mut index = 0..;
    runs.retain(|_| index.next().is_some_and(|index| newest[index] == index));
    older
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

fn compare_runs(a: &RunEntry, b: &RunEntry, pictures: Option<&Path>) -> Result<RunComparison> {
    let [counters_a, counters_b] = [read::counters(&a.directory)?, read::counters(&b.directory)?];
    let frames: BTreeSet<u32> =
        counters_a.keys().filter(|frame| counters_b.contains_key(frame)).copied().collect();
    let missing = |side: &Frames| side.keys().filter(|f| !frames.contains(f)).copied().collect();
    let mut counters = compare_counters(&counters_a, &counters_b, &frames);
    counters.push(compare_tables(a, b, &frames, |row: &ClusteringRow| row.frame)?);
    counters.push(compare_tables(a, b, &frames, |row: &HistogramRow| row.frame)?);
    Ok(RunComparison {
        run: a.label.clone(),
        frames: frames.len(),
        frames_missing_in_a: missing(&counters_b),
        frames_missing_in_b: missing(&counters_a),
        counters,
        stretch: [a.stretch, b.stretch],
        times: times::compare([&a.directory, &b.directory], &frames, [a.stretch, b.stretch])?,
        images: images::compare([&a.directory, &b.directory], pictures)?,
    })
}

/// The rows of `frames.csv` by frame.
type Frames = BTreeMap<u32, FrameRow>;

/// A row a counter.
fn compare_counters(a: &Frames, b: &Frames, frames: &BTreeSet<u32>) -> Vec<CounterComparison> {
    let names = FrameRow::default().counters().map(|(name, _)| name).collect::<Vec<_>>();
    let compare = |(place, metric): (usize, &&'static str)| {
        let values = |side: &Frames| -> Vec<u64> {
            let count = |frame| side[frame].counters().nth(place).map_or(0, |(_, count)| count);
            frames.iter().map(count).collect()
        };
        compare_values(metric, frames, &values(a), &values(b))
    };
    names.iter().enumerate().map(compare).collect()
}

fn compare_values(metric: &str, frames: &BTreeSet<u32>, a: &[u64], b: &[u64]) -> CounterComparison {
    let pairs = || a.iter().zip(b);
    let differing = || frames.iter().zip(pairs()).filter(|(_, (a, b))| a != b);
    let ratios: Option<Vec<f64>> = pairs().map(|(&a, &b)| ratio(a, b)).collect();
    let sum = |values: &[u64]| values.iter().fold(0_u64, |sum, value| sum.saturating_add(*value));
    let (sum_a, sum_b) = (sum(a), sum(b));
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

/// Compares tables beside `frames.csv`, which hold counters alone, row by row.
fn compare_tables<R: Row>(
    a: &RunEntry,
    b: &RunEntry,
    frames: &BTreeSet<u32>,
    frame: fn(&R) -> u32,
) -> Result<CounterComparison> {
    let [a, b] = [read::rows_by_frame(&a.directory, frame)?, read::rows_by_frame(&b.directory, frame)?];
    let differing: Vec<u32> = frames.iter().filter(|frame| a.get(frame) != b.get(frame)).copied().collect();
    Ok(CounterComparison {
        metric: R::FILE.to_owned(),
        a: None,
        b: None,
        ratio: None,
        over_frames: None,
        frames_differing: differing.len(),
        first_difference: differing.first().copied(),
    })
}
