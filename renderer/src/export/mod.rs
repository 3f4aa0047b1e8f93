//! Results as one tidy table: every row says of itself what run it is of, so that pandas, R or a spreadsheet can group
//! and plot it without reading anything else.
//!
//! ```text
//! DIR... ──> runs, checked ──┬─> columns: the run (axes of the sweep, options, device) ──┐
//!                            ├─> frames.csv: counters, minima over the temporal runs ────┼──> FILE.csv
//!                            ├─> timings.csv, with every stage a row ────────────────────┤
//!                            └─> memory.csv, a row a structure ──────────────────────────┘
//! ```

mod columns;

use crate::Result;
use crate::output::{
    FrameRow, MemoryRow, Older, Row, TimingRow, all_rows, check_run, prepare_file, saved_memory, stage_kind,
    write_whole,
};
use crate::report::{Found, find};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What a row is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// A frame of a run: its counters, and each time's minimum over the temporal runs.
    Frames,
    /// A stage of a frame of a temporal run: its times, and the frame's counters.
    Stages,
    /// A structure on the device: what it takes.
    Memory,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exported {
    /// The table's path.
    pub out: String,
    /// Runs in it.
    pub runs: usize,
    /// Its rows, without the header.
    pub rows: usize,
    /// Runs left out, for the same directory has them newer.
    pub older: Vec<Older>,
}

/// Writes the runs below `directories` to the CSV table `out`, whole or not at all. Each directory may have been measured
/// by a device and a version of the program of its own.
///
/// # Errors
/// A directory is missing or holds no run, a run is not whole, or the table cannot be written.
pub fn export(directories: &[PathBuf], rows: Rows, out: &Path) -> Result<Exported> {
    let (runs, older) = runs_below(directories)?;
    prepare_file(out)?;
    let mut written = 0;
    // What is wrong with a run is told as it is, not as a fault of the table.
    let mut broken = None;
    let whole = write_whole(out, |file| {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(file);
        csv.write_record(header(rows))?;
        for run in &runs {
            written += match Tables::read(&run.directory, rows) {
                Ok(tables) => tables.write(&mut csv, &columns::of(run))?,
                Err(error) => {
                    broken = Some(error);
                    return Err(io::ErrorKind::InvalidData.into());
                }
            };
        }
        csv.flush()
    });
    broken.map_or(whole, Err)?;
    Ok(Exported { out: out.display().to_string(), runs: runs.len(), rows: written, older })
}

/// The runs of all directories, each once. Of runs that were asked to do the same, each directory gives its newest.
fn runs_below(directories: &[PathBuf]) -> Result<(Vec<Found>, Vec<Older>)> {
    let (mut runs, mut older) = (vec![], vec![]);
    let mut seen = BTreeSet::new();
    for directory in directories {
        let (found, left_out) = find(std::slice::from_ref(directory))?;
        for run in found {
            let place = fs::canonicalize(&run.directory).unwrap_or_else(|_| run.directory.clone());
            if seen.insert(place) {
                runs.push(run);
            }
        }
        let placed = |name: &str| directory.join(name).display().to_string();
        older.extend(
            left_out.iter().map(|Older { run, newer }| Older { run: placed(run), newer: placed(newer) }),
        );
    }
    Ok((runs, older))
}

/// The table's columns.
fn header(rows: Rows) -> Vec<String> {
    let measured = match rows {
        Rows::Frames => FrameRow::COLUMNS.to_vec(),
        Rows::Stages => {
            let counters = FrameRow::default().counters().map(|(name, _)| name).collect();
            [TimingRow::COLUMNS.to_vec(), vec!["stage_kind"], counters].concat()
        }
        Rows::Memory => MemoryRow::COLUMNS.to_vec(),
    };
    columns::names(&measured).into_iter().chain(measured.iter().map(|name| (*name).to_owned())).collect()
}

/// What of a run's tables is written.
enum Tables {
    Frames(Vec<FrameRow>),
    Stages(Vec<FrameRow>, Vec<TimingRow>),
    Memory(Vec<MemoryRow>),
}

impl Tables {
    fn read(directory: &Path, rows: Rows) -> Result<Self> {
        check_run(directory)?;
        Ok(match rows {
            Rows::Frames => Self::Frames(all_rows(directory)?),
            Rows::Stages => Self::Stages(all_rows(directory)?, all_rows(directory)?),
            Rows::Memory => Self::Memory(saved_memory(directory)?),
        })
    }

    /// Writes the rows, each behind what they share, and says how many there are.
    fn write(&self, csv: &mut csv::Writer<impl Write>, shared: &[String]) -> io::Result<usize> {
        match self {
            Self::Frames(frames) => {
                frames.iter().try_for_each(|row| csv.serialize((shared, row)))?;
                Ok(frames.len())
            }
            Self::Stages(frames, stages) => {
                let counters = |row: &FrameRow| row.counters().map(|(_, count)| count).collect::<Vec<u64>>();
                let counters: BTreeMap<u32, Vec<u64>> =
                    frames.iter().map(|row| (row.frame, counters(row))).collect();
                stages.iter().try_for_each(|row| {
                    csv.serialize((shared, row, stage_kind(&row.stage), &counters[&row.frame]))
                })?;
                Ok(stages.len())
            }
            Self::Memory(structures) => {
                structures.iter().try_for_each(|row| csv.serialize((shared, row)))?;
                Ok(structures.len())
            }
        }
    }
}

impl fmt::Display for Exported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { out, runs, rows, older } = self;
        older.iter().try_for_each(|older| writeln!(f, "{older}"))?;
        writeln!(f, "{runs} runs, {rows} rows\n{out}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{AXES, Axis};

    #[test]
    fn every_axis_and_everything_measured_is_a_column_once() {
        let tables = [
            (Rows::Frames, FrameRow::COLUMNS),
            (Rows::Stages, TimingRow::COLUMNS),
            (Rows::Memory, MemoryRow::COLUMNS),
        ];
        for (rows, measured) in tables {
            let header = header(rows);
            let once: BTreeSet<&str> = header.iter().map(String::as_str).collect();
            assert_eq!(once.len(), header.len(), "{header:?}");
            let counters: Vec<&str> = match rows {
                Rows::Frames | Rows::Stages => FrameRow::default().counters().map(|(name, _)| name).collect(),
                Rows::Memory => vec![],
            };
            assert!(measured.iter().copied().chain(counters).all(|name| once.contains(name)));
            for Axis { column, .. } in &AXES {
                let told = format!("{column}_axis");
                assert!(header[1..=AXES.len()].iter().any(|name| name == column || *name == told));
            }
        }
    }
}
