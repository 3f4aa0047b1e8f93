//! `manylight bake-recording`.

use super::Console;
use crate::{Error, Result};
use std::path::PathBuf;

/// Arguments of `bake-recording`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Waypoints of position, target and time.
    #[arg(value_name = "WAYPOINTS.json")]
    waypoints: PathBuf,

    /// Where the recording goes [default: WAYPOINTS.recording.json beside it].
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,
}

/// Splines the waypoints and writes the recording.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    let out = args.out.clone().unwrap_or_else(|| args.waypoints.with_extension("recording.json"));
    console.note(&format!("to {}", out.display()));
    Err(Error::Internal("bake-recording is not connected yet".into()))
}
