//! G4 and G5: what far geometry does to Persp and to Ortho.

use super::is_far;
use crate::methods::Method;
use crate::report::claim::{Findings, Outcome, mean_where, milliseconds, number};
use crate::report::gelderen::flies_the_street;
use crate::report::results::{ResultSet, Run, TUNED, indi, metric};

pub(super) fn persp(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for run in on_the_street(set, indi(TUNED[0]), &mut findings) {
        compare(&mut findings, run, metric::VISIBLE, "visible clusters", |far, near| {
            Outcome::above(near, far)
        });
        let lights = |far: bool| {
            let total = |metric| mean_where(run, metric, |frame| is_far(frame) == far);
            Some(total(metric::INDICES)? / total(metric::VISIBLE)?)
        };
        if let (Some(far), Some(near)) = (lights(true), lights(false)) {
            let comparison = format!("lights a visible cluster, {}", run.lighting.label);
            let numbers = vec![number("far", far), number("others", near)];
            findings.compare(run, comparison, numbers, Outcome::above(far, near));
        }
        compare(&mut findings, run, metric::SHADE, "shading time", Outcome::above);
    }
    findings
}

pub(super) fn ortho(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for run in on_the_street(set, indi(TUNED[1]), &mut findings) {
        for (metric, what) in [(metric::VISIBLE, "visible clusters"), (metric::CLUSTER, "clustering time")] {
            let points = run.frames.points(metric);
            let Some(most) = points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1])) else {
                findings.lack("temporal runs of Indi Ortho 4");
                continue;
            };
            let make = if metric == metric::CLUSTER { milliseconds } else { number };
            let numbers = vec![number("frame with the most", most[0]), make("its value".to_owned(), most[1])];
            let peak = |far: bool| {
                let there = points.iter().filter(|point| is_far(point[0] as u32) == far);
                there.map(|point| point[1]).fold(f64::NEG_INFINITY, f64::max)
            };
            let outcome = Outcome { holds: is_far(most[0] as u32), margin: peak(true) - peak(false) };
            findings.compare(run, format!("{what}, {}", run.lighting.label), numbers, outcome);
        }
    }
    findings
}

/// Runs of `method` on the street's recording that have frames both within the far stretch and without: mono, or
/// stereo where there is no mono.
fn on_the_street<'a>(set: &'a ResultSet, method: Method, findings: &mut Findings) -> Vec<&'a Run> {
    let usable = |run: &&Run| {
        let frames = &run.frames.numbers;
        run.method == method
            && flies_the_street(&run.setting)
            && frames.iter().any(|&frame| is_far(frame))
            && frames.iter().any(|&frame| !is_far(frame))
    };
    let all: Vec<&Run> = set.runs.iter().filter(usable).collect();
    let mono: Vec<&Run> = all.iter().copied().filter(|run| !run.setting.is_stereo()).collect();
    if all.is_empty() {
        findings
            .lack(format!("{method} on the street's recording, with frames within 530 to 630 and without"));
    }
    if mono.is_empty() { all } else { mono }
}

fn compare(findings: &mut Findings, run: &Run, metric: &str, what: &str, outcome: fn(f64, f64) -> Outcome) {
    let at = |far: bool| mean_where(run, metric, |frame| is_far(frame) == far);
    let (Some(far), Some(near)) = (at(true), at(false)) else {
        return findings.lack("temporal runs of Indi Persp 64");
    };
    let make = if metric == metric::SHADE { milliseconds } else { number };
    let numbers = vec![make("far".to_owned(), far), make("others".to_owned(), near)];
    findings.compare(run, format!("{what}, {}", run.lighting.label), numbers, outcome(far, near));
}
