//! The closing table: one row a method and lighting, with ratios to Indi Persp.

mod columns;

pub use columns::{Intervals, Values};
pub(crate) use columns::{grouped, with_interval};

use super::run_times::MeasuredTimes;
use crate::config::{Axis, Labels, Role};
use crate::methods::Method;
use crate::stats::Interval;
use columns::{COLUMNS, Column, ratio_cell};
use comfy_table::{CellAlignment, ContentArrangement, Table};
use serde::Serialize;
use serde::ser::Serializer;
use std::fmt;
use std::io::{self, Write};

/// One run as the table takes it.
#[derive(Debug, Clone, PartialEq)]
pub struct RunMeans {
    /// How lights were found.
    pub method: Method,
    /// What it is called.
    pub labels: Labels,
    /// How many frames the means are over.
    pub frames: usize,
    /// The means.
    pub means: Values,
    /// The times among them, with their noise.
    pub times: MeasuredTimes,
}

/// One method under one lighting in one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SummaryRow {
    /// What it is called: a field an axis that tells runs apart.
    #[serde(flatten, serialize_with = "label_fields")]
    pub labels: Labels,
    /// How many frames the means are over.
    pub frames: usize,
    /// The means.
    #[serde(flatten)]
    pub means: Values,
    /// The method that ratios are to.
    pub reference: String,
    /// The ratios.
    pub ratios: Values,
    /// How many temporal runs the times are over. Of one alone, intervals are over its frames.
    pub runs: usize,
    /// Intervals of times.
    pub intervals: Intervals,
    /// Intervals of ratios of times, paired by frame and run.
    pub ratio_intervals: Intervals,
}

/// The closing table of a replay.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Summary {
    /// In the order of the runs.
    pub rows: Vec<SummaryRow>,
}

impl Summary {
    /// Sums up runs. The reference of a scene's lighting is its first Indi Persp, else its first method.
    pub fn from_means(runs: &[RunMeans]) -> Self {
        let rows = runs.iter().map(|run| {
            let reference = &runs[reference(runs, run)];
            SummaryRow {
                labels: run.labels.clone(),
                frames: run.frames,
                means: run.means,
                reference: reference.method.to_string(),
                ratios: run.means.over(&reference.means),
                runs: run.times.runs,
                intervals: Intervals::of(&run.times),
                ratio_intervals: Intervals::of_ratios(&run.times, &reference.times),
            }
        });
        Self { rows: rows.collect() }
    }

    /// The axes that name rows: those that tell rows apart, and the method and its lighting always.
    fn naming_axes(&self) -> Vec<&'static Axis> {
        let needed = |axis: &&Axis| {
            matches!(axis.role, Role::Method | Role::Lighting)
                || self.rows.iter().any(|row| !row.labels.get(axis).is_empty())
        };
        Axis::told().filter(needed).collect()
    }

    /// The columns of numbers: those of exceptions where there are any.
    fn columns(&self) -> Vec<&'static Column> {
        let told = |column: &&Column| {
            !column.exception || self.rows.iter().any(|row| row.means.get(column.name).is_some())
        };
        COLUMNS.iter().filter(told).collect()
    }

    /// Writes the table as CSV: what names a row, means, the reference, ratios; then how many temporal runs there were, and
    /// the ends of the intervals of times and of their ratios.
    ///
    /// # Errors
    /// The writer fails.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        let naming = self.naming_axes();
        let header = naming.iter().map(|axis| axis.column.to_owned()).chain(["frames".to_owned()]);
        let columns = self.columns();
        let means = columns.iter().map(|column| column.name.to_owned());
        let ratios = columns.iter().map(|column| format!("{}_ratio", column.name));
        let timed = || columns.iter().filter(|column| column.time.is_some());
        let ends = |what: &'static str| {
            timed().flat_map(move |column| ["low", "high"].map(|end| format!("{}{what}_{end}", column.name)))
        };
        let intervals = ["runs".to_owned()].into_iter().chain(ends("")).chain(ends("_ratio"));
        csv.write_record(header.chain(means).chain(["reference".to_owned()]).chain(ratios).chain(intervals))?;
        for row in &self.rows {
            let names =
                naming.iter().map(|axis| row.labels.get(axis).to_owned()).chain([row.frames.to_string()]);
            let means = columns.iter().map(|column| column.cell(row.means.get(column.name)));
            let ratios = columns.iter().map(|column| ratio_cell(row.ratios.get(column.name)));
            let intervals = [row.intervals, row.ratio_intervals];
            let ends = intervals.iter().flat_map(|intervals| {
                timed().flat_map(|column| {
                    let interval = intervals.get(column.name);
                    Interval::ends(interval).map(ratio_cell)
                })
            });
            let runs = [row.runs.to_string()];
            csv.write_record(
                names.chain(means).chain([row.reference.clone()]).chain(ratios).chain(runs).chain(ends),
            )?;
        }
        csv.flush()
    }
}

/// A field for each label that is told.
fn label_fields<S: Serializer>(labels: &Labels, serializer: S) -> Result<S::Ok, S::Error> {
    let told = labels.iter().filter(|(_, label)| !label.is_empty());
    serializer.collect_map(told.map(|(axis, label)| (axis.column, label)))
}

/// Index of the run that the ratios of `of` are to. Where there are several ways or tests, it is by the first.
fn reference(runs: &[RunMeans], of: &RunMeans) -> usize {
    let under = |run: &RunMeans| {
        run.labels.of(&[Role::Scene, Role::Lighting]) == of.labels.of(&[Role::Scene, Role::Lighting])
    };
    let find = |wanted: &dyn Fn(&RunMeans) -> bool| runs.iter().position(|run| under(run) && wanted(run));
    find(&|run| is_indi_persp(&run.method)).or_else(|| find(&|_| true)).unwrap_or(0)
}

fn is_indi_persp(method: &Method) -> bool {
    method.kind().name == "indi-persp"
}

/// Lines above, below and under the header, none between rows: characters in the order of comfy-table's presets.
pub(crate) const TABLE_LINES: &str = "  ── ══      ──    ";

impl fmt::Display for Summary {
    /// The table, each value with its ratio in brackets, and a line that says what ratios are to.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = Table::new();
        table.load_preset(TABLE_LINES).set_content_arrangement(ContentArrangement::Disabled);
        let naming = self.naming_axes();
        let names = naming.iter().map(|axis| axis.name);
        let columns = self.columns();
        table.set_header(names.chain(columns.iter().map(|column| column.heading)));
        for row in &self.rows {
            let cells = columns.iter().map(|column| {
                let name = column.name;
                column.shown(
                    (row.means.get(name), row.intervals.get(name)),
                    (row.ratios.get(name), row.ratio_intervals.get(name)),
                )
            });
            table.add_row(naming.iter().map(|axis| row.labels.get(axis).to_owned()).chain(cells));
        }
        for (column, index) in table.column_iter_mut().zip(0..) {
            let is_name = naming.get(index).is_some_and(|axis| axis.role != Role::Lighting);
            column.set_cell_alignment(if is_name { CellAlignment::Left } else { CellAlignment::Right });
        }
        for line in table.lines() {
            writeln!(f, "{}", line.trim_end())?;
        }
        write!(
            f,
            "Means over frames; in brackets the ratio to {}.{}",
            self.references(),
            self.about_intervals()
        )
    }
}

impl Summary {
    /// What `±` means in the table; nothing where there is none.
    fn about_intervals(&self) -> String {
        let with =
            self.rows.iter().filter(|row| row.intervals.iter().any(|(_, interval)| interval.is_some()));
        let runs: std::collections::BTreeSet<usize> = with.map(|row| row.runs).collect();
        let list = runs.iter().map(usize::to_string).collect::<Vec<_>>().join(" or ");
        match (runs.first(), runs.last()) {
            (Some(_), Some(1)) => {
                " ± is half the 95 % interval over frames alone: one temporal run tells nothing of \
                                   the noise of measuring."
                    .into()
            }
            (Some(_), Some(_)) => format!(" ± is half the 95 % interval by {list} temporal runs."),
            _ => String::new(),
        }
    }

    /// The reference methods, each once.
    fn references(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !names.contains(&row.reference.as_str()) {
                names.push(&row.reference);
            }
        }
        let several = |role: Role| {
            let labels = |row: &SummaryRow| row.labels.of(&[role]).join(" ");
            self.rows.iter().any(|row| labels(row) != labels(&self.rows[0]))
        };
        let lights = if several(Role::Lighting) { " under the same lights" } else { "" };
        let ways = several(Role::Way);
        names.join(" and ") + lights + if ways { ", by its first way and test" } else { "" }
    }
}
