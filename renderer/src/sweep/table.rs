//! The closing table of a sweep, from what is on disk.

use super::{Part, failure};
use crate::Result;
use crate::output::{Manifest, PlannedRun, RunMeans, Summary, is_complete, saved_means};
use std::fmt;

/// Sums up every run of `parts` that is complete, whoever made it and when. Runs that failed last are left out.
///
/// # Errors
/// A complete run's table cannot be read.
pub fn summary(parts: &[Part]) -> Result<Summary> {
    let mut runs = Vec::new();
    for (part, run) in complete(parts) {
        let (frames, means, times) = saved_means(&part.path(run))?;
        runs.push(RunMeans {
            method: run.method,
            labels: run.labels.clone().of_scene(&part.directory),
            frames,
            means,
            times,
        });
    }
    Ok(Summary::from_means(&runs))
}

/// Runs that are complete and did not fail last.
fn complete(parts: &[Part]) -> impl Iterator<Item = (&Part, &PlannedRun)> {
    let all = parts.iter().flat_map(|part| part.runs.iter().map(move |run| (part, run)));
    all.filter(|(part, run)| is_complete(&part.path(run)) && !failure::path(part, run).exists())
}

/// Which of the runs of a [`summary`] have doubtful times, and why.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Doubtful {
    /// Full names and reasons.
    pub runs: Vec<(String, Vec<String>)>,
    /// How many runs there are in all.
    pub all: usize,
}

/// How many doubtful runs are named before the rest are only counted.
const NAMED: usize = 5;

impl Doubtful {
    /// Asks the manifest of every run of `parts` that is complete.
    ///
    /// # Errors
    /// A manifest cannot be read.
    pub fn of(parts: &[Part]) -> Result<Self> {
        let mut doubtful = Self::default();
        for (part, run) in complete(parts) {
            doubtful.all += 1;
            let doubts = Manifest::read(&part.path(run))?.doubts;
            if !doubts.is_empty() {
                doubtful.runs.push((part.full_name(run), doubts));
            }
        }
        Ok(doubtful)
    }
}

impl fmt::Display for Doubtful {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.runs.len();
        write!(
            f,
            "warning: times of {count} of {} runs are doubtful (`doubts` in their run.json):",
            self.all
        )?;
        for (name, doubts) in self.runs.iter().take(NAMED) {
            write!(f, "\n  {name}: {}", doubts.join("; "))?;
        }
        if count > NAMED { write!(f, "\n  and {} more", count - NAMED) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_doubtful_runs_are_named_and_the_rest_counted() {
        let run = |index: usize| (format!("run-{index}"), vec!["heat".to_owned(), "others".to_owned()]);
        let of = |count| Doubtful { runs: (0..count).map(run).collect(), all: 9 }.to_string();
        let one =
            "warning: times of 1 of 9 runs are doubtful (`doubts` in their run.json):\n  run-0: heat; others";
        assert_eq!(of(1), one);
        assert!(of(5).ends_with("  run-4: heat; others"), "{}", of(5));
        assert!(of(7).ends_with("  run-4: heat; others\n  and 2 more"), "{}", of(7));
    }
}
