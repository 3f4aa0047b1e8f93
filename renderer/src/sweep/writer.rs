//! Writes the runs of one part as they come.

use super::Part;
use crate::assign::{ListStore, NODES_PER_CLUSTER};
use crate::audience::Audience;
use crate::config::Assign;
use crate::inputs::Inputs;
use crate::machine::{Host, Machine, Roots, doubts};
use crate::measure::{FrameCounts, Timing, ViewPixels};
use crate::output::{
    DeviceInfo, Manifest, PlannedRun, RUN_FORMAT, RunWriter, Source, git_revision, rfc3339_utc,
};
use crate::replay::{RunResult, RunSink};
use crate::still::Look;
use crate::{Error, Result};
use image::RgbImage;

/// One run's files. An error of the sink's own (a full disk, say) is not the run's: `broken` tells them apart.
pub(super) struct Files<'a> {
    pub part: &'a Part,
    pub inputs: &'a Inputs,
    pub audience: &'a dyn Audience,
    pub fingerprint: String,
    pub writer: Option<RunWriter>,
    pub broken: bool,
    /// Whether the run is where it belongs.
    pub finished: bool,
    /// How it was timed.
    pub timing: Option<Timing>,
}

/// The device as manifests have it.
pub(super) fn device(device: &crate::vk::DeviceInfo) -> DeviceInfo {
    DeviceInfo {
        name: device.name.clone(),
        driver: format!("{} {}", device.driver, device.driver_version),
        api: device.api_version.clone(),
    }
}

impl<'a> Files<'a> {
    /// Those of a run that is not begun.
    pub fn new(
        (part, inputs): (&'a Part, &'a Inputs),
        fingerprint: String,
        audience: &'a dyn Audience,
    ) -> Self {
        let (broken, finished) = (false, false);
        Self { part, inputs, audience, fingerprint, writer: None, broken, finished, timing: None }
    }
}

impl Files<'_> {
    fn noted<T>(&mut self, result: Result<T>) -> Result<T> {
        self.broken |= result.is_err();
        result
    }

    fn lights_file(&self) -> Option<Source> {
        let path = self.part.config.lights_file.as_ref()?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Some(Source { name, sha256: self.inputs.lights_sha256.clone()? })
    }

    fn manifest(&self, run: &PlannedRun, result: &RunResult) -> Result<Manifest> {
        let Inputs { scene, recording, .. } = self.inputs;
        let machine = Machine { host: Host::read(&Roots::default()), device: result.device.hardware.clone() };
        Ok(Manifest {
            format: RUN_FORMAT.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            git_revision: git_revision().into(),
            fingerprint: self.fingerprint.clone(),
            method: run.method.to_string(),
            lighting: run.lights.lighting(),
            config: run.config.clone(),
            assigned_by: result.assigner.to_string(),
            scene: Source { name: scene.name.clone(), sha256: scene.sha256.clone() },
            recording: Source { name: recording.name().to_owned(), sha256: recording.sha256().to_owned() },
            extent: Some(self.inputs.extent()),
            lights_file: self.lights_file(),
            generated: self.inputs.generated(&run.lights)?,
            frame_count: Some(result.counts.len()),
            device: device(&result.device),
            doubts: doubts(&machine, &result.conditions),
            machine,
            timing: result.timing.clone(),
            conditions: result.conditions.clone(),
            capacities: result.capacities,
            memory_bytes: Some(result.memory.iter().map(|structure| structure.allocated).sum()),
            growth: result.growth.clone(),
            discontinuity: result.extremes,
            started: rfc3339_utc(result.started),
            duration_s: result.duration.as_secs_f64(),
        })
    }
}

impl RunSink for Files<'_> {
    fn begin(&mut self, run: &PlannedRun) -> Result<()> {
        self.audience.say(&self.part.full_name(run));
        let writer = RunWriter::create(&self.part.config.out, &run.name);
        self.writer = Some(self.noted(writer)?);
        Ok(())
    }

    fn images(&mut self, frame: u32, views: &[ViewPixels]) -> Result<()> {
        let writer = self.writer.as_ref().ok_or_else(not_begun)?;
        let written = writer.write_images(frame, views, self.part.config.exr_layout);
        self.noted(written)
    }

    fn look(&mut self, frame: u32, look: Look, image: &RgbImage) -> Result<()> {
        let writer = self.writer.as_ref().ok_or_else(not_begun)?;
        let written = writer.write_look(frame, look.name(), image);
        self.noted(written)
    }

    fn counted(&mut self, counts: &mut [FrameCounts]) -> Result<()> {
        let writer = self.writer.as_ref().ok_or_else(not_begun)?;
        let written = writer.write_counted(counts);
        self.noted(written)?;
        // Many runs may wait for being timed.
        counts.iter_mut().for_each(FrameCounts::keep_sums);
        Ok(())
    }

    fn turn(&mut self, run: &PlannedRun) -> Result<()> {
        self.audience.say(&self.part.full_name(run));
        Ok(())
    }

    fn finish(&mut self, run: &PlannedRun, result: RunResult) -> Result<()> {
        let manifest = self.manifest(run, &result)?;
        let writer = self.writer.take().ok_or_else(not_begun)?;
        if !result.traces.is_empty() {
            self.noted(writer.write_trace(&result.traces))?;
        }
        if run.assign == Assign::Auto {
            self.audience.note(&format!("{}: lights assigned by {}", run.name, result.assigner));
        }
        notes_of_lists(run, &result).for_each(|note| self.audience.note(&note));
        self.noted(writer.write_memory(&result.memory))?;
        self.noted(writer.write_builds(&result.builds))?;
        let finished = writer.finish(&manifest, &result.counts, &result.times);
        self.noted(finished)?;
        self.timing = result.timing;
        self.finished = true;
        Ok(())
    }
}

/// What is good to know of lists that had to grow, or were too full for their lights.
fn notes_of_lists(run: &PlannedRun, result: &RunResult) -> impl Iterator<Item = String> {
    let name = &run.name;
    let (lists, entries) = (run.config.lists[0], result.capacities.list_entries);
    let bound = lists.bound();
    let grown = match lists {
        ListStore::Linked(_) => (entries > NODES_PER_CLUSTER)
            .then(|| format!("{name}: the pool of {NODES_PER_CLUSTER} nodes a cluster was too small and has {entries} since")),
        ListStore::Offsets | ListStore::Fixed(_) | ListStore::Capped(_) => (entries > bound)
            .then(|| format!("{name}: lists of {bound} entries each were too short and have {entries} since")),
    };
    let dropped: u64 = result.counts.iter().map(|frame| frame.counters.lights_dropped).sum();
    let lossy = (dropped > 0).then(|| {
        format!(
            "warning: {name}: lists with room for {bound} lights dropped {dropped} in {} frames, and pictures lack their light",
            result.counts.len()
        )
    });
    grown.into_iter().chain(lossy)
}

fn not_begun() -> Error {
    Error::Internal("a run was not begun".into())
}
