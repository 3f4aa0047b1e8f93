//! How many fragments are shaded for a pixel, over the frames (4.1).

use super::over::note;
use crate::report::chart::{Chart, Look, Plot, Series};
use crate::report::results::metric;
use crate::report::tegelaers::evaluation::{Case, Evaluation, Pipeline, Scene};

/// A column a scene: any forward run, for all shade the same fragments. `None` where there is none.
pub fn chart(evaluation: &Evaluation<'_>) -> Option<Chart> {
    let found: Vec<Option<&Case<'_>>> = evaluation.scenes.iter().map(forward).collect();
    let panel = |case: &Case<'_>| {
        let of_all = case.pixels as f64 * f64::from(case.run.setting.views.max(1));
        let mut points = case.run.frames.points(metric::FRAGMENTS);
        points.iter_mut().for_each(|point| point[1] /= of_all);
        (!points.is_empty()).then(|| {
            Plot::Lines(vec![Series { name: "fragments a pixel".into(), look: Look::plain("blue"), points }])
        })
    };
    let panels: Vec<Option<Plot>> = found.iter().map(|case| panel(case.as_ref()?)).collect();
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["row", "scene", "number", "frame"],
        columns: evaluation.scenes.iter().map(Scene::name).collect(),
        rows: vec!["fragments a pixel".into()],
        panels,
        x_label: "frame".into(),
        notes: found.iter().map(|case| case.map_or_else(Vec::new, |case| note(case.size()))).collect(),
        ..Chart::default()
    })
}

/// Of those with most pixels the one of the first method.
fn forward<'a, 'b>(scene: &'b Scene<'a>) -> Option<&'b Case<'a>> {
    let forward = scene.cases.iter().filter(|case| case.pipeline == Pipeline::Forward);
    forward.rev().max_by_key(|case| case.pixels)
}
