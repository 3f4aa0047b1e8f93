//! The paper's figures that are numbers: slice laws (KF1), times (KF5 to KF8), memory (KF9), nodes (KF10); clusters (KF11, KF16, KF17, in
//! [`cells`]) and lights a pixel (KF13 to KF15, KF18) as pictures.

use super::cells;
use super::evaluation::{Case, Evaluation, MEMORY, PARTS};
use crate::Result;
use crate::geometry::{Frustum, SliceLaw, Slices};
use crate::report::chart::palette::Color;
use crate::report::chart::{Bar, Chart, Key, Look, Plot, Series};
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::pictures::{Kind, shown};
use crate::report::results::{ResultSet, Run};

const COLORS: [Color; 4] = ["sky", "blue", "orange", "vermillion"];
const SHADING: (&str, Color) = ("shading", "green");
/// What takes lights to lists beside shells and fills.
const REST: (&str, Color) = ("all else of assignment", "grey");

/// Far plane, slices, and depth of the second plane, by which the paper draws its laws.
const DRAWN: (f64, f64, f64) = (3000.0, 64.0, 200.0);

/// The grid that the paper compares with tiles, by exponential slices.
const CLUSTERED: [u32; 3] = [24, 12, 128];

/// All, in the paper's order.
///
/// # Errors
/// A picture cannot be read.
pub fn all(set: &ResultSet) -> Result<Vec<Figure>> {
    let evaluations = Evaluation::all(set);
    let mut all = vec![laws()];
    all.extend(times(&evaluations));
    all.extend(memory(&evaluations));
    all.extend(nodes(&evaluations));
    all.push(cells::spot()?);
    all.extend(against_tiles(set)?);
    all.extend(cells::near_and_far(&evaluations)?);
    all.extend(lights_a_pixel(&evaluations)?);
    Ok(all)
}

/// KF1.
fn laws() -> Figure {
    let (far, count, metres) = DRAWN;
    let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -far, z1: -1.0 };
    let law = |name: &str, law, color| {
        let slices = Slices::new(law, &frustum, far.powf(1.0 / count) - 1.0, count);
        let points = (0..=count as u32).map(|plane| [f64::from(plane), slices.depth_at(plane.into())]);
        Series { name: name.into(), look: Look::plain(color), points: points.collect() }
    };
    let series = vec![
        law("exponential, second plane at 200", SliceLaw::SecondPlane { metres }, "vermillion"),
        law("linear", SliceLaw::Linear, "blue"),
    ];
    Figure {
        id: "KF1".into(),
        title: "Two slice laws".into(),
        caption: "Computed, not measured: the depth at which each of 64 slices begins and ends, to a far plane at 3000, as in the paper's \
                  figure 4.6."
            .into(),
        setting: String::new(),
        chart: Some(Chart {
            names: ["", "", "law", "plane"],
            columns: vec![String::new()],
            rows: vec!["Depth".into()],
            x_label: "plane".into(),
            legend: series.iter().map(|s| Key { label: s.name.clone(), look: s.look }).collect(),
            panels: vec![Some(Plot::Lines(series))],
            ..Chart::default()
        }),
    }
}

/// A bar: what it is of, and its parts with their colours.
fn bar(case: &Case, told: String, parts: Vec<(&str, Color, f64)>) -> Bar {
    let key = |name: &str, color| Key { label: name.into(), look: Look::plain(color) };
    let parts = parts.into_iter().map(|(name, color, value)| (key(name, color), value));
    Bar { label: case.name(), told, parts: parts.collect(), interval: None }
}

/// A chart of bars, a row for each number of lights; `None` where there are none.
fn chart(evaluation: &Evaluation, unit: &str, bar: impl Fn(&Case) -> Option<Bar>) -> Option<Chart> {
    let row = |lights: u32| {
        let bars: Vec<Bar> = evaluation.of_lights(lights).filter_map(&bar).collect();
        let name = evaluation.of_lights(lights).next().map_or_else(String::new, Case::lights_name);
        (!bars.is_empty()).then_some((name, bars))
    };
    let rows: Vec<(String, Vec<Bar>)> = evaluation.lights().into_iter().filter_map(row).collect();
    let mut legend: Vec<Key> = vec![];
    for (key, _) in rows.iter().flat_map(|(_, bars)| bars).flat_map(|bar| &bar.parts) {
        if !legend.contains(key) {
            legend.push(key.clone());
        }
    }
    let (names, bars): (Vec<String>, Vec<Vec<Bar>>) = rows.into_iter().unzip();
    (!names.is_empty()).then(|| Chart {
        names: ["lights", "", "part", "grid"],
        columns: vec![unit.into()],
        rows: names,
        panels: bars.into_iter().map(|bars| Some(Plot::Bars(bars))).collect(),
        legend,
        ..Chart::default()
    })
}

fn drawn<'a>(
    evaluations: &'a [Evaluation],
    unit: &str,
    bar: impl Fn(&Case) -> Option<Bar>,
) -> Vec<Drawn<'a>> {
    let of = |evaluation: &'a Evaluation| {
        let chart = chart(evaluation, unit, &bar)?;
        Some(Drawn { setting: &evaluation.setting, chart, remark: String::new() })
    };
    evaluations.iter().filter_map(of).collect()
}

/// KF5 to KF8 as one, a row for each number of lights.
fn times(evaluations: &[Evaluation]) -> Vec<Figure> {
    let wanted = Wanted {
        id: "KF5",
        title: "Assignment and shading by grid",
        caption: "Milliseconds of shells and fills of points and of spots, of all else from lights to lists, and of shading; means over frames \
                  of the least of all temporal runs. E: exponential slices, L: linear ones. The paper's figures 5.1 to 5.4.",
        missing: "needs temporal runs of raster methods",
    };
    let stacked = |case: &Case| {
        let (assignment, shading) = (case.assignment()?, case.shading()?);
        let timed = PARTS.into_iter().zip(COLORS);
        let mut parts: Vec<_> =
            timed.filter_map(|((name, stage), color)| Some((name, color, case.stage(stage)?))).collect();
        let known: f64 = parts.iter().map(|part| part.2).sum();
        parts.push((REST.0, REST.1, (assignment - known).max(0.0)));
        parts.push((SHADING.0, SHADING.1, shading));
        Some(bar(case, format!("{:.2}", assignment + shading), parts))
    };
    figures(&wanted, drawn(evaluations, "ms", stacked))
}

/// KF9.
fn memory(evaluations: &[Evaluation]) -> Vec<Figure> {
    let wanted = Wanted {
        id: "KF9",
        title: "Memory by grid",
        caption: "Mebibytes that are allocated for heads of lists, for nodes (or light indices), and for shells. The paper has two bytes for \
                  each tile and light, here there are four.",
        missing: "needs temporal runs of raster methods",
    };
    let stacked = |case: &Case| {
        let mebibytes = |structure| Some(case.bytes(structure)? / f64::from(1 << 20));
        let parts = MEMORY.into_iter().zip(COLORS);
        let parts = parts.filter_map(|((name, structure), color)| Some((name, color, mebibytes(structure)?)));
        Some(bar(case, format!("{:.1}", case.memory()? / f64::from(1 << 20)), parts.collect()))
    };
    figures(&wanted, drawn(evaluations, "MiB", stacked))
}

/// KF10.
fn nodes(evaluations: &[Evaluation]) -> Vec<Figure> {
    let wanted = Wanted {
        id: "KF10",
        title: "Assigned nodes by grid",
        caption: "Light indices of all lists, mean over frames: the paper's nodes.",
        missing: "needs runs of raster methods",
    };
    let of = |case: &Case| {
        let nodes = case.nodes()?;
        Some(bar(case, format!("{nodes:.0}"), vec![("nodes", "blue", nodes)]))
    };
    figures(&wanted, drawn(evaluations, "nodes", of))
}

/// The first picture of lights a pixel of a run.
fn heat(run: &Run) -> Result<Option<Plot>> {
    let Some(picture) = run.pictures.first() else { return Ok(None) };
    let Some(path) = picture.heat.as_ref().or(picture.lights.as_ref()) else { return Ok(None) };
    let alt = format!("Lights a pixel by {}", run.method);
    shown(path, picture.frame, alt, Kind::Photo).map(Some)
}

/// A column a run, those that have a picture.
fn gallery(runs: &[(String, &Run)]) -> Result<Option<Chart>> {
    let mut chart =
        Chart { names: ["", "method", "picture", "number"], rows: vec![String::new()], ..Chart::default() };
    for (name, run) in runs {
        if let Some(plot) = heat(run)? {
            chart.columns.push(name.clone());
            chart.panels.push(Some(plot));
        }
    }
    Ok((chart.columns.len() > 1).then_some(chart))
}

/// KF13 to KF15, one for each kind of lights: both, points, spots.
fn against_tiles(set: &ResultSet) -> Result<Vec<Figure>> {
    let wanted = Wanted {
        id: "KF13",
        title: "Lights a pixel, clustered against tiled",
        caption: "Raster methods list spots by their shape, tiles by the spheres around them and by the least and greatest depth; by one \
                  scale. Figures 5.9 to 5.11: of both kinds of lights, points alone, spots alone.",
        missing: "needs rendered frames of raster-24-12-128-e and of tiles (tiled-16): replay with --exr",
    };
    let mut drawn = vec![];
    for setting in set.settings_once() {
        let way = Default::default();
        let is_of = |run: &&Run| run.setting.by(&way) == setting.by(&way);
        let is_tiled = |run: &&Run| run.method.to_string().starts_with("tiled-");
        // By ascending lights.
        let Some(tiled) = set.runs.iter().rev().filter(is_of).find(is_tiled) else { continue };
        let is_pair = |run: &&Run| {
            let method = run.method.to_string();
            run.lighting == tiled.lighting
                && run.grid == Some(CLUSTERED)
                && method.starts_with("raster-")
                && method.ends_with("-e")
        };
        let Some(raster) = set.runs.iter().filter(is_of).find(is_pair) else { continue };
        let runs = [tiled, raster].map(|run| (run.method.to_string(), run));
        if let Some(chart) = gallery(&runs)? {
            drawn.push(Drawn { setting, chart, remark: String::new() });
        }
    }
    Ok(figures(&wanted, drawn))
}

/// KF18.
fn lights_a_pixel(evaluations: &[Evaluation]) -> Result<Vec<Figure>> {
    let wanted = Wanted {
        id: "KF18",
        title: "Lights a pixel by slice law",
        caption: "Under most lights, by one scale, for the grids whose frames were rendered.",
        missing: "needs rendered frames of raster methods by both laws: replay with --exr",
    };
    let mut drawn = vec![];
    for evaluation in evaluations {
        let most = evaluation.lights().last().copied().unwrap_or_default();
        let runs: Vec<(String, &Run)> =
            evaluation.of_lights(most).map(|case| (case.name(), case.run)).collect();
        if let Some(chart) = gallery(&runs)? {
            drawn.push(Drawn { setting: &evaluation.setting, chart, remark: String::new() });
        }
    }
    Ok(figures(&wanted, drawn))
}
