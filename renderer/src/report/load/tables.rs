//! The CSV tables of a run.

use crate::Result;
use crate::output::{
    ClusteringRow, FRAGMENTS_PER_CLUSTER, HistogramRow, LIGHTS_PER_CLUSTER, OctreeRow, Row, TimingRow,
    each_row, saved_frames, stage_kind,
};
use crate::report::bins;
use crate::report::results::{BuiltOctree, Distribution, FrameGroups, Frames};
use std::collections::BTreeMap;
use std::path::Path;

/// Views and metrics of `frames.csv`.
pub fn read_frames(directory: &Path) -> Result<(u32, Frames)> {
    let rows = saved_frames(directory)?;
    Ok((rows.last().map_or(0, |row| row.views), Frames::of(&rows)))
}

/// The grid of the first clustering of the first frame; `None` for a method without clusters.
pub fn read_grid(directory: &Path) -> Result<Option<[u32; 3]>> {
    let mut grid = None;
    each_row(directory, |_, row: ClusteringRow| {
        grid = grid.or(Some([row.dx, row.dy, row.dz]));
        Ok(())
    })?;
    Ok(grid)
}

/// Stages of building an octree; those of the host alone follow it.
const BUILDING: &str = "frame/octree/";
/// The one of them that the device takes part in.
const UPLOAD: &str = "upload";

/// The first octree of the run, with what building one takes; `None` where there is none.
pub fn read_octree(directory: &Path) -> Result<Option<BuiltOctree>> {
    if !directory.join(OctreeRow::FILE).is_file() {
        return Ok(None);
    }
    let mut built = BuiltOctree::default();
    each_row(directory, |_, row: OctreeRow| {
        if built.tables.first().is_none_or(|first| first.frame == row.frame) {
            built.tables.push(row);
        }
        Ok(())
    })?;
    each_row(directory, |_, row: TimingRow| {
        let kind = stage_kind(&row.stage);
        let step = kind.strip_prefix(BUILDING).filter(|step| !step.starts_with(UPLOAD));
        // In frames that build none, no step takes time.
        if let Some(step) = step.filter(|_| row.cpu_ms > 0.0) {
            match built.steps.iter_mut().find(|(known, _)| known == step) {
                Some((_, least)) => *least = least.min(row.cpu_ms),
                None => built.steps.push((step.to_owned(), row.cpu_ms)),
            }
        }
        Ok(())
    })?;
    Ok(Some(built))
}

/// Groups that have lists by lights, of some frames, ascending.
pub fn read_groups(directory: &Path, frames: &[u32]) -> Result<Vec<FrameGroups>> {
    let none = |&frame: &u32| FrameGroups { frame, clusterings: vec![] };
    let mut found: Vec<FrameGroups> = frames.iter().map(none).collect();
    each_row(directory, |_, row: HistogramRow| {
        let Ok(place) = frames.binary_search(&row.frame) else { return Ok(()) };
        if row.kind == LIGHTS_PER_CLUSTER {
            let clusterings = &mut found[place].clusterings;
            let number = row.clustering as usize;
            clusterings.resize(clusterings.len().max(number + 1), vec![]);
            clusterings[number].push((row.bin, row.clusters));
        }
        Ok(())
    })?;
    Ok(found)
}

type Distributions = BTreeMap<Distribution, Vec<Vec<u64>>>;

/// Clusters by frame and by row of [`bins`], over clusterings; and the most fragments of any cluster.
pub fn read_histograms(directory: &Path, frames: &[u32]) -> Result<(Distributions, Option<u64>)> {
    let mut found = Distributions::new();
    let mut most = None;
    each_row(directory, |_, row: HistogramRow| {
        let distribution = match &*row.kind {
            LIGHTS_PER_CLUSTER => Distribution::Lights,
            FRAGMENTS_PER_CLUSTER => Distribution::Fragments,
            _ => return Ok(()),
        };
        let Ok(place) = frames.binary_search(&row.frame) else { return Ok(()) };
        let bin = u64::from(row.bin);
        if distribution == Distribution::Fragments {
            most = most.max(Some(bin));
        }
        let counts = &mut found.entry(distribution).or_insert_with(|| vec![vec![]; frames.len()])[place];
        let place = bins::row(bin);
        counts.resize(counts.len().max(place + 1), 0);
        counts[place] += row.clusters;
        Ok(())
    })?;
    Ok((found, most))
}
