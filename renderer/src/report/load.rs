//! Result directories to a [`ResultSet`].

mod manifest;
mod tables;

use super::results::{Picture, ResultSet, Run, is_tuned};
use crate::output::find_runs;
use crate::{Error, Result};
use manifest::RunFile;
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};

/// By this file a run directory is known.
const MANIFEST: &str = "run.json";

/// Reads every run below `directories`.
///
/// # Errors
/// A directory is missing or holds no run, a file is missing or was written by something else, runs come from
/// several versions of the program, or one run is there twice.
pub fn load(directories: &[PathBuf]) -> Result<ResultSet> {
    let mut found = vec![];
    for directory in directories {
        let below = find_runs(directory)?;
        let root = if directories.len() > 1 { directory.parent().unwrap_or(directory) } else { directory };
        found.extend(below.into_iter().map(|path| (name_below(root, &path), path)));
    }
    let files = found.par_iter().map(|(_, path)| manifest::read(&path.join(MANIFEST))).collect::<Vec<_>>();
    let files = files.into_iter().collect::<Result<Vec<_>>>()?;
    one_version(&found, &files)?;
    let loaded: Vec<Result<Run>> =
        found.par_iter().zip(&files).map(|((name, path), file)| read_run(name, path, file)).collect();
    let mut runs = loaded.into_iter().collect::<Result<Vec<_>>>()?;
    runs.sort_by_cached_key(|run| (run.setting.clone(), run.lighting.clone(), run.method.to_string()));
    each_once(&runs)?;
    let first = &files[0];
    Ok(ResultSet { runs, version: first.version.clone(), git_revision: first.git_revision.clone() })
}

fn name_below(root: &Path, path: &Path) -> String {
    let below = path.strip_prefix(root).unwrap_or(path);
    let below = if below.as_os_str().is_empty() { path } else { below };
    below.display().to_string()
}

fn one_version(found: &[(String, PathBuf)], files: &[RunFile]) -> Result<()> {
    let first = &files[0];
    let Some(other) = files.iter().position(|file| file.built() != first.built()) else { return Ok(()) };
    Err(Error::input(format!(
        "results of different versions cannot be compared: {} was measured by {}, {} by {}; report them apart, or \
         measure anew",
        found[0].1.display(),
        first.built(),
        found[other].1.display(),
        files[other].built(),
    )))
}

fn each_once(runs: &[Run]) -> Result<()> {
    let key = |run: &Run| (run.setting.clone(), run.lighting.clone(), run.method);
    match runs.windows(2).find(|pair| key(&pair[0]) == key(&pair[1])) {
        None => Ok(()),
        Some(pair) => Err(Error::input(format!(
            "{} and {} are the same run measured twice: give one of them",
            pair[0].name, pair[1].name
        ))),
    }
}

fn read_run(name: &str, directory: &Path, file: &RunFile) -> Result<Run> {
    let at = |name: &str| directory.join(name);
    let method = file.method(&at(MANIFEST))?;
    let (views, frames) = tables::read_frames(&at("frames.csv"))?;
    let grid = tables::read_grid(&at("clusterings.csv"))?;
    let (mut distributions, mut most_fragments) = Default::default();
    if is_tuned(method) {
        (distributions, most_fragments) = tables::read_histograms(&at("histograms.csv"), &frames.numbers)?;
    }
    Ok(Run {
        name: name.to_owned(),
        setting: file.setting(views, method),
        method,
        lighting: file.lighting(),
        device: file.device(),
        started: file.started.clone(),
        duration_s: file.duration_s,
        temporal_runs: file.config.runs,
        grid,
        frames,
        distributions,
        most_fragments,
        pictures: pictures(&at("frames")),
    })
}

/// Previews in a run's `frames`, by frame; none where nothing was rendered to files.
fn pictures(directory: &Path) -> Vec<Picture> {
    let Ok(entries) = fs::read_dir(directory) else { return vec![] };
    let mut found: Vec<Picture> = entries
        .flatten()
        .filter_map(|entry| {
            let image = entry.path();
            let stem = image.file_name()?.to_str()?.strip_suffix(".png")?;
            let frame = stem.parse().ok()?;
            let [lights, clusters, birdseye] = ["lights", "clusters", "birdseye"].map(|shown| {
                Some(directory.join(format!("{stem}_{shown}.png"))).filter(|path| path.is_file())
            });
            Some(Picture { frame, image, lights, clusters, birdseye })
        })
        .collect();
    found.sort_by_key(|picture| picture.frame);
    found
}
