//! Frame times as ratios to those of tiles: measured, and in a table of their own those that the thesis prints.

use crate::methods::Method;
use crate::report::analysis::{Part, cells};
use crate::report::enhuber::evaluation::{EIGHT, Evaluation, Scene, name};
use crate::report::enhuber::printed::{BASE, MACHINE, MEANS, Printed, SCENES};
use crate::report::tables::{Row, Table};
use crate::stats::{Interval, Measured};

/// Name of the table of what was measured.
pub const MEASURED: &str = "enhuber-ratios";

/// A row a scene and method.
pub fn measured(evaluations: &[Evaluation<'_>]) -> Table {
    Table {
        id: MEASURED,
        title: "Measured: frame time over that of T-E",
        caption: "Mean GPU time of a frame under 10 000 lights or, where there are no such runs, the most, and its ratio to that of T-E, \
                  each with the ends of its 95 % interval. The thesis's own numbers follow in a table of their own: only ratios \
                  compare, for machine, scenes and program are others.",
        labels: &["scene", "method"],
        groups: vec![("mean ms", &["", "low", "high"]), ("over T-E", &["", "low", "high"])],
        rows: evaluations.iter().flat_map(rows).collect(),
    }
}

fn rows(evaluation: &Evaluation<'_>) -> Vec<Row> {
    let methods = evaluation.chosen_of(&EIGHT);
    let time = |scene: &Scene<'_>, method: Method| Part::All.mean(scene.run(method, evaluation.many()?)?);
    let row = |scene: &Scene<'_>, method: Method, base: &Measured| {
        let ms = time(scene, method)?;
        let [low, high] = Interval::ends(ms.ratio_to(base));
        Some(Row {
            setting: evaluation.setting.to_string(),
            labels: vec![scene.name(), name(method)],
            numbers: [cells(&ms), [Some(ms.value / base.value), low, high]].concat(),
        })
    };
    let of_scene = |scene: &Scene<'_>| {
        let base = evaluation.chosen(BASE).and_then(|method| time(scene, method));
        let rows = base
            .map(|base| methods.iter().filter_map(|&method| row(scene, method, &base)).collect::<Vec<_>>());
        rows.unwrap_or_default()
    };
    evaluation.scenes.iter().flat_map(of_scene).collect()
}

/// A row a kind.
pub fn printed() -> Table {
    let row = |printed: &Printed| Row {
        setting: format!("Not measured here: printed by Enhuber (2019), {MACHINE}"),
        labels: vec![name_of(printed.kind)],
        numbers: printed.ms.into_iter().chain(printed.ratios()).map(Some).collect(),
    };
    Table {
        id: "enhuber-printed",
        title: "Printed: the thesis's frame times and their ratios to T-E",
        caption: "Not measured by this program: table 4.3 and the captions of figures 4.8 and 4.13 of the thesis, means of 10 000 lights \
                  on the machine named, shaded without the depth of a prepass. M in Robot Lab is what its fitted line gives.",
        labels: &["method"],
        groups: vec![("printed ms", &SCENES), ("printed, over T-E", &SCENES)],
        rows: MEANS.iter().map(row).collect(),
    }
}

/// A kind's title, with the sizes that the thesis selects.
fn name_of(kind: &str) -> String {
    let known = crate::methods::KINDS.iter().find(|known| known.name == kind);
    known.map_or_else(|| kind.to_owned(), |kind| name(kind.tuned()))
}
