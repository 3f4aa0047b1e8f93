//! The comparison of stage times: ratios of minima over runs, and what noise the ratio has.

use super::verdict::Verdict;
use super::{Spread, TimeComparison};
use crate::Result;
use crate::output::{FRAME, saved_samples};
use crate::stats::Samples;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A row for every kind of stage that both sides timed, parents first. Frames but those in `frames` are left out. Nothing
/// is judged yet: every verdict is undecided.
pub(super) fn compare(
    [a, b]: [&Path; 2],
    frames: &BTreeSet<u32>,
    stretch: [f64; 2],
) -> Result<Vec<TimeComparison>> {
    let frames: Vec<u32> = frames.iter().copied().collect();
    let [a, b] = [kinds(a, &frames)?, kinds(b, &frames)?];
    let compared = a.iter().filter_map(|(kind, a)| compare_kind(kind, [a, b.get(kind)?]));
    let mut times: Vec<TimeComparison> = compared.map(|time| TimeComparison { stretch, ..time }).collect();
    if let Some(frame_ms) = times.iter().find(|time| time.stage == FRAME).map(|frame| frame.a_ms) {
        times.iter_mut().for_each(|time| time.part_of_frame = time.a_ms / frame_ms);
    }
    Ok(times)
}

/// Times by kind of stage, over views and clusterings.
fn kinds(directory: &Path, frames: &[u32]) -> Result<BTreeMap<String, Samples>> {
    saved_samples(directory, frames, |kind| vec![kind.to_owned()])
}

/// Over as many runs as both have: minima over different numbers of runs do not compare. `None` where a time is 0.
fn compare_kind(kind: &str, sides: [&Samples; 2]) -> Option<TimeComparison> {
    let runs = sides[0].runs().min(sides[1].runs());
    let sides = sides.map(|side| side.first(runs));
    let [a, b] = sides.each_ref().map(Samples::minima);
    let pairs = a.iter().zip(&b).filter(|(a, _)| **a > 0.0);
    let over_frames = Spread::of(pairs.map(|(a, b)| b / a).collect())?;
    let [a, b] = sides.each_ref().map(Samples::measure);
    if a.value <= 0.0 || b.value <= 0.0 {
        return None;
    }
    let noise = a.ln().noise().zip(b.ln().noise()).map(|(a, b)| a.with(&b));
    let [spread_over_runs_a, spread_over_runs_b] = sides.each_ref().map(spread_over_runs);
    Some(TimeComparison {
        stage: kind.to_owned(),
        part_of_frame: 1.0,
        runs,
        a_ms: a.value,
        b_ms: b.value,
        ratio: b.value / a.value,
        over_frames,
        spread_over_runs_a,
        spread_over_runs_b,
        noise,
        stretch: [1.0; 2],
        interval: None,
        verdict: Verdict::Undecided,
    })
}

/// The longest run's mean over the shortest one's, minus 1; `None` for fewer than two runs.
fn spread_over_runs(samples: &Samples) -> Option<f64> {
    let means = (0..samples.runs()).map(|run| samples.minima_over(&[run]).iter().sum::<f64>());
    let bounds = means.fold((f64::INFINITY, 0.0_f64), |(min, max), total| (min.min(total), max.max(total)));
    (samples.runs() > 1 && bounds.0 > 0.0).then(|| bounds.1 / bounds.0 - 1.0)
}
