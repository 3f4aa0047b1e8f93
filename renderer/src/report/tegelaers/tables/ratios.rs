//! What the thesis tells as ratios, beside the same here.

use crate::report::tables::{Row, Table};
use crate::report::tegelaers::evaluation::{Corner, Evaluation};
use crate::report::tegelaers::ratios::{ALL, Ratio};

/// A row a ratio and scene.
pub fn table(evaluations: &[Evaluation<'_>]) -> Table {
    Table {
        id: "tegelaers-ratios",
        title: "Ratios that the thesis tells",
        caption: "Means over the frames, and their ratio here; the thesis's own ratio is by its scenes, on its machine (Intel Core i7-6700HQ, \
                  NVIDIA GeForce GTX 960M), where the CPU builds lists, so that ratios of computations compare, those of times roughly. Few and \
                  many are the corners of what both methods were measured with.",
        labels: &["of", "method", "over", "pipeline", "lights and pixels", "scene"],
        groups: vec![("measured", &["method", "other", "ratio"]), ("printed ratio", &["from", "to"])],
        rows: evaluations.iter().flat_map(rows).collect(),
    }
}

fn rows(evaluation: &Evaluation<'_>) -> Vec<Row> {
    let of_ratio = |ratio: &Ratio| {
        let row = |scene| {
            let told = ratio.told(evaluation, scene)?;
            let [of, to] = told.names();
            let corner = if ratio.corner == Corner::Few { "few" } else { "many" };
            let place = format!("{corner}: {}", told.case.size());
            Some(Row {
                setting: evaluation.setting.to_string(),
                labels: vec![ratio.what().into(), of, to, told.pipeline.name().into(), place, scene.name()],
                numbers: told
                    .values
                    .into_iter()
                    .chain([told.value()])
                    .chain(ratio.printed)
                    .map(Some)
                    .collect(),
            })
        };
        evaluation.scenes.iter().filter_map(row).collect::<Vec<_>>()
    };
    ALL.iter().flat_map(of_ratio).collect()
}
