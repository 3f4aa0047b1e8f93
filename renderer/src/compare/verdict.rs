//! Faster, slower, same or undecided: what noise lets be said of ratios of times.
//!
//! A sweep compares hundreds of times, of which one in twenty lies outside its own 95 % interval by chance alone. So that
//! such do not block a merge, times are judged together, those of whole frames by themselves and those of stages by
//! themselves, so that the many stages do not blur what is said of frames: by Benjamini and Hochberg (*Controlling the False Discovery
//! Rate*, 1995), at most 5 % of those called changed are expected to be unchanged, and where nothing changed at all there
//! is with a chance of 95 % no such. The intervals told are widened to match (Benjamini and Yekutieli 2005), so that
//! one rule and one interval decide.
//!
//! Where the CPUs are the device, what others took of them may have lengthened times; on two occasions by different
//! factors, of which the noise within either shows nothing. An interval is widened by as much ([`TimeComparison`]'s `stretch`):
//! no difference is told that load alone may account for.
//!
//! A short stage changes by tens of percent with a clock or with what ran before it, which matters to nobody: a stage's
//! change must also be a change of the frame ([`LEAST_OF_FRAME`]).

use super::TimeComparison;
use crate::stats::{Interval, LEVEL};
use serde::Serialize;
use std::fmt;

/// A stage's change must be of as large a part of the frame's time, in thresholds: a quarter of a percent by default.
const LEAST_OF_FRAME: f64 = 0.25;

/// What can be said of a ratio of times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The interval lies below 1, the ratio beyond the threshold, and the change is more than a quarter of the threshold of
    /// the frame's time.
    Faster,
    /// The interval lies above 1, the ratio beyond the threshold, and the change is as above.
    Slower,
    /// The whole interval lies within the threshold, or within what changes the frame by a quarter of it.
    Same,
    /// None of these; or a side has fewer than two temporal runs, which tell nothing of noise.
    Undecided,
}

/// How many times there are of each verdict.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Faster.
    pub faster: usize,
    /// Slower.
    pub slower: usize,
    /// Same.
    pub same: usize,
    /// Undecided.
    pub undecided: usize,
}

/// Judges times together; a ratio matters that differs from 1 by more than `threshold` (0.01 for one percent).
pub(super) fn judge(times: &mut [&mut TimeComparison], threshold: f64) {
    let chances = times.iter().filter_map(|time| Some(time.noise?.chance(unexplained(time))));
    let level = 1.0 - selected_rate(chances.collect());
    for time in times {
        let Some(noise) = time.noise else { continue };
        let Interval { low, high } = Interval::around(time.ratio.ln(), noise.half_width(level)).exp();
        let [a, b] = time.stretch;
        let interval = Interval { low: low / b, high: high * a };
        time.interval = Some(interval);
        time.verdict = verdict(time.ratio, interval, [threshold, time.part_of_frame]);
    }
}

/// What load does not account for of the logarithm of a ratio.
fn unexplained(time: &TimeComparison) -> f64 {
    let [a, b] = time.stretch.map(f64::ln);
    let difference = time.ratio.ln();
    if difference > 0.0 { (difference - b).max(0.0) } else { (difference + a).min(0.0) }
}

/// By the ratio of a stage that took such a part of the frame's time.
fn verdict(ratio: f64, interval: Interval, [threshold, part_of_frame]: [f64; 2]) -> Verdict {
    let least = 1.0 + threshold.max(LEAST_OF_FRAME * threshold / part_of_frame);
    if interval.low > 1.0 && ratio > least {
        Verdict::Slower
    } else if interval.high < 1.0 && ratio < 1.0 / least {
        Verdict::Faster
    } else if interval.low >= 1.0 / least && interval.high <= least {
        Verdict::Same
    } else {
        Verdict::Undecided
    }
}

/// How rarely an interval may miss: of the chances that noise alone makes such differences, the `k` least are called
/// differences where `k` is the most for which all are at most k/n of 5 %; intervals are of that rate, of 1/n where none is.
fn selected_rate(mut chances: Vec<f64>) -> f64 {
    chances.sort_by(f64::total_cmp);
    let each = (1.0 - LEVEL) / chances.len().max(1) as f64;
    let rates = (1..=chances.len()).map(|count| each * count as f64);
    rates.zip(&chances).filter(|(rate, chance)| *chance <= rate).last().map_or(each, |(rate, _)| rate)
}

impl Tally {
    /// Of some times.
    pub fn of<'a>(times: impl IntoIterator<Item = &'a TimeComparison>) -> Self {
        let mut tally = Self::default();
        for time in times {
            *match time.verdict {
                Verdict::Faster => &mut tally.faster,
                Verdict::Slower => &mut tally.slower,
                Verdict::Same => &mut tally.same,
                Verdict::Undecided => &mut tally.undecided,
            } += 1;
        }
        tally
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { faster, slower, same, undecided } = self;
        write!(f, "{slower} slower, {faster} faster, {same} same, {undecided} undecided")
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Faster => "faster",
            Self::Slower => "slower",
            Self::Same => "same",
            Self::Undecided => "undecided",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Spread;
    use super::*;
    use crate::stats::Noise;

    #[test]
    fn verdicts_are_by_interval_and_threshold() {
        let of = |low: f64, high: f64| verdict((low * high).sqrt(), Interval { low, high }, [0.01, 1.0]);
        assert_eq!(of(1.03, 1.05), Verdict::Slower);
        assert_eq!(of(0.94, 0.99), Verdict::Faster);
        assert_eq!(of(1.002, 1.006), Verdict::Same, "a difference, and none that matters");
        assert_eq!(of(0.995, 1.03), Verdict::Undecided);
        assert_eq!(of(1.004, 1.012), Verdict::Undecided, "a difference that may or may not matter");
    }

    #[test]
    fn a_stage_must_change_the_frame_to_matter() {
        let of = |low: f64, high: f64, part: f64| {
            verdict((low * high).sqrt(), Interval { low, high }, [0.01, part])
        };
        assert_eq!(of(1.04, 1.06, 0.1), Verdict::Slower, "half a percent of the frame");
        assert_eq!(of(1.04, 1.06, 0.01), Verdict::Same, "a twentieth of a percent");
        assert_eq!(of(1.1, 1.6, 0.01), Verdict::Slower);
        assert_eq!(of(0.7, 1.4, 0.01), Verdict::Undecided);
    }

    fn time(ratio: f64, stretch: [f64; 2]) -> TimeComparison {
        TimeComparison {
            stage: "frame".into(),
            part_of_frame: 1.0,
            runs: 9,
            a_ms: 1.0,
            b_ms: ratio,
            ratio,
            over_frames: Spread { min: ratio, median: ratio, max: ratio },
            spread_over_runs_a: None,
            spread_over_runs_b: None,
            noise: Some(Noise { deviation: 0.002, freedom: 8.0 }),
            stretch,
            interval: None,
            verdict: Verdict::Undecided,
        }
    }

    #[test]
    fn no_difference_is_told_that_load_may_account_for() {
        let of = |ratio: f64, stretch: [f64; 2]| {
            let mut one = time(ratio, stretch);
            judge(&mut [&mut one], 0.01);
            one.verdict
        };
        assert_eq!([of(1.05, [1.0; 2]), of(0.95, [1.0; 2])], [Verdict::Slower, Verdict::Faster]);
        assert_eq!([of(1.05, [1.0, 1.1]), of(0.95, [1.1, 1.0])], [Verdict::Undecided; 2]);
        assert_eq!([of(1.05, [1.1, 1.0]), of(0.95, [1.0, 1.1])], [Verdict::Slower, Verdict::Faster]);
        assert_eq!(of(1.25, [1.1, 1.1]), Verdict::Slower);
        assert_eq!(of(1.0, [1.0, 1.1]), Verdict::Undecided);
    }

    #[test]
    fn the_more_are_compared_the_rarer_a_chance_must_be() {
        let near = |rate: f64, expected: f64| assert!((rate - expected).abs() < 1e-12, "{rate} {expected}");
        near(selected_rate(vec![0.04]), 0.05);
        near(selected_rate(vec![0.04, 0.5, 0.6, 0.7]), 0.05 / 4.0);
        near(selected_rate(vec![0.5, 0.001, 0.02, 0.7]), 2.0 * 0.05 / 4.0);
        near(selected_rate(vec![0.04; 4]), 0.05);
        near(selected_rate(vec![]), 0.05);
    }
}
