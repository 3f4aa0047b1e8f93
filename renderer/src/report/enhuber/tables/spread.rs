//! How much the frames of a run differ (the numbers of figure 4.8).

use crate::methods::Method;
use crate::report::analysis::{Part, cells, deviation, relative};
use crate::report::enhuber::evaluation::{Evaluation, SEVEN, Scene, name};
use crate::report::tables::{Row, Table};

/// A row a scene and method.
pub fn table(evaluations: &[Evaluation<'_>]) -> Table {
    Table {
        id: "enhuber-variability",
        title: "Figure 4.8 in numbers: variability over frames",
        caption: "Of the frame time under 10 000 lights or, where there are no such runs, the most: mean, standard deviation (SD) over \
                  the frames, which are the whole population, and its ratio to the mean (RSD), each with the ends of its 95 % \
                  interval. The noise of measuring is part of SD and RSD.",
        labels: &["scene", "method"],
        groups: vec![
            ("mean ms", &["", "low", "high"]),
            ("SD ms", &["", "low", "high"]),
            ("RSD", &["", "low", "high"]),
        ],
        rows: evaluations.iter().flat_map(rows).collect(),
    }
}

fn rows(evaluation: &Evaluation<'_>) -> Vec<Row> {
    let methods = evaluation.chosen_of(&SEVEN);
    let row = |scene: &Scene<'_>, method: Method| {
        let run = scene.run(method, evaluation.many()?)?;
        let numbers = [Part::All.mean(run)?, deviation(run)?, relative(run)?];
        Some(Row {
            setting: evaluation.setting.to_string(),
            labels: vec![scene.name(), name(method)],
            numbers: numbers.iter().flat_map(cells).collect(),
        })
    };
    let of_scene = |scene| methods.iter().filter_map(|&method| row(scene, method)).collect::<Vec<_>>();
    evaluation.scenes.iter().flat_map(of_scene).collect()
}
