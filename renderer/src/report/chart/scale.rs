//! Axes: from numbers to places, and where ticks are.

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Whether equal ratios are equally far apart, rather than equal differences; numbers are above 0 then.
    pub logarithmic: bool,
    /// Numbers at its ends.
    pub domain: [f64; 2],
    /// Places of its ends.
    pub range: [f64; 2],
}

impl Scale {
    /// The place of a number.
    pub fn at(&self, value: f64) -> f64 {
        let scaled = |value: f64| if self.logarithmic { value.ln() } else { value };
        let ([d0, d1], [r0, r1], value) = (self.domain.map(scaled), self.range, scaled(value));
        if d1 == d0 { (r0 + r1) / 2.0 } else { r0 + (value - d0) / (d1 - d0) * (r1 - r0) }
    }
}

/// Round numbers (1, 2 or 5 times a power of ten apart) within low..=high, about `wanted` of them.
pub fn ticks(low: f64, high: f64, wanted: usize) -> Vec<f64> {
    if high <= low || wanted == 0 {
        return vec![low];
    }
    let step = round_step((high - low) / wanted as f64);
    let slack = step * 1e-9;
    let (first, last) = (((low - slack) / step).ceil() as i64, ((high + slack) / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

/// Powers of ten within low..=high; where fewer than three fit, 2 and 5 times them too.
pub fn decades(low: f64, high: f64) -> Vec<f64> {
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let within = |factors: &[f64]| -> Vec<f64> {
        let all =
            (first..=last).flat_map(|power| factors.iter().map(move |factor| factor * 10_f64.powi(power)));
        all.filter(|tick| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(tick)).collect()
    };
    let powers = within(&[1.0]);
    if powers.len() < 3 { within(&[1.0, 2.0, 5.0]) } else { powers }
}

/// The end of an axis from 0 that holds `most`: the next tick, or a little room.
pub fn nice_top(most: f64, wanted: usize) -> f64 {
    if most <= 0.0 {
        return 1.0;
    }
    let step = round_step(most / wanted.max(1) as f64) / 2.0;
    (most * 1.02 / step).ceil() * step
}

/// The least of 1, 2, 5 times a power of ten that is no less than `rough`, within a rounding error.
fn round_step(rough: f64) -> f64 {
    let power = 10_f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= rough * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(0.0, 10.0, 5), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(0.0, 0.34, 4), [0.0, 0.1, 0.2, 0.1 * 3.0]);
        assert_eq!(ticks(300.0, 380.0, 4), [300.0, 320.0, 340.0, 360.0, 380.0]);
        assert_eq!(ticks(7.0, 7.0, 4), [7.0]);
    }

    #[test]
    fn ticks_of_ratios_are_powers_of_ten() {
        assert_eq!(decades(800.0, 2e5), [1e3, 1e4, 1e5]);
        assert_eq!(decades(3.0, 60.0), [5.0, 10.0, 20.0, 50.0]);
    }

    #[test]
    fn places_are_linear() {
        let linear = |domain, range| Scale { logarithmic: false, domain, range };
        let scale = linear([0.0, 4.0], [100.0, 20.0]);
        assert_eq!([0.0, 1.0, 4.0].map(|value| scale.at(value)), [100.0, 80.0, 20.0]);
        assert_eq!(linear([3.0, 3.0], [0.0, 10.0]).at(3.0), 5.0);
        let logarithmic = Scale { logarithmic: true, domain: [1.0, 1e4], range: [0.0, 8.0] };
        assert!((logarithmic.at(100.0) - 4.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn ticks_lie_within_and_are_neither_few_nor_many(
            low in -1e3..1e3, length in 1e-3..1e9, wanted in 2_usize..8,
        ) {
            let found = ticks(low, low + length, wanted);
            prop_assert!(found.len() <= wanted + 1, "{found:?}");
            // Steps grow by at most 2.5 from one round number to the next.
            prop_assert!((found.len() + 1) as f64 >= wanted as f64 / 2.5, "{found:?}");
            let slack = length * 1e-6;
            prop_assert!(found.iter().all(|&tick| tick >= low - slack && tick <= low + length + slack));
        }

        #[test]
        fn the_top_holds_the_most_without_waste(most in 1e-9..1e12) {
            let top = nice_top(most, 4);
            prop_assert!(top >= most && top <= most * 1.5, "{top}");
        }
    }
}
