//! Runs that failed: what is kept of them until they succeed.

use super::Part;
use crate::output::{PlannedRun, rfc3339_utc, write_whole};
use crate::{Error, Result};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::time::SystemTime;

/// Format and version of `<run>.error.json`.
const FORMAT: &str = "manylight.error/1";

/// Why a run failed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Failure {
    format: &'static str,
    /// The run's full name.
    pub run: String,
    /// What went wrong, in one line.
    pub error: String,
    /// When, RFC 3339, UTC.
    pub when: String,
}

/// Where a run's failure is kept.
pub(super) fn path(part: &Part, run: &PlannedRun) -> PathBuf {
    part.config.out.join(format!("{}.error.json", run.name))
}

impl Failure {
    /// A failure now.
    pub(super) fn new(part: &Part, run: &PlannedRun, error: &Error) -> Self {
        let error = error.to_string().lines().map(str::trim).collect::<Vec<_>>().join(" ");
        Self { format: FORMAT, run: part.full_name(run), error, when: rfc3339_utc(SystemTime::now()) }
    }

    /// Keeps it beside where the run would lie.
    pub(super) fn write(&self, part: &Part, run: &PlannedRun) -> Result<()> {
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| Error::Internal(format!("a failure is not JSON: {error}")))?;
        write_whole(&path(part, run), |file| writeln!(file, "{text}"))
    }
}

/// Forgets an earlier failure of a run that is complete now.
pub(super) fn forget(part: &Part, run: &PlannedRun) -> Result<()> {
    let path = path(part, run);
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(Error::file(&path, format!("cannot be removed: {error}")))
        }
        _ => Ok(()),
    }
}
