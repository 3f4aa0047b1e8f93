//! The comparison as a summary for a merge request.

use super::table::{interval, load};
use super::{Comparison, Comparisons, Verdict};
use crate::output::FRAME;
use serde::{Serialize, Serializer};
use std::fmt;

/// A comparison whose text is Markdown: every run's frame, every stage that is faster or slower, every difference.
pub struct Markdown<'a>(pub &'a Comparisons);

impl Serialize for Markdown<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl fmt::Display for Markdown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "### manylight compare: {}\n", self.0.verdicts)?;
        self.0.all().try_for_each(|comparison| section(f, comparison))?;
        write!(f, "{}", self.0.about_times())
    }
}

fn section(f: &mut fmt::Formatter<'_>, comparison: &Comparison) -> fmt::Result {
    for (side, set) in [("A", &comparison.a), ("B", &comparison.b)] {
        let (programs, devices) = (set.programs.join(" and "), set.devices.join(" and "));
        writeln!(
            f,
            "- {side}: `{}`, {} runs by {} on {}",
            set.directory,
            set.runs,
            cell(&programs),
            cell(&devices)
        )?;
    }
    match comparison.difference() {
        Some(difference) => writeln!(f, "- **{}**\n", cell(&difference))?,
        None => writeln!(f, "- All counters of {} runs are equal.\n", comparison.runs.len())?,
    }
    for run in &comparison.runs {
        for counter in run.counters.iter().filter(|counter| counter.differs()) {
            writeln!(
                f,
                "- {}: `{}` differs in {} frames",
                cell(&run.run),
                counter.metric,
                counter.frames_differing
            )?;
        }
    }
    for run in &comparison.runs {
        for image in run.images.iter().filter(|image| image.differs()) {
            writeln!(f, "- {}: image {}", cell(&run.run), cell(&image.to_string()))?;
        }
        if let Some(load) = load(run) {
            writeln!(f, "- {}: {load}", cell(&run.run))?;
        }
    }
    let told = |verdict: Verdict| matches!(verdict, Verdict::Faster | Verdict::Slower);
    let mut rows =
        comparison.times().filter(|(_, time)| told(time.verdict) || time.stage == FRAME).peekable();
    if rows.peek().is_none() {
        return Ok(());
    }
    writeln!(f, "\n| run | stage | A ms | B ms | B/A | interval | verdict |")?;
    writeln!(f, "| --- | --- | ---: | ---: | ---: | ---: | --- |")?;
    for (run, time) in rows {
        let mark = if told(time.verdict) { "**" } else { "" };
        writeln!(
            f,
            "| {} | `{}` | {:.3} | {:.3} | {:.3} | {} | {mark}{}{mark} |",
            cell(&run.run),
            time.stage,
            time.a_ms,
            time.b_ms,
            time.ratio,
            interval(time),
            time.verdict,
        )?;
    }
    writeln!(f)
}

/// Text that leaves a cell and a line whole.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace(['\n', '\r'], " ")
}
