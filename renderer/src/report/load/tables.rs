//! The CSV tables of a run.

use crate::Result;
use crate::output::{CLUSTERINGS, FRAMES, HISTOGRAMS, each_row};
use crate::report::bins;
use crate::report::results::{Distribution, Frames};
use std::collections::BTreeMap;
use std::path::Path;

/// Columns of `frames.csv` that are no metrics.
const NO_METRICS: [&str; 3] = ["frame", "time_s", "views"];

/// Views and metrics of `frames.csv`.
pub fn read_frames(path: &Path) -> Result<(u32, Frames)> {
    let columns = FRAMES.iter().filter(|name| !NO_METRICS.contains(name));
    let mut metrics: Vec<_> = columns.map(|name| ((*name).to_owned(), vec![])).collect();
    let (mut numbers, mut views) = (vec![], 0);
    each_row(path, &FRAMES, |row| {
        numbers.push(row.whole("frame")?);
        views = row.whole("views")?;
        metrics.iter_mut().try_for_each(|(name, cells)| row.optional(name).map(|cell| cells.push(cell)))
    })?;
    Ok((views, Frames { numbers, metrics }))
}

/// The grid of the first clustering of the first frame; `None` for a method without clusters.
pub fn read_grid(path: &Path) -> Result<Option<[u32; 3]>> {
    let mut grid = None;
    each_row(path, &CLUSTERINGS, |row| {
        if grid.is_none() {
            grid = Some([row.whole("dx")?, row.whole("dy")?, row.whole("dz")?]);
        }
        Ok(())
    })?;
    Ok(grid)
}

type Distributions = BTreeMap<Distribution, Vec<Vec<u64>>>;

/// Clusters by frame and by row of [`bins`], over clusterings; and the most fragments of any cluster.
pub fn read_histograms(path: &Path, frames: &[u32]) -> Result<(Distributions, Option<u64>)> {
    let mut found = Distributions::new();
    let mut most = None;
    each_row(path, &HISTOGRAMS, |row| {
        let distribution = match row.text("kind") {
            "lights_per_cluster" => Distribution::Lights,
            "fragments_per_cluster" => Distribution::Fragments,
            _ => return Ok(()),
        };
        let Ok(place) = frames.binary_search(&row.whole("frame")?) else { return Ok(()) };
        let bin: u64 = row.whole("bin")?;
        if distribution == Distribution::Fragments {
            most = most.max(Some(bin));
        }
        let counts = &mut found.entry(distribution).or_insert_with(|| vec![vec![]; frames.len()])[place];
        let place = bins::row(bin);
        counts.resize(counts.len().max(place + 1), 0);
        counts[place] += row.whole::<u64>("clusters")?;
        Ok(())
    })?;
    Ok((found, most))
}
