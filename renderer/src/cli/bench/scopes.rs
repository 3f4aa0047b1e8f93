//! `manylight bench scopes`.

use crate::cli::{Console, Interrupt};
use crate::config::{Config, Layer, Runs};
use crate::inputs::Inputs;
use crate::replay::bench::{ScopesRow, bench_scopes};
use crate::replay::{Watch, frame_total};
use crate::{Error, Result};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Arguments of `bench scopes`: those of the replay whose measuring is measured.
#[derive(Debug, clap::Args)]
#[command(args_override_self = true)]
pub struct Args {
    /// JSON configuration over the built-in defaults; flags go over it. `runs` is how often each frame is timed.
    #[arg(long, value_name = "FILE.json")]
    config: Option<PathBuf>,

    #[command(flatten)]
    layer: Layer,
}

/// Measures, and prints a line a run.
pub fn run(args: Args, console: &Console) -> Result<()> {
    if args.layer.scopes.is_some() {
        return Err(Error::input("scopes: both kinds are measured here: leave --scopes out"));
    }
    let config = Config::resolve(args.config.as_deref(), args.layer)?;
    if config.runs == Runs::Auto {
        return Err(Error::input(
            "runs: each frame is timed a given number of times here: give --runs a number",
        ));
    }
    if config.runs.is_none() {
        return Err(Error::input("runs: nothing is timed in 0 runs: give --runs 1 or more"));
    }
    let [config] = <[Config; 1]>::try_from(config.by_scene()).map_err(|_| {
        let message = "scenes: one scene in one resolution at a time is measured here: give --scene, --recording and --resolution";
        Error::input(message)
    })?;
    let interrupt = Interrupt::install()?;
    let inputs = Inputs::load(&config)?;
    inputs.notes(&config.methods).for_each(|note| console.note(&note));
    let runs = config.methods.len() * config.lights_from().len();
    let progress = console.progress(frame_total(&config, &inputs.recording, runs)?);
    let watch = Watch { interrupt: interrupt.flag(), progress: &|| progress.advance() };
    let rows = bench_scopes(&config, &inputs, &watch)?;
    drop(progress);
    console.result(&Rows(rows))
}

/// A line a run.
#[derive(Serialize)]
struct Rows(Vec<ScopesRow>);

impl fmt::Display for Rows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|row| writeln!(f, "{row}"))
    }
}
