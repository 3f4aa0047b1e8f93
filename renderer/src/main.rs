//! The `manylight` program.

use std::process::ExitCode;

fn main() -> ExitCode {
    manylight::cli::main()
}
