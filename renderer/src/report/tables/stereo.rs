//! Indi against Encl, of each grid, lighting and way.

use super::{Row, Table, mean};
use crate::report::results::{ResultSet, Run, TUNED, encl, indi, lightings, method_name, metric};
use crate::report::way::Way;
use crate::stats::Interval;

const METRICS: [(&str, &str); 5] = [
    (metric::VISIBLE, "visible clusters"),
    (metric::INDICES, "light indices"),
    (metric::COMPUTATIONS, "lighting computations"),
    (metric::CLUSTER, "clustering ms"),
    (metric::FRAME, "total ms"),
];

/// A row wherever both are there.
pub fn table(set: &ResultSet) -> Table {
    let mut rows = vec![];
    for setting in set.settings_once().into_iter().filter(|setting| setting.is_stereo()) {
        for space in TUNED {
            for lighting in lightings(set.runs.iter().filter(|run| run.method == indi(space))) {
                for way in set.ways() {
                    let setting = setting.by(way);
                    let found = |method| {
                        set.of_method(&setting, method).into_iter().find(|run| run.lighting == lighting)
                    };
                    if let (Some(by_indi), Some(by_encl)) = (found(indi(space)), found(encl(space))) {
                        rows.push(row(by_indi, by_encl));
                    }
                }
            }
        }
    }
    Table {
        id: "indi-encl",
        title: "Indi against Encl by every way of assignment",
        caption: "Means over the frames of each stereo replay, and Encl over Indi, for times from where to where it \
                  lies in 95 % of repetitions; claims G1 to G3 in numbers.",
        labels: &["method", "lighting", "assigned by"],
        groups: METRICS.map(|(metric, name)| (name, columns(metric))).to_vec(),
        rows,
    }
}

/// Of a metric: times have noise.
fn columns(metric: &str) -> &'static [&'static str] {
    let is_time = [metric::CLUSTER, metric::FRAME].contains(&metric);
    if is_time { &["Indi", "Encl", "ratio", "low", "high"] } else { &["Indi", "Encl", "ratio"] }
}

fn row(by_indi: &Run, by_encl: &Run) -> Row {
    let numbers = METRICS.iter().flat_map(|(metric, _)| {
        let [a, b] = [by_indi, by_encl].map(|run| mean(run, metric));
        let interval = by_encl
            .measured(metric)
            .zip(by_indi.measured(metric))
            .and_then(|(encl, indi)| encl.ratio_to(&indi));
        let ends = Interval::ends(interval);
        let ratio = a.zip(b).map(|(a, b)| b / a);
        [a, b, ratio].into_iter().chain(ends).take(columns(metric).len())
    });
    Row {
        setting: by_indi.setting.by(&Way::default()).to_string(),
        labels: vec![
            method_name(by_indi.method, false),
            by_indi.lighting.label.clone(),
            by_indi.setting.way.to_string(),
        ],
        numbers: numbers.collect(),
    }
}
