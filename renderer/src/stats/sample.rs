//! Statistics of values.

/// Mean, median, 95th percentile and standard deviation of a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// Arithmetic mean.
    pub mean: f64,
    /// 50th percentile.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Standard deviation of the sample as the whole population: the frames are all there are.
    pub deviation: f64,
}

impl Statistics {
    /// Of the finite values; `None` where there are none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let mean = mean(sorted.iter().copied())?;
        Some(Self {
            mean,
            median: percentile(&sorted, 0.5),
            p95: percentile(&sorted, 0.95),
            deviation: deviation(&sorted),
        })
    }
}

/// Standard deviation of values, of which there is one at least, as the whole population.
pub(super) fn deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = |value: &f64| (value - mean).powi(2);
    (values.iter().map(square).sum::<f64>() / values.len() as f64).sqrt()
}

/// Arithmetic mean; `None` of nothing.
pub fn mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (sum, count) =
        values.into_iter().fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// The value below which `fraction` of the ascending, non-empty `sorted` lies, linear between neighbours.
pub fn percentile(sorted: &[f64], fraction: f64) -> f64 {
    let place = fraction * (sorted.len() - 1) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    sorted[low] + (sorted[high] - sorted[low]) * (place - low as f64)
}

/// Slope of the least-squares line through points of (x, y); `None` where x does not vary.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let x_mean = mean(points.iter().map(|point| point.0))?;
    let y_mean = mean(points.iter().map(|point| point.1))?;
    let spread: f64 = points.iter().map(|(x, _)| (x - x_mean).powi(2)).sum();
    let common: f64 = points.iter().map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    (spread > 0.0).then(|| common / spread)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn worked_values() {
        let statistics = Statistics::of([4.0, 1.0, f64::NAN, 3.0, 2.0]).unwrap();
        assert_eq!((statistics.mean, statistics.median), (2.5, 2.5));
        assert!((statistics.p95 - 3.85).abs() < 1e-12);
        assert!((statistics.deviation - 1.25_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Statistics::of([]), None);
        assert_eq!(Statistics::of([7.0]).unwrap().deviation, 0.0);
    }

    #[test]
    fn the_slope_of_a_power_law_in_logarithms_is_its_exponent() {
        let points = [1e3, 1e4, 1e5].map(|n: f64| (n.log10(), (3.0 * n * n).log10()));
        assert!((slope(&points).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(slope(&[(1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(slope(&[]), None);
    }

    proptest! {
        #[test]
        fn percentiles_lie_in_order_within_the_sample(values in prop::collection::vec(-1e6..1e6, 1..40)) {
            let found = Statistics::of(values.iter().copied()).unwrap();
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let slack = 1e-6;
            prop_assert!(least <= found.median + slack && found.median <= found.p95 + slack);
            prop_assert!(found.p95 <= most + slack && found.deviation <= most - least + slack);
        }
    }
}
