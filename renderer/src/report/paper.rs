//! Papers whose evaluations a report makes anew: each a folder beside this file, and a line in [`PAPERS`].

use super::claim::Stated;
use super::figure::Figure;
use super::gelderen;
use super::results::ResultSet;
use crate::Result;

/// What of a paper is made anew.
pub struct Paper {
    /// Author and year.
    pub name: &'static str,
    /// Its parts, in order.
    pub sections: &'static [Section],
    /// Every figure, in the paper's order.
    pub figures: fn(&ResultSet) -> Result<Vec<Figure>>,
    /// Its claims.
    pub claims: &'static [Stated],
}

/// A part of a paper that has figures.
pub struct Section {
    /// Its heading on the page.
    pub heading: &'static str,
    /// Its anchor there.
    pub anchor: &'static str,
    /// How the numbers of its figures begin.
    pub ids: &'static [&'static str],
}

/// Every paper, in the order of the page.
pub const PAPERS: [Paper; 1] = [gelderen::PAPER];
