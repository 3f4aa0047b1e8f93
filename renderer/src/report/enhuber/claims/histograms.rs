//! E10: what depth discontinuity does to the lights of groups.

use super::compared::{Place, in_every_scene, title};
use crate::report::claim::{Findings, Outcome, number};
use crate::report::enhuber::evaluation::{lights, name};
use crate::report::results::{ResultSet, Run};

/// How many times as far the lists of tiles must grow as those of sparse clusters.
const FARTHER: f64 = 2.0;

pub(super) fn shift(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let [tiles, sparse] = ["t-e", "sc-e"].map(|kind| growth(place, kind, findings));
        let (Some(tiles), Some(sparse), Some(many)) = (tiles, sparse, place.evaluation.many()) else {
            return;
        };
        let told = [&tiles, &sparse].into_iter().flat_map(|growth| {
            let [least, most] = growth.frames;
            let of = |frame: u32, lights: f64| number(format!("{}, frame {frame}", growth.name), lights);
            [of(least, growth.lights[0]), of(most, growth.lights[1])]
        });
        let outcome = Outcome::above(tiles.by(), FARTHER * sparse.by().abs());
        let comparison = format!("mean lights of a group, {}", lights(many));
        findings.compare_in(place.name(), comparison, told.collect(), outcome);
    })
}

/// Mean lights of a group in the frames of least and of most discontinuity.
struct Growth {
    name: String,
    frames: [u32; 2],
    lights: [f64; 2],
}

impl Growth {
    fn by(&self) -> f64 {
        self.lights[1] - self.lights[0]
    }
}

/// `None` where two frames are not known, which is said.
fn growth(place: Place<'_>, kind: &str, findings: &mut Findings) -> Option<Growth> {
    let run = place.evaluation.many().and_then(|many| place.run(kind, many));
    let found = run.and_then(|run| {
        let [least, most] = run.extremes()[..] else { return None };
        Some(Growth {
            name: name(run.method),
            frames: [least, most],
            lights: [mean_lights(run, least)?, mean_lights(run, most)?],
        })
    });
    if found.is_none() {
        let kind = title(kind);
        findings.lack(format!(
            "pictures of two frames by {kind} in {} (replay --exr discontinuity)",
            place.scene.name()
        ));
    }
    found
}

fn mean_lights(run: &Run, frame: u32) -> Option<f64> {
    let of_frame = run.groups.iter().find(|groups| groups.frame == frame)?;
    let counts = || of_frame.clusterings.iter().flatten();
    let groups: u64 = counts().map(|(_, groups)| groups).sum();
    let lights: f64 = counts().map(|(lights, groups)| f64::from(*lights) * *groups as f64).sum();
    (groups > 0).then(|| lights / groups as f64)
}
