//! `manylight replay`.

use super::{Console, Interrupt};
use crate::config::{Config, Layer};
use crate::{Error, Result};
use std::path::PathBuf;

/// Arguments of `replay`: a configuration file, and every field of it as a flag.
#[derive(Debug, clap::Args)]
#[command(after_help = defaults())]
pub struct Args {
    /// JSON configuration over the built-in defaults; flags go over it.
    #[arg(long, value_name = "FILE.json")]
    config: Option<PathBuf>,

    #[command(flatten)]
    layer: Layer,
}

/// The built-in defaults, as a configuration file would put them.
fn defaults() -> String {
    let json = serde_json::to_string(&Config::default()).unwrap_or_default();
    format!("Built-in defaults, as a configuration file:\n{json}")
}

/// Replays and prints the closing table.
pub fn run(args: Args, console: &Console) -> Result<()> {
    let config = Config::resolve(args.config.as_deref(), args.layer)?;
    let _interrupt = Interrupt::install()?;
    console.note(&format!("{} methods", config.methods.len()));
    Err(Error::Internal("replay is not connected yet".into()))
}
