//! Runs that are on disk: whether they are whole, what made them, their means.

use super::run::MANIFEST;
use super::summary::Values;
use crate::{Error, Result};
use serde::Deserialize;
use std::path::Path;

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

/// Whether a run stands in `directory`: directories come into their places whole.
pub fn is_complete(directory: &Path) -> bool {
    directory.join(MANIFEST).is_file()
}

/// The fingerprint of the run in `directory`; `None` where there is none, or one by another version of the format.
pub fn saved_fingerprint(directory: &Path) -> Option<String> {
    let text = std::fs::read_to_string(directory.join(MANIFEST)).ok()?;
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
