//! What measuring costs: frames with every stage timed and frames timed as a whole alone, in turn in one process.

use super::{SLOT, TimedFrame};
use crate::Result;
use crate::assign::Assigner;
use crate::config::{Config, Scopes};
use crate::engine::{Engine, Session, plan_frames};
use crate::inputs::Inputs;
use crate::output::{PlannedRun, planned_runs};
use crate::replay::{Watch, choose};
use serde::Serialize;
use std::fmt;

/// A method's cost of measuring.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScopesRow {
    /// Name of the run: the method, with the lighting behind it where there are several.
    pub run: String,
    /// Number of frames.
    pub frames: usize,
    /// GPU time of the frame with all scopes, milliseconds: median over frames of the least of the turns.
    pub all_ms: f64,
    /// GPU time of the frame with the scope of the frame alone, milliseconds: median likewise.
    pub frame_ms: f64,
    /// Median over frames of the ratio of the two.
    pub ratio: f64,
}

/// Times every run of `config` so, `config.runs` turns a frame after one that warms up.
///
/// # Errors
/// As [`crate::replay::replay`].
pub fn bench_scopes(config: &Config, inputs: &Inputs, watch: &Watch) -> Result<Vec<ScopesRow>> {
    let mut session = Session::new(config, &inputs.scene, inputs.recording.view_set())?;
    session.context.require_timestamps()?;
    let runs = planned_runs(config);
    let rows = runs.iter().map(|run| measure(inputs, &mut session, run, watch));
    let rows = rows.collect::<Result<_>>()?;
    session.context.check_validation()?;
    Ok(rows)
}

fn measure(inputs: &Inputs, session: &mut Session, run: &PlannedRun, watch: &Watch) -> Result<ScopesRow> {
    let [all, frame] = [Scopes::All, Scopes::Frame].map(|scopes| Config { scopes, ..run.config.clone() });
    let plans = plan_frames(&run.config, &inputs.recording)?;
    let assigner = choose::assigner(inputs, session, (run, &plans))?;
    let mut source = inputs.light_source(&run.lights)?;
    let mut pairs = vec![];
    for plan in &plans {
        let lights = source.at_frame(plan.frame);
        let timed = |run| TimedFrame { run, plan, lights, shaded: true };
        pairs.push(least_times([timed(&all), timed(&frame)], session, assigner, watch)?);
    }
    Ok(ScopesRow {
        run: run.name.clone(),
        frames: pairs.len(),
        all_ms: median(pairs.iter().map(|pair| pair[0])),
        frame_ms: median(pairs.iter().map(|pair| pair[1])),
        ratio: median(pairs.iter().map(|pair| pair[0] / pair[1])),
    })
}

/// The least frame time of each case, milliseconds. Who comes first changes with every turn.
fn least_times(
    cases: [TimedFrame<'_>; 2],
    session: &mut Session,
    assigner: Assigner,
    watch: &Watch,
) -> Result<[f64; 2]> {
    let turns = cases[0].run.most_runs();
    let mut engines = vec![];
    for case in &cases {
        engines.push(case.engine(session, assigner, false)?);
    }
    let mut least = [f64::INFINITY; 2];
    for turn in 0..=turns {
        watch.check()?;
        for place in [turn as usize % 2, (turn as usize + 1) % 2] {
            let time = frame_time(&cases[place], session, &mut engines[place])?;
            if turn > 0 {
                least[place] = least[place].min(time);
            }
        }
        watch.step();
    }
    Ok(least)
}

/// Milliseconds of the outermost scope, which is the frame.
fn frame_time(case: &TimedFrame<'_>, session: &mut Session, engine: &mut Engine) -> Result<f64> {
    case.render(session, engine)?;
    let frame = session.frame_slots[SLOT].timestamps.read()?.next();
    Ok(frame.map_or(f64::NAN, |time| time.gpu_ms))
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 }
}

impl fmt::Display for ScopesRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { run, frames, all_ms, frame_ms, ratio } = self;
        let cost = 100.0 * (ratio - 1.0);
        write!(
            f,
            "{run:24} {all_ms:10.3} ms with all scopes, {frame_ms:10.3} ms with one: {cost:+.2} % (median of {frames})"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_one_or_between_the_two() {
        assert_eq!(median([3.0, 1.0, 2.0].into_iter()), 2.0);
        assert_eq!(median([4.0, 1.0, 2.0, 3.0].into_iter()), 2.5);
    }
}
