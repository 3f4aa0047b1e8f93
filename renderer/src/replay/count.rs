//! The atemporal run: it comes first, so that buffers have grown before anything is timed.

use super::{RunResult, RunSink, Watch, choose};
use crate::Result;
use crate::assign::Assigner;
use crate::config::ExrFrames;
use crate::engine::{Engine, FramePlan, LargestGrid, Mode, Session, count_frame, plan_frames};
use crate::inputs::Inputs;
use crate::lights::{LightSource, LightTally};
use crate::machine::Conditions;
use crate::measure::{BuildPhase, Extremes, FrameCounts, ViewPixels};
use crate::output::PlannedRun;
use crate::still::{self, Look};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

/// A run that is ready to be timed: counted, or at least planned.
pub struct Counted {
    /// Its frames.
    pub(super) plans: Arc<[FramePlan]>,
    /// Most lights of all frames, and whether some have cones.
    pub(super) lights: LightTally,
    /// What is known so far.
    pub(super) result: RunResult,
}

impl Counted {
    /// What an engine for it is made for: buffers as large as counting made them.
    pub(super) fn mode(&self, counting: bool) -> Mode {
        let RunResult { capacities, assigner, .. } = self.result;
        Mode { lights: self.lights, capacities, assigner, counting }
    }

    /// How its lists are built.
    pub fn assigner(&self) -> Assigner {
        self.result.assigner
    }

    /// The frames that were found for its pictures, where counting finds them.
    pub fn extremes(&self) -> Option<Extremes> {
        self.result.extremes
    }

    /// The largest grid of its frames.
    pub(super) fn largest(&self) -> LargestGrid {
        LargestGrid::of(&self.plans)
    }
}

/// Counts every frame of a run. The sink gets pictures and lists, then the records.
///
/// # Errors
/// As [`super::replay`].
pub fn count(
    inputs: &Inputs,
    session: &mut Session,
    run: &PlannedRun,
    (watch, sink): (&Watch, &mut dyn RunSink),
) -> Result<Counted> {
    let begun = Instant::now();
    let mut counted = prepare(inputs, session, run)?;
    count_frames(inputs, session, run, (watch, sink), &mut counted)?;
    let RunResult { counts, .. } = &mut counted.result;
    if counted.lights.count > 0 && counts.iter().all(|frame| frame.counters.needed_computations == 0) {
        tracing::warn!("{}: no light reaches anything that is seen, in any frame", run.name);
    }
    sink.counted(counts)?;
    counted.result.duration = begun.elapsed();
    Ok(counted)
}

/// What is known of a run before a frame of it is rendered.
///
/// # Errors
/// As [`super::replay`].
pub fn prepare(inputs: &Inputs, session: &mut Session, run: &PlannedRun) -> Result<Counted> {
    let started = SystemTime::now();
    let plans = plan_frames(&run.config, &inputs.recording)?;
    let result = RunResult {
        counts: Vec::with_capacity(plans.len()),
        times: vec![],
        traces: vec![],
        assigner: choose::assigner(inputs, session, (run, &plans))?,
        capacities: run.config.capacities(),
        memory: vec![],
        builds: vec![],
        growth: vec![],
        extremes: None,
        device: session.context.info.clone(),
        conditions: Conditions::default(),
        timing: None,
        started,
        duration: Duration::ZERO,
    };
    Ok(Counted { plans: plans.into(), lights: inputs.light_tally(&run.lights)?, result })
}

fn count_frames(
    inputs: &Inputs,
    session: &mut Session,
    run: &PlannedRun,
    (watch, sink): (&Watch, &mut dyn RunSink),
    counted: &mut Counted,
) -> Result<()> {
    let engine = Engine::new(session, &run.config, counted.largest(), counted.mode(true))?;
    let mut counting =
        Counting { inputs, session, run, engine, lights: inputs.light_source(&run.lights)?, sink };
    let Counted { plans, result, .. } = counted;
    for plan in plans.iter() {
        watch.check()?;
        result.counts.push(counting.frame(plan)?);
        let built = counting.engine.octree_build(plan.frame);
        result.builds.extend(built.map(|built| (BuildPhase::Counted, built)));
        watch.step();
    }
    if run.config.exr == ExrFrames::Discontinuity {
        result.extremes = Extremes::of(&result.counts);
    }
    let extremes = result.extremes;
    let found = |frame| extremes.is_some_and(|extremes| extremes.contains(frame));
    for plan in plans.iter().filter(|plan| found(plan.frame)) {
        watch.check()?;
        counting.picture(plan)?;
    }
    result.capacities = counting.engine.capacities();
    result.memory = counting.engine.memory(&result.counts);
    result.growth.append(&mut counting.engine.growth);
    Ok(())
}

/// A run that is being counted.
struct Counting<'a> {
    inputs: &'a Inputs,
    session: &'a mut Session,
    run: &'a PlannedRun,
    engine: Engine,
    lights: Box<dyn LightSource>,
    sink: &'a mut dyn RunSink,
}

impl Counting<'_> {
    /// Counts a frame; the sink gets its lists, and its pictures where the run names it for them.
    fn frame(&mut self, plan: &FramePlan) -> Result<FrameCounts> {
        let pictured = self.run.config.exr.contains(plan.frame);
        let names = pictured.then(|| self.view_names());
        let about = (self.inputs.recording.time(plan.frame), names.as_deref());
        let (input, sink) = ((plan, self.lights.at_frame(plan.frame)), &mut *self.sink);
        let frame =
            count_frame(&mut self.engine, self.session, input, about, &mut |lists| sink.lists(lists))?;
        if pictured {
            self.deliver(plan, &frame.pixels)?;
        }
        Ok(frame.counts)
    }

    /// Renders a frame that is counted already, for its pictures alone.
    fn picture(&mut self, plan: &FramePlan) -> Result<()> {
        let names = self.view_names();
        let about = (self.inputs.recording.time(plan.frame), Some(names.as_slice()));
        let input = (plan, self.lights.at_frame(plan.frame));
        let frame = count_frame(&mut self.engine, self.session, input, about, &mut |_| Ok(()))?;
        self.deliver(plan, &frame.pixels)
    }

    fn deliver(&mut self, plan: &FramePlan, pixels: &[ViewPixels]) -> Result<()> {
        self.sink.images(plan.frame, pixels)?;
        for look in Look::of(self.run) {
            let image = still::look(self.inputs, self.session, (self.run, plan), look)?;
            self.sink.look(plan.frame, look, &image)?;
        }
        Ok(())
    }

    fn view_names(&self) -> Vec<String> {
        self.inputs.recording.view_names().into_iter().map(str::to_owned).collect()
    }
}
