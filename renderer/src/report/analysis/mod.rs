//! Times by method, light count and scene, as M. Enhuber's thesis evaluates them (*Comparison of Light Assignment Methods*,
//! TU Graz 2019, section 4.4), of whatever methods were measured.
//!
//! ```text
//!             ┌─> spread ──> table and bars: a setting and lighting            (figures 4.8, 4.12)
//! ResultSet ──┼─> growth ──> lines over lights, bars, table: a setting         (figure 4.13)
//!             ├─> memory ──> bars and table: a setting and lighting
//!             ├─> ranking ─> table: settings that differ in scene alone        (tables 4.4 to 4.6)
//!             └─> groups ──> heat maps and histograms: a method of a setting   (figures 4.10, 4.11)
//! ```
//!
//! A [`Part`] of the frame is what is told of; every number has the interval that [`crate::stats`] gives it.

pub mod groups;
mod growth;
mod memory;
mod ranking;
mod spread;

pub use growth::{Fit, bars as slopes_and_offsets, fits, lines};
pub use ranking::{anywhere, table as classes};
pub use spread::{bar, chart as times, deviation, relative};

use super::chart::{Bar, Chart, Key, Look, Plot, palette::Color};
use super::figure::Figure;
use super::results::{LightingName, ResultSet, Run, Setting, metric};
use super::tables::Table;
use crate::Result;
use crate::methods::Method;
use crate::stats::{Interval, Measured};

/// A part of the frame's GPU time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Everything before shading: culling, prepass, marking, compaction, lights, lists. Of several samples a pixel also
    /// the resolve, which no column tells apart.
    Assignment,
    /// Shading of all views.
    Shading,
    /// The frame.
    All,
}

impl Part {
    pub const EVERY: [Self; 3] = [Self::Assignment, Self::Shading, Self::All];

    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Assignment => "assignment",
            Self::Shading => "shading",
            Self::All => "all",
        }
    }

    const fn color(self) -> Color {
        match self {
            Self::Assignment => "blue",
            Self::Shading => "orange",
            Self::All => "grey",
        }
    }

    /// What explains its colour.
    pub fn key(self) -> Key {
        Key { label: self.name().into(), look: Look::plain(self.color()) }
    }

    /// Its mean over the frames of a run, milliseconds; `None` of a run that was not timed.
    pub fn mean(self, run: &Run) -> Option<Measured> {
        let [all, shading] = [metric::FRAME, metric::SHADE].map(|metric| run.measured(metric));
        match self {
            Self::Assignment => Some(Measured::combine([&all?, &shading?], |[all, shading]| all - shading)),
            Self::Shading => shading,
            Self::All => all,
        }
    }
}

/// Bars, lines, histograms.
///
/// # Errors
/// A picture cannot be read.
pub fn figures(set: &ResultSet) -> Result<Vec<Figure>> {
    Ok([spread::figures(set), growth::figures(set), memory::figures(set), groups::figures(set)?].concat())
}

/// The tables that have rows.
pub fn tables(set: &ResultSet) -> Vec<Table> {
    let all = [spread::table(set), growth::table(set), ranking::table(set), memory::table(set)];
    all.into_iter().filter(|table| !table.rows.is_empty()).collect()
}

/// Beside each other; more lightings stand below each other.
const COLUMNS: usize = 3;

/// A panel of bars a lighting, in a unit and with a legend; `None` without lightings.
fn by_lighting(
    lightings: &[LightingName],
    (unit, legend): (&str, Vec<Key>),
    bars: impl Fn(&LightingName) -> Vec<Bar>,
) -> Option<Chart> {
    let labels: Vec<String> = lightings.iter().map(|lighting| lighting.label.clone()).collect();
    let (rows, columns) =
        if labels.len() > COLUMNS { (labels, vec![unit.into()]) } else { (vec![unit.into()], labels) };
    (!lightings.is_empty()).then(|| Chart {
        names: ["row", "column", "part", "method"],
        columns,
        rows,
        panels: lightings.iter().map(|lighting| Some(Plot::Bars(bars(lighting)))).collect(),
        legend,
        ..Chart::default()
    })
}

/// The methods of a setting in their order.
fn methods(set: &ResultSet, setting: &Setting) -> Vec<Method> {
    let mut methods: Vec<Method> = vec![];
    for run in set.of(setting) {
        if !methods.contains(&run.method) {
            methods.push(run.method);
        }
    }
    methods
}

/// A number and the ends of its interval, as three cells of a table.
pub fn cells(number: &Measured) -> [Option<f64>; 3] {
    let [low, high] = Interval::ends(number.interval());
    [Some(number.value), low, high]
}

#[cfg(test)]
mod tests;
