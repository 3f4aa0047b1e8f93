//! `manylight replay`.

use super::{Console, Interrupt, Progress};
use crate::config::{Config, Layer, LightsFrom};
use crate::measure::{FrameCounts, FrameTimes, ViewPixels};
use crate::output::{
    DeviceInfo, Manifest, MethodRun, PlannedRun, RUN_FORMAT, RunWriter, Source, Summary, git_revision,
    planned_runs, prepare_output, rfc3339_utc, write_summary,
};
use crate::replay::{Inputs, RunResult, RunSink, Watch, frame_total, replay};
use crate::report::write_report;
use crate::{Error, Result};
use std::path::PathBuf;

/// Arguments of `replay`: a configuration file, and every field of it as a flag.
#[derive(Debug, clap::Args)]
#[command(args_override_self = true)]
pub struct Args {
    /// JSON configuration over the built-in defaults; flags go over it.
    #[arg(long, value_name = "FILE.json")]
    config: Option<PathBuf>,

    /// Afterwards write a report on everything in the output directory, as `manylight report` does.
    #[arg(long)]
    report: bool,

    #[command(flatten)]
    layer: Layer,
}

/// Replays, writes every run as soon as it is complete, and prints the closing table.
pub fn run(args: Args, console: &Console) -> Result<()> {
    let config = Config::resolve(args.config.as_deref(), args.layer)?;
    let interrupt = Interrupt::install()?;
    let inputs = Inputs::load(&config)?;
    let runs = planned_runs(&config);
    let progress = console.progress(frame_total(&config, &inputs, runs.len())?);
    prepare_output(&config.out)?;
    let mut files =
        Files { config: &config, inputs: &inputs, progress: &progress, writer: None, done: vec![] };
    let watch = Watch { interrupt: interrupt.flag(), progress: &|| progress.advance() };
    let outcome = replay(&config, &inputs, &runs, &watch, &mut files);
    let done = std::mem::take(&mut files.done);
    drop(files);
    drop(progress);
    if done.is_empty() {
        return outcome;
    }
    let summary = summary(&done);
    write_summary(&config.out, &summary)?;
    outcome.map_err(|error| with_progress(error, done.len(), runs.len()))?;
    console.result(&summary)?;
    console.note(&format!("results are in {}", config.out.display()));
    if args.report {
        let report = write_report(std::slice::from_ref(&config.out), None)?;
        console.note(&format!("the report is {}", report.page.display()));
    }
    Ok(())
}

/// An interruption that says what was kept.
fn with_progress(error: Error, done: usize, all: usize) -> Error {
    match error {
        Error::Interrupted(message) => Error::Interrupted(format!("{message} ({done} of {all})")),
        other => other,
    }
}

fn summary(done: &[Done]) -> Summary {
    let runs: Vec<MethodRun> = done
        .iter()
        .map(|done| MethodRun {
            method: done.run.method,
            lighting: &done.run.lighting,
            counts: &done.counts,
            times: &done.times,
        })
        .collect();
    Summary::from_runs(&runs)
}

/// A run that is on disk, with what the closing table needs of it.
struct Done {
    run: PlannedRun,
    counts: Vec<FrameCounts>,
    times: Vec<FrameTimes>,
}

/// Writes runs to files as they come.
struct Files<'a> {
    config: &'a Config,
    inputs: &'a Inputs,
    progress: &'a Progress,
    writer: Option<RunWriter>,
    done: Vec<Done>,
}

impl Files<'_> {
    fn writer(&self) -> Result<&RunWriter> {
        self.writer.as_ref().ok_or_else(|| Error::Internal("a run was not begun".into()))
    }

    fn manifest(&self, run: &PlannedRun, result: &RunResult) -> Manifest {
        let Inputs { scene, recording, .. } = self.inputs;
        let device = &result.device;
        Manifest {
            format: RUN_FORMAT,
            version: env!("CARGO_PKG_VERSION"),
            git_revision: git_revision(),
            method: run.method.to_string(),
            lighting: match run.lights {
                LightsFrom::Rain(lighting) => Some(lighting),
                LightsFrom::File(_) | LightsFrom::Scene => None,
            },
            config: self.config.clone(),
            scene: Source { name: scene.name.clone(), sha256: scene.sha256.clone() },
            recording: Source { name: recording.name().to_owned(), sha256: recording.sha256().to_owned() },
            device: DeviceInfo {
                name: device.name.clone(),
                driver: format!("{} {}", device.driver, device.driver_version),
                api: device.api_version.clone(),
            },
            capacities: result.capacities,
            growth: result.growth.clone(),
            started: rfc3339_utc(result.started),
            duration_s: result.duration.as_secs_f64(),
        }
    }
}

impl RunSink for Files<'_> {
    fn begin(&mut self, run: &PlannedRun) -> Result<()> {
        self.progress.say(&run.name);
        self.writer = Some(RunWriter::create(&self.config.out, &run.name)?);
        Ok(())
    }

    fn images(&mut self, frame: u32, views: &[ViewPixels]) -> Result<()> {
        self.writer()?.write_images(frame, views, None)
    }

    fn finish(&mut self, run: &PlannedRun, mut result: RunResult) -> Result<()> {
        let manifest = self.manifest(run, &result);
        let writer = self.writer.take().ok_or_else(|| Error::Internal("a run was not begun".into()))?;
        writer.finish(&manifest, &result.counts, &result.times)?;
        // The table needs the totals alone.
        for clustering in result.counts.iter_mut().flat_map(|counts| &mut counts.clusterings) {
            clustering.clusters = vec![];
        }
        self.done.push(Done { run: run.clone(), counts: result.counts, times: result.times });
        Ok(())
    }
}
