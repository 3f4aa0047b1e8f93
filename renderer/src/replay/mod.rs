//! The replay: every method under every lighting, counted once and timed several times.
//!
//! ```text
//! config ─> inputs (scene, recording, lights) ─> session (device) ─┬─> atemporal: counts, images
//!                          └─> plan (views, grids) ────────────────┴─> temporal: stage times
//! ```

pub mod bench;
mod choose;
mod player;
mod shape;
mod temporal;
mod tracer;

pub use player::{Player, device_info};
pub use shape::shape_note;

use crate::assign::Assigner;
use crate::config::Config;
use crate::engine::{Engine, FramePlan, LargestGrid, Mode, Session, count_frame, nothing, plan_frames};
use crate::inputs::Inputs;
use crate::machine::Conditions;
use crate::measure::{
    Capacities, ClusterLists, FrameCounts, FrameTimes, FrameTrace, GrowthEvent, ViewPixels,
};
use crate::output::PlannedRun;
use crate::recording::Recording;
use crate::vk::DeviceInfo;
use crate::{Error, Result, still};
use image::RgbImage;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};
use tracer::Tracer;

/// The slot of the frame that warms up.
const WARM_UP_SLOT: usize = 0;

/// Takes what runs produce, as soon as it is there.
pub trait RunSink {
    /// A run begins.
    fn begin(&mut self, run: &PlannedRun) -> Result<()>;
    /// Images of one frame of the current run, a view each.
    fn images(&mut self, frame: u32, views: &[ViewPixels]) -> Result<()>;
    /// The clusters of that frame seen from above; most sinks have no use for them.
    fn birdseye(&mut self, _frame: u32, _image: &RgbImage) -> Result<()> {
        Ok(())
    }
    /// Light lists of one clustering of one frame of the current run; most sinks have no use for them.
    fn lists(&mut self, _lists: ClusterLists) -> Result<()> {
        Ok(())
    }
    /// The current run is complete.
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
    /// Frames that made them grow.
    pub growth: Vec<GrowthEvent>,
    /// The device it ran on.
    pub device: DeviceInfo,
    /// How the machine fared in the temporal runs.
    pub conditions: Conditions,
    /// Time when the run began.
    pub started: SystemTime,
    /// How long the run took.
    pub duration: Duration,
}

/// How many frames `runs` submit in all, for progress.
///
/// # Errors
/// A frame range outside the recording.
pub fn frame_total(config: &Config, recording: &Recording, runs: usize) -> Result<u64> {
    let frames = config.frame_numbers(recording.frame_count())?.len() as u64;
    Ok(frames * runs as u64 * (u64::from(config.runs) + 1))
}

/// Goes through `runs`, in order.
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

fn replay_run(
    inputs: &Inputs,
    session: &mut Session,
    run: &PlannedRun,
    (watch, sink): (&Watch, &mut dyn RunSink),
) -> Result<RunResult> {
    let started = SystemTime::now();
    let plans = plan_frames(&run.config, &inputs.recording)?;
    let mut result = RunResult {
        counts: Vec::with_capacity(plans.len()),
        times: vec![],
        traces: vec![],
        assigner: choose::assigner(inputs, session, (run, &plans))?,
        capacities: run.config.capacities(),
        growth: vec![],
        device: session.context.info.clone(),
        conditions: Conditions::default(),
        started,
        duration: Duration::ZERO,
    };
    count(inputs, session, (run, &plans), (watch, sink), &mut result)?;
    if inputs.light_count(&run.lights)? > 0
        && result.counts.iter().all(|frame| frame.counters.needed_computations == 0)
    {
        tracing::warn!("{}: no light reaches anything that is seen, in any frame", run.name);
    }
    if run.config.runs > 0 {
        time(inputs, session, (run, &plans), watch, &mut result)?;
    }
    result.duration = started.elapsed().unwrap_or_default();
    Ok(result)
}

/// An engine for a run as far as `result` knows what that takes.
fn engine(
    session: &mut Session,
    run: &PlannedRun,
    plans: &[FramePlan],
    (lights, counting): (u32, bool),
    result: &RunResult,
) -> Result<Engine> {
    let mode = Mode { lights, capacities: result.capacities, assigner: result.assigner, counting };
    Engine::new(session, &run.config, LargestGrid::of(plans), mode)
}

/// The atemporal run: it comes first, so that buffers have grown before anything is timed.
fn count(
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
    (watch, sink): (&Watch, &mut dyn RunSink),
    result: &mut RunResult,
) -> Result<()> {
    let mut lights = inputs.light_source(&run.lights)?;
    let names: Vec<String> = inputs.recording.view_names().into_iter().map(str::to_owned).collect();
    let mut engine = engine(session, run, plans, (inputs.light_count(&run.lights)?, true), result)?;
    for plan in plans {
        watch.check()?;
        let view_names = run.config.exr.contains(plan.frame).then_some(names.as_slice());
        let about = (inputs.recording.time(plan.frame), view_names);
        let input = (plan, lights.at_frame(plan.frame));
        let frame = count_frame(&mut engine, session, input, about, &mut |lists| sink.lists(lists))?;
        result.counts.push(frame.counts);
        if view_names.is_some() {
            sink.images(plan.frame, &frame.pixels)?;
            if run.method.has_lists() {
                sink.birdseye(plan.frame, &still::birdseye(inputs, session, (run, plan))?)?;
            }
        }
        watch.step();
    }
    result.capacities = engine.capacities();
    result.growth.append(&mut engine.growth);
    Ok(())
}

/// The temporal runs, after one frame that warms up: a pipeline's first use is dearer than the rest on some drivers.
fn time(
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
    watch: &Watch,
    result: &mut RunResult,
) -> Result<()> {
    let mut lights = inputs.light_source(&run.lights)?;
    let mut engine = engine(session, run, plans, (inputs.light_count(&run.lights)?, false), result)?;
    let first = (&plans[0], lights.at_frame(plans[0].frame));
    engine.render(session, WARM_UP_SLOT, first, (&mut nothing, &mut nothing))?;
    let frames = plans.iter().map(|plan| plan.frame);
    let mut tracer = Tracer::new(&run.config.trace, frames, run.config.runs, engine.tree.paths().len());
    for number in 0..run.config.runs {
        let keep = (number, &mut tracer);
        let before = session.probe.sample();
        let times = temporal::time_run(&mut engine, session, plans, &mut *lights, keep, watch)?;
        result.conditions.add(&before, &session.probe.sample());
        result.times.extend(times);
    }
    result.traces = tracer.finish(&engine.tree, &session.context.limits);
    result.capacities = engine.capacities();
    result.growth.append(&mut engine.growth);
    Ok(())
}
