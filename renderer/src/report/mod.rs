//! The evaluation as a page: figures, claims and tables from result directories.
//!
//! Reads the files that [`crate::output`] wrote and nothing else: it knows no Vulkan.
//!
//! ```text
//! DIR... ──> load ──> ResultSet ──┬─> figures ──> chart (SVG, CSV) ──┐        figures and claims: a folder a paper
//!                                 ├─> claims ────────────────────────┼──> page (index.html)
//!                                 ├─> tables, analysis ──────────────┤
//!                                 └─> runs.csv
//! OUT/
//!   index.html           everything, in one file that opens offline
//!   claims.json          the claims with the numbers behind them
//!   runs.csv             statistics of every metric of every run
//!   indi-encl.csv        Indi against Encl by every way of assignment; tests.csv: tests of light against cluster
//!   analysis-times.csv, analysis-lines.csv, analysis-classes.csv, analysis-memory.csv
//!                        means and deviations, slopes and offsets over lights, rankings of methods, memory
//!   PAPER-TABLE.csv      a paper's own tables, where its methods were run
//!   groups.csv           groups by lights, in bins, of every frame that has pictures
//!   figures/ID.svg .csv  each figure, and the numbers plotted
//! ```

mod analysis;
pub mod assign_bench;
mod bins;
mod chart;
mod claim;
mod computed;
mod enhuber;
mod figure;
mod format;
mod gelderen;
mod load;
mod ortegren;
mod ortiz;
mod page;
mod paper;
mod pictures;
mod results;
mod tables;
mod tegelaers;
mod way;

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

pub(crate) use page::{document, text};

pub use claim::{ByWay, Claim, Evidence, Number, Verdict};
pub(crate) use load::{Found, find};

use crate::output::{Older, write_whole};
use crate::{Error, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use figure::Figure;
use paper::papers;
use results::ResultSet;
use serde::{Serialize, Serializer};
use std::fmt;
use std::io::Write;
use std::path::{Path, PathBuf};
use tables::Table;

/// What a report holds, for the closing lines.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// The page.
    #[serde(serialize_with = "as_text")]
    pub page: PathBuf,
    /// Runs read.
    pub runs: usize,
    /// Runs left out, for there are newer ones that were asked to do the same.
    pub older: Vec<Older>,
    /// Figures that were drawn.
    pub drawn: Vec<String>,
    /// Figures for which there are no data.
    pub missing: Vec<String>,
    /// The claims.
    pub claims: Vec<Claim>,
}

/// Reads the runs below `directories` and writes the report to `out`, by default `report` in the first directory.
///
/// # Errors
/// A directory is missing, holds no run, or runs that do not belong together; or a file cannot be written.
pub fn write_report(directories: &[PathBuf], out: Option<&Path>) -> Result<Report> {
    let Some(first) = directories.first() else {
        return Err(Error::input("no directory: give one that a replay wrote"));
    };
    let set = load::load(directories)?;
    let out = out.map_or_else(|| first.join("report"), Path::to_owned);
    let figures = figures(&set)?;
    let galleries = pictures::galleries(&set)?;
    let claims = claims(&set);
    let tables = tables::all(&set);
    let paper_tables: Vec<Table> = papers(&set).into_iter().flat_map(|paper| (paper.tables)(&set)).collect();
    let analysis = page::Analysis { figures: analysis::figures(&set)?, tables: analysis::tables(&set) };
    for figure in figures.iter().chain(&analysis.figures).chain(&galleries) {
        write_figure(&out.join("figures"), figure)?;
    }
    for table in tables.iter().chain(&analysis.tables).chain(&paper_tables) {
        write_whole(&out.join(format!("{}.csv", table.id)), |file| table.write_csv(file))?;
    }
    write_whole(&out.join("runs.csv"), |file| page::write_runs_csv(file, &set))?;
    write_whole(&out.join("groups.csv"), |file| analysis::groups::write_csv(file, &set))?;
    let json = serde_json::to_string_pretty(&claims)
        .map_err(|error| Error::Internal(format!("the claims are not JSON: {error}")))?;
    write_whole(&out.join("claims.json"), |file| writeln!(file, "{json}"))?;
    let page = out.join("index.html");
    let html = page::html(
        &set,
        &page::Content {
            figures: &figures,
            analysis: Some(&analysis),
            galleries: &galleries,
            claims: &claims,
            tables: &tables,
            paper_tables: &paper_tables,
        },
    );
    write_whole(&page, |file| file.write_all(html.as_bytes()))?;
    let ids = |drawn: bool| {
        figures
            .iter()
            .filter(|figure| figure.chart.is_some() == drawn)
            .map(|figure| figure.id.clone())
            .collect()
    };
    let (drawn, missing) = (ids(true), ids(false));
    Ok(Report { page, runs: set.runs.len(), older: set.older, drawn, missing, claims })
}

/// Every figure of the papers whose methods were run.
fn figures(set: &ResultSet) -> Result<Vec<Figure>> {
    let drawn = papers(set).into_iter().map(|paper| (paper.figures)(set)).collect::<Result<Vec<_>>>()?;
    Ok(drawn.into_iter().flatten().collect())
}

/// The claims of those papers, checked.
fn claims(set: &ResultSet) -> Vec<Claim> {
    papers(set).into_iter().flat_map(|paper| claim::check(paper.claims, (paper.judged)(set))).collect()
}

/// Writes a figure's SVG and CSV; of a figure without data, removes those of an earlier report.
fn write_figure(directory: &Path, figure: &Figure) -> Result<()> {
    let [svg, csv] = ["svg", "csv"].map(|kind| directory.join(format!("{}.{kind}", figure.id)));
    let Some(chart) = &figure.chart else {
        for path in [svg, csv].iter().filter(|path| path.is_file()) {
            std::fs::remove_file(path)
                .map_err(|error| Error::file(path, format!("is outdated and cannot be removed: {error}")))?;
        }
        return Ok(());
    };
    let drawing = chart.svg_file(&figure.id, &figure.title);
    write_whole(&svg, |file| file.write_all(drawing.as_bytes()))?;
    write_whole(&csv, |file| chart.write_csv(file))
}

/// A path as far as it is text: JSON has nothing else.
fn as_text<S: Serializer>(path: &Path, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.collect_str(&path.display())
}

/// Bytes as a `data:` URI.
fn data_uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} runs; figures drawn: {}", self.runs, self.drawn.join(" "))?;
        self.older.iter().try_for_each(|older| writeln!(f, "{older}"))?;
        if !self.missing.is_empty() {
            writeln!(f, "no data for figures: {}", self.missing.join(" "))?;
        }
        for claim in &self.claims {
            writeln!(f, "claim {}  {:16} {}", claim.id, claim.verdict, claim.claim)?;
        }
        write!(f, "{}", self.page.display())
    }
}
