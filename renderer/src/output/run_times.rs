//! The times of every temporal run of a run on disk.

use super::rows::{FrameRow, TimingRow};
use super::strict::each_row;
use crate::Result;
use crate::stats::{Measured, Samples};
use std::collections::BTreeMap;
use std::path::Path;

/// Times of the columns of `frames.csv`; a column of which nothing was timed in every run and frame is not in it.
pub type ColumnTimes = BTreeMap<&'static str, Samples>;

/// The times of the run in `directory`, whose frames are given ascending, by column of `frames.csv`.
///
/// # Errors
/// The table of times is damaged.
pub fn saved_times(directory: &Path, frames: &[u32]) -> Result<ColumnTimes> {
    saved_samples(directory, frames, |kind| FrameRow::columns_of(kind).collect())
}

/// The times of given frames, ascending, of the run in `directory`: by what `keys` makes of a stage's kind.
///
/// # Errors
/// The table of times is damaged.
pub fn saved_samples<K: Ord>(
    directory: &Path,
    frames: &[u32],
    keys: impl Fn(&str) -> Vec<K>,
) -> Result<BTreeMap<K, Samples>> {
    let mut stages: BTreeMap<String, Vec<Vec<f64>>> = BTreeMap::new();
    each_row(directory, |_, row: TimingRow| {
        let (Ok(frame), Some(gpu_ms)) = (frames.binary_search(&row.frame), row.gpu_ms) else { return Ok(()) };
        let runs = stages.entry(row.stage).or_default();
        let run = row.run as usize;
        if runs.len() <= run {
            runs.resize(run + 1, vec![f64::NAN; frames.len()]);
        }
        runs[run][frame] = gpu_ms;
        Ok(())
    })?;
    let mut by_key: BTreeMap<K, Vec<Vec<f64>>> = BTreeMap::new();
    for (stage, runs) in stages {
        for key in keys(&super::stage_kind(&stage)) {
            let all = by_key.entry(key).or_default();
            all.resize(all.len().max(runs.len()), vec![]);
            all.iter_mut().zip(&runs).for_each(|(all, run)| all.extend(run));
        }
    }
    let samples = by_key.into_iter().map(|(key, runs)| Some((key, Samples::new(frames.len(), runs)?)));
    Ok(samples.flatten().collect())
}

/// The means of the times of a run, with their noise.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeasuredTimes {
    /// How many temporal runs there were.
    pub runs: usize,
    by_column: BTreeMap<&'static str, Measured>,
}

impl MeasuredTimes {
    /// Of the times of a run.
    pub fn new(times: &ColumnTimes) -> Self {
        let by_column = times.iter().map(|(column, samples)| (*column, samples.measure()));
        Self { runs: times.values().map(Samples::runs).max().unwrap_or(0), by_column: by_column.collect() }
    }

    /// That of a column of `frames.csv`.
    pub fn of(&self, column: &str) -> Option<&Measured> {
        self.by_column.get(column)
    }
}
