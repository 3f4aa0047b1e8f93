//! Temporal runs of a group in turn, its engines side by side.
//!
//! ```text
//! counted runs ─> an engine each, warmed up ─> turn: every engine once over its frames ─┬─> enough ─> each to its sink
//!                                              ^        └─> disturbed as a whole: again │
//!                                              └────────────────────────────────────────┘
//! ```
//!
//! What changes on the machine meanwhile meets all of them, and cancels in ratios that are paired turn by turn. A group of
//! one is timed as by itself.

use super::count::Counted;
use super::disturbed::{disturbed, median};
use super::stopping::{Series, Stopping};
use super::tracer::Tracer;
use super::{RunSink, Watch, temporal};
use crate::engine::{Engine, FramePlan, Session, nothing};
use crate::inputs::Inputs;
use crate::lights::LightSource;
use crate::machine::Conditions;
use crate::measure::{BuildPhase, Disturbance, FrameTimes, OctreeBuild, Precision, Timing};
use crate::output::PlannedRun;
use crate::{Error, Result};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The slot of the frame that warms up.
const WARM_UP_SLOT: usize = 0;

/// A run of a group.
pub struct Seat<'s> {
    /// The run.
    pub run: &'s PlannedRun,
    /// What counting told of it; taken once its result is in the sink.
    pub counted: &'s mut Option<Counted>,
    /// Its frames' progress.
    pub watch: &'s Watch<'s>,
    /// Where its result goes.
    pub sink: &'s mut dyn RunSink,
}

/// A group that could not go on.
pub struct Failed {
    /// At which of its runs.
    pub seat: usize,
    /// Why.
    pub error: Error,
}

/// Times the runs of a group in turn. Each goes to its sink as soon as all its temporal runs are there.
///
/// # Errors
/// What went wrong, and with which run. Those whose results are not in their sinks were not timed.
pub fn time(inputs: &Inputs, session: &mut Session, seats: Vec<Seat>) -> Result<(), Failed> {
    let Some(first) = seats.first() else { return Ok(()) };
    let stopping = Stopping::of(&first.run.config);
    if stopping.is_asked_for(0) {
        let deliver = |(number, seat): (usize, Seat)| seat.deliver_counts().map_err(Failed::at(number));
        return seats.into_iter().enumerate().try_for_each(deliver);
    }
    let mut group = Group::new(inputs, session, seats)?;
    for turns in 1.. {
        let last = stopping.is_asked_for(turns);
        group.turn(session, turns - 1, last)?;
        if last {
            break;
        }
        let reached = stopping.precisions(&group.series());
        if stopping.is_enough(turns, &reached) {
            return group.deliver(session, reached);
        }
    }
    Ok(())
}

/// Engines side by side.
struct Group<'s> {
    names: Vec<String>,
    /// For each the one it is compared with.
    bases: Vec<usize>,
    timed: Vec<Timed<'s>>,
}

impl<'s> Group<'s> {
    fn new(inputs: &Inputs, session: &mut Session, seats: Vec<Seat<'s>>) -> Result<Self, Failed> {
        let names = seats.iter().map(|seat| seat.run.name.clone()).collect();
        let bases = bases(&seats);
        let timed = (0..)
            .zip(seats)
            .map(|(number, seat)| Timed::new(inputs, session, seat).map_err(Failed::at(number)));
        Ok(Self { names, bases, timed: timed.collect::<Result<_, _>>()? })
    }

    /// Every engine once over its frames. After the last turn that was asked for, none needs to wait for the others.
    fn turn(&mut self, session: &mut Session, turn: u32, last: bool) -> Result<(), Failed> {
        for (number, timed) in self.timed.iter_mut().enumerate() {
            timed.turn(session, turn).map_err(Failed::at(number))?;
            if last {
                timed.deliver(session, &self.names, None).map_err(Failed::at(number))?;
            }
        }
        Ok(())
    }

    fn series(&self) -> Vec<Series> {
        self.timed.iter().zip(&self.bases).map(|(timed, &base)| timed.series(base)).collect()
    }

    fn deliver(&mut self, session: &Session, reached: Vec<Precision>) -> Result<(), Failed> {
        for ((number, timed), reached) in self.timed.iter_mut().enumerate().zip(reached) {
            timed.deliver(session, &self.names, Some(reached)).map_err(Failed::at(number))?;
        }
        Ok(())
    }
}

/// For each run the first under the same lights.
fn bases(seats: &[Seat]) -> Vec<usize> {
    let first = |seat: &Seat| seats.iter().position(|other| other.run.lights == seat.run.lights).unwrap_or(0);
    seats.iter().map(first).collect()
}

impl Failed {
    /// With the run of this number.
    fn at(seat: usize) -> impl FnOnce(Error) -> Self {
        move |error| Self { seat, error }
    }
}

impl Seat<'_> {
    /// Hands over what was counted, where nothing is timed.
    fn deliver_counts(self) -> Result<()> {
        match self.counted.take() {
            Some(counted) => self.sink.finish(self.run, counted.result),
            None => Ok(()),
        }
    }
}

/// A run with its engine and what was timed of it.
struct Timed<'s> {
    seat: Seat<'s>,
    plans: Arc<[FramePlan]>,
    engine: Engine,
    lights: Box<dyn LightSource>,
    /// The octree that the frame that warms up built.
    built: Option<OctreeBuild>,
    tracer: Tracer<'s>,
    /// By their numbers.
    runs: Vec<Vec<FrameTimes>>,
    disturbed: Vec<Disturbance>,
    conditions: Conditions,
    /// How long all this took.
    spent: Duration,
}

impl<'s> Timed<'s> {
    /// Makes the engine and renders one frame that warms up: a pipeline's first use is dearer than the rest on some drivers.
    fn new(inputs: &Inputs, session: &mut Session, seat: Seat<'s>) -> Result<Self> {
        let begun = Instant::now();
        let run = seat.run;
        let counted = seat.counted.as_ref().ok_or_else(not_counted)?;
        let plans = counted.plans.clone();
        let mut lights = inputs.light_source(&run.lights)?;
        let mut engine = Engine::new(session, &run.config, counted.largest(), counted.mode(false))?;
        let first = (&plans[0], lights.at_frame(plans[0].frame));
        engine.render(session, WARM_UP_SLOT, first, (&mut nothing, &mut nothing))?;
        session.context.check_validation()?;
        let built = engine.octree_build(plans[0].frame);
        let stages = session.frame_slots[WARM_UP_SLOT].timestamps.spans().len();
        let frames = plans.iter().map(|plan| plan.frame);
        Ok(Self {
            tracer: Tracer::new(&run.config.trace, frames, run.config.most_runs(), stages),
            seat,
            plans,
            built,
            engine,
            lights,
            runs: vec![],
            disturbed: vec![],
            conditions: Conditions::default(),
            spent: begun.elapsed(),
        })
    }

    /// Makes the temporal run of the next number, and once more those that were disturbed as a whole, as far as that shows now.
    fn turn(&mut self, session: &mut Session, number: u32) -> Result<()> {
        self.seat.sink.turn(self.seat.run)?;
        let watch = self.seat.watch;
        let times = self.once(session, number, watch)?;
        self.runs.push(times);
        // What is made again is no progress.
        let again = Watch { interrupt: watch.interrupt, progress: &|| {} };
        while let Some(found) = self.disturbance() {
            tracing::info!(
                "{}: temporal run {} was disturbed and is made again",
                self.seat.run.name,
                found.run
            );
            self.tracer.forget(found.run);
            self.runs[found.run as usize] = self.once(session, found.run, &again)?;
            self.disturbed.push(found);
        }
        Ok(())
    }

    fn once(&mut self, session: &mut Session, number: u32, watch: &Watch) -> Result<Vec<FrameTimes>> {
        let begun = Instant::now();
        let before = session.probe.sample();
        let keep = (number, &mut self.tracer);
        let times =
            temporal::time_run(&mut self.engine, session, &self.plans, &mut *self.lights, keep, watch)?;
        self.conditions.add(&before, &session.probe.sample());
        session.context.check_validation()?;
        self.spent += begun.elapsed();
        Ok(times)
    }

    fn disturbance(&self) -> Option<Disturbance> {
        let medians: Vec<f64> = self.runs.iter().map(|run| median(&frame_times(run))).collect();
        disturbed(&medians, |run| self.disturbed.iter().any(|earlier| earlier.run == run))
    }

    fn series(&self, base: usize) -> Series {
        let runs = self.runs.iter().map(|run| frame_times(run)).collect();
        Series { name: self.seat.run.name.clone(), base, runs }
    }

    /// Hands over what was counted and timed.
    fn deliver(&mut self, session: &Session, group: &[String], reached: Option<Precision>) -> Result<()> {
        let Counted { mut result, .. } = self.seat.counted.take().ok_or_else(not_counted)?;
        let run = self.seat.run;
        result.timing = Some(Timing {
            order: run.config.order,
            group: group.to_vec(),
            runs: self.runs.len() as u32,
            disturbed: std::mem::take(&mut self.disturbed),
            reached,
        });
        result.times = std::mem::take(&mut self.runs).concat();
        result.traces = self.tracer.finish(&self.engine.tree, &session.context.limits);
        result.capacities = self.engine.capacities();
        result.memory = self.engine.memory(&result.counts);
        result.builds.extend(self.built.map(|built| (BuildPhase::WarmUp, built)));
        result.growth.append(&mut self.engine.growth);
        result.conditions = std::mem::take(&mut self.conditions);
        result.duration += self.spent;
        self.seat.sink.finish(run, result)
    }
}

fn not_counted() -> Error {
    Error::Internal("a run is timed that was not counted".into())
}

/// GPU milliseconds of each frame of a temporal run; NaN where they are missing.
fn frame_times(run: &[FrameTimes]) -> Vec<f64> {
    // The frame as a whole comes before its stages.
    run.iter().map(|frame| frame.stages.first().map_or(f64::NAN, |stage| stage.gpu_ms)).collect()
}
