//! `manylight compare`.

use super::Console;
use crate::compare::compare;
use crate::{Error, Result};
use std::path::PathBuf;

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Results that ratios are to: a run's directory, or one with runs below it.
    a: PathBuf,

    /// Results to compare with them.
    b: PathBuf,
}

/// Prints the comparison; differing counters, frames or runs are an error.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    let comparison = compare(&args.a, &args.b)?;
    console.result(&comparison)?;
    comparison.difference().map_or(Ok(()), |difference| Err(Error::Difference(difference)))
}
