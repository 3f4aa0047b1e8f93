//! The figures of the post: three subdivisions from the side (OF8), the laws of slices (OF9), slices as the camera sees them (OF10).

use super::aspects::{Aspects, DEPTHS, aspects};
use super::{SUBDIVISIONS, measures};
use crate::Result;
use crate::geometry::{Frustum, SliceLaw, Slices};
use crate::output::cluster_color;
use crate::report::chart::{Chart, Key, Look, Plot, Series};
use crate::report::computed::picture;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::pictures::{Kind, nearest, shown};
use crate::report::results::{ResultSet, Run, Setting};
use glam::{DVec2, DVec3};

/// Pixels of a side view.
const SIZE: [u32; 2] = [300, 200];
/// Rows and slices of a side view.
const DRAWN: [f64; 2] = [9.0, 8.0];
/// Near and far plane of a side view, metres.
const DRAWN_DEPTHS: [f64; 2] = [1.0, 20.0];
/// Upper tangent of a side view; the lower one is its opposite.
const UPPER: f64 = 0.5;
/// Slices of the plot.
const PLOTTED: u32 = 32;
/// Rows of tiles and half the vertical field of view, radians, by which Olsson's slices are plotted.
const OLSSON: (f64, f64) = (9.0, std::f64::consts::FRAC_PI_6);
/// Frames that slices are shown of, where they were rendered.
const FRAMES: [u32; 2] = [300, 550];

/// All, in the post's order.
///
/// # Errors
/// A picture cannot be read or encoded.
pub fn all(set: &ResultSet) -> Result<Vec<Figure>> {
    let mut all = vec![subdivisions()?, laws()];
    all.extend(slices(set)?);
    Ok(all)
}

/// OF8.
fn subdivisions() -> Result<Figure> {
    let mut chart = Chart {
        names: ["", "subdivision", "picture", "number"],
        rows: vec![String::new()],
        ..Chart::default()
    };
    for (law, name) in SUBDIVISIONS {
        // Tiles as wide as high; how many stand side by side does not matter.
        let Aspects { mean, largest, .. } = aspects(law, DVec3::new(16.0, 9.0, DRAWN[1]), DRAWN_DEPTHS);
        chart.columns.push(format!("{name}: {mean:.1}, at most {largest:.1}"));
        let alt = format!("Clusters from the side, {name}");
        chart.panels.push(Some(picture(SIZE, &alt, |at| side_view(law, at))?));
    }
    let [rows, slices] = DRAWN;
    let [near, far] = DRAWN_DEPTHS;
    Ok(Figure {
        id: "OF8".into(),
        title: "Three subdivisions of the depth".into(),
        caption: format!(
            "Computed, not measured: {rows} rows of clusters in {slices} slices from {near} to {far} m, from the side; the eye is on the \
             left. Above each, the longest over the shortest edge of a cluster: the mean over all, and the most, of 16 x 9 square tiles. \
             Even steps in NDC give clusters near the far plane that are far too deep, even steps in view space such near the eye; \
             exponential steps make all clusters alike."
        ),
        setting: String::new(),
        chart: Some(chart),
    })
}

/// The colour, 0 to 1, at a place of a side view: depth to the right, height upwards.
fn side_view(law: SliceLaw, at: DVec2) -> DVec3 {
    let [rows, count] = DRAWN;
    let [near, far] = DRAWN_DEPTHS;
    let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -UPPER, y1: UPPER, z0: -far, z1: -near };
    let depth = 1.02 * far * at.x;
    let tangent = 2.04 * UPPER * far * (0.5 - at.y) / depth.max(1e-9);
    if !(near..far).contains(&depth) || tangent.abs() >= UPPER {
        return DVec3::ONE;
    }
    let slices = Slices::new(law, &frustum, (far / near).powf(1.0 / count) - 1.0, count);
    let row = rows * (tangent + UPPER) / (2.0 * UPPER);
    let color = cluster_color([0, row as u32, slices.coordinate_of(depth) as u32]);
    DVec3::from_array(color.map(|byte| f64::from(byte) / 255.0))
}

/// OF9.
fn laws() -> Figure {
    let [near, far] = DEPTHS;
    let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -far, z1: -near };
    let count = f64::from(PLOTTED);
    let counted = Slices::new(SliceLaw::Geometric, &frustum, (far / near).powf(1.0 / count) - 1.0, count);
    let (rows, half) = OLSSON;
    let olsson = Slices::geometric(near, 2.0 * half.tan() / rows);
    let last = olsson.coordinate_of(far).ceil() as u32;
    let series = vec![
        steps("near (far/near)^(k/32), counted", Look::plain("vermillion"), &counted, PLOTTED),
        steps(
            "near (1 + 2 tan θ/S)^k, as deep as high",
            Look { dashed: true, ..Look::plain("blue") },
            &olsson,
            last,
        ),
    ];
    let chart = Chart {
        names: ["", "", "law", "distance"],
        columns: vec![String::new()],
        rows: vec!["Slice".into()],
        x_label: "distance from the eye (m)".into(),
        legend: series.iter().map(|s| Key { label: s.name.clone(), look: s.look }).collect(),
        panels: vec![Some(Plot::Lines(series))],
        ..Chart::default()
    };
    Figure {
        id: "OF9".into(),
        title: "The two exponential laws".into(),
        caption: format!(
            "Computed, not measured: the slice of a depth from {near} to {far} m by the law of a given number of slices, {PLOTTED}, and by \
             Olsson's, whose number follows from the tiles: {last} with S = {rows} rows in a vertical field of view of 2θ = 60°."
        ),
        setting: String::new(),
        chart: Some(chart),
    }
}

/// Slices over depth, metres, with an end at every plane.
fn steps(name: &str, look: Look, slices: &Slices, count: u32) -> Series {
    let far = DEPTHS[1];
    let step = |slice: u32| {
        let ends = [slice, slice + 1].map(|plane| slices.depth_at(plane.into()).min(far));
        ends.map(|depth| [depth, f64::from(slice)])
    };
    Series { name: name.into(), look, points: (0..count).flat_map(step).collect() }
}

/// OF10.
fn slices(set: &ResultSet) -> Result<Vec<Figure>> {
    let mut drawn = vec![];
    for setting in set.settings_once() {
        if let Some(chart) = seen(set, setting)? {
            drawn.push(Drawn { setting, chart, remark: String::new() });
        }
    }
    let wanted = Wanted {
        id: "OF10",
        title: "Slices as the camera sees them",
        caption: "The slice of each pixel's cluster: the three low bits of its number as red, green and blue, so that colours repeat \
                  every eight slices, from black. Dark grey where nothing was hit.",
        missing: "needs rendered frames of tiles and slices by number: replay with --exr and frame numbers",
    };
    Ok(figures(&wanted, drawn))
}

/// A row a slice law, a column a frame; `None` where nothing was rendered.
fn seen(set: &ResultSet, setting: &Setting) -> Result<Option<Chart>> {
    let of_setting = |run: &&Run| run.setting.by(&setting.way) == *setting && measures(run.method);
    let has_slices = |run: &&Run| run.pictures.iter().any(|picture| picture.slices.is_some());
    let runs: Vec<&Run> = set.runs.iter().filter(of_setting).filter(has_slices).collect();
    let frames = nearest(&FRAMES, &runs);
    if frames.is_empty() {
        return Ok(None);
    }
    let mut chart = Chart {
        names: ["slices", "frame", "picture", "number"],
        columns: frames.iter().map(|frame| format!("Frame {frame}")).collect(),
        ..Chart::default()
    };
    for run in &runs {
        let law = run.setting.way.value("slices", run.method);
        if chart.rows.contains(&law) {
            continue;
        }
        for &frame in &frames {
            let picture = run.pictures.iter().find(|picture| picture.frame == frame);
            let path = picture.and_then(|picture| picture.slices.as_ref());
            let alt = format!("Slices of frame {frame}, {law}");
            chart.panels.push(path.map(|path| shown(path, frame, alt, Kind::Drawing)).transpose()?);
        }
        chart.rows.push(law);
    }
    Ok(Some(chart))
}
