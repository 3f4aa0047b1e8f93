//! R. Enhuber, *Comparison of Light Assignment Methods for Screen Space, World Space and Object Space* (TU Graz 2019): the
//! figures, tables and claims of chapter 4.
//!
//! ```text
//! ResultSet ──> Evaluation (scenes; his methods by his tests) ──┬─> figures  E4.1 to E4.13
//!                                                               ├─> tables   4.2 to 4.6, and the numbers he prints
//!                                                               └─> claims   E1 to E13
//! ```
//!
//! A figure's number is the thesis's with an E before it. Times that the thesis prints stand in a table of their own.

mod claims;
mod evaluation;
mod figures;
mod printed;
mod tables;

#[cfg(test)]
mod testing;

pub use evaluation::measures;

use super::paper::{Paper, Section};

/// The thesis.
pub const PAPER: Paper = Paper {
    name: "Enhuber 2019",
    sections: &[Section {
        heading: "Enhuber: tiles, clusters, cells of the world and models compared",
        anchor: "enhuber",
        ids: &["E4.", "enhuber-"],
    }],
    figures: figures::all,
    tables: tables::all,
    claims: &claims::CLAIMS,
    judged: evaluation::judged,
    measures,
};
