//! Run directories: which runs a configuration asks for, what they are called, how they are written.

use super::atomic::{StagedDirectory, write_whole};
use super::image_exr::write_exr;
use super::manifest::{MANIFEST, Manifest};
use super::preview::{write_png, write_previews};
use super::rows::{MemoryRow, OctreeBuildRow, Row};
use super::stages::StageMinima;
use super::summary::Summary;
use super::{tables, trace};
use crate::config::{Assign, Config, ExrLayout, Labels, Test, run_name};
use crate::lights::LightsFrom;
use crate::measure::{
    BuildPhase, FrameCounts, FrameTimes, FrameTrace, OctreeBuild, StructureMemory, ViewPixels,
};
use crate::methods::Method;
use crate::{Error, Result};
use image::RgbImage;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// One run: a method under one lighting, by one way of assignment with one test.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// How lights are found.
    pub method: Method,
    /// Where lights come from.
    pub lights: LightsFrom,
    /// How the light lists are built.
    pub assign: Assign,
    /// What decides who is on them: named, but for methods without clusters.
    pub test: Test,
    /// The configuration that asks for it and no other.
    pub config: Config,
    /// What it is called in tables.
    pub labels: Labels,
    /// Name of the run directory: see [`run_name`].
    pub name: String,
}

impl PlannedRun {
    /// Refuses what cannot go together: see [`Config::check_case`].
    ///
    /// # Errors
    /// Names both.
    pub fn check(&self) -> Result<()> {
        self.config.check_case().map_err(Error::Input)
    }
}

/// The runs a configuration asks for of its one scene, in the order of [`Config::cases`].
pub fn planned_runs(config: &Config) -> Vec<PlannedRun> {
    let planned = |run: Config| PlannedRun {
        method: run.methods[0],
        lights: run.lights_of_run(),
        assign: run.assign[0],
        test: run.test[0],
        labels: Labels::new(&run, config),
        name: run_name(&run, config),
        config: run,
    };
    config.cases().into_iter().map(planned).collect()
}

/// Writes `OUT/summary.csv`.
///
/// # Errors
/// The file cannot be written.
pub fn write_summary(out: &Path, summary: &Summary) -> Result<()> {
    write_whole(&out.join("summary.csv"), |file| summary.write_csv(file))
}

/// Writes one run directory. Nothing is seen under its name before [`Self::finish`]; dropped before that, it leaves
/// nothing, and an earlier result stays as it was.
#[derive(Debug)]
pub struct RunWriter {
    staged: StagedDirectory,
}

impl RunWriter {
    /// Begins `OUT/<name>`.
    ///
    /// # Errors
    /// The output directory cannot be written, or what stands at the name is not an earlier run.
    pub fn create(out: &Path, name: &str) -> Result<Self> {
        Ok(Self { staged: StagedDirectory::create(&out.join(name), MANIFEST)? })
    }

    /// Writes a frame's `frames/NNNNNN.exr` and its previews.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write_images(&self, frame: u32, views: &[ViewPixels], layout: ExrLayout) -> Result<()> {
        let (directory, stem) = (self.staged.path().join("frames"), format!("{frame:06}"));
        write_exr(&directory.join(format!("{stem}.exr")), views, layout)
            .and_then(|()| write_previews(&directory, &stem, views))
            .map_err(|error| self.staged.told(error))
    }

    /// Writes a further picture of a frame, `frames/NNNNNN_<name>.png`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_look(&self, frame: u32, name: &str, image: &RgbImage) -> Result<()> {
        write_png(&self.staged.path().join("frames").join(format!("{frame:06}_{name}.png")), image)
            .map_err(|error| self.staged.told(error))
    }

    /// Writes `trace.json`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_trace(&self, frames: &[FrameTrace]) -> Result<()> {
        self.write("trace.json", |file| trace::write_trace(file, frames))
    }

    /// Writes `memory.csv`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_memory(&self, memory: &[StructureMemory]) -> Result<()> {
        self.write_table(memory.iter().map(MemoryRow::new))
    }

    /// Writes `octree_builds.csv`, unless there is nothing to write: most methods have no octree.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_builds(&self, builds: &[(BuildPhase, OctreeBuild)]) -> Result<()> {
        match builds.is_empty() {
            true => Ok(()),
            false => {
                self.write_table(builds.iter().flat_map(|(phase, build)| OctreeBuildRow::of(*phase, build)))
            }
        }
    }

    /// Writes the tables that hold counts alone. What they need of `counts` and [`Self::finish`] does not, the records of
    /// clusters, the bins of fragments and the tables of octrees, may be let go then.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write_counted(&self, counts: &[FrameCounts]) -> Result<()> {
        self.write_table(tables::clusterings(counts))?;
        self.write_table(tables::histograms(counts))?;
        match counts.iter().any(|frame| frame.octree_rebuilds() > 0) {
            true => self.write_table(tables::octrees(counts)),
            // Most methods have no octree.
            false => Ok(()),
        }
    }

    /// After [`Self::write_counted`] and [`Self::write_memory`], writes the tables with times and the manifest, and puts the directory in its place, over an older run's.
    ///
    /// # Errors
    /// A file cannot be written; nothing is left of the new directory then.
    pub fn finish(self, manifest: &Manifest, counts: &[FrameCounts], times: &[FrameTimes]) -> Result<()> {
        let minima = StageMinima::from_times(times);
        self.write_table(tables::frames(counts, &minima))?;
        self.write_table(tables::timings(times))?;
        let manifest = serde_json::to_string_pretty(manifest)
            .map_err(|error| Error::Internal(format!("the manifest is not JSON: {error}")))?;
        self.write(MANIFEST, |file| writeln!(file, "{manifest}"))?;
        self.staged.commit()
    }

    fn write_table<R: Row>(&self, rows: impl Iterator<Item = R>) -> Result<()> {
        self.write(R::FILE, |file| tables::write(file, rows))
    }

    fn write(&self, name: &str, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<()> {
        write_whole(&self.staged.path().join(name), write).map_err(|error| self.staged.told(error))
    }
}
