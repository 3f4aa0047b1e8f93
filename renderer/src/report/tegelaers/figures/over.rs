//! Lines over frames, over lights and over pixels: a column a scene.
//!
//! ```text
//! Evaluation, lines, metric ──┬─ frames ─> a row a corner of what was measured: few, many
//!                             └─ lights, pixels ─> means, a row a pipeline; the other number where most was measured
//! ```

use crate::report::chart::{Chart, Key, Look, Plot, Series};
use crate::report::claim::mean;
use crate::report::tegelaers::evaluation::{Case, Corner, Evaluation, Scene};
use crate::report::tegelaers::lines::Line;
use std::collections::BTreeSet;

/// What means are drawn over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    Lights,
    Pixels,
}

/// Lines with what their row is called.
pub struct Row {
    pub name: String,
    pub lines: Vec<Line>,
}

/// A metric's value of each frame; `None` where there is none.
pub fn frames(
    evaluation: &Evaluation<'_>,
    lines: &[Line],
    metric: &str,
    corners: &[(Corner, &str)],
) -> Option<Chart> {
    let panel = |scene: &Scene<'_>, corner| {
        let methods: Vec<_> = lines.iter().map(|line| line.of).collect();
        let at = scene.corner(&methods, corner)?;
        let series = |line: &Line| {
            let points = scene.run(line.of, at)?.frames.points(metric);
            series(line, points)
        };
        let drawn: Vec<Series> = lines.iter().filter_map(series).collect();
        let case = scene.cases.iter().find(|case| (case.pixels, case.lights) == at)?;
        (!drawn.is_empty()).then(|| (Plot::Lines(drawn), note(case.size())))
    };
    let panels = corners.iter().flat_map(|&(corner, _)| {
        evaluation.scenes.iter().map(move |scene| panel(scene, corner)).collect::<Vec<_>>()
    });
    let rows = corners.iter().map(|(_, name)| (*name).to_owned()).collect();
    chart(evaluation, lines, rows, panels.collect()).map(|chart| Chart { x_label: "frame".into(), ..chart })
}

/// A metric's mean over frames; `None` where nothing was measured in two cases.
pub fn means(evaluation: &Evaluation<'_>, rows: Vec<Row>, metric: &str, over: Over) -> Option<Chart> {
    let panel = |scene: &Scene<'_>, lines: &[Line]| {
        let fixed = over.fixed(scene, lines)?;
        let series = |line: &Line| {
            let of_line = scene.of(line.of.0, line.of.1).filter(|case| over.other(case) == fixed);
            let points = of_line.filter_map(|case| Some([over.value(case) as f64, mean(case.run, metric)?]));
            series(line, points.collect())
        };
        let drawn: Vec<Series> = lines.iter().filter_map(series).collect();
        let case = scene.cases.iter().find(|case| over.other(case) == fixed)?;
        let is_line = drawn.iter().any(|series| series.points.len() > 1);
        is_line.then(|| (Plot::Lines(drawn), note(over.told(case))))
    };
    let panels = rows.iter().flat_map(|row| {
        evaluation.scenes.iter().map(move |scene| panel(scene, &row.lines)).collect::<Vec<_>>()
    });
    let names = rows.iter().map(|row| row.name.clone()).collect();
    let explained = rows.iter().max_by_key(|row| row.lines.len())?;
    let chart = chart(evaluation, &explained.lines, names, panels.collect())?;
    Some(Chart { x_label: over.label().into(), ..chart })
}

/// The panels with their remarks, a column a scene; `None` where there are none.
fn chart(
    evaluation: &Evaluation<'_>,
    lines: &[Line],
    rows: Vec<String>,
    panels: Vec<Option<(Plot, Vec<Key>)>>,
) -> Option<Chart> {
    let (panels, notes): (Vec<Option<Plot>>, Vec<Vec<Key>>) = panels
        .into_iter()
        .map(|panel| panel.map_or_else(Default::default, |(plot, notes)| (Some(plot), notes)))
        .unzip();
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["row", "scene", "method", "x"],
        columns: evaluation.scenes.iter().map(Scene::name).collect(),
        rows,
        panels,
        notes,
        legend: lines.iter().map(|line| line.key.clone()).collect(),
        ..Chart::default()
    })
}

fn series(line: &Line, points: Vec<[f64; 2]>) -> Option<Series> {
    let Key { label, look } = line.key.clone();
    (!points.is_empty()).then_some(Series { name: label, look, points })
}

/// A remark in the corner of a panel.
pub fn note(label: String) -> Vec<Key> {
    vec![Key { label, look: Look::plain("ink") }]
}

impl Over {
    fn value(self, case: &Case<'_>) -> u64 {
        match self {
            Self::Lights => case.lights.into(),
            Self::Pixels => case.pixels,
        }
    }

    fn other(self, case: &Case<'_>) -> u64 {
        match self {
            Self::Lights => case.pixels,
            Self::Pixels => case.lights.into(),
        }
    }

    /// The other number at which lines have most points in all, of several the greatest.
    fn fixed(self, scene: &Scene<'_>, lines: &[Line]) -> Option<u64> {
        let cases = || lines.iter().flat_map(|line| scene.of(line.of.0, line.of.1));
        let others: BTreeSet<u64> = cases().map(|case| self.other(case)).collect();
        let points = |other: u64| cases().filter(|case| self.other(case) == other).count();
        others.into_iter().max_by_key(|&other| points(other))
    }

    /// What the other number is, for people.
    fn told(self, case: &Case<'_>) -> String {
        match self {
            Self::Lights => {
                let [width, height] = case.run.setting.resolution;
                format!("{width} × {height}")
            }
            Self::Pixels => crate::report::tegelaers::evaluation::lights(case.lights),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Lights => "lights",
            Self::Pixels => "pixels",
        }
    }
}
