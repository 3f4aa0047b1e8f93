//! A. Ortiz, *A Primer on Efficient Rendering Algorithms & Clustered Shading* (2018): the subdivisions that the post compares, its
//! plot and picture of slices, its table of algorithms, and what it says of clusters as numbers. The post measures nothing.
//!
//! ```text
//! slice laws ──> aspects ──> figures OF8, OF9, table of aspects
//! ResultSet ───> figure OF10, table by slice law, claims O1 to O3
//! ```

mod aspects;
mod claims;
mod figures;
mod tables;

#[cfg(test)]
mod tests;

use super::paper::{Paper, Section};
use super::results::ResultSet;
use super::way::Way;
use crate::geometry::SliceLaw;
use crate::methods::{GridMethod, Method, Space};

/// The post.
pub const PAPER: Paper = Paper {
    name: "Ortiz 2018",
    sections: &[Section { heading: "Ortiz: a practical recipe", anchor: "ortiz", ids: &["OF", "ortiz-"] }],
    figures: figures::all,
    tables: tables::all,
    claims: &claims::CLAIMS,
    judged,
    measures,
};

/// Tiles and slices by their number.
pub fn measures(method: Method) -> bool {
    matches!(method, Method::Grid(GridMethod { space: Space::Counted { .. }, .. }))
}

/// All results at once: the claims compare ways of working with each other.
fn judged(set: &ResultSet) -> Vec<(Way, ResultSet)> {
    vec![(Way::default(), set.clone())]
}

/// The subdivisions that the post compares, with what it calls them.
const SUBDIVISIONS: [(SliceLaw, &str); 3] = [
    (SliceLaw::UniformNdc, "uniform in NDC"),
    (SliceLaw::UniformView, "uniform in view space"),
    (SliceLaw::Geometric, "exponential"),
];
