//! Successive halving (Jamieson and Talwalkar 2016): pure.
//!
//! ```text
//! all candidates, one frame ─> the faster half, two frames ─> a quarter, four frames ─> ... ─> the last few ─> decision
//! ```
//!
//! As many measurements are spent on each rung as on the one before, so that most go to those that are hard to tell apart.

use crate::stats::Measured;
use std::collections::{BTreeMap, BTreeSet};

/// So many are no longer halved: they are measured until they are told apart, or are not.
pub const FEW: usize = 4;

/// How many times as slow as the best so far a chain ends.
const TOO_SLOW: f64 = 10.0;

/// Halves candidates, which are numbers, until [`FEW`] are left; `scores` tells, of some and by so many frames of at most
/// `frames`, how slow each is, or infinity where it drops out. What is left comes fastest first.
///
/// # Errors
/// Those of `scores`.
pub fn halve<E>(
    candidates: usize,
    frames: usize,
    mut scores: impl FnMut(&[usize], usize) -> Result<Vec<f64>, E>,
) -> Result<Vec<usize>, E> {
    let mut left: Vec<usize> = (0..candidates).collect();
    let mut used = 1;
    while left.len() > FEW {
        let scored = scores(&left, used.min(frames))?;
        left = faster(&left, &scored);
        used *= 2;
    }
    Ok(left)
}

/// The faster half, or [`FEW`] where that is more.
fn faster(left: &[usize], scores: &[f64]) -> Vec<usize> {
    let finite = left.iter().zip(scores).filter(|(_, score)| score.is_finite());
    let mut ranked: Vec<(usize, f64)> = finite.map(|(&candidate, &score)| (candidate, score)).collect();
    ranked.sort_by(|a, b| a.1.total_cmp(&b.1));
    ranked.truncate(left.len().div_ceil(2).max(FEW));
    ranked.into_iter().map(|(candidate, _)| candidate).collect()
}

/// Which of the last few is the fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decision {
    /// Its number.
    pub best: usize,
    /// The next, where there is one.
    pub runner_up: Option<usize>,
    /// Whether the interval of their ratio says that the next may be as fast.
    pub undecided: bool,
}

/// Decides by times that were taken in turn; `None` for what could not be timed.
pub fn decide(times: &[Option<Measured>]) -> Option<Decision> {
    let timed = times.iter().enumerate().filter_map(|(number, time)| Some((number, time.as_ref()?)));
    let mut ranked: Vec<(usize, &Measured)> = timed.collect();
    ranked.sort_by(|a, b| a.1.value.total_cmp(&b.1.value));
    let (best, time) = *ranked.first()?;
    let next = ranked.get(1);
    let undecided = next.is_some_and(|(_, next)| next.ratio_to(time).is_none_or(|ratio| ratio.low <= 1.0));
    Some(Decision { best, runner_up: next.map(|(number, _)| *number), undecided })
}

/// Candidates that differ in one size alone, tried from the largest size on: where one is far slower than the best and
/// than the one before it, smaller sizes are not tried.
#[derive(Debug, Default)]
pub struct Chains {
    best: Option<f64>,
    last: BTreeMap<String, f64>,
    ended: BTreeSet<String>,
}

impl Chains {
    /// Whether the next of a chain is to be tried.
    pub fn is_open(&self, chain: &str) -> bool {
        !self.ended.contains(chain)
    }

    /// Takes how slow one candidate of each of some chains is.
    pub fn take(&mut self, scores: Vec<(String, f64)>) {
        let known = scores.iter().map(|(_, score)| *score).chain(self.best);
        self.best = known.min_by(f64::total_cmp);
        let limit = self.best.map_or(f64::INFINITY, |best| TOO_SLOW * best);
        for (chain, score) in scores {
            if score.is_finite() && score > limit && self.last.get(&chain).is_some_and(|&last| score > last) {
                self.ended.insert(chain.clone());
            }
            self.last.insert(chain, score);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::Samples;
    use rand_core::Rng;
    use rand_pcg::Pcg32;
    use std::convert::Infallible;

    const CANDIDATES: usize = 63;
    const FRAMES: usize = 15;

    /// One plus noise of a deviation.
    fn noise(random: &mut Pcg32, deviation: f64) -> f64 {
        let sum: f64 = (0..12).map(|_| f64::from(random.next_u32()) / 4_294_967_296.0).sum();
        1.0 + deviation * (sum - 6.0)
    }

    /// How slow a candidate is: the best is that of number 17.
    fn truth(candidate: usize) -> f64 {
        10.0 + candidate.abs_diff(17) as f64
    }

    fn halved(seed: u64, deviation: f64) -> (Vec<usize>, usize) {
        let (random, mut frames) = (&mut Pcg32::new(seed, 1), 0);
        let left = halve(CANDIDATES, FRAMES, |left, used| {
            frames += left.len() * used;
            let mean = |&candidate: &usize| {
                (0..used).map(|_| truth(candidate) * noise(random, deviation)).sum::<f64>() / used as f64
            };
            Ok::<_, Infallible>(left.iter().map(mean).collect())
        });
        (left.unwrap(), frames)
    }

    #[test]
    fn a_known_best_is_found_under_noise_with_a_part_of_the_frames() {
        for seed in 0..50 {
            let (left, frames) = halved(seed, 0.04);
            assert!(left.contains(&17) && left.len() == FEW, "{seed}: {left:?}");
            assert!(frames < CANDIDATES * FRAMES / 3, "{frames}");
        }
        assert_eq!(halved(1, 0.0).0[0], 17);
        assert_eq!(halved(3, 0.04), halved(3, 0.04));
    }

    #[test]
    fn frames_double_up_to_all_and_what_drops_out_is_gone() {
        let mut rungs = vec![];
        let left = halve(20, 3, |left, used| {
            rungs.push((left.len(), used));
            let score = |&candidate: &usize| if candidate < 2 { f64::INFINITY } else { candidate as f64 };
            Ok::<_, Infallible>(left.iter().map(score).collect())
        });
        assert_eq!((left.unwrap(), rungs), (vec![2, 3, 4, 5], vec![(20, 1), (10, 2), (5, 3)]));
        let few = halve(3, 3, |_, _| Err("few are not measured"));
        assert_eq!(few, Ok(vec![0, 1, 2]));
        assert_eq!(halve(9, 3, |_, _| Err("lost")), Err("lost"));
    }

    fn measured(mean: f64, seed: u64) -> Option<Measured> {
        let random = &mut Pcg32::new(seed, 1);
        let runs = (0..8).map(|_| (0..FRAMES).map(|_| mean * noise(random, 0.02)).collect());
        Samples::new(FRAMES, runs.collect()).map(|samples| samples.measure())
    }

    #[test]
    fn clear_winners_are_decided_and_ties_are_not() {
        let clear = decide(&[measured(12.0, 1), None, measured(10.0, 2), measured(11.0, 3)]).unwrap();
        assert_eq!(clear, Decision { best: 2, runner_up: Some(3), undecided: false });
        assert!(decide(&[measured(10.0, 1), measured(10.0, 2), measured(20.0, 3)]).unwrap().undecided);
        let one = decide(&[None, measured(1.0, 1)]).unwrap();
        assert_eq!(one, Decision { best: 1, runner_up: None, undecided: false });
        assert_eq!(decide(&[None]), None);
    }

    #[test]
    fn a_chain_ends_where_it_is_slow_and_gets_slower() {
        let mut chains = Chains::default();
        let take = |chains: &mut Chains, scores: [f64; 2]| {
            chains.take(["brute", "scatter"].map(str::to_owned).into_iter().zip(scores).collect());
            ["brute", "scatter"].map(|chain| chains.is_open(chain))
        };
        // Far slower at the start, but smaller sizes may be better.
        assert_eq!(take(&mut chains, [20.0, 1.0]), [true, true]);
        assert_eq!(take(&mut chains, [15.0, 0.9]), [true, true]);
        assert_eq!(take(&mut chains, [16.0, 5.0]), [false, true]);
        assert_eq!(take(&mut chains, [f64::INFINITY, 8.9]), [false, true]);
    }
}
