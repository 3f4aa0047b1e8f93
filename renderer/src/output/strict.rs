//! Tables as this program writes them, read back without forgiveness: a cell that is not what was written is a fault of
//! its line.

use super::rows::Row;
use crate::{Error, Result};
use csv::{DeserializeErrorKind, ErrorKind, ReaderBuilder, StringRecord};
use std::fmt::Display;
use std::fs;
use std::io;
use std::path::Path;

/// What to do about a damaged table.
const ADVICE: &str = "measure it again";

/// A line of a table, to say what is wrong with it.
pub struct Line<'a> {
    path: &'a Path,
    number: u64,
}

/// Gives every row of a table of the run in `directory`, which has the row's columns in any order and no others; of an earlier
/// version's table columns that were added later are 0.
///
/// # Errors
/// The file is missing, cut off or no such table; or `take` refuses a row.
pub fn each_row<R: Row>(directory: &Path, mut take: impl FnMut(&Line<'_>, R) -> Result<()>) -> Result<()> {
    let path = &directory.join(R::FILE);
    let bytes = read_whole(path)?;
    let broken = |error: csv::Error| broken(path, &error);
    // No cell of these tables is quoted: a stray quote must not swallow the lines behind it.
    let mut reader = ReaderBuilder::new().quoting(false).from_reader(bytes.as_slice());
    let header = reader.headers().map_err(broken)?.clone();
    check_header::<R>(path, &header)?;
    let mut record = StringRecord::new();
    while reader.read_record(&mut record).map_err(broken)? {
        let line = Line { path, number: record.position().map_or(0, csv::Position::line) };
        let row = row(&header, &record).map_err(|problem| line.refuse(problem))?;
        take(&line, row)?;
    }
    Ok(())
}

/// Every row of a table of the run in `directory`.
///
/// # Errors
/// As [`each_row`].
pub fn all_rows<R: Row>(directory: &Path) -> Result<Vec<R>> {
    let mut rows = vec![];
    each_row(directory, |_, row| {
        rows.push(row);
        Ok(())
    })?;
    Ok(rows)
}

/// The bytes of a table, the last of which ends a line.
fn read_whole(path: &Path) -> Result<Vec<u8>> {
    let bytes = fs::read(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Error::file(path, format!("is missing beside its run.json: {ADVICE}")),
        _ => Error::file(path, format!("cannot be read: {error}")),
    })?;
    if bytes.last() == Some(&b'\n') {
        return Ok(bytes);
    }
    let lines = bytes.iter().filter(|byte| **byte == b'\n').count();
    let problem =
        if bytes.is_empty() { "is empty".into() } else { format!("ends within line {}", lines + 1) };
    Err(refuse(path, problem))
}

fn check_header<R: Row>(path: &Path, header: &StringRecord) -> Result<()> {
    let refuse = |problem: String| Err(Line { path, number: 1 }.refuse(problem));
    for (place, name) in header.iter().enumerate() {
        if !R::COLUMNS.contains(&name) {
            return refuse(format!("a column `{}` is not known", shown(name)));
        }
        if header.iter().take(place).any(|earlier| earlier == name) {
            return refuse(format!("two columns are called `{name}`"));
        }
    }
    let mut required = R::COLUMNS.iter().filter(|column| !R::ADDED.contains(column));
    match required.find(|column| !header.iter().any(|name| name == **column)) {
        Some(missing) => refuse(format!("column `{missing}` is missing")),
        None => Ok(()),
    }
}

/// The row of a record, or what is wrong with a cell of it.
fn row<R: Row>(header: &StringRecord, record: &StringRecord) -> Result<R, String> {
    let is_no = |place: usize, what: &str| {
        let [column, cell] = [header, record].map(|cells| cells.get(place).unwrap_or_default());
        format!("{column} `{}` is no {what}", shown(cell))
    };
    const WHOLE: &str = "whole number";
    const QUANTITY: &str = "finite number from 0 on";
    // The reader would take hexadecimal numbers, which are never written.
    if let Some(place) = record.iter().position(|cell| cell.starts_with("0x")) {
        return Err(is_no(place, WHOLE));
    }
    let row: R = record.deserialize(Some(header)).map_err(|error| match error.kind() {
        ErrorKind::Deserialize { err, .. } => match (err.field(), err.kind()) {
            (Some(field), DeserializeErrorKind::ParseInt(_)) => is_no(field as usize, WHOLE),
            (Some(field), DeserializeErrorKind::ParseFloat(_)) => is_no(field as usize, QUANTITY),
            (_, kind) => kind.to_string(),
        },
        _ => error.to_string(),
    })?;
    match row.unsound() {
        Some(column) => Err(is_no(header.iter().position(|name| name == column).unwrap_or(0), QUANTITY)),
        None => Ok(row),
    }
}

fn broken(path: &Path, error: &csv::Error) -> Error {
    let problem = match error.kind() {
        ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} cells under a header of {expected_len}")
        }
        _ => "is no text".to_owned(),
    };
    Line { path, number: error.position().map_or(1, csv::Position::line) }.refuse(problem)
}

impl Line<'_> {
    /// An error about this line.
    pub fn refuse(&self, problem: impl Display) -> Error {
        refuse(self.path, format!("line {}: {problem}", self.number))
    }
}

/// A cell as far as a message has room for it.
pub fn shown(text: &str) -> String {
    const MOST: usize = 40;
    text.chars().take(MOST).flat_map(char::escape_debug).collect()
}

/// An error about a file as a whole.
pub fn refuse(path: &Path, problem: impl Display) -> Error {
    Error::file(path, format!("{problem}: {ADVICE}"))
}
