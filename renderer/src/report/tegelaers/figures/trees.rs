//! The octrees of hashed methods: by seed (7.15, 7.16), step by step (7.19), layer by layer (7.22).

use super::over::note;
use crate::output::OctreeRow;
use crate::report::chart::{Chart, Key, Look, Plot, Series, palette};
use crate::report::results::Run;
use crate::report::tegelaers::evaluation::{Case, Corner, Evaluation, Scene, lights, node};
use crate::report::tegelaers::octree::{TABLES, construction};
use std::collections::BTreeMap;

/// The ends of what octrees were built over, with what their rows are called.
const ENDS: [(Corner, &str); 2] = [(Corner::Few, "fewest lights"), (Corner::Many, "most lights")];

/// Lines by name.
type Lines = BTreeMap<String, Vec<[f64; 2]>>;

/// What building takes over seeds: a line a set of lights; `None` where there are no two seeds.
pub fn construction_by_seed(evaluation: &Evaluation<'_>) -> Option<Chart> {
    let lines = |scene: &Scene<'_>| {
        let point = |(seed, case): &(u64, Case<'_>)| {
            Some((lights(case.lights), [*seed as f64, construction(case.run)?]))
        };
        collected(scene.seeds.iter().filter_map(point))
    };
    by_scene(evaluation, ("building ms", "seed"), &|scene| (lines(scene), None))
}

/// What layers take over seeds under the most lights; `None` where there are no two seeds.
pub fn memory_by_seed(evaluation: &Evaluation<'_>) -> Option<Chart> {
    let lines = |scene: &Scene<'_>| {
        let most = scene.seeds.iter().map(|(_, case)| case.lights).max();
        let of_most = scene.seeds.iter().filter(|(_, case)| Some(case.lights) == most);
        let points = of_most.flat_map(|(seed, case)| {
            let built = case.run.octree.iter();
            built.flat_map(|built| {
                let of_depth = |depth: u32| (layer(depth), [*seed as f64, built.bytes_at(depth)]);
                built.depths().into_iter().map(of_depth).collect::<Vec<_>>()
            })
        });
        collected(points)
    };
    by_scene(evaluation, ("bytes", "seed"), &|scene| {
        let most = scene.seeds.iter().map(|(_, case)| case.lights).max();
        (lines(scene), most.map(lights))
    })
}

/// The steps of building over the size of nodes: a row an end of the sets of lights.
pub fn steps(evaluation: &Evaluation<'_>) -> Option<Chart> {
    let charts = ENDS.map(|(corner, name)| {
        by_scene(evaluation, (name, NODES), &|scene| {
            let cases = built(evaluation, scene, corner);
            let points = cases.iter().flat_map(|case| {
                let size = node(case.run.method);
                let steps = case.run.octree.iter().flat_map(|built| &built.steps);
                steps.filter_map(move |(step, ms)| Some((step.replace('_', " "), [size?, *ms])))
            });
            (collected(points), cases.first().map(|case| lights(case.lights)))
        })
    });
    stacked(charts.into_iter().flatten().collect())
}

/// The side of a table: its letter and its length.
type Side = (&'static str, fn(&OctreeRow) -> u32);

/// Sides m of slots and r of offsets, of both kinds of tables, over the size of nodes under the most lights: a line a depth.
pub fn sides(evaluation: &Evaluation<'_>) -> Option<Chart> {
    const SIDES: [Side; 2] = [("m", |row| row.slot_side), ("r", |row| row.offset_side)];
    let rows = TABLES.into_iter().flat_map(|table| SIDES.map(|(side, of)| (table, side, of)));
    let charts = rows.filter_map(|(table, side, of)| {
        by_scene(evaluation, (&format!("{side} of {table}"), NODES), &|scene| {
            let cases = built(evaluation, scene, Corner::Many);
            let points = cases.iter().flat_map(|case| {
                let tables = case.run.octree.iter().flat_map(|built| &built.tables);
                let of_kind = tables.filter(|row| row.table == table);
                let point =
                    |row: &OctreeRow| Some((layer(row.depth), [node(case.run.method)?, f64::from(of(row))]));
                of_kind.filter_map(point).collect::<Vec<_>>()
            });
            (collected(points), cases.first().map(|case| lights(case.lights)))
        })
    });
    stacked(charts.collect())
}

const NODES: &str = "edge of the smallest nodes (radii)";

/// The octrees of the methods that differ in the size of nodes alone, under the fewest or the most lights, a run each.
fn built<'a, 'b>(evaluation: &Evaluation<'_>, scene: &'b Scene<'a>, corner: Corner) -> Vec<&'b Case<'a>> {
    let is_built = |run: &Run| run.octree.is_some() && node(run.method).is_some();
    let of = |method| scene.cases.iter().filter(move |case| case.run.method == method && is_built(case.run));
    let of_method = |method| match corner {
        Corner::Few => of(method).min_by_key(|case| case.lights),
        Corner::Many => of(method).rev().max_by_key(|case| case.lights),
    };
    evaluation.nodes().into_iter().filter_map(of_method).collect()
}

fn layer(depth: u32) -> String {
    format!("depth {depth:2}")
}

fn collected(points: impl Iterator<Item = (String, [f64; 2])>) -> Lines {
    let mut lines = Lines::new();
    for (name, point) in points {
        lines.entry(name).or_default().push(point);
    }
    lines.values_mut().for_each(|points| points.sort_by(|a, b| a[0].total_cmp(&b[0])));
    lines
}

/// A column a scene, with a remark; `None` where no line has two points.
fn by_scene(
    evaluation: &Evaluation<'_>,
    (row, x_label): (&str, &str),
    lines: &dyn Fn(&Scene<'_>) -> (Lines, Option<String>),
) -> Option<Chart> {
    let found: Vec<(Lines, Option<String>)> = evaluation.scenes.iter().map(lines).collect();
    let mut names: Vec<&String> = found.iter().flat_map(|(lines, _)| lines.keys()).collect();
    names.sort();
    names.dedup();
    let look = |name: &String| {
        let place = names.iter().position(|known| *known == name).unwrap_or(0);
        Look::plain(palette::ordered(place, names.len()))
    };
    let panel = |(lines, _): &(Lines, Option<String>)| {
        let series = lines.iter().map(|(name, points)| Series {
            name: name.clone(),
            look: look(name),
            points: points.clone(),
        });
        lines.values().any(|points| points.len() > 1).then(|| Plot::Lines(series.collect()))
    };
    let panels: Vec<Option<Plot>> = found.iter().map(panel).collect();
    panels.iter().any(Option::is_some).then(|| Chart {
        names: ["row", "scene", "series", "x"],
        columns: evaluation.scenes.iter().map(Scene::name).collect(),
        rows: vec![row.to_owned()],
        notes: found.iter().map(|(_, told)| told.clone().map_or_else(Vec::new, note)).collect(),
        panels,
        x_label: x_label.to_owned(),
        legend: names.iter().map(|name| Key { label: (*name).clone(), look: look(name) }).collect(),
        ..Chart::default()
    })
}

/// Charts of the same columns as one.
fn stacked(charts: Vec<Chart>) -> Option<Chart> {
    charts.into_iter().reduce(|mut all, next| {
        all.rows.extend(next.rows);
        all.panels.extend(next.panels);
        all.notes.extend(next.notes);
        for key in next.legend {
            if !all.legend.iter().any(|known| known.label == key.label) {
                all.legend.push(key);
            }
        }
        all
    })
}
