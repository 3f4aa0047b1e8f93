//! Figures over the frames of the replay: a column a lighting, a row a metric (6.2 to 6.6, C.3, C.4).

use super::space_color;
use crate::methods::{GridMethod, Method, Sharing, Space};
use crate::report::chart::{Chart, Key, Look, Plot, Series, palette};
use crate::report::results::{
    LightingName, ResultSet, Run, Setting, TUNED, encl, indi, is_tuned, lightings, method_name, metric,
};

/// Rows: metric and label.
const ROWS: [(&str, &str); 5] = [
    (metric::VISIBLE, "Visible clusters"),
    (metric::CLUSTER, "Clustering (ms)"),
    (metric::COMPUTATIONS, "Lighting comp."),
    (metric::SHADE, "Shading (ms)"),
    (metric::FRAME, "Total (ms)"),
];

/// A kind of grid whose size is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sweep {
    /// By pixels.
    Persp,
    /// By metres.
    Ortho,
    /// By pixels, then by metres of displacement.
    Displ,
}

impl Sweep {
    /// As figures name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Persp => "Persp",
            Self::Ortho => "Ortho",
            Self::Displ => "Displ",
        }
    }

    /// What the sizes are.
    pub fn sizes(self) -> &'static str {
        match self {
            Self::Persp => "the cluster's side in pixels",
            Self::Ortho => "the cluster's side in metres",
            Self::Displ => "pixels and metres of displacement",
        }
    }

    /// The sizes of an Indi method of this kind.
    fn size(self, method: Method) -> Option<[f64; 2]> {
        let Method::Grid(GridMethod { sharing: Sharing::Indi, space, .. }) = method else { return None };
        match (self, space) {
            (Self::Persp, Space::Persp { pixels }) => Some([pixels, 0.0]),
            (Self::Ortho, Space::Ortho { metres }) => Some([metres, 0.0]),
            (Self::Displ, Space::Displ { pixels, displacement }) => Some([pixels, displacement]),
            _ => None,
        }
    }
}

/// Every size of one kind; `None` where there are fewer than two.
pub fn sweep(set: &ResultSet, setting: &Setting, sweep: Sweep) -> Option<Chart> {
    let mut methods: Vec<([f64; 2], Method)> =
        set.of(setting).filter_map(|run| Some((sweep.size(run.method)?, run.method))).collect();
    methods.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    methods.dedup();
    let count = methods.len();
    let lines = methods.into_iter().enumerate().map(|(index, (_, method))| {
        let look = Look { bold: is_tuned(method), ..Look::plain(palette::ordered(index, count)) };
        (method, method_name(method, false), look)
    });
    (count > 1).then(|| over_time(set, setting, &lines.collect::<Vec<_>>()))?
}

/// Indi and Encl, Persp and Ortho; `None` where no kind has both.
pub fn sharing(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    let mut lines = vec![];
    for space in [TUNED[0], TUNED[1]] {
        let both = [indi(space), encl(space)];
        if both.iter().all(|&method| set.of(setting).any(|run| run.method == method)) {
            lines.extend(both.map(|method| {
                let look = Look { dashed: method == encl(space), ..Look::plain(space_color(method)) };
                (method, method_name(method, true), look)
            }));
        }
    }
    over_time(set, setting, &lines)
}

/// The tuned methods; `None` where there is none.
pub fn tuned(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    let lines = TUNED.map(|space| {
        let method = indi(space);
        (method, method_name(method, false), Look::plain(space_color(method)))
    });
    over_time(set, setting, &lines)
}

type Line = (Method, String, Look);

fn over_time(set: &ResultSet, setting: &Setting, lines: &[Line]) -> Option<Chart> {
    let present = |line: &&Line| set.of(setting).any(|run| run.method == line.0);
    let lines: Vec<&Line> = lines.iter().filter(present).collect();
    let is_drawn = |run: &&Run| lines.iter().any(|line| line.0 == run.method);
    let lightings = lightings(set.of(setting).filter(is_drawn));
    let mut chart = Chart {
        names: ["metric", "lighting", "method", "frame"],
        columns: lightings.iter().map(|lighting| lighting.label.clone()).collect(),
        x_label: "frame".into(),
        legend: lines.iter().map(|(_, label, look)| Key { label: label.clone(), look: *look }).collect(),
        ..Chart::default()
    };
    for (metric, label) in ROWS {
        let row: Vec<Option<Plot>> =
            lightings.iter().map(|lighting| panel(set, setting, lighting, &lines, metric)).collect();
        if row.iter().any(Option::is_some) {
            chart.rows.push(label.into());
            chart.panels.extend(row);
        }
    }
    (!chart.rows.is_empty()).then_some(chart)
}

fn panel(
    set: &ResultSet,
    setting: &Setting,
    lighting: &LightingName,
    lines: &[&Line],
    metric: &str,
) -> Option<Plot> {
    let series: Vec<Series> = lines
        .iter()
        .filter_map(|(method, name, look)| {
            let run = set.of(setting).find(|run| run.method == *method && run.lighting == *lighting)?;
            let points = run.frames.points(metric);
            (!points.is_empty()).then(|| Series { name: name.clone(), look: *look, points })
        })
        .collect();
    (!series.is_empty()).then_some(Plot::Lines(series))
}
