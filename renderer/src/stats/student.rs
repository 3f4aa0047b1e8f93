//! Student's distribution: its tail and its quantiles, for any number of degrees of freedom from one on.
//!
//! With t = √ν tan θ the density is proportional to cos^(ν-1) θ on (-π/2, π/2), which is smooth and bounded: both come
//! from its integral.

use std::f64::consts::FRAC_PI_2;

/// Beyond as many degrees the distribution is the normal one, to three digits.
const MOST_FREEDOM: f64 = 1000.0;

/// Panels of Simpson's rule.
const PANELS: u32 = 256;

/// The chance that a variable with `freedom` (at least 1) degrees of freedom exceeds `t` (not negative).
pub fn tail(t: f64, freedom: f64) -> f64 {
    let freedom = freedom.clamp(1.0, MOST_FREEDOM);
    integral((t / freedom.sqrt()).atan(), freedom) / (2.0 * integral(0.0, freedom))
}

/// The value that a variable exceeds with chance `upper` (between 0 and 1/2).
pub fn quantile(upper: f64, freedom: f64) -> f64 {
    let freedom = freedom.clamp(1.0, MOST_FREEDOM);
    let wanted = upper * 2.0 * integral(0.0, freedom);
    // Halved until neighbouring numbers: the angle, not t, for it is bounded.
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..48 {
        let middle = (low + high) / 2.0;
        if integral(middle, freedom) > wanted { low = middle } else { high = middle }
    }
    low.tan() * freedom.sqrt()
}

/// Integral of cos^(freedom-1) from `start` to π/2.
fn integral(start: f64, freedom: f64) -> f64 {
    let step = (FRAC_PI_2 - start) / f64::from(PANELS);
    let density = |place: u32| (start + step * f64::from(place)).cos().max(0.0).powf(freedom - 1.0);
    let weight = |place: u32| match place {
        0 | PANELS => 1.0,
        _ if place % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=PANELS).map(|place| weight(place) * density(place)).sum::<f64>() * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        let table = [
            (0.025, 1.0, 12.706),
            (0.025, 2.0, 4.3027),
            (0.025, 3.0, 3.1824),
            (0.025, 4.0, 2.7764),
            (0.025, 8.0, 2.3060),
            (0.025, 30.0, 2.0423),
            (0.025, 1e9, 1.9600),
            (0.005, 10.0, 3.1693),
            (0.0005, 5.0, 6.8688),
            (0.0001, 20.0, 4.5385),
        ];
        for (upper, freedom, value) in table {
            let found = quantile(upper, freedom);
            assert!((found / value - 1.0).abs() < 2e-3, "{upper} {freedom}: {found}, not {value}");
            assert!((tail(value, freedom) / upper - 1.0).abs() < 2e-2, "{upper} {freedom}");
        }
        assert!((tail(0.0, 3.5) - 0.5).abs() < 1e-9);
    }

    #[test]
    fn fewer_degrees_are_wider() {
        let widths = [1.0, 1.3, 2.0, 2.7, 5.0, 50.0].map(|freedom| quantile(0.025, freedom));
        assert!(widths.windows(2).all(|pair| pair[0] > pair[1]), "{widths:?}");
    }
}
