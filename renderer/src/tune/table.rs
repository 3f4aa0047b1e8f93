//! The closing table of a search.

use super::search::Found;
use crate::config::Axis;
use crate::output::{PlannedRun, TABLE_LINES, with_interval};
use crate::stats::{Interval, Measured, Samples};
use comfy_table::{CellAlignment, ContentArrangement, Table};
use serde::Serialize;
use std::fmt;

/// What was found for one method under one lighting. Times are means over frames of the minima over temporal runs, GPU
/// milliseconds; intervals say from where to where they lie in 95 % of repetitions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Directory of the scene, empty where there is one.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub scene: String,
    /// What light falls.
    pub lighting: String,
    /// The method as named.
    pub method: String,
    /// The way of assignment that it is timed by: the cheapest by counts.
    pub named_assign: String,
    /// Its time.
    pub named_ms: Option<f64>,
    /// Interval of that.
    pub named_interval: Option<Interval>,
    /// The method with the sizes that are fastest.
    pub tuned: String,
    /// Its way of assignment; empty where it has none.
    pub assign: String,
    /// Its test; empty where it has none.
    pub test: String,
    /// Which of its clusters get lists; empty where it has none.
    pub clusters: String,
    /// What of its clusters is tested; empty where it has none.
    pub bounds: String,
    /// Where its slices begin; empty where it has none.
    pub slices: String,
    /// Its time.
    pub total_ms: Option<f64>,
    /// Interval of that.
    pub interval: Option<Interval>,
    /// Its time over that of the method as named.
    pub ratio: Option<f64>,
    /// Interval of that, paired by frame and run.
    pub ratio_interval: Option<Interval>,
    /// Whether what comes next may be as fast.
    pub undecided: bool,
    /// What comes next, by the name of its run.
    pub runner_up: Option<String>,
    /// How many candidates there were.
    pub tried: usize,
    /// How many combinations were left out: no such grid, buffer or test.
    pub left_out: usize,
    /// How many candidates were not timed, for larger clusters were far too slow already.
    pub given_up: usize,
    /// How many frames times are over.
    pub frames: usize,
    /// How many temporal runs.
    pub runs: usize,
}

/// What was found.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Tuning {
    /// A row a scene, lighting and method.
    pub rows: Vec<Row>,
}

/// A column behind the others, which is there where it tells something.
struct Behind {
    name: &'static str,
    of: fn(&Row) -> &str,
    /// What most methods have.
    usual: &'static str,
}

/// What the winners do with their clusters.
static BEHIND: [Behind; 3] = [
    Behind { name: "clusters", of: |row| &row.clusters, usual: "visible" },
    Behind { name: "bounds", of: |row| &row.bounds, usual: "implicit" },
    Behind { name: "slices", of: |row| &row.slices, usual: "geometric" },
];

impl Behind {
    fn tells(&self, row: &Row) -> bool {
        ![self.usual, "auto", ""].contains(&(self.of)(row))
    }
}

/// Value of a run on an axis.
fn on(axis: &str, run: &PlannedRun) -> String {
    Axis::named(axis).map_or_else(String::new, |axis| axis.value(&run.config))
}

impl Row {
    /// Of times of the method as named, and then of the best where that is another.
    pub(super) fn new(found: &Found, times: &[Option<Samples>], frames: usize) -> Self {
        let samples =
            |samples: Option<&Option<Samples>>| samples.and_then(Option::as_ref).map(Samples::measure);
        let (named, best): (Option<Measured>, _) = (samples(times.first()), samples(times.last()));
        let ratio = named.as_ref().zip(best.as_ref());
        Self {
            scene: String::new(),
            lighting: found.named.lights.to_string(),
            method: found.named.method.to_string(),
            named_assign: on("assign", &found.named),
            named_ms: named.as_ref().map(|named| named.value),
            named_interval: named.as_ref().and_then(Measured::interval),
            tuned: found.best.method.to_string(),
            assign: on("assign", &found.best),
            test: on("test", &found.best),
            clusters: on("clusters", &found.best),
            bounds: on("bounds", &found.best),
            slices: on("slices", &found.best),
            total_ms: best.as_ref().map(|best| best.value),
            interval: best.as_ref().and_then(Measured::interval),
            ratio: ratio.map(|(named, best)| best.value / named.value),
            ratio_interval: ratio.and_then(|(named, best)| best.ratio_to(named)),
            undecided: found.undecided,
            runner_up: found.runner_up.as_ref().map(|run| run.name.clone()),
            tried: found.tried,
            left_out: found.left_out,
            given_up: found.given_up,
            frames,
            runs: times.iter().flatten().map(Samples::runs).max().unwrap_or(0),
        }
    }

    /// The same with its scene told.
    #[must_use]
    pub(super) fn of_scene(self, scene: &str) -> Self {
        Self { scene: scene.to_owned(), ..self }
    }

    fn cells(&self) -> Vec<String> {
        let time = |time: Option<f64>, interval, digits| {
            time.map_or_else(|| "-".to_owned(), |time| with_interval(time, interval, digits))
        };
        let doubt = match &self.runner_up {
            Some(next) if self.undecided => format!("undecided: {next}"),
            _ => String::new(),
        };
        vec![
            self.lighting.clone(),
            self.method.clone(),
            time(self.named_ms, self.named_interval, [0, 3]),
            self.tuned.clone(),
            self.assign.clone(),
            self.test.clone(),
            time(self.total_ms, self.interval, [0, 3]),
            time(self.ratio, self.ratio_interval, [2, 3]),
            doubt,
        ]
    }
}

impl fmt::Display for Tuning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scenes = self.rows.iter().any(|row| !row.scene.is_empty());
        let told: Vec<_> =
            BEHIND.iter().filter(|column| self.rows.iter().any(|row| column.tells(row))).collect();
        let mut table = Table::new();
        table.load_preset(TABLE_LINES).set_content_arrangement(ContentArrangement::Disabled);
        let scene = |scene: &str| scenes.then(|| scene.to_owned()).into_iter();
        let heading =
            ["lights", "method", "ms", "tuned", "assign", "test", "ms", "ratio", ""].map(str::to_owned);
        table.set_header(
            scene("scene").chain(heading).chain(told.iter().map(|column| column.name.to_owned())),
        );
        table.add_rows(self.rows.iter().map(|row| {
            let behind = told.iter().map(|column| (column.of)(row).to_owned());
            scene(&row.scene).chain(row.cells()).chain(behind).collect::<Vec<_>>()
        }));
        for place in [0, 2, 6, 7].map(|place| place + usize::from(scenes)) {
            if let Some(column) = table.column_mut(place) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        table.lines().try_for_each(|line| writeln!(f, "{}", line.trim_end()))
    }
}
