//! Times by method, light count and scene, as M. Enhuber's thesis evaluates them (*Comparison of Light Assignment Methods*,
//! TU Graz 2019, section 4.4), of whatever methods were measured.
//!
//! ```text
//!             ┌─> spread ──> table and bars: a setting and lighting            (figures 4.8, 4.12)
//! ResultSet ──┼─> growth ──> lines over lights, bars, table: a setting         (figure 4.13)
//!             └─> ranking ─> table: settings that differ in scene alone        (tables 4.4 to 4.6)
//! ```
//!
//! A [`Part`] of the frame is what is told of; every number has the interval that [`crate::stats`] gives it.

mod growth;
mod ranking;
mod spread;

use super::chart::{Key, Look, palette::Color};
use super::figure::Figure;
use super::results::{ResultSet, Run, Setting, metric};
use super::tables::Table;
use crate::methods::Method;
use crate::stats::{Interval, Measured};

/// A part of the frame's GPU time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Everything before shading: culling, prepass, marking, compaction, lights, lists. Of several samples a pixel also
    /// the resolve, which no column tells apart.
    Assignment,
    /// Shading of all views.
    Shading,
    /// The frame.
    All,
}

impl Part {
    const EVERY: [Self; 3] = [Self::Assignment, Self::Shading, Self::All];

    const fn name(self) -> &'static str {
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

    fn key(self) -> Key {
        Key { label: self.name().into(), look: Look::plain(self.color()) }
    }

    /// Its mean over the frames of a run, milliseconds; `None` of a run that was not timed.
    fn mean(self, run: &Run) -> Option<Measured> {
        let [all, shading] = [metric::FRAME, metric::SHADE].map(|metric| run.measured(metric));
        match self {
            Self::Assignment => Some(Measured::combine([&all?, &shading?], |[all, shading]| all - shading)),
            Self::Shading => shading,
            Self::All => all,
        }
    }
}

/// Bars and lines.
pub fn figures(set: &ResultSet) -> Vec<Figure> {
    [spread::figures(set), growth::figures(set)].concat()
}

/// The tables that have rows.
pub fn tables(set: &ResultSet) -> Vec<Table> {
    let all = [spread::table(set), growth::table(set), ranking::table(set)];
    all.into_iter().filter(|table| !table.rows.is_empty()).collect()
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
fn cells(number: &Measured) -> [Option<f64>; 3] {
    let [low, high] = Interval::ends(number.interval());
    [Some(number.value), low, high]
}

#[cfg(test)]
mod tests;
