//! Which way of assignment a run takes where that is left to counts.

use crate::Result;
use crate::assign::{AssignCounts, Assigner, ListStore, cheapest};
use crate::config::Config;
use crate::engine::{COUNTING_SLOT as SLOT, Engine, FramePlan, LargestGrid, Mode, Session, nothing};
use crate::gpu_interface::ClusteringState;
use crate::inputs::Inputs;
use crate::lights::LightTally;
use crate::output::PlannedRun;

/// What the run names, or else the cheapest by counts of the run's middle frame.
pub fn assigner(
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
) -> Result<Assigner> {
    if !run.method.assigns() {
        return Ok(Assigner::Brute);
    }
    if let Some(rasterising) = run.method.rasterising() {
        return Ok(rasterising);
    }
    match run.assign.fixed() {
        Some(assigner) => Ok(assigner),
        None => Ok(cheapest(&count_once(inputs, session, (run, plans))?)),
    }
}

/// Builds the lists of the run's middle frame once, by scatter, for the counts of its clusterings.
fn count_once(
    inputs: &Inputs,
    session: &mut Session,
    (run, plans): (&PlannedRun, &[FramePlan]),
) -> Result<Vec<AssignCounts>> {
    let plan = &plans[plans.len() / 2];
    let mut source = inputs.light_source(&run.lights)?;
    let input = source.at_frame(plan.frame);
    let lights = LightTally::of(input.list);
    // What is counted is the same in every store; of offsets the device tells the sum.
    let config = &Config { lists: vec![ListStore::Offsets], ..run.config.clone() };
    let counting = Mode::counting(config, lights);
    let mode = Mode { assigner: Assigner::Scatter, counting: false, ..counting };
    let largest = LargestGrid::of(std::slice::from_ref(plan));
    if Engine::check(session, config, largest, &mode).is_err() {
        // What scatter needs beside does not fit the device: nothing to count by, so brute force.
        return Ok(vec![]);
    }
    let mut engine = Engine::new(session, config, largest, mode)?;
    engine.shaded = false;
    engine.render(session, SLOT, (plan, input), (&mut nothing, &mut nothing))?;
    let counts = |state: &ClusteringState| AssignCounts {
        lights: lights.count,
        visible_clusters: state.visible_total,
        light_indices: state.index_total,
        packets: state.packets,
    };
    Ok(engine.states(session, SLOT).iter().map(counts).collect())
}
