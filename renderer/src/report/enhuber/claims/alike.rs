//! E4 and E8: how steady the methods are, and which behave alike.

use super::compared::{Compared, deviation, frame_time, in_every_scene};
use crate::report::claim::{Findings, Outcome, number};
use crate::report::enhuber::evaluation::{SEVEN, lights};
use crate::report::results::ResultSet;

/// Numbers of lights under which DC-I and G are compared.
const COUNTS: [u32; 3] = [100, 1000, 10_000];

pub(super) fn deviations(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let Some((numbers, lights)) = place.under_many(&SEVEN, deviation, findings) else { return };
        let all = Compared::new(numbers, "ms");
        let sparse = all.without(&["t-i", "t-e", "dc-i", "g", "m"]);
        let but_models = all.without(&["m"]);
        let widest = all.without(&["t-e", "dc-i", "sc-i", "sc-e", "g"]);
        let compared = [
            ("SC-E below SC-I", &sparse, sparse.lowest(&["sc-e"])),
            ("SC-I below the others but SC-E", &all, all.without(&["sc-e"]).lowest(&["sc-i"])),
            ("T-I above the others but M", &but_models, but_models.highest(&["t-i"])),
            ("M above T-I", &widest, widest.highest(&["m"])),
        ];
        for (what, numbers, outcome) in compared {
            let comparison = format!("standard deviation of the frame time, {what}, {lights}");
            findings.compare_in(place.name(), comparison, numbers.told(), outcome);
        }
    })
}

pub(super) fn dense_and_world(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for count in COUNTS {
            let Some(numbers) = place.under(&["dc-i", "g"], count, frame_time, findings) else { continue };
            let [dense, world] = &numbers[..] else { continue };
            let ratio = world.value / dense.value;
            let mut told = Compared::new(numbers, "ms").told();
            told.push(number("ratio", ratio));
            let comparison = format!("frame time by G over that by DC-I, {}", lights(count));
            findings.compare_in(place.name(), comparison, told, Outcome::within(ratio, [2.0 / 3.0, 1.5]));
        }
    })
}
