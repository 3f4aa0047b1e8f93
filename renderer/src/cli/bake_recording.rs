//! `manylight bake-recording`.

use super::Console;
use crate::{Result, recording};
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
    let recording = recording::bake(&args.waypoints)?;
    recording.save(&out)?;
    console.note(&format!("{} frames written to {}", recording.frame_count(), out.display()));
    if recording.rain().is_none() {
        console.note("it brings no rain: in a replay it rains in the box around the scene");
    }
    Ok(())
}
