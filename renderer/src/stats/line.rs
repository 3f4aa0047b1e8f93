//! The least-squares line through measured numbers.

use super::measured::Measured;
use super::sample::mean;

/// The line offset + slope x that lies nearest to points, all of which weigh alike (ordinary least squares).
///
/// The intervals of slope and offset are of measuring: both are weighted sums of the numbers at the points, made again with
/// each half of the temporal runs, where all points lose the same runs. They say within what the line through the same
/// x would lie in 95 % of repetitions. They do not say that a line is what the numbers follow: [`Line::off`] tells
/// that, and no interval is made of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// At x = 0, in the unit of the numbers.
    pub offset: Measured,
    /// Per unit of x.
    pub slope: Measured,
    /// Root mean square distance of the numbers from the line, in their unit.
    pub off: f64,
}

impl Line {
    /// The line through (x, number); `None` where x does not vary.
    pub fn through(points: &[(f64, Measured)]) -> Option<Self> {
        let middle = mean(points.iter().map(|(x, _)| *x))?;
        let spread: f64 = points.iter().map(|(x, _)| (x - middle).powi(2)).sum();
        if spread <= 0.0 {
            return None;
        }
        let part = 1.0 / points.len() as f64;
        let slope = weighted(points, |x| (x - middle) / spread)?;
        let offset = weighted(points, |x| part - middle * (x - middle) / spread)?;
        let square = |(x, y): &(f64, Measured)| (y.value - offset.value - slope.value * x).powi(2);
        let off = mean(points.iter().map(square))?.sqrt();
        Some(Self { offset, slope, off })
    }

    /// The line's number at x.
    pub fn at(&self, x: f64) -> f64 {
        self.offset.value + self.slope.value * x
    }
}

/// The sum of the numbers, each times the weight of its x.
fn weighted(points: &[(f64, Measured)], weight: impl Fn(f64) -> f64) -> Option<Measured> {
    let terms = points.iter().map(|(x, number)| {
        let weight = weight(*x);
        Measured::combine([number], |[number]| weight * number)
    });
    terms.reduce(|sum, term| Measured::combine([&sum, &term], |[sum, term]| sum + term))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::{Samples, slope};

    fn measured(runs: &[f64]) -> Measured {
        Samples::new(1, runs.iter().map(|&time| vec![time]).collect()).unwrap().measure()
    }

    #[test]
    fn a_line_through_points_on_one_is_that() {
        let points = [1.0, 2.0, 10.0].map(|x| (x, measured(&[3.0 + 2.0 * x, 4.0 + 2.5 * x])));
        let line = Line::through(&points).unwrap();
        assert!((line.slope.value - 2.0).abs() < 1e-12 && (line.offset.value - 3.0).abs() < 1e-12);
        assert!(line.off < 1e-12 && (line.at(5.0) - 13.0).abs() < 1e-12);
        // Every half is a line too: that of the second run is 0.5 steeper and begins 1 higher.
        let deviations = [&line.slope, &line.offset].map(|number| number.noise().unwrap().deviation);
        assert!((deviations[1] / deviations[0] - 2.0).abs() < 1e-9, "{deviations:?}");
        assert!((deviations[0] - 0.5 / 2.0_f64.sqrt()).abs() < 1e-9, "{deviations:?}");
    }

    #[test]
    fn points_off_the_line_are_told_and_the_slope_is_the_common_one() {
        let points = [(0.0, 1.0), (1.0, 0.0), (2.0, 1.0), (3.0, 4.0)];
        let line = Line::through(&points.map(|(x, y)| (x, measured(&[y, y])))).unwrap();
        assert!((line.slope.value - slope(&points).unwrap()).abs() < 1e-12);
        // Of y = (x - 1)², the line is x: distances 1, -1, -1, 1.
        assert!((line.off - 1.0).abs() < 1e-12 && line.offset.value.abs() < 1e-12);
        assert_eq!(Line::through(&[(1.0, measured(&[1.0, 2.0])), (1.0, measured(&[2.0, 3.0]))]), None);
    }

    #[test]
    fn without_as_many_runs_everywhere_there_is_no_interval() {
        let points = [(0.0, measured(&[1.0, 2.0])), (1.0, measured(&[1.0, 2.0, 3.0]))];
        let line = Line::through(&points).unwrap();
        assert_eq!((line.slope.interval(), line.offset.interval()), (None, None));
    }
}
