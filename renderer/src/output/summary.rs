//! The closing table: one row a method and lighting, with ratios to Indi Persp.

use super::stages::StageMinima;
use super::tables::optional_ms;
use crate::measure::{FrameCounts, FrameTimes};
use crate::methods::{MethodSpec, Sharing, Space};
use comfy_table::{CellAlignment, ContentArrangement, Table};
use serde::Serialize;
use std::fmt;
use std::io::{self, Write};

/// What one run measured.
#[derive(Debug, Clone, Copy)]
pub struct MethodRun<'a> {
    /// How lights were found.
    pub method: MethodSpec,
    /// Name of the lighting: see [`super::PlannedRun::lighting`].
    pub lighting: &'a str,
    /// The atemporal run's frames.
    pub counts: &'a [FrameCounts],
    /// The temporal runs' frames; empty where there were none.
    pub times: &'a [FrameTimes],
}

/// Means over the frames of one run. Milliseconds are GPU time, of each stage the minimum over the temporal runs;
/// `None` where there were none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Values {
    /// Visible clusters, summed over clusterings.
    pub visible_clusters: f64,
    /// Light indices, summed over clusterings.
    pub light_indices: f64,
    /// Lighting computations.
    pub lighting_computations: f64,
    /// Clustering.
    pub clustering_ms: Option<f64>,
    /// Shading.
    pub shading_ms: Option<f64>,
    /// The whole frame.
    pub total_ms: Option<f64>,
}

/// [`Values`] over those of the reference method; `None` where either is missing or the reference is 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Ratios {
    /// Of visible clusters.
    pub visible_clusters: Option<f64>,
    /// Of light indices.
    pub light_indices: Option<f64>,
    /// Of lighting computations.
    pub lighting_computations: Option<f64>,
    /// Of clustering time.
    pub clustering_ms: Option<f64>,
    /// Of shading time.
    pub shading_ms: Option<f64>,
    /// Of total time.
    pub total_ms: Option<f64>,
}

/// One run as the table takes it.
#[derive(Debug, Clone, PartialEq)]
pub struct RunMeans {
    /// The scene's directory, empty where there is one scene.
    pub scene: String,
    /// How lights were found.
    pub method: MethodSpec,
    /// Name of the lighting: see [`super::PlannedRun::lighting`].
    pub lighting: String,
    /// The way of assignment, empty where the sweep has one.
    pub assign: String,
    /// The test of light against cluster, empty where the sweep has one.
    pub test: String,
    /// How many frames the means are over.
    pub frames: usize,
    /// The means.
    pub means: Values,
}

/// One method under one lighting in one scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SummaryRow {
    /// The scene's directory, empty where there is one scene.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub scene: String,
    /// The method's name.
    pub method: String,
    /// The lighting's name.
    pub lighting: String,
    /// The way of assignment, empty where the sweep has one.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub assign: String,
    /// The test of light against cluster, empty where the sweep has one.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub test: String,
    /// How many frames the means are over.
    pub frames: usize,
    /// The means.
    #[serde(flatten)]
    pub means: Values,
    /// The method that ratios are to.
    pub reference: String,
    /// The ratios.
    pub ratios: Ratios,
}

/// The closing table of a replay.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Summary {
    /// In the order of the runs.
    pub rows: Vec<SummaryRow>,
}

impl Summary {
    /// Sums up runs of one scene.
    pub fn from_runs(runs: &[MethodRun<'_>]) -> Self {
        let means = runs.iter().map(|run| RunMeans {
            scene: String::new(),
            method: run.method,
            lighting: run.lighting.to_owned(),
            assign: String::new(),
            test: String::new(),
            frames: run.counts.len(),
            means: Values::mean(run),
        });
        Self::from_means(&means.collect::<Vec<_>>())
    }

    /// Sums up runs. The reference of a scene's lighting is its first Indi Persp, else its first method.
    pub fn from_means(runs: &[RunMeans]) -> Self {
        let rows = runs.iter().map(|run| {
            let reference = &runs[reference(runs, run)];
            SummaryRow {
                scene: run.scene.clone(),
                method: run.method.to_string(),
                lighting: run.lighting.clone(),
                assign: run.assign.clone(),
                test: run.test.clone(),
                frames: run.frames,
                means: run.means,
                reference: reference.method.to_string(),
                ratios: Ratios::of(&run.means, &reference.means),
            }
        });
        Self { rows: rows.collect() }
    }

    /// The columns that name rows: those of axes that tell rows apart, and the method and its lighting always.
    fn naming_columns(&self) -> Vec<NamingColumn> {
        let all: [NamingColumn; 5] = [
            ("scene", |row| &row.scene),
            ("method", |row| &row.method),
            ("lighting", |row| &row.lighting),
            ("assign", |row| &row.assign),
            ("test", |row| &row.test),
        ];
        let needed = |(name, cell): &NamingColumn| {
            matches!(*name, "method" | "lighting") || self.rows.iter().any(|row| !cell(row).is_empty())
        };
        all.into_iter().filter(needed).collect()
    }

    /// Writes the table as CSV: what names a row, means, then the reference, then ratios.
    ///
    /// # Errors
    /// The writer fails.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        let naming = self.naming_columns();
        csv.write_record(naming.iter().map(|(name, _)| *name).chain(CSV_HEADER))?;
        for row in &self.rows {
            let (means, ratios) = (&row.means, &row.ratios);
            let counts = [means.visible_clusters, means.light_indices, means.lighting_computations];
            let times = [means.clustering_ms, means.shading_ms, means.total_ms];
            let cells = naming
                .iter()
                .map(|(_, cell)| cell(row).clone())
                .chain([row.frames.to_string()])
                .chain(counts.map(|count| format!("{count:.3}")))
                .chain(times.map(optional_ms))
                .chain([row.reference.clone()])
                .chain(ratios.list().map(optional_ms));
            csv.write_record(cells.collect::<Vec<_>>())?;
        }
        csv.flush()
    }
}

/// Its name in CSV, and its cell.
type NamingColumn = (&'static str, fn(&SummaryRow) -> &String);

const CSV_HEADER: [&str; 14] = [
    "frames",
    "visible_clusters",
    "light_indices",
    "lighting_computations",
    "clustering_ms",
    "shading_ms",
    "total_ms",
    "reference",
    "visible_clusters_ratio",
    "light_indices_ratio",
    "lighting_computations_ratio",
    "clustering_ms_ratio",
    "shading_ms_ratio",
    "total_ms_ratio",
];

/// Index of the run that the ratios of `of` are to. Where there are several ways or tests, it is by the first.
fn reference(runs: &[RunMeans], of: &RunMeans) -> usize {
    let find = |wanted: &dyn Fn(&RunMeans) -> bool| {
        runs.iter().position(|run| run.scene == of.scene && run.lighting == of.lighting && wanted(run))
    };
    find(&|run| is_indi_persp(&run.method)).or_else(|| find(&|_| true)).unwrap_or(0)
}

fn is_indi_persp(method: &MethodSpec) -> bool {
    matches!(method, MethodSpec::Clustered { sharing: Sharing::Indi, space: Space::Persp { .. } })
}

impl Values {
    fn mean(run: &MethodRun<'_>) -> Self {
        let minima = StageMinima::from_times(run.times);
        let count =
            |get: fn(&FrameCounts) -> u64| mean(run.counts.iter().map(|frame| Some(get(frame) as f64)));
        let time = |get: fn(&super::GpuTimes) -> Option<f64>| {
            mean(run.counts.iter().map(|frame| get(&minima.frame(frame.frame))))
        };
        Self {
            visible_clusters: count(FrameCounts::visible_clusters).unwrap_or(0.0),
            light_indices: count(FrameCounts::light_indices).unwrap_or(0.0),
            lighting_computations: count(|frame| frame.lighting_computations).unwrap_or(0.0),
            clustering_ms: time(|times| times.cluster),
            shading_ms: time(|times| times.shade),
            total_ms: time(|times| times.frame),
        }
    }

    fn list(&self) -> [Option<f64>; 6] {
        let counts = [self.visible_clusters, self.light_indices, self.lighting_computations].map(Some);
        [counts[0], counts[1], counts[2], self.clustering_ms, self.shading_ms, self.total_ms]
    }
}

/// The mean of the values that are there.
pub(super) fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let (sum, count) = values.flatten().fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

impl Ratios {
    fn of(values: &Values, reference: &Values) -> Self {
        let mut ratios = values.list().into_iter().zip(reference.list()).map(|pair| match pair {
            (Some(value), Some(reference)) if reference != 0.0 => Some(value / reference),
            _ => None,
        });
        let mut next = || ratios.next().flatten();
        Self {
            visible_clusters: next(),
            light_indices: next(),
            lighting_computations: next(),
            clustering_ms: next(),
            shading_ms: next(),
            total_ms: next(),
        }
    }

    fn list(&self) -> [Option<f64>; 6] {
        [
            self.visible_clusters,
            self.light_indices,
            self.lighting_computations,
            self.clustering_ms,
            self.shading_ms,
            self.total_ms,
        ]
    }
}

/// Lines above, below and under the header, none between rows: characters in the order of comfy-table's presets.
pub(crate) const TABLE_LINES: &str = "  ── ══      ──    ";

impl fmt::Display for Summary {
    /// The table, each value with its ratio in brackets, and a line that says what ratios are to.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = Table::new();
        table.load_preset(TABLE_LINES).set_content_arrangement(ContentArrangement::Disabled);
        let naming = self.naming_columns();
        let header = [
            "visible\nclusters",
            "light\nindices",
            "lighting\ncomputations",
            "clustering\nms",
            "shading\nms",
            "total\nms",
        ];
        let names = naming.iter().map(|(name, _)| if *name == "lighting" { "lights" } else { *name });
        table.set_header(names.chain(header));
        for row in &self.rows {
            let values = row.means.list().into_iter().zip(row.ratios.list()).enumerate();
            let cells = values.map(|(column, (value, ratio))| cell(value, ratio, column >= 3));
            table.add_row(naming.iter().map(|(_, cell)| cell(row).clone()).chain(cells));
        }
        for (column, index) in table.column_iter_mut().zip(0..) {
            let is_name = naming.get(index).is_some_and(|(name, _)| *name != "lighting");
            column.set_cell_alignment(if is_name { CellAlignment::Left } else { CellAlignment::Right });
        }
        for line in table.lines() {
            writeln!(f, "{}", line.trim_end())?;
        }
        write!(f, "Means over frames; in brackets the ratio to {}.", self.references())
    }
}

impl Summary {
    /// The reference methods, each once.
    fn references(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !names.contains(&row.reference.as_str()) {
                names.push(&row.reference);
            }
        }
        let several =
            |cell: fn(&SummaryRow) -> &String| self.rows.iter().any(|row| cell(row) != cell(&self.rows[0]));
        let lights = if several(|row| &row.lighting) { " under the same lights" } else { "" };
        let ways = several(|row| &row.assign) || several(|row| &row.test);
        names.join(" and ") + lights + if ways { ", by its first way and test" } else { "" }
    }
}

fn cell(value: Option<f64>, ratio: Option<f64>, milliseconds: bool) -> String {
    let Some(value) = value else { return "-".into() };
    let value = if milliseconds { format!("{value:.3}") } else { grouped(value.round() as u64) };
    match ratio {
        Some(ratio) => format!("{value} ({ratio:.2})"),
        None => format!("{value}    -  "),
    }
}

/// A whole number with a space between thousands.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}
