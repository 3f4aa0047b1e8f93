//! The CSV tables of a run.

use crate::report::bins;
use crate::report::results::{Distribution, Frames, metric};
use crate::{Error, Result};
use csv::{Reader, StringRecord};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;
use std::str::FromStr;

/// Columns of `frames.csv` that are no metrics.
const NO_METRICS: [&str; 3] = ["frame", "time_s", "views"];

/// A table with the places of its columns.
struct Table<'a> {
    path: &'a Path,
    header: StringRecord,
    reader: Reader<File>,
}

impl<'a> Table<'a> {
    fn open(path: &'a Path) -> Result<Self> {
        let cannot = |error: csv::Error| match error.into_kind() {
            csv::ErrorKind::Io(error) if error.kind() == std::io::ErrorKind::NotFound => {
                Error::file(path, "is missing beside its run.json: measure anew")
            }
            csv::ErrorKind::Io(error) => Error::file(path, format!("cannot be read: {error}")),
            _ => Error::file(path, "is damaged: measure anew"),
        };
        let mut reader = Reader::from_path(path).map_err(cannot)?;
        let header = reader.headers().map_err(cannot)?.clone();
        Ok(Self { path, header, reader })
    }

    fn column(&self, name: &str) -> Result<usize> {
        self.header.iter().position(|column| column == name).ok_or_else(|| {
            Error::file(
                self.path,
                format!("has no column '{name}', so another version wrote it: measure anew"),
            )
        })
    }

    /// Gives every record with its line; cells are then read by [`Row::cell`].
    fn each(mut self, mut take: impl FnMut(&Row<'_>) -> Result<()>) -> Result<()> {
        let mut record = StringRecord::new();
        loop {
            match self.reader.read_record(&mut record) {
                Ok(true) => take(&Row { path: self.path, record: &record })?,
                Ok(false) => return Ok(()),
                Err(error) => {
                    let line = error.position().map_or(0, csv::Position::line);
                    return Err(Error::file(self.path, format!("is damaged at line {line}: measure anew")));
                }
            }
        }
    }
}

struct Row<'a> {
    path: &'a Path,
    record: &'a StringRecord,
}

impl Row<'_> {
    fn cell<T: FromStr>(&self, column: usize) -> Result<T> {
        let text = self.record.get(column).unwrap_or_default();
        text.parse().map_err(|_| {
            let line = self.record.position().map_or(0, csv::Position::line);
            Error::file(self.path, format!("line {line}, column {}: '{text}' is not a number", column + 1))
        })
    }

    fn optional(&self, column: usize) -> Result<Option<f64>> {
        if self.record.get(column).is_none_or(str::is_empty) {
            return Ok(None);
        }
        self.cell(column).map(|value: f64| Some(value).filter(|value| value.is_finite()))
    }
}

/// Views and metrics of `frames.csv`.
pub fn read_frames(path: &Path) -> Result<(u32, Frames)> {
    let table = Table::open(path)?;
    let (number, views) = (table.column("frame")?, table.column("views")?);
    for needed in [metric::VISIBLE, metric::INDICES, metric::COMPUTATIONS, metric::FRAME] {
        table.column(needed)?;
    }
    let is_metric = |name: &str| !NO_METRICS.contains(&name);
    let columns: Vec<usize> =
        table.header.iter().enumerate().filter(|(_, name)| is_metric(name)).map(|(place, _)| place).collect();
    let mut metrics: Vec<_> =
        columns.iter().map(|&column| (table.header[column].to_owned(), vec![])).collect();
    let (mut numbers, mut seen) = (vec![], 0);
    table.each(|row| {
        numbers.push(row.cell(number)?);
        seen = row.cell(views)?;
        for (&column, (_, cells)) in columns.iter().zip(&mut metrics) {
            cells.push(row.optional(column)?);
        }
        Ok(())
    })?;
    if numbers.is_empty() {
        return Err(Error::file(path, "holds no frames: measure anew"));
    }
    Ok((seen, Frames { numbers, metrics }))
}

/// The grid of the first clustering of the first frame; `None` for a method without clusters.
pub fn read_grid(path: &Path) -> Result<Option<[u32; 3]>> {
    let table = Table::open(path)?;
    let columns = [table.column("dx")?, table.column("dy")?, table.column("dz")?];
    let mut grid = None;
    table.each(|row| {
        if grid.is_none() {
            grid = Some([row.cell(columns[0])?, row.cell(columns[1])?, row.cell(columns[2])?]);
        }
        Ok(())
    })?;
    Ok(grid)
}

type Distributions = BTreeMap<Distribution, Vec<Vec<u64>>>;

/// Clusters by frame and by row of [`bins`], over clusterings; and the most fragments of any cluster.
pub fn read_histograms(path: &Path, frames: &[u32]) -> Result<(Distributions, Option<u64>)> {
    let table = Table::open(path)?;
    let [frame, kind, bin, clusters] =
        [table.column("frame")?, table.column("kind")?, table.column("bin")?, table.column("clusters")?];
    let mut found = Distributions::new();
    let mut most = None;
    table.each(|row| {
        let distribution = match row.record.get(kind) {
            Some("lights_per_cluster") => Distribution::Lights,
            Some("fragments_per_cluster") => Distribution::Fragments,
            _ => return Ok(()),
        };
        let Ok(place) = frames.binary_search(&row.cell(frame)?) else { return Ok(()) };
        let bin: u64 = row.cell(bin)?;
        if distribution == Distribution::Fragments {
            most = most.max(Some(bin));
        }
        let counts = &mut found.entry(distribution).or_insert_with(|| vec![vec![]; frames.len()])[place];
        let place = bins::row(bin);
        counts.resize(counts.len().max(place + 1), 0);
        counts[place] += row.cell::<u64>(clusters)?;
        Ok(())
    })?;
    Ok((found, most))
}
