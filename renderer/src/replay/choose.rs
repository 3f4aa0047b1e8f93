//! Which way of assignment a run takes where that is left to counts.

use super::engine::{Engine, Mode};
use super::plan::FramePlan;
use super::session::Session;
use super::{Inputs, temporal};
use crate::Result;
use crate::assign::{AssignCounts, Assigner};
use crate::config::Config;
use crate::measure::Capacities;
use crate::methods::MethodSpec;
use crate::output::PlannedRun;

/// What the run names, or else the cheapest by counts of the run's middle frame.
pub fn assigner(
    config: &Config,
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
) -> Result<Assigner> {
    if run.method == MethodSpec::AllLights {
        return Ok(Assigner::Brute);
    }
    match run.assign.fixed() {
        Some(assigner) => Ok(assigner),
        None => Ok(count_once(config, inputs, session, (run, plans))?.cheapest()),
    }
}

/// Renders the run's middle frame once, by the way that is never far off, for its counts.
fn count_once(
    config: &Config,
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
) -> Result<AssignCounts> {
    let plan = &plans[plans.len() / 2];
    let mut source = inputs.light_source(&run.lights)?;
    let lights = source.at_frame(plan.frame).len() as u32;
    let capacities = Capacities {
        visible_clusters: config.visible_cluster_capacity,
        light_indices: config.light_index_capacity,
    };
    let test = run.test.of(&run.method);
    let mode = Mode { lights, capacities, assigner: Assigner::Hierarchy, test, counting: false };
    let mut engine = Engine::new(session, config, run.method, std::slice::from_ref(plan), mode)?;
    temporal::warm_up(&mut engine, session, plan, &mut source)?;
    let states = engine.states(session, 0);
    Ok(AssignCounts {
        lights: u64::from(lights) * states.len() as u64,
        visible_clusters: states.iter().map(|s| u64::from(s.visible_total)).sum(),
        light_indices: states.iter().map(|s| u64::from(s.index_total)).sum(),
        clusters: plan.grids.iter().map(|grid| grid.cluster_count()).sum(),
    })
}
