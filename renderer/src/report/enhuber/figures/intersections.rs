//! Frame time by test of sphere against frustum (4.6, 4.7).

use crate::report::analysis::{Part, bar};
use crate::report::chart::{Bar, Chart, Plot};
use crate::report::enhuber::evaluation::{Evaluation, Scene, TESTS, name, test};

/// Bars of a kind: a column a scene, a bar a test; `None` where no two tests were timed in a scene.
pub fn chart(evaluation: &Evaluation<'_>, kind: &str) -> Option<Chart> {
    let method = evaluation.chosen(kind)?;
    let panel = |scene: &Scene<'_>| {
        let bars = bars(evaluation, scene, kind);
        (bars.len() > 1).then_some(Plot::Bars(bars))
    };
    let panels: Vec<Option<Plot>> = evaluation.scenes.iter().map(panel).collect();
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["method", "scene", "part", "test"],
        columns: evaluation.scenes.iter().map(Scene::name).collect(),
        rows: vec![name(method)],
        panels,
        legend: [Part::Assignment, Part::Shading].map(Part::key).to_vec(),
        ..Chart::default()
    })
}

/// In the thesis's order of tests; those that it does not compare last.
fn bars(evaluation: &Evaluation<'_>, scene: &Scene<'_>, kind: &str) -> Vec<Bar> {
    let mut runs = evaluation.tests_of(scene, kind);
    let place = |test: &str| TESTS.iter().position(|known| *known == test).unwrap_or(TESTS.len());
    runs.sort_by_key(|run| place(&test(run)));
    runs.into_iter().filter_map(|run| bar(run, test(run))).collect()
}
