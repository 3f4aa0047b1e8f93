//! Tables as this program writes them, read back without forgiveness: a cell that is not what was written is a fault of
//! its line.

use crate::{Error, Result};
use csv::{ErrorKind, ReaderBuilder, StringRecord};
use std::fmt::Display;
use std::fs;
use std::io;
use std::path::Path;
use std::str::FromStr;

/// What to do about a damaged table.
const ADVICE: &str = "measure it again";

/// One line of a table.
pub struct Row<'a> {
    path: &'a Path,
    columns: &'a [&'static str],
    /// Where each column stands in the file.
    places: &'a [usize],
    record: &'a StringRecord,
}

/// Gives every row of the table at `path`, which has `columns` in any order and no others.
///
/// # Errors
/// The file is missing, cut off or no such table; or `take` refuses a row.
pub fn each_row(
    path: &Path,
    columns: &[&'static str],
    mut take: impl FnMut(&Row<'_>) -> Result<()>,
) -> Result<()> {
    let bytes = fs::read(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Error::file(path, format!("is missing beside its run.json: {ADVICE}")),
        _ => Error::file(path, format!("cannot be read: {error}")),
    })?;
    if bytes.last() != Some(&b'\n') {
        let lines = bytes.iter().filter(|byte| **byte == b'\n').count();
        let problem =
            if bytes.is_empty() { "is empty".into() } else { format!("ends within line {}", lines + 1) };
        return Err(Error::file(path, format!("{problem}: {ADVICE}")));
    }
    let broken = |error: csv::Error| broken(path, &error);
    // No cell of these tables is quoted: a stray quote must not swallow the lines behind it.
    let mut reader = ReaderBuilder::new().quoting(false).from_reader(bytes.as_slice());
    let places = places(path, columns, reader.headers().map_err(broken)?)?;
    let mut record = StringRecord::new();
    while reader.read_record(&mut record).map_err(broken)? {
        take(&Row { path, columns, places: &places, record: &record })?;
    }
    Ok(())
}

fn places(path: &Path, columns: &[&'static str], header: &StringRecord) -> Result<Vec<usize>> {
    let refuse = |problem: String| Err(Error::file(path, format!("line 1: {problem}: {ADVICE}")));
    for (place, name) in header.iter().enumerate() {
        if !columns.contains(&name) {
            return refuse(format!("a column `{}` is not known", shown(name)));
        }
        if header.iter().take(place).any(|earlier| earlier == name) {
            return refuse(format!("two columns are called `{name}`"));
        }
    }
    let place = |column: &&'static str| header.iter().position(|name| name == *column);
    match columns.iter().find(|column| place(column).is_none()) {
        Some(missing) => refuse(format!("column `{missing}` is missing")),
        None => Ok(columns.iter().filter_map(place).collect()),
    }
}

fn broken(path: &Path, error: &csv::Error) -> Error {
    let line = error.position().map_or(1, csv::Position::line);
    let problem = match error.kind() {
        ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} cells under a header of {expected_len}")
        }
        _ => "is no text".to_owned(),
    };
    Error::file(path, format!("line {line}: {problem}: {ADVICE}"))
}

impl Row<'_> {
    /// The cell of a column, as it stands.
    pub fn text(&self, column: &str) -> &str {
        let index = self.columns.iter().position(|name| *name == column);
        index.and_then(|index| self.record.get(self.places[index])).unwrap_or_default()
    }

    /// The whole number of a column.
    pub fn whole<T: FromStr>(&self, column: &str) -> Result<T> {
        let text = self.text(column);
        text.parse().map_err(|_| self.refuse(format!("{column} `{}` is no whole number", shown(text))))
    }

    /// A quantity that is finite and not negative.
    pub fn quantity(&self, column: &str) -> Result<f64> {
        let text = self.text(column);
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite() && *value >= 0.0);
        value.ok_or_else(|| self.refuse(format!("{column} `{}` is no finite number from 0 on", shown(text))))
    }

    /// A time; `None` where the cell is empty, for nothing was timed.
    pub fn optional(&self, column: &str) -> Result<Option<f64>> {
        if self.text(column).is_empty() { Ok(None) } else { self.quantity(column).map(Some) }
    }

    /// An error about this line.
    pub fn refuse(&self, problem: impl Display) -> Error {
        let line = self.record.position().map_or(0, csv::Position::line);
        Error::file(self.path, format!("line {line}: {problem}: {ADVICE}"))
    }
}

/// A cell as far as a message has room for it.
pub fn shown(text: &str) -> String {
    const MOST: usize = 40;
    text.chars().take(MOST).flat_map(char::escape_debug).collect()
}

/// An error about a table as a whole.
pub fn refuse(path: &Path, problem: impl Display) -> Error {
    Error::file(path, format!("{problem}: {ADVICE}"))
}
