//! Papers whose evaluations a report makes anew: each a folder beside this file, and a line in `PAPERS`.

use super::claim::Stated;
use super::figure::Figure;
use super::results::ResultSet;
use super::tables::Table;
use super::way::Way;
use super::{enhuber, gelderen, ortegren, ortiz, tegelaers};
use crate::Result;
use crate::methods::Method;

/// What of a paper is made anew.
pub struct Paper {
    /// Author and year.
    pub name: &'static str,
    /// Its parts, in order.
    pub sections: &'static [Section],
    /// Every figure, in the paper's order.
    pub figures: fn(&ResultSet) -> Result<Vec<Figure>>,
    /// Its own tables, those that have rows; each stands in the section whose `ids` its name begins with.
    pub tables: fn(&ResultSet) -> Vec<Table>,
    /// Its claims.
    pub claims: &'static [Stated],
    /// The results that its claims are judged by, apart by way, the way that decides first.
    pub judged: fn(&ResultSet) -> Vec<(Way, ResultSet)>,
    /// Whether the paper measures a method. It is on the page where a run is of such a method.
    pub measures: fn(Method) -> bool,
}

/// A part of a paper that has figures.
pub struct Section {
    /// Its heading on the page.
    pub heading: &'static str,
    /// Its anchor there.
    pub anchor: &'static str,
    /// How the numbers of its figures and the names of its tables begin.
    pub ids: &'static [&'static str],
}

/// Every paper, in the order of the page.
static PAPERS: [Paper; 5] =
    [gelderen::PAPER, enhuber::PAPER, ortiz::PAPER, ortegren::PAPER, tegelaers::PAPER];

/// The papers whose methods were run; of no runs the first.
pub fn papers(set: &ResultSet) -> Vec<&'static Paper> {
    let is_of = |paper: &&Paper| set.runs.iter().any(|run| (paper.measures)(run.method));
    let found: Vec<&Paper> = PAPERS.iter().filter(is_of).collect();
    if found.is_empty() { vec![&PAPERS[0]] } else { found }
}
