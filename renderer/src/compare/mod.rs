//! Comparing result sets: the regression check of anyone who changes a shader.
//!
//! Runs are joined by what they were asked to do, not by where they lie. Counters are compared exactly, frame by
//! frame. Times are compared as ratios of minima over the temporal runs, with the noise that those runs show
//! ([`crate::stats`]), and judged together (`verdict.rs`).
//!
//! ```text
//! A ─┬─ join ──> runs ──> counters (exact), times ──> verdicts ──┬──> table, Markdown, JSON, page
//! B ─┘                  images (channels, FLIP)                  └──> exit code
//! ```

mod flip;
mod images;
mod join;
mod markdown;
mod page;
mod read;
mod table;
mod times;
mod verdict;

#[cfg(test)]
mod tests;

pub use images::{ChannelComparison, Flip, ImageComparison};
pub use markdown::Markdown;
pub use page::write_page;
pub use verdict::{Tally, Verdict};

use crate::Result;
use crate::output::FRAME;
use crate::output::Older;
use crate::stats::{Interval, Noise};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Result sets, each compared with the first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparisons {
    /// A ratio of times matters that differs from 1 by more than so many percent.
    pub threshold_percent: f64,
    /// Verdicts over all sets, runs and stages.
    pub verdicts: Tally,
    /// The second set against the first.
    #[serde(flatten)]
    pub first: Comparison,
    /// Any further set against the first.
    pub further: Vec<Comparison>,
}

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
    /// The factors by which others on the device may have lengthened the times of A and of B; 1 where nothing tells of any.
    pub stretch: [f64; 2],
    /// A row a stage; empty where either side has no temporal runs.
    pub times: Vec<TimeComparison>,
    /// Layers of frames that both rendered to files.
    pub images: Vec<ImageComparison>,
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
    /// The stage's part of the frame's time by A, from 0 to 1.
    pub part_of_frame: f64,
    /// How many temporal runs are compared: as many as the side with fewer has.
    pub runs: usize,
    /// Milliseconds a frame: the mean over frames of the minimum over runs.
    pub a_ms: f64,
    /// Milliseconds a frame: the mean over frames of the minimum over runs.
    pub b_ms: f64,
    /// B over A.
    pub ratio: f64,
    /// The same of single frames.
    pub over_frames: Spread,
    /// How far the runs of one set lie apart: the longest run's mean of the stage over the shortest one's, minus 1.
    pub spread_over_runs_a: Option<f64>,
    /// The same of B.
    pub spread_over_runs_b: Option<f64>,
    /// Noise of the ratio's logarithm; `None` for fewer than two temporal runs on a side.
    #[serde(skip)]
    noise: Option<Noise>,
    /// The factors by which others on the device may have lengthened A and B.
    #[serde(skip)]
    stretch: [f64; 2],
    /// Where the ratio lies, by 95 % intervals that are widened for how many are told and by what others on the device may
    /// account for; `None` without noise known.
    pub interval: Option<Interval>,
    /// What that lets be said.
    pub verdict: Verdict,
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

/// How sets are compared.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// A ratio of times matters that differs from 1 by more than so many percent.
    pub threshold_percent: f64,
    /// Where pictures of differences of images go: a directory a run below it, of several sets below their numbers.
    pub pictures: Option<PathBuf>,
}

/// Compares every run under `base` with the run of the same configuration under each of `others`, of which there is at
/// least one.
///
/// # Errors
/// A directory that is missing or holds no run, a file that is damaged or no result of this version, a picture that
/// cannot be written.
pub fn compare(base: &Path, others: &[PathBuf], options: &Options) -> Result<Comparisons> {
    let threshold_percent = options.threshold_percent;
    let pictures = |place: usize| match others.len() {
        1 => options.pictures.clone(),
        _ => options.pictures.as_ref().map(|out| out.join((place + 2).to_string())),
    };
    let join = |(place, other): (usize, &PathBuf)| join::join(base, other, pictures(place).as_deref());
    let mut all = others.iter().enumerate().map(join).collect::<Result<Vec<_>>>()?;
    let times = all.iter_mut().flat_map(|comparison| &mut comparison.runs).flat_map(|run| &mut run.times);
    let (mut frames, mut stages): (Vec<_>, Vec<_>) = times.partition(|time| time.stage == FRAME);
    for family in [&mut frames, &mut stages] {
        verdict::judge(family, threshold_percent / 100.0);
    }
    let verdicts = Tally::of(all.iter().flat_map(Comparison::times).map(|(_, time)| time));
    if all.is_empty() {
        return Err(crate::Error::input("nothing to compare with: give two result sets or more"));
    }
    let first = all.remove(0);
    Ok(Comparisons { threshold_percent, verdicts, first, further: all })
}

impl Comparisons {
    /// Each further set against the first.
    pub fn all(&self) -> impl Iterator<Item = &Comparison> {
        std::iter::once(&self.first).chain(&self.further)
    }

    /// What is not equal, as one line; `None` where every counter of every run and frame is.
    pub fn difference(&self) -> Option<String> {
        let several = !self.further.is_empty();
        let of = |comparison: &Comparison| {
            let difference = comparison.difference()?;
            Some(if several { format!("{}: {difference}", comparison.b.directory) } else { difference })
        };
        let differences: Vec<String> = self.all().filter_map(of).collect();
        (!differences.is_empty()).then(|| differences.join("; "))
    }

    /// What became slower by more than so many percent, as one line: its whole interval lies beyond.
    pub fn slower_than(&self, percent: f64) -> Option<String> {
        let beyond = |time: &TimeComparison| {
            time.interval
                .filter(|interval| interval.low > 1.0 + percent / 100.0 && time.verdict == Verdict::Slower)
        };
        let times = self.all().flat_map(Comparison::times);
        let mut slower = times.filter_map(|(run, time)| Some((run, time, beyond(time)?)));
        let (run, time, Interval { low, high }) = slower.next()?;
        let more = match slower.count() {
            0 => String::new(),
            more => format!(" (and {more} more)"),
        };
        Some(format!(
            "slower by more than {percent} %: {} of {}, by {:.1} to {:.1} %{more}",
            time.stage,
            run.run,
            100.0 * (low - 1.0),
            100.0 * (high - 1.0),
        ))
    }
}

impl Comparison {
    /// Every time of every run.
    pub fn times(&self) -> impl Iterator<Item = (&RunComparison, &TimeComparison)> {
        self.runs.iter().flat_map(|run| run.times.iter().map(move |time| (run, time)))
    }

    /// What is not equal, as one line; `None` where every counter of every run and frame is.
    pub fn difference(&self) -> Option<String> {
        let counters = self.runs.iter().filter(|run| run.counters.iter().any(CounterComparison::differs));
        let frames = self
            .runs
            .iter()
            .filter(|run| !run.frames_missing_in_a.is_empty() || !run.frames_missing_in_b.is_empty());
        let pixels = self.runs.iter().filter(|run| run.images.iter().any(ImageComparison::integers_differ));
        let faults = [
            (counters.count(), "with counters that differ"),
            (pixels.count(), "with images whose integers differ"),
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
