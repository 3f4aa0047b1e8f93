//! `manylight import-recording`.

use super::Console;
use crate::geometry::views::Mirror;
use crate::{Result, recording};
use clap::ValueEnum;
use glam::DVec3;
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

    /// One more view, `mirror`, that sees the world reflected at the plane of the points p with N·p = D; the normal N points
    /// to the side that is seen.
    #[arg(long, value_name = "NX,NY,NZ,D", value_parser = mirror, allow_hyphen_values = true, requires = "hmd")]
    mirror: Option<Mirror>,
}

/// Reads `NX,NY,NZ,D`; the normal may be of any length.
fn mirror(text: &str) -> std::result::Result<Mirror, String> {
    let wrong = || format!("`{text}` is no plane NX,NY,NZ,D such as 0,1,0,0");
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| wrong()))
        .collect::<std::result::Result<_, _>>()?;
    let [x, y, z, offset] = numbers[..] else { return Err(wrong()) };
    let normal = DVec3::new(x, y, z);
    let unit = normal.try_normalize().ok_or_else(|| format!("`{text}`: the normal has no direction"))?;
    Ok(Mirror { normal: unit, offset: offset / normal.length() })
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
    let hmd = hmd.map(|hmd| args.mirror.map_or(hmd.clone(), |mirror| hmd.with_mirror(mirror)));
    let recording = recording::import_bin(&args.file, &recording::ImportOptions { hmd })?;
    recording.save(&out)?;
    console.note(&format!("{} frames written to {}", recording.frame_count(), out.display()));
    Ok(())
}
