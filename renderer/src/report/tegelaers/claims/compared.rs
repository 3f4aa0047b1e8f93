//! H1, H2, H3, H7 and H8: what one method needs over what another does.

use super::places::{Place, in_every_scene, relative, spread, told};
use crate::methods::Method;
use crate::report::claim::{Findings, Outcome, number};
use crate::report::results::{ResultSet, metric};
use crate::report::tegelaers::evaluation::{Corner, Pipeline, TILED, name};
use crate::report::tegelaers::ratios::{
    CLUSTERED_COMPUTATIONS, DEFERRED_TIME, FEW_COMPUTATIONS, FORWARD_TIME, HASHED_COMPUTATIONS,
    NAIVE_COMPUTATIONS, QUARTER_COMPUTATIONS, Who,
};

/// Numbers that differ by less hardly do.
const HARDLY: f64 = 1.25;

pub(super) fn half_of_tiled(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| place.judge(&HASHED_COMPUTATIONS, [0.4, 0.6], findings))
}

pub(super) fn times(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        place.judge(&FORWARD_TIME, [1.5, 2.5], findings);
        place.judge(&DEFERRED_TIME, [1.0 / HARDLY, HARDLY], findings);
    })
}

pub(super) fn close_to_clustered(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| place.judge(&QUARTER_COMPUTATIONS, [0.0, 1.2], findings))
}

pub(super) fn tiled(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        place.judge(&NAIVE_COMPUTATIONS, [2.5, 5.0], findings);
        place.judge(&FEW_COMPUTATIONS, [1.25, 2.5], findings);
        tile_sizes(place, findings);
    })
}

/// Whether tiles of all sizes need about as many computations.
fn tile_sizes(place: Place<'_>, findings: &mut Findings) {
    let pipeline = place.evaluation.counting();
    let tiles = place.evaluation.methods(TILED).into_iter();
    let methods: Vec<(Method, Pipeline)> = tiles.map(|method| (method, pipeline)).collect();
    match place.means(&methods, metric::COMPUTATIONS, Corner::Many) {
        Some((numbers, size)) if numbers.len() > 1 => {
            let spread = spread(&numbers);
            let mut told = told(&numbers, "");
            told.push(number("most over least", spread));
            let comparison = format!("lighting computations by size of tiles, {}, {size}", pipeline.name());
            findings.compare_in(place.name(), comparison, told, Outcome::within(spread, [0.0, HARDLY]));
        }
        _ => findings.lack(format!("runs of {TILED} in two sizes at least, in {}", place.scene.name())),
    }
}

pub(super) fn clustered(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        place.judge(&CLUSTERED_COMPUTATIONS, [0.4, 0.65], findings);
        steadier(place, findings);
    })
}

/// Whether clusters' computations vary less over the frames than those of tiles.
fn steadier(place: Place<'_>, findings: &mut Findings) {
    let pipeline = place.evaluation.counting();
    let found = || {
        let methods = [Who::Clustered.method(place.evaluation)?, Who::Tiled.method(place.evaluation)?];
        let cases = place.scene.both(methods.map(|method| (method, pipeline)), Corner::Many)?;
        let [clustered, tiled] = cases.map(|case| relative(case.run, metric::COMPUTATIONS));
        Some((methods, [clustered?, tiled?], cases[0].size()))
    };
    // What is missing is said where computations are compared.
    let Some((methods, [clustered, tiled], size)) = found() else { return };
    let [of, to] = methods.map(name);
    let numbers = vec![number(of.clone(), clustered), number(to.clone(), tiled)];
    let comparison =
        format!("relative deviation of lighting computations, {of} and {to}, {}, {size}", pipeline.name());
    findings.compare_in(place.name(), comparison, numbers, Outcome::above(tiled, clustered));
}
