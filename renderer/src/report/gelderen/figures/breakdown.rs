//! Where the time goes, stacked: a column a lighting, a row a method (6.7, 6.8).

use super::distribution::by_method;
use crate::report::chart::{Chart, Key, Look, Plot, Series, Stack, palette::Color};
use crate::report::results::{ResultSet, Run, Setting, metric};

/// A named part of a whole, and the whole that the last part fills up.
struct Breakdown {
    parts: &'static [(&'static str, &'static str, Color)],
    whole: &'static str,
}

const FRAME: Breakdown = Breakdown {
    parts: &[("Shading", metric::SHADE, "orange"), ("Clustering", metric::CLUSTER, "blue")],
    whole: metric::FRAME,
};

const CLUSTERING: Breakdown = Breakdown {
    parts: &[
        ("Visibility", metric::VISIBILITY, "sky"),
        ("Count", metric::COUNT, "green"),
        ("Assign", metric::ASSIGN, "vermillion"),
    ],
    whole: metric::CLUSTER,
};

const REST: (&str, Color) = ("Miscellaneous", "grey");

/// Shading, clustering and the rest of the frame.
pub fn frame(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    stacked(set, setting, &FRAME)
}

/// Visibility, counting, assigning and the rest of clustering.
pub fn clustering(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    stacked(set, setting, &CLUSTERING)
}

fn stacked(set: &ResultSet, setting: &Setting, breakdown: &Breakdown) -> Option<Chart> {
    let mut chart = by_method(set, setting, |run| parts(run, breakdown).map(Plot::Stack))?;
    chart.names = ["method", "lighting", "part", "frame"];
    let named = breakdown.parts.iter().map(|&(name, _, color)| (name, color)).chain([REST]);
    chart.legend = named.map(|(name, color)| Key { label: name.into(), look: Look::plain(color) }).collect();
    let columns = chart.columns.len();
    for column in 0..columns {
        let tops =
            chart.panels.iter().skip(column).step_by(columns).flatten().filter_map(|plot| match plot {
                Plot::Stack(stack) => Some(stack.top),
                _ => None,
            });
        let most = tops.fold(0.0, f64::max);
        for plot in chart.panels.iter_mut().skip(column).step_by(columns).flatten() {
            if let Plot::Stack(stack) = plot {
                stack.top = most;
            }
        }
    }
    Some(chart)
}

/// The parts of the frames that have all of them; `None` where none has.
fn parts(run: &Run, breakdown: &Breakdown) -> Option<Stack> {
    let cells = |metric| run.frames.metric(metric);
    let whole = cells(breakdown.whole);
    let columns: Vec<&[Option<f64>]> = breakdown.parts.iter().map(|&(_, metric, _)| cells(metric)).collect();
    let mut points = vec![vec![]; columns.len() + 1];
    let mut top = 0.0_f64;
    for (place, &frame) in run.frames.numbers.iter().enumerate() {
        let at = |cells: &[Option<f64>]| cells.get(place).copied().flatten();
        let values: Option<Vec<f64>> = columns.iter().map(|cells| at(cells)).collect();
        let (Some(values), Some(whole)) = (values, at(whole)) else { continue };
        // Minima are taken stage by stage, so the parts may exceed the whole by a little.
        let rest = (whole - values.iter().sum::<f64>()).max(0.0);
        top = top.max(values.iter().sum::<f64>() + rest);
        for (points, value) in points.iter_mut().zip(values.into_iter().chain([rest])) {
            points.push([f64::from(frame), value]);
        }
    }
    let named = breakdown.parts.iter().map(|&(name, _, color)| (name, color)).chain([REST]);
    let parts: Vec<Series> = named
        .zip(points)
        .map(|((name, color), points)| Series { name: name.into(), look: Look::plain(color), points })
        .collect();
    parts.first().is_some_and(|part| !part.points.is_empty()).then_some(Stack { parts, top })
}
