//! What the self-test says.

use crate::vk::DeviceInfo;
use serde::Serialize;
use std::fmt;

/// What one check found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// All is well; what was measured.
    Fine(String),
    /// Nothing that makes the device unfit, but good to know.
    Note(String),
    /// What is wrong.
    Wrong(String),
    /// Why nothing was found: something else is wrong, which other checks may tell.
    Failed(String),
}

impl Verdict {
    /// Fine with what was measured, unless there is a fault.
    pub fn of(fault: Option<String>, measured: impl FnOnce() -> String) -> Self {
        fault.map_or_else(|| Self::Fine(measured()), Self::Wrong)
    }
}

/// A check with its verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outcome {
    /// Its name.
    pub check: &'static str,
    /// `ok`, `note` or `wrong`.
    pub verdict: &'static str,
    /// What was measured, or what is wrong.
    pub found: String,
    /// What it means for results; `None` where all is well.
    pub means: Option<&'static str>,
    /// How long it took.
    pub seconds: f64,
}

impl Outcome {
    /// Of a check that says, where it does not find all well, what that means.
    pub fn new(check: &'static str, means: &'static str, verdict: Verdict, seconds: f64) -> Self {
        let (verdict, found, means) = match verdict {
            Verdict::Fine(found) => ("ok", found, None),
            Verdict::Note(found) => ("note", found, Some(means)),
            Verdict::Wrong(found) => ("wrong", found, Some(means)),
            Verdict::Failed(error) => ("wrong", format!("cannot be checked: {error}"), None),
        };
        Self { check, verdict, found, means, seconds }
    }
}

/// What all checks found on a device.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SelfTest {
    /// The device.
    pub device: DeviceInfo,
    /// In the order in which they ran.
    pub checks: Vec<Outcome>,
}

impl SelfTest {
    /// What makes the device unfit: the names of the checks that found something wrong.
    pub fn faults(&self) -> Vec<&'static str> {
        self.checks.iter().filter(|outcome| outcome.verdict == "wrong").map(|outcome| outcome.check).collect()
    }
}

impl fmt::Display for SelfTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Outcome { check, verdict, found, means, .. } in &self.checks {
            write!(f, "{verdict:5}  {check:10}  {}", found.replace('\n', " "))?;
            writeln!(f, "{}", means.map_or(String::new(), |means| format!(" ({means})")))?;
        }
        let DeviceInfo { name, driver, driver_version, .. } = &self.device;
        let seconds: f64 = self.checks.iter().map(|outcome| outcome.seconds).sum();
        let fit = if self.faults().is_empty() { "found nothing wrong" } else { "is not fit to be measured" };
        let count = self.checks.len();
        write!(f, "{name}, {driver} {driver_version}: {fit}, {count} checks in {seconds:.0} s")
    }
}
