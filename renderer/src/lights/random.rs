//! Random numbers of lights: a generator of its own for each light, so that light k is the same in any company.

use rand_core::Rng;
use rand_pcg::Pcg32;

/// The generator of one life of one light: its own stream, and a state that no other seed or life is near to.
pub(super) fn generator(seed: u64, light: u32, life: u32) -> Pcg32 {
    let key = u64::from(light) << 32 | u64::from(life);
    Pcg32::new(scramble(seed ^ scramble(key)), key)
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014; constants of Vigna's version).
fn scramble(value: u64) -> u64 {
    let value = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ (value >> 31)
}

/// Uniform in low..=high on each axis, in steps of 2^-24 of the range.
pub(super) fn uniform_vector(random: &mut Pcg32, low: [f32; 3], high: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let fraction = (random.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0);
        (low[axis] + fraction * (high[axis] - low[axis])).min(high[axis])
    })
}

/// Uniform in 0..1 without its ends, in steps of 2^-52.
pub(super) fn uniform(random: &mut Pcg32) -> f64 {
    ((random.next_u64() >> 12) as f64 + 0.5) * (1.0 / 4_503_599_627_370_496.0)
}

/// Of mean 0 and variance 1, by the polar method (Marsaglia and Bray 1964).
pub(super) fn normal(random: &mut Pcg32) -> f64 {
    loop {
        let [x, y] = [uniform(random), uniform(random)].map(|part| 2.0 * part - 1.0);
        let square = x * x + y * y;
        if square < 1.0 && square > 0.0 {
            return x * (-2.0 * libm::log(square) / square).sqrt();
        }
    }
}

/// A fully saturated colour of a random hue: its greatest channel is 1, its least 0.
pub(super) fn saturated_hue(random: &mut Pcg32) -> [f32; 3] {
    let hue = (random.next_u32() >> 8) as f32 * (6.0 / 16_777_216.0);
    // How far around the circle the channel's own hue is: within a sixth it is full, beyond two it is gone.
    [0.0, 2.0, 4.0].map(|own: f32| {
        let apart = (hue - own).abs();
        (2.0 - apart.min(6.0 - apart)).clamp(0.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_the_moments_of_the_normal_distribution() {
        let count = 200_000;
        let mut random = generator(1, 0, 0);
        let [mut mean, mut variance, mut fourth] = [0.0; 3];
        for _ in 0..count {
            let value = normal(&mut random);
            mean += value / f64::from(count);
            variance += value.powi(2) / f64::from(count);
            fourth += value.powi(4) / f64::from(count);
        }
        // Five standard deviations of each moment's own noise.
        assert!(mean.abs() < 0.012, "{mean}");
        assert!((variance - 1.0).abs() < 0.016, "{variance}");
        assert!((fourth - 3.0).abs() < 0.11, "{fourth}");
    }

    #[test]
    fn hues_are_full_and_go_all_around() {
        let mut sums = [0.0_f64; 3];
        for light in 0..20_000 {
            let colour = saturated_hue(&mut generator(3, light, 0));
            let (low, high) =
                (colour.iter().copied().fold(9.0, f32::min), colour.iter().copied().fold(0.0, f32::max));
            assert_eq!((low, high), (0.0, 1.0), "{colour:?}");
            sums.iter_mut().zip(colour).for_each(|(sum, channel)| *sum += f64::from(channel) / 20_000.0);
        }
        // Around the circle each channel is at 1 a third of the way, on a slope a third, at 0 a third.
        assert!(sums.iter().all(|mean| (mean - 0.5).abs() < 0.015), "{sums:?}");
    }

    #[test]
    fn uniform_numbers_keep_off_the_ends() {
        let mut random = generator(1, 7, 0);
        let values: Vec<f64> = (0..100_000).map(|_| uniform(&mut random)).collect();
        assert!(values.iter().all(|value| *value > 0.0 && *value < 1.0));
        let mean = values.iter().sum::<f64>() / 100_000.0;
        assert!((mean - 0.5).abs() < 0.005, "{mean}");
    }
}
