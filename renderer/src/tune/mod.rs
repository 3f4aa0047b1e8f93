//! Which sizes, ways of assignment and tests make methods fastest: searched by successive halving.
//!
//! ```text
//! config ─> a search a scene, lighting and method ─> winners ─┬─> timed with the named methods, in turn ─> table
//!             candidates (sizes x ways x tests)               └─> configuration that replays them alone
//!             └─> rungs ─> the last few ─> decision
//! ```
//!
//! The sizes of the thesis were judged by eye from curves (Gelderen section 6.2). They depend on the scene, the lights, the
//! resolution, the device, and on how dear clusters are: with fast assignment smaller ones win.

mod halving;
mod ladder;
mod search;
mod table;
mod timer;
mod written;

pub use table::{Row, Tuning};

use crate::audience::Audience;
use crate::config::{Assign, Config, Runs, Test};
use crate::geometry::SphereTest;
use crate::inputs::Inputs;
use crate::output::PlannedRun;
use crate::stats::Samples;
use crate::sweep::{Part, parts};
use crate::{Error, Result, recording};
use search::{Found, Problem};
use std::sync::atomic::AtomicBool;
use timer::{Effort, Timer};

/// The defaults of a search: those of a replay, but with every way of assignment, tests of three costs, and as many
/// temporal runs as it takes, up to fewer than a replay makes: a search times dozens of candidates.
pub fn defaults() -> Config {
    Config {
        assign: vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter, Assign::Rectangles],
        test: vec![
            Test::Auto,
            Test::from(SphereTest::Exact),
            Test::from(SphereTest::HALF_SPACES_AND_NEAREST),
        ],
        runs: Runs::Auto,
        max_runs: 20,
        ..Config::default()
    }
}

/// Searches for every method of `config` under every lighting of every scene. What is found comes with the configuration
/// that replays it.
///
/// # Errors
/// Bad input, a device that lacks something, a method that cannot be played as named, a validation message, an
/// interruption: nothing is found then.
pub fn tune(config: &Config, interrupt: &AtomicBool, audience: &dyn Audience) -> Result<(Tuning, Config)> {
    check(config)?;
    let named = Config { assign: vec![Assign::Auto], test: vec![Test::Auto], ..config.clone() };
    let (mut rows, mut chosen) = (vec![], vec![]);
    for part in parts(&named)? {
        let (mut of_part, mut runs) = tune_part(config, &part, interrupt, audience)?;
        rows.append(&mut of_part);
        chosen.append(&mut runs);
    }
    Ok((Tuning { rows }, written::configuration(config, &chosen)))
}

/// Refuses what times nothing, or what no rule of the configuration that is written could tell apart.
fn check(config: &Config) -> Result<()> {
    if config.runs.is_none() {
        return Err(Error::input("runs: nothing is timed in 0 runs: give --runs auto, or 1 or more"));
    }
    if config.shading.len() > 1 {
        return Err(Error::input(
            "shading: sizes are searched for one way of shading: tune one after the other",
        ));
    }
    if config.pipeline.len() > 1 {
        return Err(Error::input("pipeline: sizes are searched for one pipeline: tune one after the other"));
    }
    let counts: Vec<u32> = config.lights.iter().map(|lighting| lighting.count).collect();
    match counts.iter().enumerate().find(|(place, count)| counts[..*place].contains(count)) {
        Some((_, count)) => Err(Error::Input(format!(
            "lights: two lightings of {count} lights cannot be told apart in the configuration that is written: tune one \
             after the other"
        ))),
        None => Ok(()),
    }
}

/// Searches in one scene.
fn tune_part(
    config: &Config,
    part: &Part,
    interrupt: &AtomicBool,
    audience: &dyn Audience,
) -> Result<(Vec<Row>, Vec<Config>)> {
    // Ways and tests that are tried, and rules, are those of the whole.
    let Config { assign, test, exclude, .. } = config.clone();
    let scene = Config { assign, test, exclude, ..part.config.clone() };
    let recording = recording::load(&scene.recording)?;
    let frames = scene.frame_numbers(recording.frame_count())?;
    let inputs = Inputs::load_with(&scene, recording, None)?;
    inputs.notes(&scene.methods).for_each(|note| audience.note(&note));
    // Whatever is asked for, times decide.
    let opened = Config { runs: Runs::Auto, ..scene.clone() };
    let mut timer = Timer::new((&opened, &inputs), (interrupt, audience))?;
    let (mut rows, mut chosen) = (vec![], vec![]);
    for runs in part.runs.chunk_by(|a, b| a.lights == b.lights) {
        let mut found: Vec<Found> = vec![];
        for run in methods(runs) {
            audience.say(&format!("{} {}", run.method, run.lights));
            let problem = Problem { config: &scene, of: &run.config, frames: &frames };
            let of_run = problem.solve(&mut timer)?;
            audience.note(&format!("{} {}: {of_run}", run.method, run.lights));
            found.push(of_run);
        }
        audience.say(&format!("the winners, {}", runs[0].lights));
        let effort = Effort::whole(&scene, &frames);
        for (found, times) in compared(&mut timer, found, &effort)? {
            rows.push(Row::new(&found, &times, frames.len()).of_scene(&part.directory));
            chosen.push(found.best.config);
        }
    }
    timer.finish()?;
    Ok((rows, chosen))
}

/// One run of each method.
fn methods(runs: &[PlannedRun]) -> Vec<&PlannedRun> {
    let is_first = |place: usize| runs[..place].iter().all(|other| other.method != runs[place].method);
    (0..runs.len()).filter(|&place| is_first(place)).map(|place| &runs[place]).collect()
}

/// What was found with the times of what was named and of what is best, all in turn where they fit side by side, and else
/// each pair by itself. Where the method as named comes out faster after all, it is the best.
fn compared(
    timer: &mut Timer,
    found: Vec<Found>,
    effort: &Effort,
) -> Result<Vec<(Found, Vec<Option<Samples>>)>> {
    let all: Vec<&PlannedRun> = found.iter().flat_map(Found::compared).collect();
    let together = timer.fit(&all, effort)?;
    let mut times = vec![];
    for found in found.chunks(if together { found.len() } else { 1 }) {
        let all: Vec<&PlannedRun> = found.iter().flat_map(Found::compared).collect();
        times.extend(timer.time(&all, effort)?);
    }
    let mut times = times.into_iter();
    let pair = |found: Found| {
        let pair: Vec<_> = times.by_ref().take(found.compared().len()).collect();
        found.settled(pair)
    };
    Ok(found.into_iter().map(pair).collect())
}
