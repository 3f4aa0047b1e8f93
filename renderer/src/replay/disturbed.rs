//! Temporal runs that were disturbed as a whole: pure.
//!
//! Of each temporal run the median of its frames' times is taken. A run is called disturbed where its median lies farther
//! than [`SPREADS`] times the spread of the other runs' medians from the middle of those, and by more than [`CLOSE`] of it.
//! The middle is their median; the spread is how far from it three quarters of them lie at most, so that one disturbed run
//! hides no other, and no run is disturbed that has company: where the machine became slower half way, both halves are as
//! they are. With fewer than [`FEWEST_OTHERS`] other runs nothing is known of the spread.
//!
//! Of normal noise three quarters lie within 1.15 standard deviations, so six spreads are 6.9 of them; that few other runs
//! tell their spread badly makes false alarms more frequent than that suggests (one in seventy of five runs, one in five
//! hundred of eight). One costs a run and no more: what was repeated once is kept.

use crate::measure::Disturbance;
use crate::stats::percentile;

/// Fewer other runs say nothing of their spread.
pub const FEWEST_OTHERS: usize = 4;

/// How many spreads away a run is disturbed.
const SPREADS: f64 = 6.0;

/// Which part of the others lies within their spread.
const WITHIN: f64 = 0.75;

/// How close, relative to the others, no run is disturbed.
const CLOSE: f64 = 0.02;

/// The median of the times of a run's frames; NaN without any.
pub fn median(times: &[f64]) -> f64 {
    part(times.iter().copied(), 0.5)
}

/// The run that lies farthest beyond the others, by the medians of all, milliseconds. Runs that `settled` says were repeated
/// already are left alone. `None` where a median is missing (not finite).
pub fn disturbed(medians: &[f64], settled: impl Fn(u32) -> bool) -> Option<Disturbance> {
    if medians.len() <= FEWEST_OTHERS || !medians.iter().all(|median| median.is_finite()) {
        return None;
    }
    let candidates = (0..medians.len()).filter(|&run| !settled(run as u32));
    let beyond = candidates.map(|run| compared(medians, run)).filter(is_beyond);
    beyond.max_by(|a, b| excess(a).total_cmp(&excess(b)))
}

/// A run among the others.
fn compared(medians: &[f64], run: usize) -> Disturbance {
    let others = || medians.iter().enumerate().filter(|(other, _)| *other != run).map(|(_, &median)| median);
    let others_ms = part(others(), 0.5);
    let spread_ms = part(others().map(|other| (other - others_ms).abs()), WITHIN);
    Disturbance { run: run as u32, median_ms: medians[run], others_ms, spread_ms }
}

fn is_beyond(run: &Disturbance) -> bool {
    excess(run) > 0.0
}

/// How far it lies beyond what is not disturbed, milliseconds.
fn excess(run: &Disturbance) -> f64 {
    (run.median_ms - run.others_ms).abs() - (SPREADS * run.spread_ms).max(CLOSE * run.others_ms)
}

/// The value below which so large a part of some values lies, linear between neighbours; NaN of nothing.
fn part(values: impl Iterator<Item = f64>, fraction: f64) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    if sorted.is_empty() { f64::NAN } else { percentile(&sorted, fraction) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_core::Rng;
    use rand_pcg::Pcg32;

    fn found(medians: &[f64]) -> Option<u32> {
        disturbed(medians, |_| false).map(|run| run.run)
    }

    #[test]
    fn a_run_far_beyond_the_others_is_disturbed_on_either_side() {
        assert_eq!(found(&[10.0, 10.1, 13.0, 10.2, 10.05]), Some(2));
        assert_eq!(found(&[10.0, 10.1, 10.2, 10.05, 7.0]), Some(4));
        let run = disturbed(&[10.0, 10.1, 13.0, 10.3, 10.0], |_| false).unwrap();
        assert_eq!((run.median_ms, run.others_ms), (13.0, 10.05));
        assert!((run.spread_ms - 0.1).abs() < 1e-9, "{run:?}");
    }

    #[test]
    fn two_disturbed_runs_do_not_hide_each_other() {
        let mut medians = vec![10.0, 10.1, 30.0, 10.2, 10.05, 14.0, 10.1];
        assert_eq!(found(&medians), Some(2));
        medians[2] = 10.15;
        assert_eq!(found(&medians), Some(5));
    }

    #[test]
    fn a_machine_that_drifts_or_slows_down_half_way_disturbs_no_run() {
        let drift: Vec<f64> = (0..12).map(|run| 10.0 + 0.7 * f64::from(run)).collect();
        assert_eq!(found(&drift), None);
        assert_eq!(found(&[10.0, 10.1, 10.0, 14.0, 14.1, 14.0]), None);
    }

    #[test]
    fn few_runs_close_ones_repeated_ones_and_missing_times_are_left_alone() {
        assert_eq!(found(&[10.0, 10.0, 99.0, 10.0]), None);
        assert_eq!(found(&[10.0, 10.0, 10.1, 10.0, 10.0]), None);
        assert_eq!(found(&[10.0, 10.0, f64::NAN, 10.0, 99.0]), None);
        assert_eq!(disturbed(&[10.0, 10.1, 13.0, 10.2, 10.05], |run| run == 2), None);
    }

    #[test]
    fn noise_alone_is_seldom_called_a_disturbance() {
        let mut random = Pcg32::new(5, 5);
        // The sum of twelve uniform variables is close to normal, with deviation 1.
        let mut noisy = || {
            let sum: f64 = (0..12).map(|_| f64::from(random.next_u32()) / 4_294_967_296.0).sum();
            100.0 + 5.0 * (sum - 6.0)
        };
        for (runs, most) in [(5, 0.02), (8, 0.004), (15, 0.0005)] {
            let trials = (0..2000).map(|_| found(&(0..runs).map(|_| noisy()).collect::<Vec<_>>()));
            let alarms = trials.flatten().count() as f64 / 2000.0 / f64::from(runs);
            assert!(alarms < most, "{alarms} of {runs} runs");
        }
    }
}
