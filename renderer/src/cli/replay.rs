//! `manylight replay`.

use super::{Console, FrameBar, Interrupt};
use crate::audience::Audience;
use crate::config::{Config, Layer};
use crate::output::{Summary, write_summary};
use crate::report::write_report;
use crate::sweep::{Doubtful, Outcome, Part, Selection, Sweep, parts, summary};
use crate::{Error, Result};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Arguments of `replay`: a configuration file, every field of it as a flag, and which runs of it to make.
#[derive(Debug, clap::Args)]
#[command(args_override_self = true)]
pub struct Args {
    /// JSON configuration over the built-in defaults; flags go over it.
    #[arg(long, value_name = "FILE.json")]
    config: Option<PathBuf>,

    /// Afterwards write a report on everything in the output directory, as `manylight report` does.
    #[arg(long)]
    report: bool,

    #[command(flatten)]
    layer: Layer,

    #[command(flatten)]
    selection: Selection,

    /// Make complete runs again; without it, a run whose inputs, program and device are unchanged is skipped.
    #[arg(long)]
    force: bool,

    /// Print the names of the runs, one a line, and make none.
    #[arg(long, conflicts_with = "summarize")]
    list_runs: bool,

    /// Make no run: write and print the closing table of the complete runs in the output directory.
    #[arg(long)]
    summarize: bool,
}

/// Makes the runs that are asked for and not there yet, and prints the closing table of all that are there.
pub fn run(args: Args, console: &Console) -> Result<()> {
    let config = Config::resolve(args.config.as_deref(), args.layer)?;
    let whole = parts(&config)?;
    let chosen = args.selection.choose(&whole)?;
    if args.list_runs {
        return console.result(&RunNames::of(&chosen));
    }
    if args.summarize {
        let table = summary(&whole)?;
        if table.rows.is_empty() {
            return Err(Error::file(&config.out, "holds no complete run of this configuration"));
        }
        return close((&config, &whole), &table, args.report, console);
    }
    let (outcome, ended) = sweep(&chosen, args.force, console)?;
    let table = summary(&whole);
    if let Err(error) = ended {
        // What ended the sweep is the first thing to say, whatever becomes of the table.
        if let Ok(table) = &table
            && !table.rows.is_empty()
        {
            write_summary(&config.out, table)?;
        }
        return Err(with_progress(error, &outcome, &chosen));
    }
    let table = table?;
    if !table.rows.is_empty() {
        close((&config, &whole), &table, args.report, console)?;
    }
    if outcome.skipped > 0 {
        console.note(&format!("{} of {} runs were complete and unchanged", outcome.skipped, count(&chosen)));
    }
    failures(&outcome, count(&chosen))
}

/// Runs the sweep; an error that comes before anything was done is the outer one.
fn sweep(chosen: &[Part], force: bool, console: &Console) -> Result<(Outcome, Result<()>)> {
    let interrupt = Interrupt::install()?;
    let bar = FrameBar::new(console);
    let mut sweep = Sweep::new(chosen, force, interrupt.flag(), &bar)?;
    bar.more(sweep.frames()?);
    let ended = sweep.run();
    Ok((std::mem::take(&mut sweep.outcome), ended))
}

/// Writes and prints the table, and the report where it is asked for; says which times are doubtful.
fn close(
    (config, parts): (&Config, &[Part]),
    table: &Summary,
    report: bool,
    console: &Console,
) -> Result<()> {
    write_summary(&config.out, table)?;
    let written = report.then(|| write_report(std::slice::from_ref(&config.out), None)).transpose()?;
    console.result(table)?;
    let doubtful = Doubtful::of(parts)?;
    if !doubtful.runs.is_empty() {
        console.note(&doubtful.to_string());
    }
    console.note(&format!("results are in {}", config.out.display()));
    if let Some(report) = written {
        console.note(&format!("the report is {}", report.page.display()));
    }
    Ok(())
}

fn count(parts: &[Part]) -> usize {
    parts.iter().map(|part| part.runs.len()).sum()
}

/// An interruption that says what was kept.
fn with_progress(error: Error, outcome: &Outcome, chosen: &[Part]) -> Error {
    match error {
        Error::Interrupted(message) => {
            let done = outcome.made + outcome.skipped;
            Error::Interrupted(format!("{message} ({done} of {})", count(chosen)))
        }
        other => other,
    }
}

fn failures(outcome: &Outcome, all: usize) -> Result<()> {
    let Some(first) = outcome.failed.first() else { return Ok(()) };
    Err(Error::Failures(format!(
        "{} of {all} runs failed, each left its <run>.error.json; the first was {}: {}",
        outcome.failed.len(),
        first.run,
        first.error
    )))
}

/// Full names of runs.
#[derive(Serialize)]
#[serde(transparent)]
struct RunNames(Vec<String>);

impl RunNames {
    fn of(parts: &[Part]) -> Self {
        Self(parts.iter().flat_map(|part| part.runs.iter().map(|run| part.full_name(run))).collect())
    }
}

impl fmt::Display for RunNames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join("\n"))
    }
}
