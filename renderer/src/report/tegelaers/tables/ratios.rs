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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::tegelaers::testing::{costs, elsewhere, everything};
    use crate::report::testing::set;

    #[test]
    fn ratios_stand_beside_those_that_are_printed() {
        let street = everything(costs);
        let hall = street.clone().into_iter().map(elsewhere);
        let set = set(hall.chain(street.clone()).collect());
        let table = table(&Evaluation::all(&set));
        assert_eq!(table.rows.len(), 2 * ALL.len());
        for row in &table.rows {
            let columns: usize = table.groups.iter().map(|(_, columns)| columns.len()).sum();
            assert_eq!((row.labels.len(), row.numbers.len()), (table.labels.len(), columns));
        }
        let few = &table.rows[0];
        let words = [
            "lighting computations",
            "Naive",
            "Tiled MM 32",
            "deferred",
            "few: 60 lights, 160 × 160",
            "hall (hall)",
        ];
        assert_eq!(few.labels, words);
        assert!((few.numbers[2].unwrap() - 60.0 / 33.0).abs() < 1e-9);
        assert_eq!(few.numbers[3..], [Some(1.5), Some(2.0)]);
    }
}
