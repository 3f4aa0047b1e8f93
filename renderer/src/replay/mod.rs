//! The replay: every method under every lighting, counted once and timed several times.
//!
//! ```text
//! config ─> inputs (scene, recording, lights) ─> session (device) ─┬─> atemporal: counts, images  (run by run)
//!                          └─> plan (views, grids) ────────────────┴─> temporal: stage times      (a group in turn)
//! ```

pub mod bench;
mod choose;
mod count;
mod disturbed;
mod player;
mod shape;
mod stopping;
mod temporal;
mod tracer;
mod turns;

pub use count::Counted;
pub use player::{Player, device_info};
pub use shape::shape_note;
pub use turns::{Failed, Seat};

use crate::assign::Assigner;
use crate::config::Config;
use crate::engine::plan_frames;
use crate::inputs::Inputs;
use crate::machine::Conditions;
use crate::measure::{
    BuildPhase, Capacities, ClusterLists, Extremes, FrameCounts, FrameTimes, FrameTrace, GrowthEvent,
    OctreeBuild, StructureMemory, Timing, ViewPixels,
};
use crate::output::PlannedRun;
use crate::recording::Recording;
use crate::still::Look;
use crate::vk::DeviceInfo;
use crate::{Error, Result};
use image::RgbImage;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

/// Takes what runs produce, as soon as it is there.
pub trait RunSink {
    /// A run begins.
    fn begin(&mut self, run: &PlannedRun) -> Result<()>;
    /// Images of one frame of the current run, a view each.
    fn images(&mut self, frame: u32, views: &[ViewPixels]) -> Result<()>;
    /// A further look at that frame; most sinks have no use for it.
    fn look(&mut self, _frame: u32, _look: Look, _image: &RgbImage) -> Result<()> {
        Ok(())
    }
    /// Light lists of one clustering of one frame of the current run; most sinks have no use for them.
    fn lists(&mut self, _lists: ClusterLists) -> Result<()> {
        Ok(())
    }
    /// Everything of the current run is counted. What the sink needs no more may be let go.
    fn counted(&mut self, _counts: &mut [FrameCounts]) -> Result<()> {
        Ok(())
    }
    /// A temporal run of this run begins.
    fn turn(&mut self, _run: &PlannedRun) -> Result<()> {
        Ok(())
    }
    /// This run is complete.
    fn finish(&mut self, run: &PlannedRun, result: RunResult) -> Result<()>;
}

/// How far a replay is and whether it should stop: the user's side of a long run.
pub struct Watch<'a> {
    /// Set to stop after the frame at hand.
    pub interrupt: &'a AtomicBool,
    /// Called after each frame submitted.
    pub progress: &'a dyn Fn(),
}

impl Watch<'_> {
    pub(crate) fn check(&self) -> Result<()> {
        if self.interrupt.load(Ordering::Relaxed) {
            return Err(Error::Interrupted(
                "interrupted: the run at hand was left, complete runs are kept".into(),
            ));
        }
        Ok(())
    }

    pub(crate) fn step(&self) {
        (self.progress)();
    }
}

/// Everything one run measured.
pub struct RunResult {
    /// Record of each frame.
    pub counts: Vec<FrameCounts>,
    /// A record a frame and temporal run.
    pub times: Vec<FrameTimes>,
    /// When the stages of the traced frames ran.
    pub traces: Vec<FrameTrace>,
    /// How the lists were built.
    pub assigner: Assigner,
    /// What the buffers held at the end.
    pub capacities: Capacities,
    /// What each structure took on the device, and what frames needed of that.
    pub memory: Vec<StructureMemory>,
    /// Octrees that were built beside the timed frames, and when.
    pub builds: Vec<(BuildPhase, OctreeBuild)>,
    /// Frames that made them grow.
    pub growth: Vec<GrowthEvent>,
    /// The frames of its pictures, where these are the ones of least and of most depth discontinuity.
    pub extremes: Option<Extremes>,
    /// The device it ran on.
    pub device: DeviceInfo,
    /// How the machine fared in the temporal runs.
    pub conditions: Conditions,
    /// How its temporal runs were made; `None` where there are none.
    pub timing: Option<Timing>,
    /// Time when the run began.
    pub started: SystemTime,
    /// How long the run took, without what others did meanwhile.
    pub duration: Duration,
}

/// How many frames `runs` submit in all at most, for progress.
///
/// # Errors
/// A frame range outside the recording.
pub fn frame_total(config: &Config, recording: &Recording, runs: usize) -> Result<u64> {
    let frames = config.frame_numbers(recording.frame_count())?.len() as u64;
    Ok(frames * runs as u64 * (u64::from(config.most_runs()) + 1))
}

/// Goes through `runs`, in order, each by itself.
///
/// # Errors
/// Bad input ([`Error::Input`], [`Error::File`]), a device that lacks something ([`Error::Device`]), a validation
/// message ([`Error::Internal`]), an interruption ([`Error::Interrupted`]). Runs finished before are in the sink.
pub fn replay(
    config: &Config,
    inputs: &Inputs,
    runs: &[PlannedRun],
    watch: &Watch,
    sink: &mut dyn RunSink,
) -> Result<()> {
    // What can be refused without a device is refused first.
    for run in runs {
        run.check()?;
        plan_frames(&run.config, &inputs.recording)?;
    }
    let mut player = Player::new(config, inputs)?;
    for run in runs {
        player.play(run, watch, sink)?;
    }
    player.finish()
}
