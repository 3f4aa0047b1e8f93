//! Command line: arguments in, one exit code out. Each subcommand's handler is a file of its own.

mod bake_recording;
mod bench;
mod compare;
mod completions;
mod console;
mod devices;
mod export;
mod import_recording;
mod interrupt;
mod replay;
mod report;
mod scene;
mod selftest;
mod still;
mod tune;
mod usage;

pub use console::{Console, FrameBar, Progress};
pub use interrupt::Interrupt;

use crate::Result;
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Replays recordings of many-light scenes and measures, stage by stage, how clustered shading works.
#[derive(Debug, Parser)]
#[command(name = "manylight", version, long_version = LONG_VERSION, after_help = EXIT_CODES, max_term_width = 100)]
#[command(arg_required_else_help = true)]
struct Cli {
    /// Neither progress bar nor notes: the result and errors alone.
    #[arg(long, short, global = true)]
    quiet: bool,

    /// For machines: the result as JSON on standard output, an error as a JSON object on standard error.
    #[arg(long, global = true)]
    json: bool,

    #[command(subcommand)]
    command: Command,
}

const LONG_VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("MANYLIGHT_GIT_REVISION"), ")");

const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    the program or the driver misbehaved: a validation message, a lost device;
       `compare` found counters that differ, or a time slower than --fail-slower allows;
       or `selftest` something wrong
  2    something to be mended: a flag, a file, a missing device
  3    some runs of a replay failed; each left OUT/<run>.error.json, and the others are complete
  130  interrupted; the frame was finished and what was complete is kept
  141  done, but the reader of standard output (`| head`) went away before all was printed

The environment variable RUST_LOG (warn, info, debug, ...) sets how much is logged to standard error.";

/// The exit code where the reader of standard output went away: that of a program which SIGPIPE ends, as shells have it.
const UNREAD: u8 = 141;

#[derive(Debug, Subcommand)]
enum Command {
    /// Replay a recording by one or more methods, and time and count every stage
    Replay(Box<replay::Args>),
    /// Draw the figures of results, check the claims, write it all as one page
    Report(report::Args),
    /// Look at one frame from any camera: clusters, frusta, light volumes, heat maps
    Still(Box<still::Args>),
    /// Find the sizes, ways of assignment and tests by which methods are fastest
    Tune(Box<tune::Args>),
    /// Compare result sets run by run: counters exactly, times against their noise
    Compare(compare::Args),
    /// Write results as one table for pandas, R or a spreadsheet
    Export(export::Args),
    /// Measure one part by itself
    #[command(subcommand)]
    Bench(bench::Bench),
    /// Whether a device and its driver are fit to be measured: timestamps, lists, pictures, counters
    Selftest(selftest::Args),
    /// List the Vulkan devices, with the limits that matter
    Devices,
    /// Print a scene's triangles, materials, textures and bounds
    Scene(scene::Args),
    /// Turn a recording of the thesis's program (.bin) into JSON
    ImportRecording(import_recording::Args),
    /// Spline waypoints (position, target, time) to a recording
    BakeRecording(bake_recording::Args),
    /// Print a completion script for a shell
    Completions(completions::Args),
}

/// Runs the program on the process's arguments.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return usage::exit(&error),
    };
    let console = Console::new(cli.quiet, cli.json);
    console.start_logging();
    match dispatch(cli.command, &console) {
        Ok(()) if console.unread() => ExitCode::from(UNREAD),
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            console.error(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

fn dispatch(command: Command, console: &Console) -> Result<()> {
    match command {
        Command::Replay(args) => replay::run(*args, console),
        Command::Report(args) => report::run(&args, console),
        Command::Still(args) => still::run(*args, console),
        Command::Tune(args) => tune::run(*args, console),
        Command::Compare(args) => compare::run(&args, console),
        Command::Export(args) => export::run(&args, console),
        Command::Bench(args) => bench::run(args, console),
        Command::Selftest(args) => selftest::run(args, console),
        Command::Devices => devices::run(console),
        Command::Scene(args) => scene::run(&args, console),
        Command::ImportRecording(args) => import_recording::run(&args, console),
        Command::BakeRecording(args) => bake_recording::run(&args, console),
        Command::Completions(args) => completions::run(&args, console),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_declared_consistently() {
        Cli::command().debug_assert();
    }

    /// Flags of replay that are no fields: they say which runs are made and what comes after them, not what a run is.
    const ABOUT_RUNS: [&str; 7] = ["config", "report", "shard", "only", "force", "list-runs", "summarize"];

    /// Fields of several values whose flag is given for each.
    const ONE_EACH: [(&str, &str); 2] = [("methods", "method"), ("light_volumes", "light-volume")];

    fn flag_of(field: &str) -> String {
        let one = ONE_EACH.iter().find(|(several, _)| *several == field);
        one.map_or_else(|| field.replace('_', "-"), |(_, flag)| (*flag).to_owned())
    }

    #[test]
    fn every_field_is_a_flag_of_replay_and_every_flag_a_field_or_about_runs() {
        let mut cli = Cli::command();
        let replay = cli.find_subcommand_mut("replay").unwrap();
        let mut flags: Vec<String> =
            replay.get_arguments().filter_map(|arg| arg.get_long()).map(str::to_owned).collect();
        let schema = crate::config::json_schema();
        let fields = schema["properties"].as_object().unwrap().keys().filter(|field| *field != "$schema");
        let mut known: Vec<String> =
            fields.map(|field| flag_of(field)).chain(ABOUT_RUNS.map(str::to_owned)).collect();
        flags.sort_unstable();
        known.sort_unstable();
        assert_eq!(flags, known);
    }

    #[test]
    fn global_flags_stand_anywhere() {
        let cli = Cli::try_parse_from(["manylight", "devices", "--json", "--quiet"]).unwrap();
        assert!(cli.json && cli.quiet);
    }
}
