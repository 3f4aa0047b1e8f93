//! Whether a run on disk is whole: every file there, every number one that a run can have, every row that others
//! speak of.

use super::manifest::RUN_FORMAT;
use super::run::MANIFEST;
use super::strict::{Row, each_row, refuse, shown};
use super::tables::{CLUSTERINGS, FRAMES, HISTOGRAMS, KINDS, TIMINGS};
use crate::{Error, Result};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

#[cfg(test)]
mod tests;

/// What `run.json` says of the tables beside it.
#[derive(Deserialize)]
struct Announced {
    format: String,
    config: AnnouncedConfig,
    /// Left out by earlier versions.
    frame_count: Option<usize>,
}

#[derive(Deserialize)]
struct AnnouncedConfig {
    runs: u32,
}

/// What other tables must agree with, of one row of `frames.csv`.
struct FrameRow {
    frame: u32,
    clusterings: u32,
    /// In the order of [`SUMMED`].
    sums: [u64; 3],
    fragments_shaded: u64,
    /// Whether it has a time.
    timed: bool,
}

/// The counters of `frames.csv` that are sums over the rows of `clusterings.csv`.
const SUMMED: [&str; 3] = ["visible_clusters", "light_indices", "intersection_tests"];

/// Columns of `frames.csv` that are no counters.
fn is_counter(column: &str) -> bool {
    column != "time_s" && !column.contains("_ms")
}

/// Checks the files of the run in `directory`.
///
/// # Errors
/// Names the first file at fault, with its line where it is one line's.
pub fn check_run(directory: &Path) -> Result<()> {
    let announced = read_manifest(&directory.join(MANIFEST))?;
    let frames = check_frames(&directory.join("frames.csv"), announced.frame_count)?;
    check_clusterings(&directory.join("clusterings.csv"), &frames)?;
    check_histograms(&directory.join("histograms.csv"), &frames)?;
    check_timings(&directory.join("timings.csv"), &frames, announced.config.runs)
}

fn read_manifest(path: &Path) -> Result<Announced> {
    let bytes = fs::read(path).map_err(|error| Error::file(path, format!("cannot be read: {error}")))?;
    let announced: Announced = serde_json::from_slice(&bytes)
        .map_err(|error| refuse(path, format!("is no manifest of a run: {error}")))?;
    match announced.format == RUN_FORMAT {
        true => Ok(announced),
        false => Err(refuse(
            path,
            format!("has format {}, this version reads {RUN_FORMAT}", shown(&announced.format)),
        )),
    }
}

fn check_frames(path: &Path, announced: Option<usize>) -> Result<Vec<FrameRow>> {
    let mut frames: Vec<FrameRow> = vec![];
    each_row(path, &FRAMES, |row| {
        let frame = row.whole("frame")?;
        if let Some(last) = frames.last().filter(|last| last.frame >= frame) {
            return Err(row.refuse(format!("frame {frame} stands below frame {}", last.frame)));
        }
        row.quantity("time_s")?;
        for column in FRAMES {
            if is_counter(column) {
                row.whole::<u64>(column)?;
            } else if column != "time_s" {
                row.optional(column)?;
            }
        }
        let [visible, indices, tests] = SUMMED.map(|column| row.whole(column));
        frames.push(FrameRow {
            frame,
            clusterings: row.whole("clusterings")?,
            sums: [visible?, indices?, tests?],
            fragments_shaded: row.whole("fragments_shaded")?,
            timed: row.optional("gpu_ms_frame")?.is_some(),
        });
        Ok(())
    })?;
    match announced.unwrap_or(frames.len().max(1)) {
        count if count == frames.len() => Ok(frames),
        count => Err(refuse(path, format!("holds {} frames of {count}", frames.len()))),
    }
}

fn check_clusterings(path: &Path, frames: &[FrameRow]) -> Result<()> {
    let mut expected = frames.iter().flat_map(|row| (0..row.clusterings).map(|number| (row.frame, number)));
    let mut sums: BTreeMap<u32, [u64; 3]> = BTreeMap::new();
    each_row(path, &CLUSTERINGS, |row| {
        let found: (u32, u32) = (row.whole("frame")?, row.whole("clustering")?);
        if expected.next() != Some(found) {
            return Err(row.refuse(format!("frame {}, clustering {} is out of place", found.0, found.1)));
        }
        ["dx", "dy", "dz"].into_iter().try_for_each(|side| row.whole::<u32>(side).map(drop))?;
        let hash = row.text("lists_hash");
        if hash.len() != 16 || !hash.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return Err(row.refuse(format!("lists_hash `{}` is no hash", shown(hash))));
        }
        let of_frame = sums.entry(found.0).or_default();
        for (sum, column) in of_frame.iter_mut().zip(SUMMED) {
            *sum = sum.saturating_add(row.whole(column)?);
        }
        Ok(())
    })?;
    if let Some((frame, number)) = expected.next() {
        return Err(refuse(path, format!("ends before frame {frame}, clustering {number}")));
    }
    for row in frames.iter().filter(|row| row.clusterings > 0) {
        let found = sums.get(&row.frame).copied().unwrap_or_default();
        agree(path, row.frame, SUMMED, (found, row.sums))?;
    }
    Ok(())
}

fn check_histograms(path: &Path, frames: &[FrameRow]) -> Result<()> {
    let mut last = None;
    // By frame: clusters by lights, clusters by fragments, shaded fragments by lights.
    let mut totals: BTreeMap<u32, [u64; 3]> = frames.iter().map(|row| (row.frame, [0; 3])).collect();
    each_row(path, &HISTOGRAMS, |row| {
        let kind = kind_of(row)?;
        let place: (u32, u32, usize, u32) =
            (row.whole("frame")?, row.whole("clustering")?, kind, row.whole("bin")?);
        if last.replace(place).is_some_and(|last| last >= place) {
            return Err(row.refuse("the row is out of place"));
        }
        let (clusters, fragments): (u64, u64) = (row.whole("clusters")?, row.whole("fragments")?);
        let of_frame = totals.get_mut(&place.0).ok_or_else(|| row.refuse("frames.csv has no such frame"))?;
        let counted = if kind == 2 { fragments } else { clusters };
        of_frame[kind] = of_frame[kind].saturating_add(counted);
        Ok(())
    })?;
    for row in frames {
        let told = [row.sums[0], row.sums[0], row.fragments_shaded];
        agree(path, row.frame, KINDS, (totals[&row.frame], told))?;
    }
    Ok(())
}

/// Refuses sums over the rows of a frame that are not as `frames.csv` tells.
fn agree(path: &Path, frame: u32, names: [&str; 3], (found, told): ([u64; 3], [u64; 3])) -> Result<()> {
    match (0..names.len()).find(|&place| found[place] != told[place]) {
        None => Ok(()),
        Some(place) => {
            let (name, found, told) = (names[place], found[place], told[place]);
            let problem = format!("{name} of frame {frame} add up to {found}, in frames.csv to {told}");
            Err(refuse(path, problem))
        }
    }
}

fn kind_of(row: &Row<'_>) -> Result<usize> {
    let name = row.text("kind");
    let kind = KINDS.iter().position(|kind| *kind == name);
    kind.ok_or_else(|| row.refuse(format!("`{}` is no kind of histogram", shown(name))))
}

/// Every temporal run of every frame has the stages of the first; a device without timestamps gave none at all.
fn check_timings(path: &Path, frames: &[FrameRow], runs: u32) -> Result<()> {
    let mut stages: BTreeMap<(u32, u32), Vec<String>> = BTreeMap::new();
    each_row(path, &TIMINGS, |row| {
        let place = (row.whole("run")?, row.whole("frame")?);
        if place.0 >= runs || frames.binary_search_by_key(&place.1, |row| row.frame).is_err() {
            return Err(row.refuse(format!("there is no run {} of a frame {}", place.0, place.1)));
        }
        row.optional("gpu_ms")?;
        row.quantity("cpu_ms")?;
        let (of_place, stage) = (stages.entry(place).or_default(), row.text("stage"));
        if of_place.iter().any(|earlier| earlier == stage) {
            return Err(row.refuse(format!("stage {} comes twice", shown(stage))));
        }
        of_place.push(stage.to_owned());
        Ok(())
    })?;
    let Some(first) = stages.values().next() else {
        return match frames.iter().any(|row| row.timed) {
            true => Err(refuse(path, "holds no times, and frames.csv does")),
            false => Ok(()),
        };
    };
    if let Some(row) = frames.iter().find(|row| !row.timed) {
        return Err(refuse(
            path,
            format!("times frame {}, for which frames.csv has no gpu_ms_frame", row.frame),
        ));
    }
    for place in (0..runs).flat_map(|run| frames.iter().map(move |row| (run, row.frame))) {
        if stages.get(&place) != Some(first) {
            let (run, frame) = place;
            return Err(refuse(path, format!("the stages of run {run}, frame {frame} are not all there")));
        }
    }
    Ok(())
}
