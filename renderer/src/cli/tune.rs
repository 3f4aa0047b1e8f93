//! `manylight tune`.

use super::{Console, FrameBar, Interrupt};
use crate::config::Layer;
use crate::output::{prepare_file, write_whole};
use crate::tune::{defaults, tune};
use crate::{Error, Result};
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `tune`: those of the replay that is made faster, and where its configuration goes.
#[derive(Debug, clap::Args)]
#[command(args_override_self = true)]
pub struct Args {
    /// JSON configuration over the built-in defaults; flags go over it. `methods` says where the search starts; `assign`
    /// (brute, hierarchy, scatter, rectangles for test mm), `test` (auto, exact, hs+sat-n) and `clusters` what is tried. `runs` (auto) is
    /// how often the last few are timed.
    #[arg(long, value_name = "FILE.json")]
    config: Option<PathBuf>,

    /// The configuration that replays what was found.
    #[arg(long, value_name = "FILE.json")]
    write: PathBuf,

    #[command(flatten)]
    layer: Layer,
}

/// Searches, writes the configuration, and prints the closing table.
pub fn run(args: Args, console: &Console) -> Result<()> {
    let config = defaults().under(args.config.as_deref(), args.layer)?;
    prepare_file(&args.write)?;
    let interrupt = Interrupt::install()?;
    let bar = FrameBar::new(console);
    let (tuning, tuned) = tune(&config, interrupt.flag(), &bar).map_err(of_nothing)?;
    drop(bar);
    let text = serde_json::to_string_pretty(&tuned)
        .map_err(|error| Error::Internal(format!("the configuration is not JSON: {error}")))?;
    write_whole(&args.write, |file| writeln!(file, "{text}"))?;
    console.result(&tuning)?;
    console.note(&format!("replay it with: manylight replay --config {}", args.write.display()));
    Ok(())
}

/// An interruption, which keeps nothing here.
fn of_nothing(error: Error) -> Error {
    match error {
        Error::Interrupted(_) => Error::Interrupted("interrupted: nothing was written".into()),
        other => other,
    }
}
