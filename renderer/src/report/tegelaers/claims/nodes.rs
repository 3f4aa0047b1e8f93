//! H12 and H13: what the size of nodes does.

use super::places::{Place, in_every_scene, told};
use crate::methods::Method;
use crate::report::claim::{Findings, Outcome, number};
use crate::report::results::{ResultSet, metric};
use crate::report::tegelaers::evaluation::{Corner, Evaluation, HASHED, node};

/// A light's diameter, in radii.
const DIAMETER: f64 = 2.0;
/// What counts as no more.
const SLACK: f64 = 1.05;

/// Nodes larger than a diameter, the smallest of them, and the largest that is not.
fn around_the_diameter(evaluation: &Evaluation<'_>) -> Option<[Method; 2]> {
    let nodes = evaluation.nodes();
    let is_larger = |method: &&Method| node(**method).is_some_and(|radii| radii > 1.1 * DIAMETER);
    let larger = nodes.iter().copied().find(|method| is_larger(&method))?;
    let other =
        nodes.iter().copied().filter(|method| node(*method).is_some()).rfind(|method| !is_larger(&method))?;
    Some([larger, other])
}

/// In one scene at least: they need not.
pub(super) fn large(set: &ResultSet) -> Findings {
    let mut all = in_every_scene(set, |place, findings| {
        let pipeline = place.evaluation.counting();
        let found = around_the_diameter(place.evaluation).and_then(|methods| {
            place.means(&methods.map(|method| (method, pipeline)), metric::COMPUTATIONS, Corner::Many)
        });
        let Some((numbers, size)) = found else {
            return lack(place, "nodes of two radii or fewer and of more", findings);
        };
        let ratio = numbers[0].1 / numbers[1].1;
        let mut told = told(&numbers, "");
        told.push(number("ratio", ratio));
        let comparison =
            format!("lighting computations by nodes beyond the diameter, {}, {size}", pipeline.name());
        findings.compare_in(place.name(), comparison, told, Outcome::within(ratio, [0.0, SLACK]));
    });
    // That some scene needs more does not contradict that none must.
    if all.evidence.iter().any(|evidence| evidence.holds) {
        all.evidence.retain(|evidence| evidence.holds);
    }
    all
}

pub(super) fn small(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let pipeline = place.evaluation.counting();
        // Scenes differ in the sizes that they were measured with.
        let is_there = |method: &Method| place.scene.of(*method, pipeline).next().is_some();
        let in_radii = |method: &Method| node(*method).is_some();
        let mut nodes = place.evaluation.nodes();
        nodes.retain(|method| in_radii(method) && is_there(method));
        let ends = nodes.first().zip(nodes.last()).filter(|(smallest, largest)| smallest != largest);
        let found = ends.and_then(|(smallest, largest)| {
            let methods = [*smallest, *largest].map(|method| (method, pipeline));
            place.means(&methods, metric::FRAME, Corner::Few)
        });
        let Some((numbers, size)) = found else { return lack(place, "nodes of two sizes, timed", findings) };
        let comparison = format!("frame time by size of nodes, {}, {size}", pipeline.name());
        let outcome = Outcome::above(numbers[0].1, numbers[1].1);
        findings.compare_in(place.name(), comparison, told(&numbers, "ms"), outcome);
    })
}

fn lack(place: Place<'_>, what: &str, findings: &mut Findings) {
    findings.lack(format!("runs of {HASHED} with {what}, in {}", place.scene.name()));
}
