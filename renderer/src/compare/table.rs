//! The comparison as people read it.

use super::{Comparison, Comparisons, CounterComparison, ResultSet, RunComparison, TimeComparison};
use crate::output::{TABLE_LINES, grouped};
use crate::stats::Interval;
use comfy_table::{CellAlignment, ContentArrangement, Table};
use std::fmt;

impl fmt::Display for Comparisons {
    /// Each comparison, then how its verdicts are meant and how many there are of each.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, comparison) in self.all().enumerate() {
            write!(f, "{}{comparison}", if place > 0 { "\n\n" } else { "" })?;
        }
        match self.all().any(|comparison| comparison.times().next().is_some()) {
            true => write!(f, "\n{}", self.about_times()),
            false => Ok(()),
        }
    }
}

impl Comparisons {
    /// The verdicts counted, and what they mean, in one line.
    pub(super) fn about_times(&self) -> String {
        let more =
            if self.verdicts.undecided > 0 { " More temporal runs decide more: `--runs auto`." } else { "" };
        format!(
            "Times: {}. Same is within {} %; intervals are of 95 %, widened for as many as are told.{more}",
            self.verdicts, self.threshold_percent
        )
    }
}

impl fmt::Display for Comparison {
    /// Where results come from, then of every run the counters that differ and the times, then what is missing.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        source(f, "A", &self.a)?;
        source(f, "B", &self.b)?;
        if self.a.devices != self.b.devices {
            writeln!(f, "The devices differ, so ratios of times compare machines.")?;
        }
        self.older.iter().try_for_each(|older| writeln!(f, "{older}"))?;
        for run in &self.runs {
            writeln!(f, "\n{}", run.run)?;
            display_run(f, run)?;
        }
        for (side, missing) in [("A", &self.missing_in_a), ("B", &self.missing_in_b)] {
            for run in missing {
                writeln!(f, "\nmissing in {side}: {run}")?;
            }
        }
        match self.difference() {
            Some(difference) => write!(f, "\n{difference}"),
            None => write!(f, "\nAll counters of {} runs are equal.", self.runs.len()),
        }
    }
}

fn source(f: &mut fmt::Formatter<'_>, side: &str, set: &ResultSet) -> fmt::Result {
    let (programs, devices) = (set.programs.join(" and "), set.devices.join(" and "));
    writeln!(f, "{side}: {}, {} runs by {programs} on {devices}", set.directory, set.runs)
}

fn display_run(f: &mut fmt::Formatter<'_>, run: &RunComparison) -> fmt::Result {
    for (side, frames) in [("A", &run.frames_missing_in_a), ("B", &run.frames_missing_in_b)] {
        if !frames.is_empty() {
            writeln!(f, "  missing in {side}: frames {}", list(frames))?;
        }
    }
    let differing: Vec<_> = run.counters.iter().filter(|counter| counter.differs()).collect();
    if differing.is_empty() {
        writeln!(f, "  counters: all {} equal in {} frames", run.counters.len(), run.frames)?;
    }
    let (other, same): (Vec<_>, Vec<_>) = run.images.iter().partition(|image| image.differs());
    other.iter().try_for_each(|image| writeln!(f, "  image {image}"))?;
    if !same.is_empty() {
        writeln!(f, "  images: {} layers equal in every channel", same.len())?;
    }
    match load(run) {
        _ if run.times.is_empty() => writeln!(f, "  times: not on both sides")?,
        Some(load) => writeln!(f, "  times: {load}")?,
        None => {}
    }
    if differing.is_empty() && run.times.is_empty() {
        return Ok(());
    }
    let mut table = Table::new();
    table.load_preset(TABLE_LINES).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(["metric", "A", "B", "B/A", "over frames", "interval", "verdict"]);
    table.add_rows(differing.iter().map(|counter| counter_row(counter, run.frames)));
    table.add_rows(run.times.iter().map(time_row));
    for column in table.column_iter_mut().skip(1).take(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.lines().try_for_each(|line| writeln!(f, "{}", line.trim_end()))
}

/// What others on the device may account for, where that is more than a percent.
pub(super) fn load(run: &RunComparison) -> Option<String> {
    const TOLD: f64 = 1.01;
    let [a, b] = run.stretch;
    (a > TOLD || b > TOLD).then(|| {
        format!("others on the device's CPUs may have lengthened A's by {a:.2} and B's by {b:.2}: intervals are widened by that")
    })
}

fn counter_row(counter: &CounterComparison, frames: usize) -> [String; 7] {
    let first = counter.first_difference.map(|frame| format!(", first {frame}")).unwrap_or_default();
    [
        counter.metric.clone(),
        counter.a.map(grouped).unwrap_or_default(),
        counter.b.map(grouped).unwrap_or_default(),
        counter.ratio.map(|ratio| format!("{ratio:.6}")).unwrap_or_default(),
        counter.over_frames.map(|s| format!("{:.4} .. {:.4}", s.min, s.max)).unwrap_or_default(),
        String::new(),
        format!("differs in {} of {frames} frames{first}", counter.frames_differing),
    ]
}

fn time_row(time: &TimeComparison) -> [String; 7] {
    let verdict = match time.interval {
        None => "undecided: fewer than 2 temporal runs".to_owned(),
        Some(_) => time.verdict.to_string(),
    };
    [
        format!("{} ms", time.stage),
        format!("{:.3}", time.a_ms),
        format!("{:.3}", time.b_ms),
        format!("{:.3}", time.ratio),
        format!("{:.2} .. {:.2}", time.over_frames.min, time.over_frames.max),
        interval(time),
        verdict,
    ]
}

/// An interval that reaches farther, as a factor, says no more than that.
const TOLD: f64 = 10.0;

/// From where to where the ratio lies; nothing where that is not known.
pub(super) fn interval(time: &TimeComparison) -> String {
    match time.interval {
        Some(Interval { low, high }) if low < 1.0 / TOLD || high > TOLD => "beyond 0.1 .. 10".to_owned(),
        Some(Interval { low, high }) => format!("{low:.3} .. {high:.3}"),
        None => String::new(),
    }
}

/// Frame numbers, the first few of many.
fn list(frames: &[u32]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = frames.iter().take(SHOWN).map(u32::to_string).collect();
    match frames.len().saturating_sub(SHOWN) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}
