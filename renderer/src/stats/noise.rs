//! Noise of a number, and intervals.

use super::student;
use serde::Serialize;

/// Of how many repetitions an interval tells, where nothing else is said.
pub const LEVEL: f64 = 0.95;

/// From where to where a number lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// How a number spreads over repetitions of its measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Standard deviation.
    pub deviation: f64,
    /// Degrees of freedom by which the deviation is known.
    pub freedom: f64,
}

/// A number (or what one is computed from) for either half of so many runs, for each way of splitting them.
#[derive(Debug, Clone, PartialEq)]
pub struct Halves<T> {
    /// How many runs there are.
    pub runs: usize,
    /// Those of the first half and of the second.
    pub pairs: Vec<[T; 2]>,
}

impl<T> Halves<T> {
    /// The same for what is computed from each.
    pub fn map<U>(&self, of: impl Fn(&T) -> U) -> Halves<U> {
        Halves { runs: self.runs, pairs: self.pairs.iter().map(|[a, b]| [of(a), of(b)]).collect() }
    }
}

impl Interval {
    /// So far to both sides of a value.
    pub fn around(value: f64, half: f64) -> Self {
        Self { low: value - half, high: value + half }
    }

    /// The ends of an interval that may not be there.
    pub fn ends(interval: Option<Self>) -> [Option<f64>; 2] {
        [interval.map(|interval| interval.low), interval.map(|interval| interval.high)]
    }

    /// Half its width.
    pub fn half(&self) -> f64 {
        (self.high - self.low) / 2.0
    }

    /// Whether a value lies within, the ends included.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Whether a value lies within, the ends excluded: whether it is open on which side of the value the number lies.
    pub fn straddles(&self, value: f64) -> bool {
        self.low < value && value < self.high
    }

    /// The interval of a number whose logarithm lies in this one.
    pub fn exp(&self) -> Self {
        Self { low: self.low.exp(), high: self.high.exp() }
    }
}

impl Noise {
    /// Of a number by its values for halves of the runs: that over repetitions with half as many. `None` without any.
    pub fn of_halves(halves: &Halves<f64>) -> Option<Self> {
        // Equal infinities do not differ.
        let squares = halves.pairs.iter().map(|[a, b]| if a == b { 0.0 } else { (a - b).powi(2) });
        let variance = super::mean(squares)? / 2.0;
        Some(Self { deviation: variance.sqrt(), freedom: (halves.runs - 1).max(1) as f64 })
    }

    /// Half the width of the interval that holds so large a part of repetitions.
    pub fn half_width(&self, level: f64) -> f64 {
        if self.deviation == 0.0 {
            return 0.0;
        }
        self.deviation * student::quantile((1.0 - level) / 2.0, self.freedom)
    }

    /// The noise of a sum of two numbers that were measured apart (Welch 1947, with Satterthwaite's degrees of freedom).
    pub fn with(&self, other: &Self) -> Self {
        let [a, b] = [self, other].map(|noise| noise.deviation.powi(2));
        let variance = a + b;
        let inverse = (a * a / self.freedom + b * b / other.freedom) / (variance * variance);
        let freedom = if variance > 0.0 { 1.0 / inverse } else { self.freedom.min(other.freedom) };
        Self { deviation: variance.sqrt(), freedom }
    }

    /// The chance that noise alone moves a number at least so far, to either side.
    pub fn chance(&self, distance: f64) -> f64 {
        if self.deviation == 0.0 {
            return if distance == 0.0 { 1.0 } else { 0.0 };
        }
        2.0 * student::tail(distance.abs() / self.deviation, self.freedom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_of_two_measurements_adds() {
        let [a, b] = [(3.0, 4.0), (4.0, 9.0)].map(|(deviation, freedom)| Noise { deviation, freedom });
        let sum = a.with(&b);
        assert_eq!(sum.deviation, 5.0);
        assert!((sum.freedom - 625.0 / (81.0 / 4.0 + 256.0 / 9.0)).abs() < 1e-9);
        let none = Noise { deviation: 0.0, freedom: 4.0 };
        assert_eq!((none.with(&none), none.half_width(LEVEL)), (none, 0.0));
        assert_eq!(a.with(&none), a);
    }

    #[test]
    fn chance_and_width_agree() {
        let noise = Noise { deviation: 2.0, freedom: 7.0 };
        let half = noise.half_width(LEVEL);
        assert!((noise.chance(-half) - 0.05).abs() < 1e-6);
        let none = Noise { deviation: 0.0, freedom: 1.0 };
        assert_eq!([none.chance(0.0), none.chance(0.1)], [1.0, 0.0]);
    }

    #[test]
    fn an_interval_straddles_what_lies_between_its_ends() {
        let interval = Interval::around(1.0, 0.5);
        assert_eq!((interval.low, interval.high, interval.half()), (0.5, 1.5, 0.5));
        assert!(interval.contains(1.5) && !interval.straddles(1.5) && interval.straddles(1.4));
        assert!(!Interval::around(0.0, 0.0).straddles(0.0));
    }
}
