//! The atemporal run: it comes first, so that buffers have grown before anything is timed.

use super::{RunResult, RunSink, Watch, choose};
use crate::assign::Assigner;
use crate::engine::{Engine, FramePlan, LargestGrid, Mode, Session, count_frame, plan_frames};
use crate::inputs::Inputs;
use crate::machine::Conditions;
use crate::output::PlannedRun;
use crate::{Result, still};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

/// A run that is ready to be timed: counted, or at least planned.
pub struct Counted {
    /// Its frames.
    pub(super) plans: Arc<[FramePlan]>,
    /// Most lights of all frames.
    pub(super) lights: u32,
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
    if counted.lights > 0 && counts.iter().all(|frame| frame.counters.needed_computations == 0) {
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
        growth: vec![],
        device: session.context.info.clone(),
        conditions: Conditions::default(),
        timing: None,
        started,
        duration: Duration::ZERO,
    };
    Ok(Counted { plans: plans.into(), lights: inputs.light_count(&run.lights)?, result })
}

fn count_frames(
    inputs: &Inputs,
    session: &mut Session,
    run: &PlannedRun,
    (watch, sink): (&Watch, &mut dyn RunSink),
    counted: &mut Counted,
) -> Result<()> {
    let mut lights = inputs.light_source(&run.lights)?;
    let names: Vec<String> = inputs.recording.view_names().into_iter().map(str::to_owned).collect();
    let mut engine = Engine::new(session, &run.config, counted.largest(), counted.mode(true))?;
    let Counted { plans, result, .. } = counted;
    for plan in plans.iter() {
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
