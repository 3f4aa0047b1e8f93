//! `manylight selftest`.

use super::{Console, Interrupt};
use crate::replay::Watch;
use crate::selftest::{CHECKS, Context, Options, check_count, self_test};
use crate::{Error, Result};
use std::path::PathBuf;

/// Arguments of `selftest`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Device, as in `replay`.
    #[arg(long, value_name = "NAME|INDEX")]
    device: Option<String>,

    /// Shader sources, as in `replay`: whether changed shaders still do what they must.
    #[arg(long, value_name = "DIR")]
    shaders: Option<PathBuf>,

    /// Turn the validation layers on.
    #[arg(long)]
    validate: bool,

    /// Run this check alone; the flag is repeated for several.
    #[arg(long = "check", value_name = "NAME", long_help = checks_help())]
    checks: Vec<String>,
}

fn checks_help() -> String {
    let names: Vec<&str> = CHECKS.iter().map(|check| check.name).collect();
    format!("Run this check alone; the flag is repeated for several: {}.", names.join(", "))
}

/// Runs the checks and prints a line each; what is wrong is an error.
pub fn run(args: Args, console: &Console) -> Result<()> {
    let Args { device, shaders, validate, checks } = args;
    let options = Options { device, shaders, validate, checks };
    let count = check_count(&options)?;
    let interrupt = Interrupt::install()?;
    let progress = console.progress(count as u64);
    let watch = Watch { interrupt: interrupt.flag(), progress: &|| progress.advance() };
    let mut context = Context::new(options)?;
    let found = self_test(&mut context, &watch, &|name| progress.say(name))?;
    drop(progress);
    console.result(&found)?;
    match found.faults().as_slice() {
        [] => Ok(()),
        faults => Err(Error::Unfit(format!(
            "{} is not fit to be measured: {}",
            found.device.name,
            faults.join(", ")
        ))),
    }
}
