//! Resampling of blocks of neighbouring frames: what a single run has to offer.

use super::sample::mean;
use super::splits::below;
use rand_pcg::Pcg32;

/// Resamples made.
const RESAMPLES: usize = 400;

/// With fewer frames there are too few blocks to draw from.
const FEWEST_FRAMES: usize = 16;

/// Seed of the draws.
const SEED: u64 = 0x626c_6f63;

/// Means over blocks of √n values, drawn with replacement until there are at least n, in a circle. Series of equal
/// length are drawn alike, so that what is computed from several of them is paired. `None` of fewer than 16 values.
pub fn means(values: &[f64]) -> Option<Vec<f64>> {
    let count = values.len();
    if count < FEWEST_FRAMES {
        return None;
    }
    let block = (count as f64).sqrt().round() as usize;
    let blocks = count.div_ceil(block);
    // Sums of the values before each place, twice around, make a block one subtraction.
    let mut before = Vec::with_capacity(2 * count + 1);
    before.push(0.0);
    for value in values.iter().chain(values) {
        before.push(before[before.len() - 1] + value);
    }
    let mut random = Pcg32::new(SEED, count as u64);
    let mut drawn = || {
        let start = below(&mut random, count);
        before[start + block] - before[start]
    };
    let mut resample = || (0..blocks).map(|_| drawn()).sum::<f64>() / (blocks * block) as f64;
    Some((0..RESAMPLES).map(|_| resample()).collect())
}

/// Standard deviations of the same resamples.
pub fn deviations(values: &[f64]) -> Option<Vec<f64>> {
    let middle = mean(values.iter().copied())?;
    // About the middle, so that little is lost to rounding.
    let apart: Vec<f64> = values.iter().map(|value| value - middle).collect();
    let squares: Vec<f64> = apart.iter().map(|value| value * value).collect();
    let moments = means(&apart)?.into_iter().zip(means(&squares)?);
    Some(moments.map(|(mean, square)| (square - mean * mean).max(0.0).sqrt()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::Statistics;

    #[test]
    fn means_of_blocks_centre_on_the_mean() {
        let values: Vec<f64> = (0..100).map(|place| f64::from(place % 10)).collect();
        let found = means(&values).unwrap();
        assert!(found.iter().all(|mean| (mean - 4.5).abs() < 1e-9), "each block is a whole period");
        assert_eq!(means(&values), means(&values));
        assert_eq!(means(&values[..15]), None);
    }

    #[test]
    fn neighbours_that_resemble_each_other_spread_more() {
        let slow: Vec<f64> = (0..400).map(|place| (f64::from(place) / 60.0).sin()).collect();
        let mut shuffled = slow.clone();
        let mut random = Pcg32::new(1, 1);
        for last in (1..shuffled.len()).rev() {
            shuffled.swap(last, below(&mut random, last + 1));
        }
        let spread = |values: &[f64]| Statistics::of(means(values).unwrap()).unwrap().deviation;
        assert!(spread(&slow) > 2.0 * spread(&shuffled));
    }
}
