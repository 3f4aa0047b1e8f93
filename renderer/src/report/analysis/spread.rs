//! Means of assignment and shading, and how much the frames of a run differ (Enhuber, figures 4.8 and 4.12).

use super::{Part, by_lighting, cells, methods};
use crate::output::with_interval;
use crate::report::chart::{Bar, Chart};
use crate::report::figure::{self, Drawn, Figure, Wanted};
use crate::report::results::{LightingName, ResultSet, Run, Setting, lightings, method_name, metric};
use crate::report::tables::{Row, Table};
use crate::stats::{Measured, Samples};

const WANTED: Wanted<'static> = Wanted {
    id: "analysis-times",
    title: "Assignment and shading by method",
    caption: "Mean GPU time of a frame (ms), each panel with its own axis. Assignment is everything before shading: the frame \
              less shading (and, at several samples a pixel, the resolve). The black line is the 95 % interval of the whole, cut \
              off where it reaches far.",
    missing: "needs temporal runs",
};

/// A figure a setting: a panel a lighting, a bar a method.
pub fn figures(set: &ResultSet) -> Vec<Figure> {
    let settings = set.settings().into_iter();
    let drawn = settings
        .filter_map(|setting| Some(Drawn { setting, chart: chart(set, setting)?, remark: String::new() }));
    figure::figures(&WANTED, drawn.collect())
}

/// A panel a lighting, a bar a method; `None` where nothing was timed.
pub fn chart(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    let lightings = lightings(set.of(setting).filter(|run| Part::Assignment.mean(run).is_some()));
    let legend = [Part::Assignment, Part::Shading].map(Part::key).to_vec();
    by_lighting(&lightings, ("ms", legend), |lighting| bars(set, setting, lighting))
}

fn bars(set: &ResultSet, setting: &Setting, lighting: &LightingName) -> Vec<Bar> {
    let run = |method| set.of(setting).find(|run| run.method == method && run.lighting == *lighting);
    let label = |method| method_name(method, setting.is_stereo());
    methods(set, setting).into_iter().filter_map(|method| bar(run(method)?, label(method))).collect()
}

/// Assignment and shading of a run, one upon the other; `None` where it was not timed.
pub fn bar(run: &Run, label: String) -> Option<Bar> {
    let [assignment, shading, all] = Part::EVERY.map(|part| part.mean(run));
    let all = all?;
    let interval = all.interval();
    Some(Bar {
        label,
        told: with_interval(all.value, interval, [0, 3]),
        parts: vec![(Part::Assignment.key(), assignment?.value), (Part::Shading.key(), shading?.value)],
        interval,
    })
}

/// A row a method, lighting and setting.
pub fn table(set: &ResultSet) -> Table {
    Table {
        id: "analysis-times",
        title: "Means and how much frames differ",
        caption: "Over the frames of each run: means of assignment (everything before shading), of shading and of all, standard \
                  deviation (SD) of all, of the frames as the whole population, and its ratio to the mean (RSD); each with \
                  the ends of its 95 % interval. The noise of measuring is part of SD and RSD.",
        labels: &["method", "lighting"],
        groups: vec![
            ("assignment ms", &["mean", "low", "high"]),
            ("shading ms", &["mean", "low", "high"]),
            ("all ms", &["mean", "low", "high"]),
            ("all SD ms", &["", "low", "high"]),
            ("all RSD", &["", "low", "high"]),
        ],
        rows: set.runs.iter().filter_map(row).collect(),
    }
}

fn row(run: &Run) -> Option<Row> {
    let means = Part::EVERY.map(|part| part.mean(run)).into_iter().collect::<Option<Vec<_>>>()?;
    let numbers = means.into_iter().chain([deviation(run)?, relative(run)?]);
    Some(Row {
        setting: run.setting.to_string(),
        labels: vec![method_name(run.method, run.setting.is_stereo()), run.lighting.label.clone()],
        numbers: numbers.flat_map(|number| cells(&number)).collect(),
    })
}

/// Standard deviation of the frame time over the frames of a run, milliseconds.
pub fn deviation(run: &Run) -> Option<Measured> {
    run.times.get(metric::FRAME).map(Samples::deviation)
}

/// The same over the mean.
pub fn relative(run: &Run) -> Option<Measured> {
    let [deviation, mean] = [deviation(run)?, Part::All.mean(run)?];
    Some(Measured::combine([&deviation, &mean], |[deviation, mean]| deviation / mean))
}
