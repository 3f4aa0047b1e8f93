//! `manylight compare`.

use super::Console;
use crate::compare::{Markdown, Options, compare, write_page};
use crate::output::prepare_file;
use crate::{Error, Result};
use std::path::PathBuf;

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Results that ratios are to: a run's directory, or one with runs below it.
    #[arg(value_name = "A")]
    base: PathBuf,

    /// Results to compare with them; of several, each by itself.
    #[arg(value_name = "B", required = true)]
    others: Vec<PathBuf>,

    /// By how many percent times may differ and still be the same: a smaller difference does not matter.
    #[arg(long, value_name = "PERCENT", default_value = "1", value_parser = percent)]
    threshold: f64,

    /// End with exit code 1 where a time is slower by more than this: where the whole interval of its ratio lies beyond.
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    fail_slower: Option<f64>,

    /// Print a summary in Markdown: every run's frame, every stage that is faster or slower, every difference.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,

    /// Write the comparison as a page that opens offline.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,

    /// Write pictures of what differs between rendered frames: how different colours look (FLIP), and which pixels differ
    /// in lights, fragments or clusters.
    #[arg(long, value_name = "DIR")]
    pictures: Option<PathBuf>,
}

/// Prints the comparison; differing counters, frames or runs are an error, and so is what is slower than is allowed.
pub fn run(args: &Args, console: &Console) -> Result<()> {
    if let Some(page) = &args.html {
        prepare_file(page)?;
    }
    let options = Options { threshold_percent: args.threshold, pictures: args.pictures.clone() };
    let comparisons = compare(&args.base, &args.others, &options)?;
    if let Some(page) = &args.html {
        write_page(page, &comparisons)?;
    }
    if args.markdown { console.result(&Markdown(&comparisons)) } else { console.result(&comparisons) }?;
    let slower = args.fail_slower.and_then(|percent| comparisons.slower_than(percent));
    let faults: Vec<String> = comparisons.difference().into_iter().chain(slower).collect();
    if faults.is_empty() { Ok(()) } else { Err(Error::Difference(faults.join("; "))) }
}

fn percent(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(percent) if (0.0..=1000.0).contains(&percent) => Ok(percent),
        _ => Err("give a percentage from 0 to 1000, such as 5".into()),
    }
}
