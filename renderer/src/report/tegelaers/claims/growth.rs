//! H10: how times and computations grow with lights and pixels.

use super::places::{Place, in_every_scene};
use crate::report::claim::{Findings, Outcome, mean, number};
use crate::report::results::{ResultSet, metric};
use crate::report::tegelaers::evaluation::{Case, Pipeline, name};
use crate::report::tegelaers::ratios::Who;
use crate::stats;
use std::collections::BTreeSet;

/// How far numbers may lie off their line, in parts of their mean.
const OFF: f64 = 0.1;
/// Through fewer points a line says nothing.
const FEWEST: usize = 3;
const COMPARED: [Who; 4] = [Who::Naive, Who::Tiled, Who::Clustered, Who::Hashed(0.5)];

/// A number of a case.
type Coordinate = fn(&Case<'_>) -> u64;

/// What it grows with: its name, its number, and what stays.
const OVER: [(&str, Coordinate, Coordinate); 2] = [
    ("lights", |case| case.lights.into(), |case| case.pixels),
    ("pixels", |case| case.pixels, |case| case.lights.into()),
];

pub(super) fn linear(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let counting = place.evaluation.counting();
        for who in COMPARED {
            for (over, of, fixed) in OVER {
                for pipeline in Pipeline::BOTH {
                    let found = line(place, (who, pipeline), (over, of, fixed), findings);
                    if found.is_none() && pipeline == counting {
                        findings.lack(format!(
                            "temporal runs of {}, {}, with three numbers of {over} or more in {}",
                            who.pattern(),
                            pipeline.name(),
                            place.scene.name()
                        ));
                    }
                }
            }
        }
    })
}

/// `None` where there are too few points.
fn line(
    place: Place<'_>,
    (who, pipeline): (Who, Pipeline),
    (over, of, fixed): (&str, Coordinate, Coordinate),
    findings: &mut Findings,
) -> Option<()> {
    let method = who.method(place.evaluation)?;
    let cases = || place.scene.of(method, pipeline);
    let stays: BTreeSet<u64> = cases().map(fixed).collect();
    let stays = stays.into_iter().max_by_key(|&at| cases().filter(|case| fixed(case) == at).count())?;
    for (what, metric) in [("frame time", metric::FRAME), ("lighting computations", metric::COMPUTATIONS)] {
        let point = |case: &Case<'_>| Some((of(case) as f64, mean(case.run, metric)?));
        let points: Vec<(f64, f64)> = cases().filter(|case| fixed(case) == stays).filter_map(point).collect();
        let part = off_the_line(&points)?;
        let comparison = format!("{what} over {over}, {}, {}", name(method), pipeline.name());
        let numbers =
            vec![number("off the line, part of the mean", part), number("points", points.len() as f64)];
        findings.compare_in(place.name(), comparison, numbers, Outcome::within(part, [0.0, OFF]));
    }
    Some(())
}

/// Root mean square distance of points from their least-squares line, over the mean.
fn off_the_line(points: &[(f64, f64)]) -> Option<f64> {
    let slope = stats::slope(points).filter(|_| points.len() >= FEWEST)?;
    let [x, y] =
        [stats::mean(points.iter().map(|point| point.0))?, stats::mean(points.iter().map(|point| point.1))?];
    let square = |point: &(f64, f64)| (point.1 - y - slope * (point.0 - x)).powi(2);
    Some(stats::mean(points.iter().map(square))?.sqrt() / y)
}
