//! Which way of assignment a run takes where that is left to counts.

use super::temporal;
use crate::Result;
use crate::assign::{AssignCounts, Assigner, cheapest};
use crate::config::Config;
use crate::engine::{Engine, FramePlan, Mode, Session};
use crate::gpu_interface::ClusteringState;
use crate::inputs::Inputs;
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
        None => Ok(cheapest(&count_once(config, inputs, session, (run, plans))?)),
    }
}

/// Builds the lists of the run's middle frame once, by scatter, for the counts of its clusterings.
fn count_once(
    config: &Config,
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
) -> Result<Vec<AssignCounts>> {
    let plan = &plans[plans.len() / 2];
    let mut source = inputs.light_source(&run.lights)?;
    let lights = source.at_frame(plan.frame).len() as u32;
    let capacities = Capacities {
        visible_clusters: config.visible_cluster_capacity,
        light_indices: config.light_index_capacity,
    };
    let test = run.test.of(&run.method);
    let mode = Mode { lights, capacities, assigner: Assigner::Scatter, test, counting: false };
    let plan_alone = std::slice::from_ref(plan);
    if Engine::check(session, config, run.method, plan_alone, &mode).is_err() {
        // What scatter needs beside does not fit the device: nothing to count by, so brute force.
        return Ok(vec![]);
    }
    let mut engine = Engine::new(session, config, run.method, plan_alone, mode)?;
    engine.shaded = false;
    temporal::warm_up(&mut engine, session, plan, &mut source)?;
    let counts = |state: &ClusteringState| AssignCounts {
        lights,
        visible_clusters: state.visible_total,
        light_indices: state.index_total,
        tiles: state.tiles,
    };
    Ok(engine.states(session, 0).iter().map(counts).collect())
}
