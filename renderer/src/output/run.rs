//! Run directories: which runs a configuration asks for, what they are called, how they are written.

use super::atomic::{StagedDirectory, write_whole};
use super::image_exr::write_exr;
use super::manifest::{MANIFEST, Manifest};
use super::preview::{write_png, write_previews};
use super::rows::Row;
use super::stages::StageMinima;
use super::summary::Summary;
use super::tables;
use super::trace;
use crate::config::{Assign, Case, Config, Lighting, LightsFrom, Test};
use crate::measure::{FrameCounts, FrameTimes, FrameTrace, ViewPixels};
use crate::methods::MethodSpec;
use crate::{Error, Result};
use image::RgbImage;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// One run: a method under one lighting, by one way of assignment with one test.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// How lights are found.
    pub method: MethodSpec,
    /// Where lights come from.
    pub lights: LightsFrom,
    /// How the light lists are built.
    pub assign: Assign,
    /// What decides who is on them: named, but for methods without clusters.
    pub test: Test,
    /// Name of the lighting, for tables: its count, with its other fields where counts are equal.
    pub lighting: String,
    /// Name of the run directory: the method, and behind it the lighting, the way of assignment and the test, each
    /// where there are several.
    pub name: String,
}

impl PlannedRun {
    /// Where it stands in the product of the axes.
    pub fn case(&self) -> Case {
        Case { lights: self.lights.clone(), method: self.method, assign: self.assign, test: self.test }
    }

    /// Refuses a test that cannot serve the method.
    ///
    /// # Errors
    /// Names both.
    pub fn check(&self) -> Result<()> {
        self.case().check().map_err(Error::Input)
    }
}

/// The runs a configuration asks for, in the order of [`Config::cases`].
pub fn planned_runs(config: &Config) -> Vec<PlannedRun> {
    let sources = config.lights_from();
    let planned = |case: Case| {
        let lighting = lighting_name(&case.lights, &sources);
        let name = run_name(config, &case, (sources.len() > 1).then_some(&lighting));
        let Case { lights, method, assign, test } = case;
        PlannedRun { method, lights, assign, test, lighting, name }
    };
    config.cases().into_iter().map(planned).collect()
}

fn run_name(config: &Config, case: &Case, lighting: Option<&String>) -> String {
    let clustered = case.method != MethodSpec::AllLights;
    let assign = (clustered && config.assign.len() > 1).then(|| case.assign.to_string());
    let test = (clustered && config.test.len() > 1).then(|| case.test.to_string());
    let parts = [Some(case.method.to_string()), lighting.cloned(), assign, test];
    parts.into_iter().flatten().collect::<Vec<_>>().join("_")
}

/// What tells a lighting from the others.
fn lighting_name(lights: &LightsFrom, all: &[LightsFrom]) -> String {
    let count = |lights: &LightsFrom| match lights {
        LightsFrom::Rain(lighting) => Some(lighting.count),
        LightsFrom::File(_) | LightsFrom::Scene => None,
    };
    match lights {
        LightsFrom::Rain(Lighting { count: n, intensity, cutoff, r0 })
            if all.iter().filter(|other| count(other) == Some(*n)).count() > 1 =>
        {
            format!("{n}-{intensity}-{cutoff}-{r0}")
        }
        _ => lights.to_string(),
    }
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

    /// Writes a frame's `frames/NNNNNN.exr` and its previews. `most_lights` is the upper end of the heat map, the
    /// frame's own most where `None`.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write_images(&self, frame: u32, views: &[ViewPixels], most_lights: Option<u32>) -> Result<()> {
        let (directory, stem) = (self.staged.path().join("frames"), format!("{frame:06}"));
        write_exr(&directory.join(format!("{stem}.exr")), views)
            .and_then(|()| write_previews(&directory, &stem, views, most_lights))
            .map_err(|error| self.staged.told(error))
    }

    /// Writes a frame's `frames/NNNNNN_birdseye.png`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_birdseye(&self, frame: u32, image: &RgbImage) -> Result<()> {
        write_png(&self.staged.path().join("frames").join(format!("{frame:06}_birdseye.png")), image)
            .map_err(|error| self.staged.told(error))
    }

    /// Writes `trace.json`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_trace(&self, frames: &[FrameTrace]) -> Result<()> {
        self.write("trace.json", |file| trace::write_trace(file, frames))
    }

    /// Writes the tables and the manifest, and puts the directory in its place, over an older run's.
    ///
    /// # Errors
    /// A file cannot be written; nothing is left of the new directory then.
    pub fn finish(self, manifest: &Manifest, counts: &[FrameCounts], times: &[FrameTimes]) -> Result<()> {
        let minima = StageMinima::from_times(times);
        self.write_table(tables::frames(counts, &minima))?;
        self.write_table(tables::timings(times))?;
        self.write_table(tables::clusterings(counts))?;
        self.write_table(tables::histograms(counts))?;
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
