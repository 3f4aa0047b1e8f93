//! `manylight completions`.

use super::{Cli, Console};
use crate::Result;
use clap::CommandFactory;
use clap_complete::Shell;

/// Arguments of `completions`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the completion script.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    // Into memory first: clap_complete panics where standard output goes away.
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "manylight", &mut script);
    console.print(&String::from_utf8_lossy(&script))
}
