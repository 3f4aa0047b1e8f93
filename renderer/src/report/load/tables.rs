//! The CSV tables of a run.

use crate::Result;
use crate::output::{
    ClusteringRow, FRAGMENTS_PER_CLUSTER, HistogramRow, LIGHTS_PER_CLUSTER, OctreeBuildRow, OctreeRow, Row,
    TimingRow, each_row, saved_frames, stage_kind,
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
    // Earlier versions did not write it.
    if directory.join(OctreeBuildRow::FILE).is_file() {
        each_row(directory, |_, row: OctreeBuildRow| {
            note_step(&mut built, &row.step, row.cpu_ms);
            Ok(())
        })?;
    }
    each_row(directory, |_, row: TimingRow| {
        let kind = stage_kind(&row.stage);
        let step = kind.strip_prefix(BUILDING).filter(|step| !step.starts_with(UPLOAD));
        // In frames that build none, no step takes time.
        if let Some(step) = step.filter(|_| row.cpu_ms > 0.0) {
            note_step(&mut built, step, row.cpu_ms);
        }
        Ok(())
    })?;
    Ok(Some(built))
}

/// Keeps the least that a step took.
fn note_step(built: &mut BuiltOctree, step: &str, ms: f64) {
    match built.steps.iter_mut().find(|(known, _)| known == step) {
        Some((_, least)) => *least = least.min(ms),
        None => built.steps.push((step.to_owned(), ms)),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_first_octree_is_read_with_the_least_that_each_step_took() {
        let run = tempfile::tempdir().unwrap();
        let write = |file: &str, text: &str| fs::write(run.path().join(file), text).unwrap();
        assert_eq!(read_octree(run.path()).unwrap(), None, "most methods have none");
        write(
            OctreeRow::FILE,
            "frame,table,depth,keys,slot_side,offset_side,slot_bytes,offset_bytes,light_indices\n\
             4,structure,2,60,5,3,250,108,0\n4,data,3,300,7,5,2744,500,900\n5,structure,2,61,5,3,250,108,0\n",
        );
        write(
            "timings.csv",
            "run,frame,stage,gpu_ms,cpu_ms\n\
             0,4,frame,9.0,9.0\n0,4,frame/octree,8.0,8.0\n0,4,frame/octree/add_lights,0.0,2.5\n0,4,frame/octree/upload,1.0,0.1\n\
             0,5,frame/octree/add_lights,0.0,2.0\n1,4,frame/octree/add_lights,0.0,0.0\n1,5,frame/octree/hash_layers,0.0,4.0\n",
        );
        let octree = read_octree(run.path()).unwrap().unwrap();
        assert_eq!(octree.steps, [("add_lights".to_owned(), 2.0), ("hash_layers".to_owned(), 4.0)]);
        let told: Vec<_> =
            octree.tables.iter().map(|table| (table.frame, &*table.table, table.keys)).collect();
        assert_eq!(told, [(4, "structure", 60), (4, "data", 300)]);
        assert_eq!(
            (octree.tables[1].depth, octree.tables[1].slot_side, octree.tables[1].offset_side),
            (3, 7, 5)
        );
        assert_eq!((octree.tables[1].slot_bytes, octree.tables[1].offset_bytes), (2744, 500));
        assert_eq!(octree.tables[1].light_indices, 900);
        // Builds beside timed frames count too.
        write(
            OctreeBuildRow::FILE,
            "phase,frame,step,cpu_ms,lights,nodes\n\
             counted,4,empty_octree,0.5,20,360\ncounted,4,add_lights,1.5,20,360\nwarm-up,4,add_lights,3.0,20,360\n",
        );
        let octree = read_octree(run.path()).unwrap().unwrap();
        let steps = [("empty_octree", 0.5), ("add_lights", 1.5), ("hash_layers", 4.0)];
        assert_eq!(octree.steps, steps.map(|(step, ms)| (step.to_owned(), ms)));
        // What is no such table is refused.
        write(OctreeBuildRow::FILE, "phase,frame,step,cpu_ms,lights\ncounted,4,add_lights,1.5,20\n");
        assert!(read_octree(run.path()).unwrap_err().to_string().contains(OctreeBuildRow::FILE));
    }
}
