//! `manylight scene`.

use super::Console;
use crate::Result;
use crate::inputs::load_scene;

/// Arguments of `scene`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// `street`, `temple`, `hall`, `city`, or the path of a .gltf, .glb or .obj file.
    #[arg(value_name = "NAME|PATH")]
    scene: String,

    /// Refuse an OBJ file, or an MTL file of its, for the first line that would else be a warning.
    #[arg(long)]
    strict: bool,
}

/// Loads the scene and prints what it holds.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    console.result(&load_scene(&args.scene, args.strict)?.describe())
}
