//! How runs are split into two halves.

use rand_core::Rng;
use rand_pcg::Pcg32;

/// How many ways of splitting more than a few runs are looked at. The width of an interval is then within 7 % of that by all of them.
const MOST_SPLITS: usize = 100;

/// Up to as many runs all ways of splitting are looked at: 70 of seven, 35 of eight.
const ALL_OF: usize = 8;

/// Seed of the random splits.
const SEED: u64 = 0x6d61_6e79;

/// Two disjoint halves, by the numbers of their runs.
pub type Split = [Vec<usize>; 2];

/// Ways of splitting so many runs into two halves of equal size, of which an odd run is left out: all of them, or
/// `MOST_SPLITS` at random. Equal numbers of runs are split alike. None of fewer than two runs.
pub fn splits(runs: usize) -> Vec<Split> {
    match runs {
        0 | 1 => vec![],
        _ if runs <= ALL_OF => all(runs),
        _ => random(runs),
    }
}

fn all(runs: usize) -> Vec<Split> {
    let half = (runs / 2) as u32;
    let sets: Vec<u32> = (0..1_u32 << runs).filter(|set| set.count_ones() == half).collect();
    let members = |set: u32| (0..runs).filter(|run| set >> run & 1 == 1).collect();
    let disjoint = |a: u32| sets.iter().filter(move |&&b| a < b && a & b == 0).map(move |&b| [a, b]);
    sets.iter().flat_map(|&a| disjoint(a)).map(|pair| pair.map(members)).collect()
}

fn random(runs: usize) -> Vec<Split> {
    let mut random = Pcg32::new(SEED, runs as u64);
    let mut order: Vec<usize> = (0..runs).collect();
    let half = runs / 2;
    let mut split = || {
        for last in (1..runs).rev() {
            order.swap(last, below(&mut random, last + 1));
        }
        [order[..half].to_vec(), order[half..2 * half].to_vec()]
    };
    (0..MOST_SPLITS).map(|_| split()).collect()
}

/// A whole number from 0 to below `end`.
pub(super) fn below(random: &mut Pcg32, end: usize) -> usize {
    ((u64::from(random.next_u32()) * end as u64) >> 32) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn halves_are_disjoint_and_of_equal_size() {
        for runs in 0..30 {
            for [a, b] in splits(runs) {
                assert_eq!((a.len(), b.len()), (runs / 2, runs / 2));
                let members: BTreeSet<usize> = a.iter().chain(&b).copied().collect();
                assert!(members.len() == 2 * (runs / 2) && members.iter().all(|&run| run < runs));
            }
        }
    }

    #[test]
    fn few_runs_are_split_in_every_way() {
        let counts: Vec<usize> = (0..=8).map(|runs| splits(runs).len()).collect();
        assert_eq!(counts, [0, 0, 1, 3, 3, 15, 10, 70, 35]);
        assert_eq!(splits(20).len(), MOST_SPLITS);
        assert_eq!(splits(20), splits(20));
    }
}
