//! E1 and E9: measured bounds against implicit ones.

use super::compared::{Compared, Of, Place, frame_time, in_every_scene, relative};
use crate::report::claim::{Findings, Outcome};
use crate::report::enhuber::evaluation::name;
use crate::report::results::{ResultSet, Run};

const TILES: [&str; 2] = ["t-i", "t-e"];
const DENSE: [&str; 2] = ["dc-i", "dc-e"];
const SPARSE: [&str; 2] = ["sc-i", "sc-e"];

pub(super) fn faster(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for pair in [TILES, DENSE, SPARSE] {
            compare(place, pair, ("frame time", "ms", frame_time), findings);
        }
    })
}

pub(super) fn steadier(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for pair in [TILES, SPARSE] {
            compare(place, pair, ("relative deviation", "", relative), findings);
        }
    })
}

/// What of a run is compared: its name, unit and value.
type Quantity = (&'static str, &'static str, fn(&Run) -> Option<f64>);

fn compare(place: Place<'_>, pair: [&str; 2], (what, unit, of): Quantity, findings: &mut Findings) {
    let Some((numbers, lights)) = place.under_many(&pair, of, findings) else { return };
    let [implicit, measured] =
        [0, 1].map(|side: usize| numbers.get(side).map_or(f64::NAN, |of: &Of| of.value));
    let names: Vec<String> = numbers.iter().map(|of| name(of.method)).collect();
    let comparison = format!("{what}, {}, {lights}", names.join(" and "));
    let outcome = Outcome::above(implicit, measured);
    findings.compare_in(place.name(), comparison, Compared::new(numbers, unit).told(), outcome);
}
