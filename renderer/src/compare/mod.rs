//! Comparing two result sets: the regression check of anyone who changes a shader.
//!
//! Runs are joined by what they were asked to do, not by where they lie. Counters are compared exactly, frame by
//! frame. Times are compared as ratios of minima over the temporal runs, and a difference counts only where it
//! exceeds the noise that those runs show among themselves (see [`TimeComparison::noise`]).

mod join;
mod read;
mod table;
mod times;

#[cfg(test)]
mod tests;

use crate::Result;
use crate::output::Older;
use serde::Serialize;
use std::path::Path;

/// Two result sets, side by side.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// The set that ratios are to.
    pub a: ResultSet,
    /// The other.
    pub b: ResultSet,
    /// Runs that are left out, for the same set has them newer.
    pub older: Vec<Older>,
    /// Runs that both have, in A's order.
    pub runs: Vec<RunComparison>,
    /// Runs of B that A lacks.
    pub missing_in_a: Vec<String>,
    /// Runs of A that B lacks.
    pub missing_in_b: Vec<String>,
}

/// Where a result set lies and what made it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ResultSet {
    /// Its directory.
    pub directory: String,
    /// How many runs it holds.
    pub runs: usize,
    /// Every program (version and revision) that made one of them.
    pub programs: Vec<String>,
    /// Every device (name and driver) that rendered one of them.
    pub devices: Vec<String>,
}

/// One run of both sets.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunComparison {
    /// Method, lights, scene, recording and the rest of what tells it from the others.
    pub run: String,
    /// How many frames both have.
    pub frames: usize,
    /// Frames of B that A lacks.
    pub frames_missing_in_a: Vec<u32>,
    /// Frames of A that B lacks.
    pub frames_missing_in_b: Vec<u32>,
    /// A row a counter.
    pub counters: Vec<CounterComparison>,
    /// A row a stage; empty where either side has no temporal runs.
    pub times: Vec<TimeComparison>,
}

/// One counter over the frames that both sets have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CounterComparison {
    /// Its column of `frames.csv`, or the name of another table, which is compared row by row.
    pub metric: String,
    /// Sum over frames; `None` for a table.
    pub a: Option<u64>,
    /// Sum over frames; `None` for a table.
    pub b: Option<u64>,
    /// B over A; `None` for a table, and where A is 0 and B is not.
    pub ratio: Option<f64>,
    /// The same of single frames.
    pub over_frames: Option<Spread>,
    /// In how many frames it differs.
    pub frames_differing: usize,
    /// The first of them.
    pub first_difference: Option<u32>,
}

/// One stage's GPU time over the frames that both sets have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimeComparison {
    /// Path in the stage tree without the numbers of views and clusterings.
    pub stage: String,
    /// Milliseconds a frame: the mean over frames of the minimum over runs.
    pub a_ms: f64,
    /// Milliseconds a frame: the mean over frames of the minimum over runs.
    pub b_ms: f64,
    /// B over A.
    pub ratio: f64,
    /// The same of single frames.
    pub over_frames: Spread,
    /// How far the runs of one set lie apart: the longest run's total of the stage over the shortest one's, minus 1.
    pub spread_over_runs_a: Option<f64>,
    /// The same of B.
    pub spread_over_runs_b: Option<f64>,
    /// The largest factor, minus 1, that noise explains: (1 + spread of A) (1 + spread of B) - 1. A run's total
    /// varies more than the minima do that ratios are made of, so this is on the safe side. `None` where a
    /// set has fewer than two temporal runs.
    pub noise: Option<f64>,
    /// Whether the ratio or its inverse exceeds 1 + `noise`.
    pub exceeds_noise: Option<bool>,
}

/// Ratios of single frames.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The smallest.
    pub min: f64,
    /// The median.
    pub median: f64,
    /// The largest.
    pub max: f64,
}

/// Compares every run under `a` with the run of the same configuration under `b`.
///
/// # Errors
/// A directory that is missing or holds no run, a file that is damaged or no result of this version.
pub fn compare(a: &Path, b: &Path) -> Result<Comparison> {
    join::join(a, b)
}

impl Comparison {
    /// What is not equal, as one line; `None` where every counter of every run and frame is.
    pub fn difference(&self) -> Option<String> {
        let counters = self.runs.iter().filter(|run| run.counters.iter().any(CounterComparison::differs));
        let frames = self
            .runs
            .iter()
            .filter(|run| !run.frames_missing_in_a.is_empty() || !run.frames_missing_in_b.is_empty());
        let faults = [
            (counters.count(), "with counters that differ"),
            (frames.count(), "with frames that only one side has"),
            (self.missing_in_a.len(), "missing in A"),
            (self.missing_in_b.len(), "missing in B"),
        ];
        let parts: Vec<String> = faults
            .into_iter()
            .filter(|(runs, _)| *runs > 0)
            .map(|(runs, what)| format!("{runs} {} {what}", if runs == 1 { "run" } else { "runs" }))
            .collect();
        (!parts.is_empty()).then(|| format!("the results differ: {}", parts.join(", ")))
    }
}

impl CounterComparison {
    /// Whether any frame differs.
    pub fn differs(&self) -> bool {
        self.frames_differing > 0
    }
}

impl Spread {
    /// Of ratios in any order; `None` where there are none.
    fn of(mut ratios: Vec<f64>) -> Option<Self> {
        ratios.sort_by(f64::total_cmp);
        let middle = ratios.len() / 2;
        let (&min, &max) = (ratios.first()?, ratios.last()?);
        let median =
            if ratios.len() % 2 == 1 { ratios[middle] } else { (ratios[middle - 1] + ratios[middle]) / 2.0 };
        Some(Self { min, median, max })
    }
}
