//! The comparison of stage times: ratios of minima, and the noise between runs.

use super::{Spread, TimeComparison};
use crate::Result;
use crate::output::{TimingRow, each_row, stage_kind};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What one result set says of a kind of stage.
#[derive(Default)]
struct KindTimes {
    /// By frame: by path: the minimum over runs.
    minima: BTreeMap<u32, BTreeMap<String, f64>>,
    /// By run: the total over frames.
    totals: BTreeMap<u32, f64>,
}

/// A row for every kind of stage that both sides timed, parents first. Frames but those in `frames` are left out.
pub(super) fn compare(a: &Path, b: &Path, frames: &BTreeSet<u32>) -> Result<Vec<TimeComparison>> {
    let [a, b] = [kinds(a, frames)?, kinds(b, frames)?];
    Ok(a.iter().filter_map(|(kind, a)| Some(compare_kind(kind, a, b.get(kind)?))).flatten().collect())
}

fn kinds(directory: &Path, frames: &BTreeSet<u32>) -> Result<BTreeMap<String, KindTimes>> {
    let mut kinds: BTreeMap<String, KindTimes> = BTreeMap::new();
    each_row(directory, |_, row: TimingRow| {
        // Stages without a GPU time are left out.
        let Some(gpu_ms) = row.gpu_ms.filter(|_| frames.contains(&row.frame)) else { return Ok(()) };
        let times = kinds.entry(stage_kind(&row.stage)).or_default();
        let stages = times.minima.entry(row.frame).or_default();
        let minimum = stages.entry(row.stage).or_insert(f64::INFINITY);
        *minimum = minimum.min(gpu_ms);
        *times.totals.entry(row.run).or_default() += gpu_ms;
        Ok(())
    })?;
    Ok(kinds)
}

/// `None` where no frame was timed on both sides, or a time is 0.
fn compare_kind(kind: &str, a: &KindTimes, b: &KindTimes) -> Option<TimeComparison> {
    let sum = |stages: &BTreeMap<String, f64>| stages.values().sum::<f64>();
    let pairs: Vec<(f64, f64)> = a
        .minima
        .iter()
        .filter_map(|(frame, stages)| Some((sum(stages), sum(b.minima.get(frame)?))))
        .filter(|(a, _)| *a > 0.0)
        .collect();
    let over_frames = Spread::of(pairs.iter().map(|(a, b)| b / a).collect())?;
    let mean = |get: fn(&(f64, f64)) -> f64| pairs.iter().map(get).sum::<f64>() / pairs.len() as f64;
    let (a_ms, b_ms) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let ratio = b_ms / a_ms;
    let spreads = [spread_over_runs(&a.totals), spread_over_runs(&b.totals)];
    let noise = spreads[0].zip(spreads[1]).map(|(a, b)| (1.0 + a) * (1.0 + b) - 1.0);
    Some(TimeComparison {
        stage: kind.to_owned(),
        a_ms,
        b_ms,
        ratio,
        over_frames,
        spread_over_runs_a: spreads[0],
        spread_over_runs_b: spreads[1],
        noise,
        exceeds_noise: noise.map(|noise| ratio.max(1.0 / ratio) > 1.0 + noise),
    })
}

/// The longest total over the shortest, minus 1; `None` for fewer than two runs.
fn spread_over_runs(totals: &BTreeMap<u32, f64>) -> Option<f64> {
    let bounds = totals.values().fold((f64::INFINITY, 0.0_f64), |(min, max), &t| (min.min(t), max.max(t)));
    (totals.len() > 1 && bounds.0 > 0.0).then(|| bounds.1 / bounds.0 - 1.0)
}
