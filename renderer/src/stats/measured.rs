//! A number with its noise, and numbers computed from several.

use super::noise::{Halves, Interval, LEVEL, Noise};
use serde::Serialize;

/// What an interval is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// Temporal runs: the noise of measuring.
    Runs,
    /// The frames of the one run there is: how they differ, and nothing of what shifts a run as a whole.
    Frames,
}

/// A number with what it takes to tell its noise, and that of whatever is computed from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The number.
    pub value: f64,
    resampled: Resampled,
}

/// The same number of other data.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Resampled {
    /// Of halves of the runs.
    Runs(Halves<f64>),
    /// Of so many frames drawn in blocks, many times.
    Frames { frames: usize, drawn: Vec<f64> },
    /// There is too little.
    Nothing,
}

impl Measured {
    pub(super) fn new(value: f64, resampled: Resampled) -> Self {
        Self { value, resampled }
    }

    /// What its interval is made of; `None` where it has none.
    pub fn basis(&self) -> Option<Basis> {
        match self.resampled {
            Resampled::Runs(_) => Some(Basis::Runs),
            Resampled::Frames { .. } => Some(Basis::Frames),
            Resampled::Nothing => None,
        }
    }

    /// Its noise over repetitions; `None` where fewer than two runs tell of it.
    pub fn noise(&self) -> Option<Noise> {
        let Resampled::Runs(halves) = &self.resampled else { return None };
        Noise::of_halves(halves)
    }

    /// From where to where it lies in 95 % of repetitions.
    pub fn interval(&self) -> Option<Interval> {
        match &self.resampled {
            Resampled::Frames { drawn, .. } => Some(percentiles(drawn)),
            _ => self.noise().map(|noise| Interval::around(self.value, noise.half_width(LEVEL))),
        }
    }

    /// A number computed from several, with its noise. It is paired: by frame, and by run where all have as many. There
    /// is no noise where they do not: minima over different numbers of runs do not compare.
    pub fn combine<const N: usize>(parts: [&Self; N], of: impl Fn([f64; N]) -> f64) -> Self {
        let value = of(parts.map(|part| part.value));
        let resampled = match parts[0].resampled {
            Resampled::Runs(ref first) => {
                let all = parts.map(|part| part.halves_of(first.runs));
                match all.iter().all(Option::is_some) {
                    true => Resampled::Runs(computed(first, &all.map(|halves| halves.unwrap_or(first)), of)),
                    false => Resampled::Nothing,
                }
            }
            Resampled::Frames { frames, ref drawn } => {
                let all = parts.map(|part| part.drawn_of(frames));
                let computed = |draw: usize| of(all.map(|drawn| drawn.unwrap_or(&[])[draw]));
                match all.iter().all(Option::is_some) {
                    true => Resampled::Frames { frames, drawn: (0..drawn.len()).map(computed).collect() },
                    false => Resampled::Nothing,
                }
            }
            Resampled::Nothing => Resampled::Nothing,
        };
        Self { value, resampled }
    }

    /// The logarithm, in which ratios are differences.
    pub fn ln(&self) -> Self {
        Self::combine([self], |[value]| value.ln())
    }

    /// From where to where the ratio to another number lies in 95 % of repetitions; `None` too where one is not above 0.
    pub fn ratio_to(&self, other: &Self) -> Option<Interval> {
        let ratio = Self::combine([self, other], |[value, other]| (value / other).ln());
        ratio.interval().map(|logarithm| logarithm.exp()).filter(|interval| interval.half().is_finite())
    }

    fn halves_of(&self, runs: usize) -> Option<&Halves<f64>> {
        match &self.resampled {
            Resampled::Runs(halves) if halves.runs == runs => Some(halves),
            _ => None,
        }
    }

    fn drawn_of(&self, wanted: usize) -> Option<&[f64]> {
        match &self.resampled {
            Resampled::Frames { frames, drawn } if *frames == wanted => Some(drawn),
            _ => None,
        }
    }
}

/// What is computed from numbers of which all have halves of as many runs.
fn computed<const N: usize>(
    shape: &Halves<f64>,
    parts: &[&Halves<f64>; N],
    of: impl Fn([f64; N]) -> f64,
) -> Halves<f64> {
    let pair = |split: usize| [0, 1].map(|side| of(parts.map(|part| part.pairs[split][side])));
    Halves { runs: shape.runs, pairs: (0..shape.pairs.len()).map(pair).collect() }
}

/// What the middle 95 % of values span.
fn percentiles(values: &[f64]) -> Interval {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |part| super::sample::percentile(&sorted, part);
    Interval { low: at((1.0 - LEVEL) / 2.0), high: at((1.0 + LEVEL) / 2.0) }
}

#[cfg(test)]
mod tests {
    use super::super::Samples;
    use super::*;

    fn measured(runs: &[f64]) -> Measured {
        Samples::new(1, runs.iter().map(|&time| vec![time]).collect()).unwrap().measure()
    }

    #[test]
    fn two_runs_are_as_wide_as_one_difference_allows() {
        let number = measured(&[10.0, 12.0]);
        assert_eq!((number.value, number.basis()), (10.0, Some(Basis::Runs)));
        let noise = number.noise().unwrap();
        assert!((noise.deviation - 2.0_f64.sqrt()).abs() < 1e-12 && noise.freedom == 1.0);
        assert!((number.interval().unwrap().half() / (12.706 * 2.0_f64.sqrt()) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn what_two_methods_share_cancels_in_their_ratio() {
        let ratio = measured(&[1.0, 1.5, 3.0, 1.2]).ratio_to(&measured(&[2.0, 3.0, 6.0, 2.4])).unwrap();
        assert!((ratio.low - 0.5).abs() < 1e-12 && (ratio.high - 0.5).abs() < 1e-12, "{ratio:?}");
        assert_eq!(measured(&[1.0, 1.5]).ratio_to(&measured(&[2.0, 3.0, 6.0])), None, "not as many runs");
        assert_eq!(measured(&[1.0, 2.0]).ratio_to(&measured(&[0.0, 0.0])), None);
    }

    #[test]
    fn one_run_speaks_of_its_frames_alone() {
        let of = |frames: Vec<f64>| Samples::new(frames.len(), vec![frames]).unwrap().measure();
        let varied = of((0..64).map(|place| f64::from(place % 7)).collect());
        assert_eq!((varied.basis(), varied.noise()), (Some(Basis::Frames), None));
        assert!(varied.interval().unwrap().straddles(varied.value));
        let doubled = of((0..64).map(|place| f64::from(place % 7) * 2.0).collect());
        let ratio = doubled.ratio_to(&varied).unwrap();
        assert!((ratio.low - 2.0).abs() < 1e-12 && (ratio.high - 2.0).abs() < 1e-12);
        assert_eq!(of(vec![1.0, 2.0]).interval(), None);
    }
}
