//! Runs that are on disk: whether they are whole, what made them, their means.

use super::run::MANIFEST;
use super::summary::Values;
use crate::{Error, Result};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// What is asked of a run on disk.
#[derive(Deserialize)]
struct SavedManifest {
    fingerprint: String,
}

/// The columns of `frames.csv` that the closing table takes.
#[derive(Deserialize)]
struct FrameRow {
    visible_clusters: f64,
    light_indices: f64,
    lighting_computations: f64,
    gpu_ms_cluster: Option<f64>,
    gpu_ms_shade: Option<f64>,
    gpu_ms_frame: Option<f64>,
}

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
        entry.file_type().is_ok_and(|kind| kind.is_dir())
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

/// The fingerprint of the run in `directory`; `None` where there is none, or one by another version of the format.
pub fn saved_fingerprint(directory: &Path) -> Option<String> {
    let text = fs::read_to_string(directory.join(MANIFEST)).ok()?;
    serde_json::from_str::<SavedManifest>(&text).ok().map(|manifest| manifest.fingerprint)
}

/// How many frames the run in `directory` has, and its means over them.
///
/// # Errors
/// Its `frames.csv` is missing or broken.
pub fn saved_means(directory: &Path) -> Result<(usize, Values)> {
    let path = directory.join("frames.csv");
    let broken = |error: csv::Error| {
        Error::file(&path, format!("is no table of frames ({error}): render the run again with --force"))
    };
    let mut reader = csv::Reader::from_path(&path).map_err(broken)?;
    let rows = reader.deserialize().collect::<std::result::Result<Vec<FrameRow>, _>>().map_err(broken)?;
    let mean = |get: fn(&FrameRow) -> Option<f64>| super::summary::mean(rows.iter().map(get));
    let values = Values {
        visible_clusters: mean(|row| Some(row.visible_clusters)).unwrap_or(0.0),
        light_indices: mean(|row| Some(row.light_indices)).unwrap_or(0.0),
        lighting_computations: mean(|row| Some(row.lighting_computations)).unwrap_or(0.0),
        clustering_ms: mean(|row| row.gpu_ms_cluster),
        shading_ms: mean(|row| row.gpu_ms_shade),
        total_ms: mean(|row| row.gpu_ms_frame),
    };
    Ok((rows.len(), values))
}
