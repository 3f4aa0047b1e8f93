//! K. Örtegren and E. Persson, *Clustered Shading: Assigning Lights Using Conservative Rasterization in DirectX 12* (GPU Pro 7, 2016), and
//! Örtegren's thesis behind it: meshes around lights to lists by shells and fills, with the figures and claims of its evaluation.
//!
//! ```text
//! ResultSet ──> Evaluation (cases by lights, grid, slice law) ──┬─> figures  KF1 to KF18
//!                                                               ├─> tables   of nodes, of times (C.1), against tests
//!                                                               └─> claims   K1 to K11
//! ```
//!
//! Its times are of a GeForce GTX 970; ratios compare, milliseconds do not.

mod cells;
mod claims;
mod evaluation;
mod figures;
mod printed;
mod tables;

#[cfg(test)]
mod tests;

use super::paper::{Paper, Section};

/// The paper.
pub const PAPER: Paper = Paper {
    name: "Örtegren 2016",
    sections: &[Section {
        heading: "Örtegren: light meshes, shells and fills",
        anchor: "ortegren",
        ids: &["KF", "ortegren-"],
    }],
    figures: figures::all,
    tables: tables::all,
    claims: &claims::CLAIMS,
    judged: evaluation::judged,
    measures: evaluation::measures,
};
