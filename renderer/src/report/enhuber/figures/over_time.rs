//! Frame time over the frames of the recording (4.8).

use crate::methods::Method;
use crate::report::chart::{Chart, Key, Look, Plot, Series, palette::NAMED};
use crate::report::enhuber::evaluation::{Evaluation, SEVEN, Scene, name};
use crate::report::results::metric;

/// A row a scene; models stand apart, for they take many times as long. `None` where nothing was timed.
pub fn chart(evaluation: &Evaluation<'_>) -> Option<Chart> {
    let keys: Vec<(Method, Key)> = evaluation
        .chosen_of(&SEVEN)
        .into_iter()
        .zip(NAMED)
        .map(|(method, color)| (method, Key { label: name(method), look: Look::plain(color) }))
        .collect();
    let (models, groups): (Vec<_>, Vec<_>) = keys.iter().partition(|(method, _)| *method == Method::Models);
    let columns: Vec<(&str, &[&(Method, Key)])> =
        [("frame time (ms)", &groups[..]), ("M, frame time (ms)", &models[..])]
            .into_iter()
            .filter(|(_, keys)| !keys.is_empty())
            .collect();
    let scenes = evaluation.scenes.iter();
    let panels: Vec<Option<Plot>> = scenes
        .flat_map(|scene| columns.iter().map(|(_, keys)| panel(evaluation, scene, keys)).collect::<Vec<_>>())
        .collect();
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["scene", "unit", "method", "frame"],
        columns: columns.iter().map(|(heading, _)| (*heading).to_owned()).collect(),
        rows: evaluation.scenes.iter().map(Scene::name).collect(),
        panels,
        x_label: "frame".into(),
        legend: keys.iter().map(|(_, key)| key.clone()).collect(),
        ..Chart::default()
    })
}

fn panel(evaluation: &Evaluation<'_>, scene: &Scene<'_>, keys: &[&(Method, Key)]) -> Option<Plot> {
    let line = |(method, key): &&(Method, Key)| {
        let points = scene.run(*method, evaluation.many()?)?.frames.points(metric::FRAME);
        (!points.is_empty()).then(|| Series { name: key.label.clone(), look: key.look, points })
    };
    let lines: Vec<Series> = keys.iter().filter_map(line).collect();
    (!lines.is_empty()).then_some(Plot::Lines(lines))
}
