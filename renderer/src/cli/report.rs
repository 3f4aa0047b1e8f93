//! `manylight report`.

use super::Console;
use crate::Result;
use crate::report::write_report;
use std::path::PathBuf;

/// Arguments of `report`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Directories that replays wrote; every run below them is taken.
    #[arg(value_name = "DIR", required = true)]
    directories: Vec<PathBuf>,

    /// Where the report goes; by default `report` in the first directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Writes the report and prints what it holds.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    console.result(&write_report(&args.directories, args.out.as_deref())?)
}
