//! Result directories to a [`ResultSet`].

mod manifest;
mod tables;

use super::results::{LightingName, Picture, ResultSet, Run, is_tuned};
use crate::output::{Manifest, Older, age, check_run, find_runs, newest_of_each, saved_times};
use crate::{Error, Result};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Reads every run below `directories`.
///
/// # Errors
/// A directory is missing or holds no run, a file is missing, damaged or was written by something else, or runs come
/// from several versions of the program.
pub fn load(directories: &[PathBuf]) -> Result<ResultSet> {
    let mut found = vec![];
    for directory in directories {
        let below = find_runs(directory)?;
        let root = if directories.len() > 1 { directory.parent().unwrap_or(directory) } else { directory };
        found.extend(below.into_iter().map(|path| (name_below(root, &path), path)));
    }
    each_directory_once(&mut found);
    let files = found.par_iter().map(|(_, path)| Manifest::read(path)).collect::<Vec<_>>();
    let mut files = files.into_iter().collect::<Result<Vec<_>>>()?;
    let older = keep_newest(&mut found, &mut files)?;
    one_version(&found, &files)?;
    let loaded: Vec<Result<Run>> =
        found.par_iter().zip(&files).map(|((name, path), file)| read_run(name, path, file)).collect();
    let mut runs = loaded.into_iter().collect::<Result<Vec<_>>>()?;
    name_lights_files_once(&mut runs);
    runs.sort_by_cached_key(|run| (run.setting.clone(), run.lighting.clone(), run.method.to_string()));
    let first = &files[0];
    Ok(ResultSet { runs, older, version: first.version.clone(), git_revision: first.git_revision.clone() })
}

/// Directories that are given within each other hold the same runs.
fn each_directory_once(found: &mut Vec<(String, PathBuf)>) {
    let mut seen = BTreeSet::new();
    found.retain(|(_, path)| seen.insert(fs::canonicalize(path).unwrap_or_else(|_| path.clone())));
}

/// Of runs that were asked to do the same, leaves the newest; says which were older.
fn keep_newest(found: &mut Vec<(String, PathBuf)>, files: &mut Vec<Manifest>) -> Result<Vec<Older>> {
    let key = |((_, path), file): (&(String, PathBuf), &Manifest)| {
        let method = manifest::method(file, path)?;
        // How many views there are follows from the recording.
        let key = (manifest::setting(file, 0, method), manifest::lights_key(file), method.to_string());
        Ok((key, age(path, &file.started)))
    };
    let keys = found.iter().zip(files.iter()).map(key).collect::<Result<Vec<_>>>()?;
    let newest = newest_of_each(&keys);
    let name = |index: usize| found[index].0.clone();
    let pairs = newest.iter().enumerate().filter(|(index, newest)| index != *newest);
    let older = pairs.map(|(index, &newest)| Older { run: name(index), newer: name(newest) }).collect();
    let is_newest = |index: usize| newest[index] == index;
    let mut index = 0..;
    found.retain(|_| index.next().is_some_and(is_newest));
    let mut index = 0..;
    files.retain(|_| index.next().is_some_and(is_newest));
    Ok(older)
}

/// One file of lights may lie under several names: it is called by the first.
fn name_lights_files_once(runs: &mut [Run]) {
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    for LightingName { label, sha256, .. } in runs.iter_mut().map(|run| &mut run.lighting) {
        if let Some(sha256) = sha256 {
            label.clone_from(names.entry(sha256.clone()).or_insert_with(|| label.clone()));
        }
    }
}

fn name_below(root: &Path, path: &Path) -> String {
    let below = path.strip_prefix(root).unwrap_or(path);
    let below = if below.as_os_str().is_empty() { path } else { below };
    below.display().to_string()
}

fn one_version(found: &[(String, PathBuf)], files: &[Manifest]) -> Result<()> {
    let first = &files[0];
    let built = manifest::built;
    let Some(other) = files.iter().position(|file| built(file) != built(first)) else { return Ok(()) };
    Err(Error::input(format!(
        "results of different versions cannot be compared: {} was measured by {}, {} by {}; report them apart, or \
         measure anew",
        found[0].1.display(),
        built(first),
        found[other].1.display(),
        built(&files[other]),
    )))
}

fn read_run(name: &str, directory: &Path, file: &Manifest) -> Result<Run> {
    let method = manifest::method(file, directory)?;
    check_run(directory)?;
    let (views, frames) = tables::read_frames(directory)?;
    let grid = tables::read_grid(directory)?;
    let (mut distributions, mut most_fragments) = Default::default();
    if is_tuned(method) {
        (distributions, most_fragments) = tables::read_histograms(directory, &frames.numbers)?;
    }
    let times = saved_times(directory, &frames.numbers)?;
    Ok(Run {
        name: name.to_owned(),
        setting: manifest::setting(file, views, method),
        method,
        lighting: manifest::lighting(file),
        device: [file.device.name.clone(), file.device.driver.clone(), file.device.api.clone()],
        machine: file.machine.clone(),
        conditions: file.conditions.clone(),
        doubts: file.doubts.clone(),
        started: file.started.clone(),
        duration_s: file.duration_s,
        temporal_runs: file.config.runs,
        grid,
        frames,
        times,
        distributions,
        most_fragments,
        pictures: pictures(&directory.join("frames")),
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
