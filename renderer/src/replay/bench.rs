//! Light assignment alone, timed by every way with every test in one process, in turn: what runs on the machine beside
//! it slows all alike.

mod limit;
mod scopes;

pub use limit::LIMIT;
pub use scopes::{ScopesRow, bench_scopes};

use super::Watch;
use crate::assign::Assigner;
use crate::config::{Config, FrameRange, Test};
use crate::engine::{
    COUNTING_SLOT as SLOT, Counted, Engine, FramePlan, LargestGrid, Mode, Session, nothing, plan_frames,
};
use crate::geometry::VolumeTest;
use crate::gpu_interface::ClusteringState;
use crate::inputs::Inputs;
use crate::lights::{FrameLights, Generator, LightTally, Lighting, LightsFrom};
use crate::methods::Method;
use crate::output::makes_lists;
use crate::passes::readback;
use crate::{Error, Result};
use limit::Limit;
use serde::Serialize;

/// What `bench assign` times.
#[derive(Debug, Clone)]
pub struct AssignBench {
    /// Ways of assignment, on each frame all that serve the test.
    pub assigners: Vec<Assigner>,
    /// Tests of light against cluster, each by all ways.
    pub tests: Vec<Test>,
    /// Lightings of the rain.
    pub lights: Vec<Lighting>,
    /// Frames of the recording.
    pub frames: Vec<u32>,
    /// How often each is timed; the least time counts.
    pub repeats: u32,
}

impl AssignBench {
    /// The ways that serve a test.
    fn assigners_for(&self, test: VolumeTest) -> impl Iterator<Item = Assigner> {
        self.assigners.iter().copied().filter(move |assigner| assigner.serves(test.sphere))
    }

    /// What the tests are for a method, each once.
    pub fn tests_of(&self, method: &Method) -> Vec<VolumeTest> {
        let mut tests = vec![];
        for test in self.tests.iter().map(|test| test.of(method)) {
            if !tests.contains(&test) {
                tests.push(test);
            }
        }
        tests
    }
}

/// One measured way of assignment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchRow {
    /// Number of lights.
    pub lights: u32,
    /// How many of them are spots.
    pub spots: u32,
    /// Name of the method.
    pub method: String,
    /// The way: `brute`, `hierarchy`, `scatter` or `rectangles`; or [`LIMIT`], the least that any way can do.
    pub assign: String,
    /// The test of light against cluster.
    pub test: String,
    /// Frame of the recording.
    pub frame: u32,
    /// Visible clusters of all clusterings.
    pub visible_clusters: u64,
    /// Light indices of all clusterings.
    pub light_indices: u64,
    /// Tests of a light against a cluster or a node, of all clusterings.
    pub intersection_tests: u64,
    /// Time from lights to lists: transform or culling, build, count, offsets and assign. Least of the repeats,
    /// milliseconds.
    pub gpu_ms: f64,
    /// `gpu_ms` over that of the limit for these lists.
    pub over_limit: f64,
}

/// Times `bench` by the config's methods, scene, recording, resolution and part of spots; rows come as soon as they are measured.
///
/// # Errors
/// As [`super::replay`].
pub fn bench_assign(
    config: &Config,
    inputs: &Inputs,
    bench: &AssignBench,
    watch: &Watch,
    sink: &mut dyn FnMut(BenchRow) -> Result<()>,
) -> Result<()> {
    let mut session = Session::new(config, &inputs.scene, inputs.recording.view_set())?;
    session.context.require_timestamps()?;
    for lighting in &bench.lights {
        let mut source =
            inputs.light_source(&LightsFrom::Generated(Generator::Rain, *lighting, config.spots))?;
        for &frame in &bench.frames {
            let lights = source.at_frame(frame);
            let range = FrameRange { first: frame, end: Some(frame + 1), step: 1 };
            for &method in &config.methods {
                let run = Config { frames: range, methods: vec![method], ..config.clone() };
                let plan = &plan_frames(&run, &inputs.recording)?[0];
                let timed = TimedFrame { run: &run, plan, lights, shaded: false };
                for row in timed.measure(&mut session, bench, watch)? {
                    sink(row)?;
                }
            }
        }
    }
    session.context.check_validation()
}

/// One frame of a run, timed again and again.
#[derive(Clone, Copy)]
struct TimedFrame<'a> {
    /// Has one value on every axis; benchmarks of assignment put their own tests there.
    run: &'a Config,
    plan: &'a FramePlan,
    lights: FrameLights<'a>,
    /// Whether the frame goes on to shading.
    shaded: bool,
}

/// All ways with one test, each with its engine.
struct Ways {
    /// That of the limit first.
    rows: Vec<BenchRow>,
    engines: Vec<Engine>,
    limit: Limit,
}

impl Ways {
    /// Times each once more. The limit is timed on the lists of the last way.
    fn time(&mut self, session: &mut Session, frame: &TimedFrame, watch: &Watch) -> Result<()> {
        let [limit, ways @ ..] = &mut self.rows[..] else { return Ok(()) };
        for (engine, row) in self.engines.iter_mut().zip(ways) {
            watch.check()?;
            row.gpu_ms = row.gpu_ms.min(frame.time(session, engine)?);
            watch.step();
        }
        if let Some(engine) = self.engines.last_mut() {
            limit.gpu_ms = limit.gpu_ms.min(self.limit.time(session, engine)?);
        }
        Ok(())
    }

    /// The rows, with how far each is from the limit.
    fn into_rows(self) -> Vec<BenchRow> {
        let limit_ms = self.rows[0].gpu_ms;
        let over = |row: BenchRow| BenchRow { over_limit: row.gpu_ms / limit_ms, ..row };
        self.rows.into_iter().map(over).collect()
    }
}

impl TimedFrame<'_> {
    fn measure(&self, session: &mut Session, bench: &AssignBench, watch: &Watch) -> Result<Vec<BenchRow>> {
        let tests = bench.tests_of(&self.run.methods[0]);
        let served = |test: &VolumeTest| bench.assigners_for(*test).next().is_some();
        let ways = tests.into_iter().filter(served).map(|test| self.ways(session, bench, test));
        let mut ways = ways.collect::<Result<Vec<_>>>()?;
        for _ in 0..=bench.repeats {
            // The first turn warms up, and counts as the others: it is never the least.
            ways.iter_mut().try_for_each(|ways| ways.time(session, self, watch))?;
        }
        Ok(ways.into_iter().flat_map(Ways::into_rows).collect())
    }

    /// All ways with a test, counted.
    fn ways(&self, session: &mut Session, bench: &AssignBench, test: VolumeTest) -> Result<Ways> {
        let run = &Config { test: vec![Test::Named(test)], ..self.run.clone() };
        let tested = TimedFrame { run, ..*self };
        let (mut rows, mut engines) = (vec![], vec![]);
        let assigners: Vec<Assigner> = bench.assigners_for(test).collect();
        for &assigner in &assigners {
            rows.push(tested.count(session, (assigner, test))?);
            engines.push(tested.engine(session, assigner, false)?);
        }
        let (Some(row), Some(engine)) = (rows.first(), engines.last_mut()) else {
            return Err(Error::input("assign: name at least one way, such as scatter"));
        };
        let limit_row = BenchRow { assign: LIMIT.to_owned(), intersection_tests: 0, ..row.clone() };
        rows.insert(0, limit_row);
        let last = assigners[assigners.len() - 1];
        let limit = Limit::new(session, engine, (run, &tested.mode(last, false)))?;
        Ok(Ways { rows, engines, limit })
    }

    fn mode(&self, assigner: Assigner, counting: bool) -> Mode {
        Mode { assigner, counting, ..Mode::counting(self.run, LightTally::of(self.lights.list)) }
    }

    /// An engine that has rendered the frame once.
    fn engine(&self, session: &mut Session, assigner: Assigner, counting: bool) -> Result<Engine> {
        let mode = self.mode(assigner, counting);
        let mut engine =
            Engine::new(session, self.run, LargestGrid::of(std::slice::from_ref(self.plan)), mode)?;
        engine.shaded = self.shaded;
        self.render(session, &mut engine)?;
        Ok(engine)
    }

    fn render(&self, session: &mut Session, engine: &mut Engine) -> Result<()> {
        let extend = (&mut readback::clear_counters as _, &mut nothing as _);
        engine.render(session, SLOT, (self.plan, self.lights), extend)
    }

    fn count(&self, session: &mut Session, (assigner, test): (Assigner, VolumeTest)) -> Result<BenchRow> {
        let mut engine = self.engine(session, assigner, true)?;
        let lights = self.lights.list.len() as u32;
        let states = engine.states(session, SLOT);
        let mut intersection_tests = 0;
        for (clustering, state) in states.iter().enumerate() {
            let at = (SLOT, self.plan.frame, clustering);
            let read = Counted::read(&mut engine, session, at, (*state, lights))?;
            intersection_tests += read.counters.intersection_tests;
        }
        let sum = |count: fn(&ClusteringState) -> u32| states.iter().map(|s| u64::from(count(s))).sum();
        Ok(BenchRow {
            lights,
            spots: self.lights.list.iter().filter(|light| light.spot.is_some()).count() as u32,
            method: self.run.methods[0].to_string(),
            assign: assigner.to_string(),
            test: test.to_string(),
            frame: self.plan.frame,
            visible_clusters: sum(|state| state.visible_total),
            light_indices: sum(|state| state.index_total),
            intersection_tests,
            gpu_ms: f64::INFINITY,
            over_limit: f64::NAN,
        })
    }

    fn time(&self, session: &mut Session, engine: &mut Engine) -> Result<f64> {
        self.render(session, engine)?;
        let times = session.frame_slots[SLOT].timestamps.read()?;
        Ok(times.filter(|time| makes_lists(engine.tree.path(time.scope))).map(|time| time.gpu_ms).sum())
    }
}
