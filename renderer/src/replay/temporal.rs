//! Temporal runs: nothing is counted, every stage is timed, and a frame's times are read only once it has ended,
//! while the next one runs.

use super::Watch;
use super::tracer::Tracer;
use crate::Result;
use crate::clustering::FRAME_SLOTS;
use crate::engine::{Engine, FramePlan, Session, nothing};
use crate::lights::LightSource;
use crate::measure::{FrameTimes, StageTime};
use crate::pass::ScopeTime;

/// How long every stage of every frame took, in rendering order.
#[derive(Default)]
struct Samples {
    /// Each frame, and where its times end.
    frames: Vec<(u32, usize)>,
    times: Vec<ScopeTime>,
}

/// Renders all frames once and times them; the tracer keeps what it wants of them.
pub fn time_run(
    engine: &mut Engine,
    session: &mut Session,
    plans: &[FramePlan],
    lights: &mut dyn LightSource,
    (run, tracer): (u32, &mut Tracer),
    watch: &Watch,
) -> Result<Vec<FrameTimes>> {
    let mut samples = Samples::default();
    let mut in_flight: [Option<usize>; FRAME_SLOTS] = [None; FRAME_SLOTS];
    let mut next = 0;
    while next < plans.len() || in_flight.iter().any(Option::is_some) {
        let slot = next % FRAME_SLOTS;
        if let Some(ended) = in_flight[slot].take()
            && collect(engine, session, (slot, &plans[ended]), &mut samples, (run, tracer))?
        {
            // The frame did not fit: whatever follows it is rendered again too.
            abandon(session, &mut in_flight)?;
            next = ended;
            continue;
        }
        if next >= plans.len() {
            // Nothing is left to submit: the oldest slot was read, now the other.
            next += 1;
            continue;
        }
        watch.check()?;
        let plan = &plans[next];
        let input = (plan, lights.at_frame(plan.frame));
        engine.submit(session, slot, input, (&mut nothing, &mut nothing))?;
        in_flight[slot] = Some(next);
        next += 1;
        watch.step();
    }
    Ok(samples.into_frames(engine, run))
}

/// Waits for the frame in `slot` and keeps its times; true where it did not fit and must be rendered again.
fn collect(
    engine: &mut Engine,
    session: &mut Session,
    (slot, plan): (usize, &FramePlan),
    samples: &mut Samples,
    (run, tracer): (u32, &mut Tracer),
) -> Result<bool> {
    session.frame_slots[slot].wait()?;
    if engine.overflowed(session, slot) {
        return engine.grow_if_needed(session, slot, plan.frame);
    }
    samples.times.extend(session.frame_slots[slot].timestamps.read()?);
    samples.frames.push((plan.frame, samples.times.len()));
    tracer.keep(run, plan.frame, session.frame_slots[slot].timestamps.spans());
    Ok(false)
}

fn abandon(session: &Session, in_flight: &mut [Option<usize>; FRAME_SLOTS]) -> Result<()> {
    for (slot, frame) in in_flight.iter_mut().enumerate() {
        if frame.take().is_some() {
            session.frame_slots[slot].wait()?;
        }
    }
    Ok(())
}

impl Samples {
    fn into_frames(self, engine: &Engine, run: u32) -> Vec<FrameTimes> {
        let stage = |time: &ScopeTime| StageTime {
            stage: engine.tree.path(time.scope).to_owned(),
            gpu_ms: time.gpu_ms,
            cpu_ms: time.cpu_ms,
        };
        let mut begin = 0;
        let of_frame = |&(frame, end): &(u32, usize)| {
            let times = &self.times[begin..end];
            begin = end;
            // Stages that got no timestamps were not timed.
            let timed = times.iter().filter(|time| !time.gpu_ms.is_nan());
            FrameTimes { run, frame, stages: timed.map(stage).collect() }
        };
        self.frames.iter().map(of_frame).collect()
    }
}
