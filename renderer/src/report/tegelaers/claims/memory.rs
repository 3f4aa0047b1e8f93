//! H14: what of the memory depends on the resolution.

use super::places::{Place, in_every_scene};
use crate::measure::Purpose;
use crate::report::claim::{Findings, Number, Outcome, number};
use crate::report::results::{ResultSet, Run};
use crate::report::tegelaers::evaluation::Case;
use crate::report::tegelaers::ratios::Who;
use std::collections::BTreeSet;

/// Up to here, memory is the same.
const SAME: f64 = 1.01;
/// From here on, it is not.
const OTHER: f64 = 1.1;

pub(super) fn of_resolution(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let pipeline = place.evaluation.counting();
        for (who, outcome) in [
            (Who::Hashed(0.5), (|ratio| Outcome::within(ratio, [0.0, SAME])) as fn(f64) -> Outcome),
            (Who::Tiled, |ratio| Outcome::above(ratio, OTHER)),
            (Who::Clustered, |ratio| Outcome::above(ratio, OTHER)),
        ] {
            let Some([fewest, most]) = ends(place, who) else {
                findings.lack(format!(
                    "runs of {}, {}, at two resolutions at least in {}",
                    who.pattern(),
                    pipeline.name(),
                    place.scene.name()
                ));
                continue;
            };
            let [low, high] = [&fewest, &most].map(|(_, bytes)| *bytes);
            let ratio = high.max(low) / high.min(low);
            let size = |(case, _): &(&Case<'_>, f64)| case.size();
            let bytes = |end| Number { name: size(end), value: end.1, unit: "bytes" };
            let numbers = vec![bytes(&fewest), bytes(&most), number("ratio", ratio)];
            let comparison = format!("memory of groups and lists, {}", who.pattern());
            findings.compare_in(place.name(), comparison, numbers, outcome(ratio));
        }
    })
}

/// The runs of the fewest and of the most pixels under as many lights, those that most were measured under, with their bytes.
fn ends<'a>(place: Place<'a>, who: Who) -> Option<[(&'a Case<'a>, f64); 2]> {
    let method = who.method(place.evaluation)?;
    let cases = || place.scene.of(method, place.evaluation.counting());
    let counts: BTreeSet<u32> = cases().map(|case| case.lights).collect();
    let of = |lights: u32| cases().filter(move |case| case.lights == lights);
    let lights = counts.into_iter().max_by_key(|&lights| of(lights).count())?;
    let known: Vec<(&Case<'a>, f64)> = of(lights).filter_map(|case| Some((case, bytes(case.run)?))).collect();
    let (first, last) = (*known.first()?, *known.last()?);
    (first.0.pixels != last.0.pixels).then_some([first, last])
}

/// What a frame needs for groups and lists, on average; `None` where nothing is told of it.
fn bytes(run: &Run) -> Option<f64> {
    let purposes = [Purpose::Grouping, Purpose::Lists].map(Purpose::name);
    let used = run.memory.iter().filter(|row| purposes.contains(&row.purpose.as_str())).map(|row| row.used);
    Some(used.sum::<u64>()).filter(|bytes| *bytes > 0).map(|bytes| bytes as f64)
}
