//! `manylight import-recording`.

use super::Console;
use crate::{Result, recording};
use clap::ValueEnum;
use std::path::PathBuf;

/// Arguments of `import-recording`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The recording of the thesis's program.
    #[arg(value_name = "FILE.bin")]
    file: PathBuf,

    /// Where the JSON goes [default: FILE.json beside it].
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,

    /// Put the eyes of a head-mounted display on the recorded head.
    #[arg(long, value_enum)]
    hmd: Option<Hmd>,
}

/// Head-mounted displays with known eyes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Hmd {
    /// HTC Vive.
    Vive,
}

/// Decodes the recording and writes it as JSON.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    let out = args.out.clone().unwrap_or_else(|| args.file.with_extension("json"));
    let hmd = args.hmd.map(|Hmd::Vive| recording::Hmd::vive());
    let recording = recording::import_bin(&args.file, &recording::ImportOptions { hmd })?;
    recording.save(&out)?;
    console.note(&format!("{} frames written to {}", recording.frame_count(), out.display()));
    Ok(())
}
