//! The closing table: one row a method and lighting, with ratios to Indi Persp.

use super::rows::FrameRow;
use crate::config::{Axis, Labels, Role};
use crate::methods::Method;
use comfy_table::{CellAlignment, ContentArrangement, Table};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use std::fmt;
use std::io::{self, Write};

/// A column of numbers of the closing table: a mean over frames, and its ratio to the reference method's.
struct Column {
    /// Its name in CSV and JSON.
    name: &'static str,
    /// Its heading, on two lines.
    heading: &'static str,
    /// What it is of a frame; `None` where that was not measured.
    of: fn(&FrameRow) -> Option<f64>,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Count,
    Milliseconds,
}

const COLUMNS: [Column; 6] = [
    Column {
        name: "visible_clusters",
        heading: "visible\nclusters",
        of: |row| Some(row.visible_clusters as f64),
        kind: Kind::Count,
    },
    Column {
        name: "light_indices",
        heading: "light\nindices",
        of: |row| Some(row.light_indices as f64),
        kind: Kind::Count,
    },
    Column {
        name: "lighting_computations",
        heading: "lighting\ncomputations",
        of: |row| Some(row.lighting_computations as f64),
        kind: Kind::Count,
    },
    Column {
        name: "clustering_ms",
        heading: "clustering\nms",
        of: |row| row.gpu_ms_cluster,
        kind: Kind::Milliseconds,
    },
    Column {
        name: "shading_ms",
        heading: "shading\nms",
        of: |row| row.gpu_ms_shade,
        kind: Kind::Milliseconds,
    },
    Column { name: "total_ms", heading: "total\nms", of: |row| row.gpu_ms_frame, kind: Kind::Milliseconds },
];

/// A number for each column of the closing table: means over the frames of one run, or their ratios to those of the
/// reference method. `None` where nothing was measured, or a ratio would be to nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Values([Option<f64>; COLUMNS.len()]);

impl Values {
    /// Means over frames.
    pub fn mean(rows: &[FrameRow]) -> Self {
        Self(COLUMNS.map(|column| mean(rows.iter().filter_map(column.of))))
    }

    /// Its value in the column of a name.
    pub fn get(&self, name: &str) -> Option<f64> {
        COLUMNS.iter().zip(self.0).find(|(column, _)| column.name == name).and_then(|(_, value)| value)
    }

    /// The ratios to `reference`.
    fn over(&self, reference: &Self) -> Self {
        Self(std::array::from_fn(|place| match (self.0[place], reference.0[place]) {
            (Some(value), Some(reference)) if reference != 0.0 => Some(value / reference),
            _ => None,
        }))
    }
}

impl Serialize for Values {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(COLUMNS.len()))?;
        for (column, value) in COLUMNS.iter().zip(self.0) {
            map.serialize_entry(column.name, &value)?;
        }
        map.end()
    }
}

/// The mean; `None` of nothing.
fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

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

    /// Writes the table as CSV: what names a row, means, then the reference, then ratios.
    ///
    /// # Errors
    /// The writer fails.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        let naming = self.naming_axes();
        let header = naming.iter().map(|axis| axis.column.to_owned()).chain(["frames".to_owned()]);
        let means = COLUMNS.map(|column| column.name.to_owned());
        let ratios = COLUMNS.map(|column| format!("{}_ratio", column.name));
        csv.write_record(header.chain(means).chain(["reference".to_owned()]).chain(ratios))?;
        for row in &self.rows {
            let names =
                naming.iter().map(|axis| row.labels.get(axis).to_owned()).chain([row.frames.to_string()]);
            let means = COLUMNS.iter().zip(row.means.0).map(|(column, mean)| column.kind.cell(mean));
            let ratios = row.ratios.0.map(|ratio| Kind::Milliseconds.cell(ratio));
            csv.write_record(names.chain(means).chain([row.reference.clone()]).chain(ratios))?;
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

impl Kind {
    /// A cell of the CSV.
    fn cell(self, value: Option<f64>) -> String {
        let digits = match self {
            Self::Count => 3,
            Self::Milliseconds => 6,
        };
        value.map(|value| format!("{value:.digits$}")).unwrap_or_default()
    }

    /// A number with its ratio, for people.
    fn shown(self, value: Option<f64>, ratio: Option<f64>) -> String {
        let Some(value) = value else { return "-".into() };
        let value = match self {
            Self::Count => grouped(value.round() as u64),
            Self::Milliseconds => format!("{value:.3}"),
        };
        match ratio {
            Some(ratio) => format!("{value} ({ratio:.2})"),
            None => format!("{value}    -  "),
        }
    }
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
        table.set_header(names.chain(COLUMNS.map(|column| column.heading)));
        for row in &self.rows {
            let values = COLUMNS.iter().zip(row.means.0.into_iter().zip(row.ratios.0));
            let cells = values.map(|(column, (value, ratio))| column.kind.shown(value, ratio));
            table.add_row(naming.iter().map(|axis| row.labels.get(axis).to_owned()).chain(cells));
        }
        for (column, index) in table.column_iter_mut().zip(0..) {
            let is_name = naming.get(index).is_some_and(|axis| axis.role != Role::Lighting);
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
        let several = |role: Role| {
            let labels = |row: &SummaryRow| row.labels.of(&[role]).join(" ");
            self.rows.iter().any(|row| labels(row) != labels(&self.rows[0]))
        };
        let lights = if several(Role::Lighting) { " under the same lights" } else { "" };
        let ways = several(Role::Way);
        names.join(" and ") + lights + if ways { ", by its first way and test" } else { "" }
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
