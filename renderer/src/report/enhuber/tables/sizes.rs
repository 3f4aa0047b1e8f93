//! The sizes that are fastest, and those that stand for all scenes (table 4.3).

use crate::methods::Method;
use crate::report::analysis::{Part, cells};
use crate::report::enhuber::evaluation::{EIGHT, Evaluation, Scene, name};
use crate::report::tables::{Row, Table};
use crate::stats::{Interval, Measured};

/// A row a kind and scene.
pub fn table(evaluations: &[Evaluation<'_>]) -> Table {
    Table {
        id: "enhuber-sizes",
        title: "Table 4.3: sizes",
        caption: "Mean GPU time of a frame under 10 000 lights or, where there are no such runs, the most, with the ends of its \
                  95 % interval: by the fastest size of each kind in each scene, and by the size that is the fastest in most \
                  scenes (of several, the one that is slower than the fastest by the least in all scenes together), which \
                  stands for all. The thesis selects T-I 28, T-E 28, DC-I 128 64, DC-E 64 40, SC-I 48 40, SC-E 48 40, G 20.",
        labels: &["kind", "scene", "fastest", "selected"],
        groups: vec![
            ("fastest ms", &["mean", "low", "high"]),
            ("selected ms", &["mean", "low", "high"]),
            ("selected over fastest", &["", "low", "high"]),
        ],
        rows: evaluations.iter().flat_map(rows).collect(),
    }
}

fn rows(evaluation: &Evaluation<'_>) -> Vec<Row> {
    EIGHT.iter().filter_map(|kind| rows_of(evaluation, kind)).flatten().collect()
}

/// The rows of a kind; `None` where it has no sizes or no scene has a time of it.
fn rows_of(evaluation: &Evaluation<'_>, kind: &str) -> Option<Vec<Row>> {
    let times = times(evaluation, kind);
    let selected = select(&times).filter(|method| !method.sizes().is_empty())?;
    let row = |(scene, sizes): (&Scene<'_>, &Vec<(Method, Measured)>)| {
        let (fastest, least) = fastest(sizes)?;
        let chosen = sizes.iter().find(|(method, _)| *method == selected).map(|(_, ms)| ms);
        let over = chosen.map_or([None; 3], |ms| {
            let [low, high] = Interval::ends(ms.ratio_to(least));
            [Some(ms.value / least.value), low, high]
        });
        Some(Row {
            setting: evaluation.setting.to_string(),
            labels: vec![selected.kind().title.to_owned(), scene.name(), name(fastest), name(selected)],
            numbers: [cells(least), chosen.map_or([None; 3], cells), over].concat(),
        })
    };
    Some(evaluation.scenes.iter().zip(&times).filter_map(row).collect())
}

/// By scene, the mean time of each size of a kind.
fn times(evaluation: &Evaluation<'_>, kind: &str) -> Vec<Vec<(Method, Measured)>> {
    let methods = evaluation.methods(kind);
    let of_scene = |scene: &Scene<'_>| {
        let time =
            |method: &Method| Some((*method, Part::All.mean(scene.run(*method, evaluation.many()?)?)?));
        methods.iter().filter_map(time).collect()
    };
    evaluation.scenes.iter().map(of_scene).collect()
}

fn fastest(sizes: &[(Method, Measured)]) -> Option<(Method, &Measured)> {
    sizes.iter().min_by(|a, b| a.1.value.total_cmp(&b.1.value)).map(|(method, ms)| (*method, ms))
}

/// The size that is the fastest in most scenes, of those measured in all; of several the one whose times are the least
/// over those of the fastest, multiplied over scenes.
fn select(times: &[Vec<(Method, Measured)>]) -> Option<Method> {
    let scenes: Vec<&Vec<(Method, Measured)>> = times.iter().filter(|sizes| !sizes.is_empty()).collect();
    let of = |sizes: &[(Method, Measured)], wanted: Method| {
        sizes.iter().find(|(method, _)| *method == wanted).map(|(_, ms)| ms.value)
    };
    let wins = |wanted: Method| {
        scenes.iter().filter(|sizes| fastest(sizes).is_some_and(|(method, _)| method == wanted)).count()
    };
    let over = |wanted: Method| {
        let ratio = |sizes: &&Vec<(Method, Measured)>| Some(of(sizes, wanted)? / fastest(sizes)?.1.value);
        scenes.iter().map(ratio).product::<Option<f64>>()
    };
    let candidates =
        scenes.first()?.iter().filter_map(|(method, _)| Some((*method, wins(*method), over(*method)?)));
    let best = candidates.max_by(|a, b| a.1.cmp(&b.1).then(b.2.total_cmp(&a.2)));
    best.map(|(method, ..)| method)
}
