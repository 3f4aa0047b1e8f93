//! M. Tegelaers' thesis on forward and deferred hashed shading (2016): naive, tiled, clustered and hashed in both pipelines, with the
//! figures and claims of chapters 4 to 7.
//!
//! ```text
//! ResultSet ──> Evaluation (scenes; methods in both pipelines) ──┬─> figures  T2.12 to T7.42
//!                                                                ├─> tables   of ratios, steps, layers
//!                                                                └─> claims   H1 to H14
//! ```
//!
//! A figure's number is the thesis's with a T before it. Its times are of a CPU that waits for the GPU and builds grids and
//! trees itself; those here are of the GPU alone, so that ratios compare and milliseconds do not.

mod claims;
mod evaluation;
mod figures;
mod lines;
mod octree;
mod ratios;
mod tables;

#[cfg(test)]
mod testing;

pub use evaluation::measures;

use super::paper::{Paper, Section};

/// The thesis.
pub const PAPER: Paper = Paper {
    name: "Tegelaers 2016",
    sections: &[
        Section {
            heading: "Tegelaers: shading, scenes, pipelines",
            anchor: "tegelaers",
            ids: &["T2.", "T3.", "T4.", "tegelaers-"],
        },
        Section { heading: "Tegelaers: tiles and clusters", anchor: "tegelaers-tiles", ids: &["T5.", "T6."] },
        Section { heading: "Tegelaers: hashed shading", anchor: "tegelaers-hashed", ids: &["T7."] },
    ],
    figures: figures::all,
    tables: tables::all,
    claims: &claims::CLAIMS,
    judged: evaluation::judged,
    measures,
};
