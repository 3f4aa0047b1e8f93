//! Whether a run on disk is whole: every file there, every number one that a run can have, every row that others
//! speak of.

use super::manifest::Manifest;
use super::rows::{
    ClusteringRow, FrameRow, HistogramRow, KINDS, LIGHTS_PER_FRAGMENT, MemoryRow, Row, TimingRow,
};
use super::saved::has_memory;
use super::stages::is_everyones;
use super::strict::{Line, each_row, refuse, shown};
use crate::Result;
use crate::measure::Purpose;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

#[cfg(test)]
mod tests;

/// The counters of `frames.csv` that are sums over the rows of `clusterings.csv`.
const SUMMED: [&str; 3] = ["visible_clusters", "light_indices", "intersection_tests"];

impl FrameRow {
    /// In the order of [`SUMMED`].
    fn sums(&self) -> [u64; 3] {
        [self.visible_clusters, self.light_indices, self.intersection_tests]
    }

    fn is_timed(&self) -> bool {
        self.gpu_ms_frame.is_some()
    }
}

/// Checks the files of the run in `directory`.
///
/// # Errors
/// Names the first file at fault, with its line where it is one line's.
pub fn check_run(directory: &Path) -> Result<()> {
    let manifest = Manifest::read(directory)?;
    let frames = check_frames(directory, manifest.frame_count)?;
    check_clusterings(directory, &frames)?;
    check_histograms(directory, &frames)?;
    check_memory(directory, manifest.memory_bytes)?;
    check_timings(directory, &frames, manifest.temporal_runs())
}

/// An error about a table as a whole.
fn refuse_table<R: Row>(directory: &Path, problem: String) -> crate::Error {
    refuse(&directory.join(R::FILE), problem)
}

fn check_frames(directory: &Path, announced: Option<usize>) -> Result<Vec<FrameRow>> {
    let mut frames: Vec<FrameRow> = vec![];
    each_row(directory, |line, row: FrameRow| {
        if let Some(last) = frames.last().filter(|last| last.frame >= row.frame) {
            return Err(line.refuse(format!("frame {} stands below frame {}", row.frame, last.frame)));
        }
        frames.push(row);
        Ok(())
    })?;
    match announced.unwrap_or(frames.len().max(1)) {
        count if count == frames.len() => Ok(frames),
        count => {
            Err(refuse_table::<FrameRow>(directory, format!("holds {} frames of {count}", frames.len())))
        }
    }
}

fn check_clusterings(directory: &Path, frames: &[FrameRow]) -> Result<()> {
    let mut expected = frames.iter().flat_map(|row| (0..row.clusterings).map(|number| (row.frame, number)));
    let mut sums: BTreeMap<u32, [u64; 3]> = BTreeMap::new();
    each_row(directory, |line, row: ClusteringRow| {
        let ClusteringRow { frame, clustering, lists_hash: hash, .. } = &row;
        if expected.next() != Some((*frame, *clustering)) {
            return Err(line.refuse(format!("frame {frame}, clustering {clustering} is out of place")));
        }
        if hash.len() != 16 || !hash.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return Err(line.refuse(format!("lists_hash `{}` is no hash", shown(hash))));
        }
        let counted = [row.visible_clusters, row.light_indices, row.intersection_tests];
        for (sum, count) in sums.entry(*frame).or_default().iter_mut().zip(counted) {
            *sum = sum.saturating_add(count);
        }
        Ok(())
    })?;
    if let Some((frame, number)) = expected.next() {
        let problem = format!("ends before frame {frame}, clustering {number}");
        return Err(refuse_table::<ClusteringRow>(directory, problem));
    }
    frames.iter().filter(|row| row.clusterings > 0).try_for_each(|row| {
        let found = sums.get(&row.frame).copied().unwrap_or_default();
        agree::<ClusteringRow>(directory, row.frame, SUMMED, (found, row.sums()))
    })
}

fn check_histograms(directory: &Path, frames: &[FrameRow]) -> Result<()> {
    let mut last = None;
    // By frame, in the order of the kinds: clusters by lights, clusters by fragments, shaded fragments by lights.
    let mut totals: BTreeMap<u32, [u64; 3]> = frames.iter().map(|row| (row.frame, [0; 3])).collect();
    each_row(directory, |line, row: HistogramRow| {
        let kind = kind_of(line, &row)?;
        let place = (row.frame, row.clustering, kind, row.bin);
        if last.replace(place).is_some_and(|last| last >= place) {
            return Err(line.refuse("the row is out of place"));
        }
        let of_frame =
            totals.get_mut(&row.frame).ok_or_else(|| line.refuse("frames.csv has no such frame"))?;
        let counted = if KINDS[kind] == LIGHTS_PER_FRAGMENT { row.fragments } else { row.clusters };
        of_frame[kind] = of_frame[kind].saturating_add(counted);
        Ok(())
    })?;
    frames.iter().try_for_each(|row| {
        let told = [row.visible_clusters, row.visible_clusters, row.fragments_shaded];
        agree::<HistogramRow>(directory, row.frame, KINDS, (totals[&row.frame], told))
    })
}

/// Refuses sums over the rows of a frame that are not as `frames.csv` tells.
fn agree<R: Row>(
    directory: &Path,
    frame: u32,
    names: [&str; 3],
    (found, told): ([u64; 3], [u64; 3]),
) -> Result<()> {
    match (0..names.len()).find(|&place| found[place] != told[place]) {
        None => Ok(()),
        Some(place) => {
            let (name, found, told) = (names[place], found[place], told[place]);
            let problem = format!("{name} of frame {frame} add up to {found}, in frames.csv to {told}");
            Err(refuse_table::<R>(directory, problem))
        }
    }
}

fn kind_of(line: &Line<'_>, row: &HistogramRow) -> Result<usize> {
    let kind = KINDS.iter().position(|kind| *kind == row.kind);
    kind.ok_or_else(|| line.refuse(format!("`{}` is no kind of histogram", shown(&row.kind))))
}

/// No frame needs more of a structure than was allocated, and all together were allocated what is announced; earlier versions
/// announced nothing.
fn check_memory(directory: &Path, announced: Option<u64>) -> Result<()> {
    if announced.is_none() && !has_memory(directory) {
        return Ok(());
    }
    let (mut seen, mut sum) = (BTreeSet::new(), 0_u64);
    each_row(directory, |line, row: MemoryRow| {
        let MemoryRow { structure, purpose, allocated, used, most } = row;
        if Purpose::named(&purpose).is_none() {
            return Err(line.refuse(format!("`{}` is no purpose", shown(&purpose))));
        }
        if used > most || most > allocated {
            let problem = format!("{used} bytes used, {most} at most, do not fit {allocated} allocated");
            return Err(line.refuse(problem));
        }
        sum = sum.saturating_add(allocated);
        match seen.insert(structure.clone()) {
            true => Ok(()),
            false => Err(line.refuse(format!("structure {} comes twice", shown(&structure)))),
        }
    })?;
    match announced.unwrap_or(sum) {
        announced if announced == sum => Ok(()),
        announced => {
            let problem = format!("allocated bytes add up to {sum}, in run.json to {announced}");
            Err(refuse_table::<MemoryRow>(directory, problem))
        }
    }
}

/// Every temporal run of every frame has the stages of the first, but for those that follow changes alone; a device without
/// timestamps gave none at all.
fn check_timings(directory: &Path, frames: &[FrameRow], runs: u32) -> Result<()> {
    let mut stages: BTreeMap<(u32, u32), Vec<String>> = BTreeMap::new();
    each_row(directory, |line, row: TimingRow| {
        let TimingRow { run, frame, stage, .. } = row;
        if run >= runs || frames.binary_search_by_key(&frame, |row| row.frame).is_err() {
            return Err(line.refuse(format!("there is no run {run} of a frame {frame}")));
        }
        let of_place = stages.entry((run, frame)).or_default();
        if of_place.contains(&stage) {
            return Err(line.refuse(format!("stage {} comes twice", shown(&stage))));
        }
        of_place.push(stage);
        Ok(())
    })?;
    let refuse = |problem: String| Err(refuse_table::<TimingRow>(directory, problem));
    let lasting = |stages: &Vec<String>| -> Vec<String> {
        stages.iter().filter(|stage| is_everyones(stage)).cloned().collect()
    };
    let Some(first) = stages.values().next().map(lasting) else {
        return match frames.iter().any(FrameRow::is_timed) {
            true => refuse("holds no times, and frames.csv does".into()),
            false => Ok(()),
        };
    };
    if let Some(row) = frames.iter().find(|row| !row.is_timed()) {
        return refuse(format!("times frame {}, for which frames.csv has no gpu_ms_frame", row.frame));
    }
    for place in (0..runs).flat_map(|run| frames.iter().map(move |row| (run, row.frame))) {
        if stages.get(&place).map(lasting).as_ref() != Some(&first) {
            let (run, frame) = place;
            return refuse(format!("the stages of run {run}, frame {frame} are not all there"));
        }
    }
    Ok(())
}
