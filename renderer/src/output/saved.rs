//! Runs that are on disk: whether they are whole, what made them, their means.

use super::check::check_run;
use super::manifest::{MANIFEST, Manifest};
use super::rows::{FrameRow, MemoryRow, Row};
use super::run_times::{MeasuredTimes, saved_times};
use super::strict::all_rows;
use super::summary::Values;
use crate::{Error, Result};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use std::{fmt, fs, io};

/// The directories of all runs in or below `directory`, by name. Hidden ones are unfinished, and what stands in a
/// run's own is not searched.
///
/// # Errors
/// It is missing, is no directory, cannot be read, or holds no run.
pub fn find_runs(directory: &Path) -> Result<Vec<PathBuf>> {
    let mut found = vec![];
    search(directory, &mut found)?;
    if found.is_empty() {
        return Err(Error::file(
            directory,
            format!("holds no results (no {MANIFEST} below it): give a directory that a replay wrote"),
        ));
    }
    Ok(found)
}

fn search(directory: &Path, found: &mut Vec<PathBuf>) -> Result<()> {
    if is_complete(directory) {
        found.push(directory.to_owned());
        return Ok(());
    }
    let cannot = |error: io::Error| {
        let problem = match error.kind() {
            io::ErrorKind::NotFound => "there is no such directory".to_owned(),
            io::ErrorKind::NotADirectory => "is no directory: give one that a replay wrote".to_owned(),
            _ => format!("cannot be read: {error}"),
        };
        Error::file(directory, problem)
    };
    let entries = fs::read_dir(directory).map_err(cannot)?.collect::<io::Result<Vec<_>>>().map_err(cannot)?;
    let is_inner = |entry: &fs::DirEntry| {
        // A link is followed to a run and no further: links may lead in circles.
        entry.file_type().is_ok_and(|kind| kind.is_dir() || (kind.is_symlink() && is_complete(&entry.path())))
            && !entry.file_name().to_string_lossy().starts_with('.')
    };
    let mut inner: Vec<PathBuf> =
        entries.iter().filter(|entry| is_inner(entry)).map(fs::DirEntry::path).collect();
    inner.sort();
    inner.iter().try_for_each(|path| search(path, found))
}

/// Whether a run stands in `directory`: directories come into their places whole.
pub fn is_complete(directory: &Path) -> bool {
    directory.join(MANIFEST).is_file()
}

/// When the run in `directory` was begun (`started`, as its manifest has it), and when it was put there: of runs that
/// were asked to do the same, the greatest is the newest.
pub type Age = (String, Option<SystemTime>);

/// The age of the run in `directory`.
pub fn age(directory: &Path, started: &str) -> Age {
    let put = fs::metadata(directory.join(MANIFEST)).and_then(|manifest| manifest.modified());
    (started.to_owned(), put.ok())
}

/// A run that is passed over: there is a newer one that was asked to do the same.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Older {
    /// Its directory.
    pub run: String,
    /// The newer one's.
    pub newer: String,
}

impl fmt::Display for Older {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is left out: {} is the same run, made later", self.run, self.newer)
    }
}

/// For each of some runs the index of the newest that was asked to do the same, as their keys tell.
pub fn newest_of_each<K: Ord>(runs: &[(K, Age)]) -> Vec<usize> {
    let mut newest: BTreeMap<&K, usize> = BTreeMap::new();
    for (index, (key, age)) in runs.iter().enumerate() {
        let best = newest.entry(key).or_insert(index);
        if *age > runs[*best].1 {
            *best = index;
        }
    }
    runs.iter().map(|(key, _)| newest[key]).collect()
}

/// The fingerprint of the run in `directory`; `None` where there is none, or one by another version of the format.
pub fn saved_fingerprint(directory: &Path) -> Option<String> {
    Manifest::read(directory).ok().map(|manifest| manifest.fingerprint)
}

/// The rows of `frames.csv` of the run in `directory`.
///
/// # Errors
/// The table is damaged.
pub fn saved_frames(directory: &Path) -> Result<Vec<FrameRow>> {
    all_rows(directory)
}

/// Whether the run in `directory` tells what structures take, which those of earlier versions do not.
pub(super) fn has_memory(directory: &Path) -> bool {
    directory.join(MemoryRow::FILE).is_file()
}

/// The rows of `memory.csv` of the run in `directory`; none of one that does not tell.
///
/// # Errors
/// The table is damaged.
pub fn saved_memory(directory: &Path) -> Result<Vec<MemoryRow>> {
    if has_memory(directory) { all_rows(directory) } else { Ok(vec![]) }
}

/// How many frames the run in `directory` has, its means over them, and the noise of its times.
///
/// # Errors
/// The run is not whole: see [`check_run`].
pub fn saved_means(directory: &Path) -> Result<(usize, Values, MeasuredTimes)> {
    check_run(directory)?;
    let rows = saved_frames(directory)?;
    let frames: Vec<u32> = rows.iter().map(|row| row.frame).collect();
    let times = MeasuredTimes::new(&saved_times(directory, &frames)?);
    Ok((rows.len(), Values::mean(&rows), times))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn runs_are_found_behind_links_and_circles_are_not_followed() {
        let dir = tempfile::tempdir().unwrap();
        let [far, out] = ["far", "out"].map(|name| dir.path().join(name));
        fs::create_dir_all(far.join("run")).unwrap();
        fs::create_dir(&out).unwrap();
        fs::write(far.join("run").join(MANIFEST), "").unwrap();
        std::os::unix::fs::symlink(far.join("run"), out.join("linked")).unwrap();
        std::os::unix::fs::symlink(&out, out.join("circle")).unwrap();
        assert_eq!(find_runs(&out).unwrap(), [out.join("linked")]);
    }

    #[test]
    fn of_equal_keys_the_newest_stands_for_all() {
        let later = |seconds| Some(SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(seconds));
        let runs = [
            ("a", ("2026-01-01T00:00:00Z".to_owned(), later(9))),
            ("b", ("2026-01-01T00:00:00Z".to_owned(), later(1))),
            ("a", ("2026-01-02T00:00:00Z".to_owned(), later(1))),
            ("b", ("2026-01-01T00:00:00Z".to_owned(), later(2))),
            ("a", ("2026-01-01T12:00:00Z".to_owned(), later(5))),
        ];
        assert_eq!(newest_of_each(&runs), [2, 3, 2, 3, 2]);
    }
}
