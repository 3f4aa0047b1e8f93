//! How large scenes, models, the camera's way and the box of the lights are (table 4.2).

use crate::report::enhuber::evaluation::{Evaluation, Scene};
use crate::report::tables::{Row, Table};

const AXES: [&str; 3] = ["x", "y", "z"];

/// A row a scene.
pub fn table(evaluations: &[Evaluation<'_>]) -> Table {
    Table {
        id: "enhuber-scenes",
        title: "Table 4.2: scenes, models, cameras and lights",
        caption: "Sizes of boxes along the world's axes, metres, variance in square metres. Models are the instances that are drawn. \
                  The camera's box is that of all frames of the recording, whether rendered or not.",
        labels: &["scene"],
        groups: vec![
            ("scene", &["triangles", "vertices"]),
            ("scene's box", &AXES),
            ("models", &[""]),
            ("mean box of a model", &AXES),
            ("variance", &AXES),
            ("camera's box", &AXES),
            ("frames", &[""]),
            ("lights' box", &AXES),
        ],
        rows: evaluations.iter().flat_map(rows).collect(),
    }
}

fn rows(evaluation: &Evaluation<'_>) -> Vec<Row> {
    let row = |scene: &Scene<'_>| {
        let run = scene.by_test.iter().find(|run| run.extent.is_some())?;
        let extent = run.extent.as_ref()?;
        let numbers = [
            vec![extent.triangles as f64, extent.vertices as f64],
            extent.scene_m.to_vec(),
            vec![extent.models as f64],
            extent.model_mean_m.to_vec(),
            extent.model_variance_m2.to_vec(),
            extent.path_m.to_vec(),
            vec![f64::from(extent.path_frames)],
        ];
        let lights = run.light_box_m.map_or([None; 3], |size| size.map(Some));
        Some(Row {
            setting: evaluation.setting.to_string(),
            labels: vec![scene.name()],
            numbers: numbers.concat().into_iter().map(Some).chain(lights).collect(),
        })
    };
    evaluation.scenes.iter().filter_map(row).collect()
}
