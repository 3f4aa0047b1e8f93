//! The closing table of a sweep, from what is on disk.

use super::{Part, failure};
use crate::Result;
use crate::output::{RunMeans, Summary, is_complete, saved_means};

/// Sums up every run of `parts` that is complete, whoever made it and when. Runs that failed last are left out.
///
/// # Errors
/// A complete run's table cannot be read.
pub fn summary(parts: &[Part]) -> Result<Summary> {
    let mut runs = Vec::new();
    for part in parts {
        for run in &part.runs {
            let directory = part.path(run);
            if !is_complete(&directory) || failure::path(part, run).exists() {
                continue;
            }
            let (frames, means) = saved_means(&directory)?;
            runs.push(RunMeans {
                method: run.method,
                labels: run.labels.clone().of_scene(&part.directory),
                frames,
                means,
            });
        }
    }
    Ok(Summary::from_means(&runs))
}
