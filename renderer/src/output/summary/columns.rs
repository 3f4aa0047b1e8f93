//! The columns of numbers of the closing table, and how their cells are written.

use crate::output::rows::FrameRow;
use crate::output::run_times::MeasuredTimes;
use crate::stats::{Interval, mean};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

/// A column of numbers of the closing table: a mean over frames, and its ratio to the reference method's.
pub struct Column {
    /// Its name in CSV and JSON.
    pub name: &'static str,
    /// Its heading, on two lines.
    pub heading: &'static str,
    /// What it is of a frame; `None` where that was not measured.
    pub of: fn(&FrameRow) -> Option<f64>,
    /// The column of `frames.csv` that it is the mean of, where that is a time.
    pub time: Option<&'static str>,
    /// Whether it is told only where it is not 0 in some run.
    pub exception: bool,
}

/// The columns, in their order.
pub const COLUMNS: [Column; 7] = [
    Column {
        name: "visible_clusters",
        heading: "visible\nclusters",
        of: |row| Some(row.visible_clusters as f64),
        time: None,
        exception: false,
    },
    Column {
        name: "light_indices",
        heading: "light\nindices",
        of: |row| Some(row.light_indices as f64),
        time: None,
        exception: false,
    },
    Column {
        name: "lights_dropped",
        heading: "lights\ndropped",
        of: |row| Some(row.lights_dropped as f64),
        time: None,
        exception: true,
    },
    Column {
        name: "lighting_computations",
        heading: "lighting\ncomputations",
        of: |row| Some(row.lighting_computations as f64),
        time: None,
        exception: false,
    },
    Column {
        name: "clustering_ms",
        heading: "clustering\nms",
        of: |row| row.gpu_ms_cluster,
        time: Some("gpu_ms_cluster"),
        exception: false,
    },
    Column {
        name: "shading_ms",
        heading: "shading\nms",
        of: |row| row.gpu_ms_shade,
        time: Some("gpu_ms_shade"),
        exception: false,
    },
    Column {
        name: "total_ms",
        heading: "total\nms",
        of: |row| row.gpu_ms_frame,
        time: Some("gpu_ms_frame"),
        exception: false,
    },
];

/// Something for each column of the closing table; `None` where there is nothing to tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByColumn<T>([Option<T>; COLUMNS.len()]);

/// Means over the frames of one run, or their ratios to those of the reference method. `None` where nothing was
/// measured, or a ratio would be to nothing.
pub type Values = ByColumn<f64>;

/// From where to where times, or ratios of them, lie in 95 % of repetitions; `None` for counts, which repeat exactly.
pub type Intervals = ByColumn<Interval>;

impl<T: Copy> ByColumn<T> {
    /// What stands in the column of a name.
    pub fn get(&self, name: &str) -> Option<T> {
        self.iter().find(|(column, _)| column.name == name).and_then(|(_, value)| value)
    }

    /// Columns with what stands in them.
    pub fn iter(&self) -> impl Iterator<Item = (&'static Column, Option<T>)> {
        COLUMNS.iter().zip(self.0)
    }
}

impl<T> Default for ByColumn<T> {
    fn default() -> Self {
        Self([const { None }; COLUMNS.len()])
    }
}

impl Values {
    /// Means over frames.
    pub fn mean(rows: &[FrameRow]) -> Self {
        let told = |column: &Column, mean: &f64| !column.exception || *mean != 0.0;
        Self(COLUMNS.map(|column| mean(rows.iter().filter_map(column.of)).filter(|mean| told(&column, mean))))
    }

    /// The ratios to `reference`.
    pub fn over(&self, reference: &Self) -> Self {
        Self(std::array::from_fn(|place| match (self.0[place], reference.0[place]) {
            (Some(value), Some(reference)) if reference != 0.0 => Some(value / reference),
            _ => None,
        }))
    }
}

impl Intervals {
    /// Of the means of a run: no time is below 0.
    pub fn of(times: &MeasuredTimes) -> Self {
        let from_zero = |Interval { low, high }| Interval { low: low.max(0.0), high };
        Self(COLUMNS.map(|column| times.of(column.time?)?.interval().map(from_zero)))
    }

    /// Of their ratios to those of another run.
    pub fn of_ratios(times: &MeasuredTimes, reference: &MeasuredTimes) -> Self {
        Self(COLUMNS.map(|column| times.of(column.time?)?.ratio_to(reference.of(column.time?)?)))
    }
}

impl<T: Copy + Serialize> Serialize for ByColumn<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let told = || self.iter().filter(|(column, value)| !column.exception || value.is_some());
        let mut map = serializer.serialize_map(Some(told().count()))?;
        told().try_for_each(|(column, value)| map.serialize_entry(column.name, &value))?;
        map.end()
    }
}

impl Column {
    /// A mean as a cell of the CSV.
    pub fn cell(&self, value: Option<f64>) -> String {
        let digits = if self.time.is_some() { 6 } else { 3 };
        value.map(|value| format!("{value:.digits$}")).unwrap_or_default()
    }

    /// A mean and its ratio, each with half its interval, for people.
    pub fn shown(
        &self,
        (value, interval): (Option<f64>, Option<Interval>),
        (ratio, of_ratio): (Option<f64>, Option<Interval>),
    ) -> String {
        let Some(value) = value else { return "-".into() };
        let value = match self.time {
            None => grouped(value.round() as u64),
            Some(_) => with_interval(value, interval, [0, 3]),
        };
        match ratio {
            Some(ratio) => format!("{value} ({})", with_interval(ratio, of_ratio, [2, 3])),
            None if self.exception => value,
            None => format!("{value}    -  "),
        }
    }
}

/// A ratio, or an end of an interval, as a cell of the CSV.
pub fn ratio_cell(value: Option<f64>) -> String {
    value.map(|value| format!("{value:.6}")).unwrap_or_default()
}

/// A number and half its interval (the larger part, where it is not in its middle), such as `84.1 ±0.6`: to as many decimals, between `fewest` and `most`, as that half has
/// to one significant digit, or to two that begin with 1; and that half rounded up. Without an interval: the number, to the most decimals, or to the
/// fewest where there are some. An interval of no width is none.
pub(crate) fn with_interval(value: f64, interval: Option<Interval>, [fewest, most]: [usize; 2]) -> String {
    let half = interval
        .map(|Interval { low, high }| (value - low).max(high - value))
        .filter(|half| *half > 0.0 && half.is_finite());
    let Some(half) = half else {
        let digits = if fewest > 0 { fewest } else { most };
        return format!("{value:.digits$}");
    };
    let digits = ((-(half / 2.0).log10().floor()).max(0.0) as usize).clamp(fewest, most);
    let unit = 10_f64.powi(digits as i32);
    // Less than rounding of the half itself may add.
    let half = (half * unit - 1e-9).ceil() / unit;
    format!("{value:.digits$} ±{half:.digits$}")
}

/// A whole number with a space between thousands.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_their_intervals_allow() {
        let time = |value: f64, half: f64| with_interval(value, Some(Interval::around(value, half)), [0, 3]);
        assert_eq!(time(84.1234, 0.58), "84.1 ±0.6");
        assert_eq!(time(84.1234, 0.61), "84.1 ±0.7");
        assert_eq!(time(84.1234, 12.0), "84 ±12");
        assert_eq!(time(84.1234, 1.62), "84.1 ±1.7");
        assert_eq!(time(0.5, 0.5), "0.5 ±0.5");
        assert_eq!(time(84.1234, 1e-7), "84.123 ±0.001");
        assert_eq!(time(84.1234, 0.0), "84.123");
        assert_eq!(with_interval(1.25, Some(Interval { low: 1.22, high: 1.3 }), [2, 3]), "1.25 ±0.05");
        assert_eq!(with_interval(1.0, None, [2, 3]), "1.00");
    }
}
