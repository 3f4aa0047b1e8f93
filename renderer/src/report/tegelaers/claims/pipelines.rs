//! H9: the deferred pipeline against the forward one.

use super::places::{Place, in_every_scene, relative};
use crate::report::claim::{Findings, Outcome, mean, milliseconds, number};
use crate::report::results::{ResultSet, metric};
use crate::report::tegelaers::evaluation::{Corner, Pipeline, name};
use crate::report::tegelaers::ratios::Who;

/// What the thesis runs in both.
const COMPARED: [Who; 3] = [Who::Naive, Who::Tiled, Who::Hashed(0.5)];

pub(super) fn deferred(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for who in COMPARED {
            let found = compare(place, who, findings);
            if found.is_none() {
                findings.lack(format!(
                    "temporal runs of {} in both pipelines in {}",
                    who.pattern(),
                    place.scene.name()
                ));
            }
        }
    })
}

/// `None` where there is nothing to compare.
fn compare(place: Place<'_>, who: Who, findings: &mut Findings) -> Option<()> {
    let method = who.method(place.evaluation)?;
    let cases = place.scene.both(Pipeline::BOTH.map(|pipeline| (method, pipeline)), Corner::Many)?;
    let times = cases.map(|case| mean(case.run, metric::FRAME));
    let deviations = cases.map(|case| relative(case.run, metric::FRAME));
    let ([Some(forward), Some(deferred)], [Some(swaying), Some(steady)]) = (times, deviations) else {
        return None;
    };
    let where_ = format!("{}, {}", name(method), cases[0].size());
    let numbers = vec![milliseconds("forward", forward), milliseconds("deferred", deferred)];
    let comparison = format!("frame time, {where_}");
    findings.compare_in(place.name(), comparison, numbers, Outcome::above(forward, deferred));
    let numbers = vec![number("forward", swaying), number("deferred", steady)];
    let comparison = format!("relative deviation of the frame time, {where_}");
    findings.compare_in(place.name(), comparison, numbers, Outcome::above(swaying, steady));
    Some(())
}
