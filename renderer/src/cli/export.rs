//! `manylight export`.

use super::Console;
use crate::Result;
use crate::export::{Rows, export};
use std::path::PathBuf;

/// Arguments of `export`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Directories that replays wrote; every run below them is taken.
    #[arg(value_name = "DIR", required = true)]
    directories: Vec<PathBuf>,

    /// The table.
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,

    /// A row for every stage of every frame of every temporal run, instead of one for every frame.
    #[arg(long)]
    stages: bool,

    /// A row for every structure on the device, with the bytes that it takes, instead.
    #[arg(long, conflicts_with = "stages")]
    memory: bool,
}

/// Writes the table and says what is in it.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    let rows = match (args.stages, args.memory) {
        (true, _) => Rows::Stages,
        (_, true) => Rows::Memory,
        _ => Rows::Frames,
    };
    console.result(&export(&args.directories, rows, &args.out)?)
}
