//! Small multiples as plain SVG: a grid of panels of lines, stacked areas, bars, columns, heat maps or pictures, with axes, ticks and
//! legend; the same numbers as CSV, and as JSON for the page's tooltips.

mod bars;
mod columns;
mod draw;
mod export;
mod layout;
mod marks;
pub mod palette;
pub mod scale;
mod svg;

pub use svg::escape;

use crate::stats::Interval;
use palette::Color;

/// Panels in rows and columns.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// What rows, columns, series and x are called in the CSV.
    pub names: [&'static str; 4],
    /// Headings of columns, from the left.
    pub columns: Vec<String>,
    /// Labels of rows, from the top.
    pub rows: Vec<String>,
    /// Row by row; `None` where there are no data.
    pub panels: Vec<Option<Plot>>,
    /// Label below.
    pub x_label: String,
    /// Colours explained above.
    pub legend: Vec<Key>,
    /// Whether the axes of lines are logarithmic; their numbers are above 0 then.
    pub logarithmic: bool,
    /// Remarks in the corner of each panel, in the colours of the lines they are about; empty for none.
    pub notes: Vec<Vec<Key>>,
}

/// An entry of the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// What it stands for.
    pub label: String,
    /// How it looks.
    pub look: Look,
}

/// How a series looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// Colour by name.
    pub color: Color,
    /// Broken line.
    pub dashed: bool,
    /// Heavier line.
    pub bold: bool,
    /// Dots alone, without a line.
    pub dots: bool,
}

/// What a panel shows.
#[derive(Debug, Clone)]
pub enum Plot {
    /// A line a series.
    Lines(Vec<Series>),
    /// Areas upon each other, the first at the bottom; all have the same x.
    Stack(Stack),
    /// Counts as colour.
    Heat(Heat),
    /// Bars across, one below the other.
    Bars(Vec<Bar>),
    /// Columns side by side, on a logarithmic axis: how many things there are of each kind.
    Columns(Vec<Column>),
    /// An image.
    Picture(Picture),
}

/// Points joined by a line.
#[derive(Debug, Clone)]
pub struct Series {
    /// What it is.
    pub name: String,
    /// How it looks.
    pub look: Look,
    /// (x, y) by ascending x.
    pub points: Vec<[f64; 2]>,
}

/// Areas upon each other.
#[derive(Debug, Clone)]
pub struct Stack {
    /// From the bottom.
    pub parts: Vec<Series>,
    /// Upper end of the y axis at least, so that panels compare.
    pub top: f64,
}

/// A bar of parts end to end, from 0 to the right; a lone part below 0 goes to the left.
#[derive(Debug, Clone)]
pub struct Bar {
    /// What it is of.
    pub label: String,
    /// The number behind the label.
    pub told: String,
    /// What the parts are and how much, from 0.
    pub parts: Vec<(Key, f64)>,
    /// From where to where the whole lies.
    pub interval: Option<Interval>,
}

/// A column of a histogram.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// What is counted in it, such as a range of numbers: `26-50`.
    pub label: String,
    /// From where to where it reaches along x.
    pub x: [f64; 2],
    /// How many there are, at least 1.
    pub count: u64,
    /// How it is filled.
    pub color: Color,
}

/// Counts over x and ordered rows.
#[derive(Debug, Clone)]
pub struct Heat {
    /// x of each column, ascending.
    pub x: Vec<f64>,
    /// Counts by column, then by row of [`super::bins`], lowest first; rows beyond the end are 0.
    pub counts: Vec<Vec<u64>>,
    /// Rows of the axis; the same in every panel of a chart.
    pub rows: usize,
    /// Count at the upper end of the colours; the same in every panel of a chart.
    pub most: u64,
    /// A value of the axis to mark, with what it means.
    pub mark: Option<(u64, String)>,
}

/// An encoded image.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Its bytes as a `data:` URI.
    pub uri: String,
    /// Pixels.
    pub size: [u32; 2],
    /// What it shows, for those who cannot see it.
    pub alt: String,
    /// Where it came from, for the CSV.
    pub file: String,
    /// Frame number.
    pub frame: u32,
}

impl Look {
    /// A plain line.
    pub const fn plain(color: Color) -> Self {
        Self { color, dashed: false, bold: false, dots: false }
    }
}

impl Chart {
    /// The panel of a row and column.
    fn panel(&self, row: usize, column: usize) -> Option<&Plot> {
        self.panels.get(row * self.columns.len() + column).and_then(Option::as_ref)
    }

    /// (row, column, plot) of every panel that has data.
    fn drawn(&self) -> impl Iterator<Item = (usize, usize, &Plot)> {
        let columns = self.columns.len().max(1);
        self.panels
            .iter()
            .enumerate()
            .filter_map(move |(place, plot)| Some((place / columns, place % columns, plot.as_ref()?)))
    }
}
