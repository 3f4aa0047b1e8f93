//! What noise does to a comparison: it is made again with the times of either half of the temporal runs.
//!
//! ```text
//! runs ──> halves ──> a ResultSet each ──> the claims' own functions ──> margins ──> interval ──> decided?
//! ```
//!
//! So claims know nothing of noise, and an interval is that of whatever they compute: a ratio, a saving, an exponent, a
//! peak. Methods are paired by frame and run. See [`crate::stats`].

use super::{Findings, Stated};
use crate::report::results::{ResultSet, Run};
use crate::stats::{Halves, Interval, LEVEL, Noise, Samples, Split, splits};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What each claim finds, with the intervals of its margins.
pub fn findings(stated: &[&Stated], set: &ResultSet) -> Vec<Findings> {
    let mut found: Vec<Findings> = stated.iter().map(|stated| (stated.find)(set)).collect();
    let Some(margins) = Repeats::of(set).map(|repeats| repeats.margins(stated)) else { return found };
    let all = found.iter_mut().flat_map(|findings| &mut findings.evidence);
    for (place, evidence) in all.enumerate() {
        let comparison = (&evidence.setting, &evidence.comparison);
        let of = |side: &Margins| {
            let (setting, compared, margin) = side.get(place)?;
            ((setting, compared) == comparison).then_some(*margin)
        };
        let pairs = margins.pairs.iter().map(|[a, b]| Some([of(a)?, of(b)?])).collect::<Option<Vec<_>>>();
        let noise = pairs.and_then(|pairs| Noise::of_halves(&Halves { runs: margins.runs, pairs }));
        let Some(noise) = noise.filter(|noise| noise.deviation > 0.0) else { continue };
        let interval = Interval::around(evidence.margin, noise.half_width(LEVEL));
        evidence.decided = !interval.straddles(0.0);
        evidence.interval = Some(interval);
    }
    found
}

/// Setting, comparison and margin of all evidence of all claims.
type Margins = Vec<(String, String, f64)>;

/// A result set whose times can be made those of some of the runs.
struct Repeats<'a> {
    set: &'a ResultSet,
    /// Without what claims do not look at for times.
    light: ResultSet,
    /// By number of runs.
    splits: BTreeMap<usize, Vec<Split>>,
}

impl<'a> Repeats<'a> {
    /// `None` where nothing was timed, or something once alone.
    fn of(set: &'a ResultSet) -> Option<Self> {
        let times = set.runs.iter().flat_map(|run| run.times.values());
        let counts: Vec<usize> = times.map(Samples::runs).collect();
        if counts.iter().min()? < &2 {
            return None;
        }
        let splits = counts.into_iter().map(|runs| (runs, splits(runs))).collect();
        let light = |run: &Run| Run {
            distributions: BTreeMap::new(),
            pictures: vec![],
            times: BTreeMap::new(),
            ..run.clone()
        };
        let runs = set.runs.iter().map(light).collect();
        Some(Self { set, light: ResultSet { runs, older: vec![], ..set.clone() }, splits })
    }

    /// Of either half, in each way of splitting.
    fn margins(&self, stated: &[&Stated]) -> Halves<Margins> {
        let runs = self.splits.keys().next().copied().unwrap_or(0);
        let ways = self.splits.values().map(Vec::len).max().unwrap_or(0);
        let of = |set: ResultSet| -> Margins {
            let evidence = stated.iter().flat_map(|stated| (stated.find)(&set).evidence);
            evidence.map(|evidence| (evidence.setting, evidence.comparison, evidence.margin)).collect()
        };
        let pair = |way: usize| [0, 1].map(|side| of(self.half(way, side)));
        Halves { runs, pairs: (0..ways).into_par_iter().map(pair).collect() }
    }

    /// The set with the times of half of the runs.
    fn half(&self, way: usize, side: usize) -> ResultSet {
        let mut set = self.light.clone();
        for (run, whole) in set.runs.iter_mut().zip(&self.set.runs) {
            for (column, samples) in &whole.times {
                let splits = &self.splits[&samples.runs()];
                let minima = samples.minima_over(&splits[way % splits.len()][side]);
                run.frames.replace(column, minima);
            }
        }
        set
    }
}
