//! G6 to G8: steadiness, the bound of a cluster's fragments, growth with the lights.

use crate::report::claim::{Findings, Outcome, mean, milliseconds, number};
use crate::report::results::{ResultSet, Run, Setting, TUNED, indi, lightings, method_name, metric};
use crate::stats::{Statistics, slope};

pub(super) fn steadiness(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for setting in mono_first(set) {
        for lighting in lightings(set.of(setting)) {
            let deviation = |place: usize| {
                let method = indi(TUNED[place]);
                let run = set.of_method(setting, method).into_iter().find(|run| run.lighting == lighting)?;
                // One frame is always steady.
                let values: Vec<f64> = run.frames.values(metric::FRAME).collect();
                (values.len() > 1).then(|| Statistics::of(values).map(|found| (run, found.deviation)))?
            };
            let (Some((_, persp)), Some((_, ortho)), Some((run, displ))) =
                (deviation(0), deviation(1), deviation(2))
            else {
                continue;
            };
            let numbers = [("Persp 64", persp), ("Ortho 4", ortho), ("Displ 64 32", displ)];
            let numbers = numbers.map(|(name, value)| milliseconds(name, value)).to_vec();
            let comparison = format!("standard deviation of the frame's time, {}", lighting.label);
            let outcome = Outcome::above(persp, displ).and(Outcome::above(ortho, displ));
            findings.compare(run, comparison, numbers, outcome);
        }
    }
    if findings.evidence.is_empty() {
        findings.lack("temporal runs of Indi Persp 64, Ortho 4 and Displ 64 32 under one lighting");
    }
    findings
}

pub(super) fn fragments(set: &ResultSet) -> Findings {
    const MOST: u64 = 64 * 64;
    let mut findings = Findings::default();
    for run in set.runs.iter().filter(|run| run.method == indi(TUNED[0]) && run.setting.msaa == 1) {
        let Some(most) = run.most_fragments else { continue };
        let comparison = format!("most fragments of a cluster, {}", run.lighting.label);
        let outcome = Outcome::within(most as f64, [0.0, MOST as f64]);
        findings.compare(run, comparison, vec![number("most", most as f64)], outcome);
    }
    if findings.evidence.is_empty() {
        findings.lack("runs of Indi Persp 64 at one sample a pixel");
    }
    findings
}

pub(super) fn growth(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for setting in mono_first(set) {
        for space in TUNED {
            let runs = set.of_method(setting, indi(space));
            grows(&mut findings, &runs, "intersection tests", [0.99, 1.01], |run| mean(run, metric::TESTS));
            grows(&mut findings, &runs, "time to count and assign", [0.8, 1.2], |run| {
                Some(mean(run, metric::COUNT)? + mean(run, metric::ASSIGN)?)
            });
        }
    }
    for what in ["intersection tests", "time to count and assign"] {
        if !findings.evidence.iter().any(|evidence| evidence.comparison.starts_with(what)) {
            findings.lack(format!("{what} of a tuned Indi method under two numbers of lights or more"));
        }
    }
    findings
}

/// Compares the exponent of growth over the lights with `bounds`, where there are two numbers of lights.
fn grows(
    findings: &mut Findings,
    runs: &[&Run],
    what: &str,
    bounds: [f64; 2],
    value: impl Fn(&Run) -> Option<f64>,
) {
    let points: Vec<(f64, f64)> = runs
        .iter()
        .filter_map(|run| Some((f64::from(run.lighting.count?), value(run)?)))
        .filter(|(lights, value)| *lights > 0.0 && *value > 0.0)
        .map(|(lights, value)| (lights.log10(), value.log10()))
        .collect();
    let Some(exponent) = slope(&points) else { return };
    let comparison = format!("{what}, {}", method_name(runs[0].method, false));
    let numbers = vec![number("exponent", exponent), number("numbers of lights", points.len() as f64)];
    findings.compare(runs[0], comparison, numbers, Outcome::within(exponent, bounds));
}

/// Mono settings; stereo ones where there is no mono.
fn mono_first(set: &ResultSet) -> Vec<&Setting> {
    let (stereo, mono): (Vec<&Setting>, Vec<&Setting>) =
        set.settings().into_iter().partition(|setting| setting.is_stereo());
    if mono.is_empty() { stereo } else { mono }
}
