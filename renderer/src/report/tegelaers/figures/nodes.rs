//! Numbers of hashed methods over the size of nodes: a line a set of lights, or a line a starting depth.

use super::over::note;
use crate::methods::Method;
use crate::report::chart::{Chart, Key, Look, Plot, Series, palette};
use crate::report::results::Run;
use crate::report::tegelaers::evaluation::{Case, Evaluation, HASHED, Scene, lights, node, start_depth};
use std::collections::BTreeSet;

/// A number of a run.
pub type Number = fn(&Run) -> Option<f64>;

/// A line a set of lights, by the starting depth of most sizes, with as many pixels as most were measured with; `None` where there are no two sizes.
pub fn by_lights(evaluation: &Evaluation<'_>, what: &str, of: Number) -> Option<Chart> {
    let methods = evaluation.nodes();
    let is_of = |case: &&Case<'_>| methods.contains(&case.run.method);
    // Sets differ from scene to scene: lines are told by their place, fewest lights first.
    let most = evaluation.scenes.iter().map(|scene| counts(scene, &methods).len()).max()?;
    let keys: Vec<Key> = (0..most)
        .map(|place| Key { label: place_name(place, most), look: Look::plain(palette::ordered(place, most)) })
        .collect();
    let lines = |scene: &Scene<'_>| {
        let counts = counts(scene, &methods);
        let pixels = most_pixels(scene, evaluation, &methods)?;
        let of_scene = || scene.cases.iter().filter(is_of).filter(|case| case.pixels == pixels);
        let series = counts.iter().zip(&keys).map(|(&count, key)| {
            let of_set = of_scene().filter(|case| case.lights == count);
            (Key { label: lights(count), look: key.look }, points(evaluation, of_set, of))
        });
        Some((series.collect(), of_scene().next()?.run.setting.resolution))
    };
    chart(evaluation, what, keys.clone(), &lines)
}

/// A line a starting depth, under the most lights, with as many pixels as most were measured with; `None` where there are no two sizes.
pub fn by_depth(evaluation: &Evaluation<'_>, what: &str, of: Number) -> Option<Chart> {
    let methods = evaluation.methods(HASHED);
    let mut depths: Vec<f64> = methods.iter().map(|method| start_depth(*method)).collect();
    depths.sort_by(f64::total_cmp);
    depths.dedup();
    let key = |(place, depth): (usize, &f64)| Key {
        label: format!("depth {depth}"),
        look: Look::plain(palette::ordered(place, depths.len())),
    };
    let keys: Vec<Key> = depths.iter().enumerate().map(key).collect();
    let lines = |scene: &Scene<'_>| {
        let pixels = most_pixels(scene, evaluation, &methods)?;
        let count = counts(scene, &methods).pop()?;
        let of_scene = || scene.cases.iter().filter(|case| (case.pixels, case.lights) == (pixels, count));
        let series = depths.iter().zip(&keys).map(|(&depth, key)| {
            let of_depth = of_scene()
                .filter(|case| methods.contains(&case.run.method) && start_depth(case.run.method) == depth);
            (key.clone(), points(evaluation, of_depth, of))
        });
        Some((series.collect(), of_scene().next()?.run.setting.resolution))
    };
    chart(evaluation, what, keys.clone(), &lines)
}

/// The lines of a scene with the resolution they are of.
type Lines = (Vec<(Key, Vec<[f64; 2]>)>, [u32; 2]);

fn chart(
    evaluation: &Evaluation<'_>,
    what: &str,
    legend: Vec<Key>,
    lines: &dyn Fn(&Scene<'_>) -> Option<Lines>,
) -> Option<Chart> {
    let panel = |scene: &Scene<'_>| {
        let (lines, [width, height]) = lines(scene)?;
        let series = lines.into_iter().filter(|(_, points)| !points.is_empty());
        let series: Vec<Series> =
            series.map(|(Key { label, look }, points)| Series { name: label, look, points }).collect();
        let is_line = series.iter().any(|series| series.points.len() > 1);
        is_line.then(|| (Plot::Lines(series), note(format!("{width} × {height}"))))
    };
    let (panels, notes): (Vec<Option<Plot>>, Vec<Vec<Key>>) = evaluation
        .scenes
        .iter()
        .map(|scene| panel(scene).map_or_else(Default::default, |(plot, notes)| (Some(plot), notes)))
        .unzip();
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["number", "scene", "series", "node"],
        columns: evaluation.scenes.iter().map(Scene::name).collect(),
        rows: vec![what.to_owned()],
        panels,
        notes,
        x_label: "edge of the smallest nodes (radii)".into(),
        legend,
        ..Chart::default()
    })
}

/// By ascending size of nodes, as far as it is in radii, in the pipeline in which the thesis counts.
fn points<'a, 'b: 'a>(
    evaluation: &Evaluation<'_>,
    cases: impl Iterator<Item = &'a Case<'b>>,
    of: Number,
) -> Vec<[f64; 2]> {
    let pipeline = evaluation.counting();
    let counting = cases.filter(|case| case.pipeline == pipeline);
    let mut points: Vec<[f64; 2]> =
        counting.filter_map(|case| Some([node(case.run.method)?, of(case.run)?])).collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points
}

/// Numbers of lights that some of the methods were measured under, ascending.
fn counts(scene: &Scene<'_>, methods: &[Method]) -> Vec<u32> {
    let of_methods = scene.cases.iter().filter(|case| methods.contains(&case.run.method));
    let counts: BTreeSet<u32> = of_methods.map(|case| case.lights).collect();
    counts.into_iter().collect()
}

/// As many pixels as most of the methods were measured with, two at least; of several the most.
fn most_pixels(scene: &Scene<'_>, evaluation: &Evaluation<'_>, methods: &[Method]) -> Option<u64> {
    let pipeline = evaluation.counting();
    let of_methods = || {
        scene.cases.iter().filter(move |case| case.pipeline == pipeline && methods.contains(&case.run.method))
    };
    let sizes: BTreeSet<u64> = of_methods().map(|case| case.pixels).collect();
    let measured = |pixels: u64| {
        // Cases come method by method.
        let mut found: Vec<Method> =
            of_methods().filter(|case| case.pixels == pixels).map(|case| case.run.method).collect();
        found.dedup();
        found.len()
    };
    sizes.into_iter().filter(|&pixels| measured(pixels) > 1).max_by_key(|&pixels| measured(pixels))
}

fn place_name(place: usize, count: usize) -> String {
    match place {
        0 => "fewest lights".into(),
        _ if place + 1 == count => "most lights".into(),
        _ => format!("set {}", place + 1),
    }
}
