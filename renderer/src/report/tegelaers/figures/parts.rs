//! What a frame of clusters takes its time for, stage by stage (6.8).

use super::over::note;
use crate::report::chart::palette::Color;
use crate::report::chart::{Chart, Key, Look, Plot, Series, Stack};
use crate::report::results::{Run, metric};
use crate::report::tegelaers::evaluation::{CLUSTERED, Corner, Evaluation, Scene};

/// A part of the frame: its name, colour, and metric.
type Part = (&'static str, Color, &'static str);

const PARTS: [Part; 4] = [
    ("depth and clusters", "sky", metric::VISIBILITY),
    ("counting lights", "green", metric::COUNT),
    ("writing lists", "vermillion", metric::ASSIGN),
    ("shading", "orange", metric::SHADE),
];
const REST: (&str, Color) = ("all else", "grey");

/// A column a scene, with the most lights and pixels; `None` where no clusters were timed.
pub fn chart(evaluation: &Evaluation<'_>) -> Option<Chart> {
    let of = (evaluation.chosen(CLUSTERED)?, evaluation.counting());
    let panel = |scene: &Scene<'_>| {
        let at = scene.corner(&[of], Corner::Many)?;
        let case = scene.of(of.0, of.1).find(|case| (case.pixels, case.lights) == at)?;
        Some((Plot::Stack(stack(case.run)?), note(case.size())))
    };
    let (panels, notes): (Vec<Option<Plot>>, Vec<Vec<Key>>) = evaluation
        .scenes
        .iter()
        .map(|scene| panel(scene).map_or_else(Default::default, |(plot, notes)| (Some(plot), notes)))
        .unzip();
    let named = PARTS.iter().map(|(name, color, _)| (*name, *color)).chain([REST]);
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["row", "scene", "part", "frame"],
        columns: evaluation.scenes.iter().map(Scene::name).collect(),
        rows: vec!["frame ms".into()],
        panels,
        notes,
        x_label: "frame".into(),
        legend: named.map(|(name, color)| Key { label: name.into(), look: Look::plain(color) }).collect(),
        ..Chart::default()
    })
}

/// The parts and what is left of the whole; `None` where frames lack one.
fn stack(run: &Run) -> Option<Stack> {
    let whole = run.frames.points(metric::FRAME);
    let mut rest = whole.clone();
    let mut parts = vec![];
    for (name, color, metric) in PARTS {
        let points = run.frames.points(metric);
        if points.len() != whole.len() {
            return None;
        }
        // Minima are taken stage by stage, so the parts may exceed the whole by a little.
        rest.iter_mut().zip(&points).for_each(|(rest, point)| rest[1] = (rest[1] - point[1]).max(0.0));
        parts.push(Series { name: name.into(), look: Look::plain(color), points });
    }
    let top = whole.iter().map(|point| point[1]).fold(0.0, f64::max);
    parts.push(Series { name: REST.0.into(), look: Look::plain(REST.1), points: rest });
    (!whole.is_empty()).then_some(Stack { parts, top })
}
