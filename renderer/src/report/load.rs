//! Result directories to a [`ResultSet`].

mod manifest;
mod tables;

use super::results::{LightingName, Picture, ResultSet, Run, is_tuned};
use crate::output::{
    Manifest, Older, age, check_run, find_runs, newest_of_each, saved_memory, saved_samples, saved_times,
};
use crate::{Error, Result};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A run as it was found.
pub struct Found {
    /// Its path below the directory given.
    pub name: String,
    /// Where it is.
    pub directory: PathBuf,
    /// How it came to be.
    pub manifest: Manifest,
}

/// Reads every run below `directories`.
///
/// # Errors
/// A directory is missing or holds no run, a file is missing, damaged or was written by something else, or runs come
/// from several versions of the program.
pub fn load(directories: &[PathBuf]) -> Result<ResultSet> {
    let (found, older) = find(directories)?;
    one_version(&found)?;
    let loaded: Vec<Result<Run>> = found.par_iter().map(read_run).collect();
    let mut runs = loaded.into_iter().collect::<Result<Vec<_>>>()?;
    name_lights_files_once(&mut runs);
    runs.sort_by_cached_key(|run| (run.setting.clone(), run.lighting.clone(), run.method.to_string()));
    let first = &found[0].manifest;
    Ok(ResultSet { runs, older, version: first.version.clone(), git_revision: first.git_revision.clone() })
}

/// The runs below `directories`, each once, of those that were asked to do the same the newest; and which were older.
///
/// # Errors
/// A directory is missing or holds no run, or a manifest is damaged or was written by something else.
pub fn find(directories: &[PathBuf]) -> Result<(Vec<Found>, Vec<Older>)> {
    let mut found = vec![];
    for directory in directories {
        let below = find_runs(directory)?;
        let root = if directories.len() > 1 { directory.parent().unwrap_or(directory) } else { directory };
        found.extend(below.into_iter().map(|path| (name_below(root, &path), path)));
    }
    each_directory_once(&mut found);
    let read = |(name, directory): (String, PathBuf)| {
        let manifest = Manifest::read(&directory)?;
        Ok(Found { name, directory, manifest })
    };
    let found: Vec<Result<Found>> = found.into_par_iter().map(read).collect();
    keep_newest(found.into_iter().collect::<Result<_>>()?)
}

/// Directories that are given within each other hold the same runs.
fn each_directory_once(found: &mut Vec<(String, PathBuf)>) {
    let mut seen = BTreeSet::new();
    found.retain(|(_, path)| seen.insert(fs::canonicalize(path).unwrap_or_else(|_| path.clone())));
}

/// Of runs that were asked to do the same, leaves the newest; says which were older.
fn keep_newest(mut found: Vec<Found>) -> Result<(Vec<Found>, Vec<Older>)> {
    let key = |Found { directory, manifest, .. }: &Found| {
        let method = manifest::method(manifest, directory)?;
        // How many views there are follows from the recording.
        let setting = manifest::setting(manifest, 0, method)?;
        let key = (setting, manifest::lights_key(manifest), method.to_string());
        Ok((key, age(directory, &manifest.started)))
    };
    let keys = found.iter().map(key).collect::<Result<Vec<_>>>()?;
    let newest = newest_of_each(&keys);
    let name = |index: usize| found[index].name.clone();
    let pairs = newest.iter().enumerate().filter(|(index, newest)| index != *newest);
    let older = pairs.map(|(index, &newest)| Older { run: name(index), newer: name(newest) }).collect();
    let mut index = 0..;
    found.retain(|_| index.next().is_some_and(|index| newest[index] == index));
    Ok((found, older))
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

fn one_version(found: &[Found]) -> Result<()> {
    let built = |found: &Found| manifest::built(&found.manifest);
    let first = &found[0];
    let Some(other) = found.iter().find(|found| built(found) != built(first)) else { return Ok(()) };
    Err(Error::input(format!(
        "results of different versions cannot be compared: {} was measured by {}, {} by {}; report them apart, or \
         measure anew",
        first.directory.display(),
        built(first),
        other.directory.display(),
        built(other),
    )))
}

fn read_run(Found { name, directory, manifest: file }: &Found) -> Result<Run> {
    let method = manifest::method(file, directory)?;
    check_run(directory)?;
    let (views, frames) = tables::read_frames(directory)?;
    let grid = tables::read_grid(directory)?;
    let (mut distributions, mut most_fragments) = Default::default();
    if is_tuned(method) {
        (distributions, most_fragments) = tables::read_histograms(directory, &frames.numbers)?;
    }
    let numbers = frames.numbers.clone();
    let times = saved_times(directory, &numbers)?;
    let pictures = pictures(&directory.join("frames"));
    let groups = if pictures.is_empty() {
        vec![]
    } else {
        let pictured: Vec<u32> = pictures.iter().map(|picture| picture.frame).collect();
        tables::read_groups(directory, &pictured)?
    };
    Ok(Run {
        name: name.clone(),
        setting: manifest::setting(file, views, method)?,
        extent: file.extent.clone(),
        light_box_m: manifest::light_box(file),
        method,
        lighting: manifest::lighting(file),
        device: [file.device.name.clone(), file.device.driver.clone(), file.device.api.clone()],
        machine: file.machine.clone(),
        conditions: file.conditions.clone(),
        doubts: file.doubts.clone(),
        started: file.started.clone(),
        duration_s: file.duration_s,
        temporal_runs: file.temporal_runs(),
        grid,
        frames,
        times,
        stages: if method.is_rasterised() { stages(directory, &numbers)? } else { BTreeMap::new() },
        distributions,
        most_fragments,
        memory: saved_memory(directory)?,
        octree: tables::read_octree(directory)?,
        pictures,
        lists_all: manifest::lists_all(file, method),
        groups,
    })
}

/// Mean times of the stages of clustering by name, milliseconds, over all clusterings and views.
fn stages(directory: &Path, frames: &[u32]) -> Result<BTreeMap<String, f64>> {
    let name = |kind: &str| kind.strip_prefix("frame/cluster/").map(str::to_owned).into_iter().collect();
    let samples = saved_samples(directory, frames, name)?;
    Ok(samples.into_iter().map(|(name, samples)| (name, samples.measure().value)).collect())
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
            let shown =
                |name: &str| Some(directory.join(format!("{stem}_{name}.png"))).filter(|path| path.is_file());
            Some(Picture {
                frame,
                lights: shown("lights"),
                share: shown("share"),
                heat: shown("heat"),
                clusters: shown("clusters"),
                slices: shown("slices"),
                birdseye: shown("birdseye"),
                plan: shown("plan"),
                gbuffer: shown("gbuffer"),
                image: image.clone(),
            })
        })
        .collect();
    found.sort_by_key(|picture| picture.frame);
    found
}
