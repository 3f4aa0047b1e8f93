//! E2, E3, E7 and E12: lines over the number of lights.

use super::compared::{Compared, Line, Of, Place, in_every_scene};
use crate::report::analysis::Part;
use crate::report::claim::{Findings, Number, Outcome, milliseconds, number};
use crate::report::enhuber::evaluation::{SEVEN, name};
use crate::report::results::ResultSet;

/// How far times may lie off their line, in parts of their mean.
const OFF: f64 = 0.05;
const SPARSE: [&str; 2] = ["sc-i", "sc-e"];

pub(super) fn linear(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for kind in SEVEN {
            let Some(lines) = place.lines(&[kind], Part::All, findings) else { continue };
            for (method, line) in lines {
                let part = line.off / line.mean;
                let numbers = vec![milliseconds("off the line", line.off), number("part of the mean", part)];
                let comparison = format!("frame time over lights, {}", name(method));
                findings.compare_in(place.name(), comparison, numbers, Outcome::within(part, [0.0, OFF]));
            }
        }
    })
}

pub(super) fn sparse(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for part in [Part::Shading, Part::All] {
            ranked(place, part, SLOPE, findings, |slopes| slopes.lowest(&SPARSE));
        }
        ranked(place, Part::Assignment, OFFSET, findings, |offsets| offsets.highest(&SPARSE));
    })
}

pub(super) fn models(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        ranked(place, Part::Assignment, SLOPE, findings, |slopes| slopes.lowest(&["m"]));
        ranked(place, Part::Shading, SLOPE, findings, |slopes| slopes.highest(&["m"]));
    })
}

pub(super) fn shading(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for kind in SEVEN {
            let parts = [Part::Shading, Part::Assignment].map(|part| place.lines(&[kind], part, findings));
            let [Some(shading), Some(assignment)] = parts else { continue };
            for ((method, shading), (_, assignment)) in shading.into_iter().zip(assignment) {
                let slope = |name: &str, line: Line| Number {
                    name: name.into(),
                    value: line.slope,
                    unit: "µs a light",
                };
                let numbers = vec![slope("shading", shading), slope("assignment", assignment)];
                let outcome = Outcome::above(shading.slope, assignment.slope);
                findings.compare_in(place.name(), format!("slopes, {}", name(method)), numbers, outcome);
            }
        }
    })
}

/// What of a line is compared: its name, unit and value.
type Quantity = (&'static str, &'static str, fn(&Line) -> f64);

const SLOPE: Quantity = ("slope", "µs a light", |line| line.slope);
const OFFSET: Quantity = ("offset", "ms", |line| line.offset);

/// Compares the seven methods by a number of their lines.
fn ranked(
    place: Place<'_>,
    part: Part,
    (what, unit, of): Quantity,
    findings: &mut Findings,
    outcome: impl Fn(&Compared) -> Outcome,
) {
    let Some(lines) = place.lines(&SEVEN, part, findings) else { return };
    let numbers = lines.iter().map(|(method, line)| Of { method: *method, value: of(line) }).collect();
    let compared = Compared::new(numbers, unit);
    let outcome = outcome(&compared);
    findings.compare_in(place.name(), format!("{what} of {}", part.name()), compared.told(), outcome);
}
