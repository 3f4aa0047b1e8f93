//! `manylight scene`.

use super::Console;
use crate::{Error, Result};

/// Arguments of `scene`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// `street`, `temple`, or the path of a .gltf, .glb or .obj file.
    #[arg(value_name = "NAME|PATH")]
    scene: String,
}

/// Loads the scene and prints what it holds.
pub fn run(args: &Args, _console: &Console) -> Result<()> {
    Err(Error::Internal(format!("scene {} is not connected yet", args.scene)))
}
