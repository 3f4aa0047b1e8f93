//! The closing table of a sweep, from what is on disk.

use super::{Part, failure};
use crate::Result;
use crate::methods::MethodSpec;
use crate::output::{PlannedRun, RunMeans, Summary, is_complete, saved_means};

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
                scene: part.directory.clone(),
                method: run.method,
                lighting: run.lighting.clone(),
                assign: way(part.config.assign.len(), run, run.assign.to_string()),
                test: way(part.config.test.len(), run, run.test.to_string()),
                frames,
                means,
            });
        }
    }
    Ok(Summary::from_means(&runs))
}

/// The name of a way or test where it tells runs apart: where there are `several`, and the method knows any.
fn way(several: usize, run: &PlannedRun, name: String) -> String {
    if several > 1 && run.method != MethodSpec::AllLights { name } else { String::new() }
}
