//! Frame time over the sizes of groups (4.2 to 4.5).

use crate::methods::Method;
use crate::output::with_interval;
use crate::report::analysis::{Part, bar};
use crate::report::chart::{Bar, Chart, Key, Look, Plot, Series, palette};
use crate::report::enhuber::evaluation::{Evaluation, Scene, name};
use crate::report::results::Run;

/// Bars: a row a scene, a column a kind; `None` where no kind was timed in two sizes.
pub fn bars(evaluation: &Evaluation<'_>, kinds: &[&str]) -> Option<Chart> {
    let panel = |runs: &[&Run]| {
        Plot::Bars(runs.iter().filter_map(|run| bar(run, name(run.method))).collect::<Vec<Bar>>())
    };
    let mut chart = chart(evaluation, kinds, panel)?;
    chart.names = ["scene", "method", "part", "size"];
    chart.legend = [Part::Assignment, Part::Shading].map(Part::key).to_vec();
    Some(chart)
}

/// Lines over slices: a row a scene, a column a kind; `None` where no kind was timed in two sizes.
pub fn lines(evaluation: &Evaluation<'_>, kinds: &[&str]) -> Option<Chart> {
    let mut tiles: Vec<f64> =
        kinds.iter().flat_map(|kind| evaluation.methods(kind)).map(|method| size(method, 0)).collect();
    tiles.sort_by(f64::total_cmp);
    tiles.dedup();
    let keys: Vec<(f64, Key)> = tiles
        .iter()
        .enumerate()
        .map(|(place, tile)| {
            let look = Look::plain(palette::ordered(place, tiles.len()));
            (*tile, Key { label: format!("{tile} px"), look })
        })
        .collect();
    let mut chart = chart(evaluation, kinds, |runs| Plot::Lines(series(runs, &keys)))?;
    let least = |scene: &Scene<'_>, kind: &str| least(&timed(evaluation, scene, kind));
    let panels = evaluation.scenes.iter().flat_map(|scene| kinds.iter().map(move |kind| (scene, *kind)));
    chart.notes = panels.map(|(scene, kind)| least(scene, kind).into_iter().collect()).collect();
    chart.names = ["scene", "method", "tile", "slices"];
    chart.x_label = "slices".into();
    chart.legend = keys.into_iter().map(|(_, key)| key).collect();
    Some(chart)
}

/// A panel a scene and kind that was timed in two sizes at least.
fn chart(evaluation: &Evaluation<'_>, kinds: &[&str], draw: impl Fn(&[&Run]) -> Plot) -> Option<Chart> {
    let panel = |scene: &Scene<'_>, kind: &str| {
        let runs = timed(evaluation, scene, kind);
        (runs.len() > 1).then(|| draw(&runs))
    };
    let panels: Vec<Option<Plot>> = evaluation
        .scenes
        .iter()
        .flat_map(|scene| kinds.iter().map(|kind| panel(scene, kind)).collect::<Vec<_>>())
        .collect();
    let title = |kind: &&str| {
        evaluation.chosen(kind).map_or_else(|| (*kind).to_owned(), |method| method.kind().title.to_owned())
    };
    panels.iter().any(Option::is_some).then(|| Chart {
        columns: kinds.iter().map(title).collect(),
        rows: evaluation.scenes.iter().map(Scene::name).collect(),
        panels,
        ..Chart::default()
    })
}

/// The timed runs of a kind in a scene under the lights that sizes are compared by.
fn timed<'a>(evaluation: &Evaluation<'a>, scene: &Scene<'a>, kind: &str) -> Vec<&'a Run> {
    let run = |method| scene.run(method, evaluation.many()?).filter(|run| Part::All.mean(run).is_some());
    evaluation.methods(kind).into_iter().filter_map(run).collect()
}

/// A line a tile size.
fn series(runs: &[&Run], keys: &[(f64, Key)]) -> Vec<Series> {
    let point = |run: &&Run| Some([size(run.method, 1), Part::All.mean(run)?.value]);
    let line = |(tile, key): &(f64, Key)| {
        let of_tile = runs.iter().filter(|run| size(run.method, 0) == *tile);
        Series { name: key.label.clone(), look: key.look, points: of_tile.filter_map(point).collect() }
    };
    keys.iter().map(line).filter(|series| !series.points.is_empty()).collect()
}

/// What the fastest of several sizes takes.
fn least(runs: &[&Run]) -> Option<Key> {
    let timed = runs.iter().filter_map(|run| Some((run.method, Part::All.mean(run)?)));
    let (method, ms) = timed.min_by(|a, b| a.1.value.total_cmp(&b.1.value))?;
    let label = format!("{}: {} ms", name(method), with_interval(ms.value, ms.interval(), [0, 3]));
    Some(Key { label, look: Look::plain("ink") })
}

fn size(method: Method, place: usize) -> f64 {
    method.sizes().get(place).map_or(0.0, |size| size.number)
}
