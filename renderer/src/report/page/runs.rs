//! The table of all runs: statistics of every metric of `frames.csv`.

use super::text;
use crate::output::with_interval;
use crate::report::format::{readable, significant};
use crate::report::results::{ResultSet, Run, method_name};
use crate::stats::{Interval, Statistics};
use std::fmt::Write as _;
use std::io::{self, Write};

/// Statistics in the order of columns: class, name for people, name in the CSV.
const STATISTICS: [(&str, &str, &str); 4] = [
    ("mean", "Mean", "mean"),
    ("median", "Median", "median"),
    ("p95", "95th percentile", "p95"),
    ("deviation", "Standard deviation", "standard_deviation"),
];

/// Metrics of all runs in the order in which they first occur.
fn metrics(set: &ResultSet) -> Vec<&str> {
    let mut names: Vec<&str> = vec![];
    for (name, _) in set.runs.iter().flat_map(|run| &run.frames.metrics) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names
}

fn values(statistics: Statistics) -> [f64; 4] {
    [statistics.mean, statistics.median, statistics.p95, statistics.deviation]
}

/// One line a run and metric.
///
/// # Errors
/// The writer fails.
pub fn write_runs_csv(out: impl Write, set: &ResultSet) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    let head = ["run", "setting", "method", "lighting", "frames", "metric"];
    let interval = ["mean_low", "mean_high"];
    csv.write_record(head.into_iter().chain(STATISTICS.map(|(_, _, name)| name)).chain(interval))?;
    for run in &set.runs {
        for metric in metrics(set) {
            let Some(statistics) = Statistics::of(run.frames.values(metric)) else { continue };
            let head = [
                run.name.clone(),
                run.setting.to_string(),
                run.method.to_string(),
                run.lighting.label.clone(),
                run.frames.numbers.len().to_string(),
                metric.to_owned(),
            ];
            let numbers = values(statistics).map(|value| significant(value, 9)).into_iter();
            let interval = run.measured(metric).and_then(|mean| mean.interval());
            let ends = Interval::ends(interval);
            let ends = ends.map(|end| end.map_or(String::new(), |value| significant(value, 9)));
            csv.write_record(head.into_iter().chain(numbers).chain(ends))?;
        }
    }
    csv.flush()
}

/// The table, with a choice of the statistic shown.
pub fn section(body: &mut String, set: &ResultSet) {
    super::section(body, "runs", "All runs");
    body.push_str("<fieldset class=\"choice\"><legend>Over the frames of each run</legend>\n");
    for (index, (class, label, _)) in STATISTICS.iter().enumerate() {
        let checked = if index == 0 { " checked" } else { "" };
        // Writing to a string cannot fail, here and below.
        let _ = writeln!(
            body,
            "<label><input type=\"radio\" name=\"statistic\" id=\"show-{class}\"{checked}> {label}</label>"
        );
    }
    body.push_str("</fieldset>\n<div class=\"scroll\"><table class=\"runs\">\n<thead><tr><th>Method</th><th>Lighting</th>");
    body.push_str("<th>Frames</th><th>Grid</th>");
    let metrics = metrics(set);
    for metric in &metrics {
        let (name, unit) = heading(metric);
        let _ = write!(body, "<th>{}{unit}</th>", text(&name));
    }
    body.push_str("</tr></thead>\n");
    for setting in set.settings() {
        let columns = metrics.len() + 4;
        let _ = writeln!(
            body,
            "<tbody><tr class=\"group\"><th colspan=\"{columns}\"><span>{}</span></th></tr>",
            text(&setting.to_string())
        );
        set.of(setting).for_each(|run| row(body, run, &metrics));
        body.push_str("</tbody>\n");
    }
    body.push_str("</table></div>\n</section>\n");
}

fn row(body: &mut String, run: &Run, metrics: &[&str]) {
    let grid = run.grid.map_or("–".to_owned(), |[x, y, z]| format!("{x}×{y}×{z}"));
    let _ = write!(
        body,
        "<tr title=\"{}\"><th>{}</th><td class=\"lighting\">{}</td><td>{}</td><td>{grid}</td>",
        text(&run.name),
        text(&method_name(run.method, true)),
        text(&run.lighting.label),
        run.frames.numbers.len()
    );
    for metric in metrics {
        body.push_str("<td>");
        match Statistics::of(run.frames.values(metric)) {
            None => body.push('–'),
            Some(statistics) => {
                for ((class, ..), value) in STATISTICS.iter().zip(values(statistics)) {
                    let interval = run.measured(metric).and_then(|mean| mean.interval());
                    let shown = match interval.filter(|_| *class == "mean") {
                        Some(interval) => with_interval(value, Some(interval), [0, 3]),
                        None => readable(value),
                    };
                    let _ = write!(body, "<span class=\"{class}\">{shown}</span>");
                }
            }
        }
        body.push_str("</td>");
    }
    body.push_str("</tr>\n");
}

/// A metric's column for people: words, and the unit beside them.
fn heading(metric: &str) -> (String, &'static str) {
    match metric.strip_prefix("gpu_ms_") {
        Some(stage) => (stage.replace('_', " "), " <small>ms</small>"),
        None => (metric.replace('_', " "), ""),
    }
}
