//! E6: which method is the fastest under few and under many lights.

use super::compared::{Compared, Of, Place, frame_time, in_every_evaluation};
use crate::report::claim::Findings;
use crate::report::enhuber::evaluation::{Evaluation, SEVEN, lights};
use crate::report::results::ResultSet;

/// Numbers of lights, and the kind that is the fastest under them.
const BEST: [(u32, &str); 3] = [(100, "dc-i"), (1000, "t-e"), (10_000, "sc-e")];

pub(super) fn fastest(set: &ResultSet) -> Findings {
    in_every_evaluation(set, |evaluation, findings| {
        for (count, best) in BEST {
            let Some(worst) = worst(evaluation, count, findings) else { continue };
            let compared = Compared::new(worst, "ms");
            let comparison = format!("frame time in each method's worst scene, {}", lights(count));
            let outcome = compared.lowest(&[best]);
            findings.compare_in(evaluation.setting.to_string(), comparison, compared.told(), outcome);
        }
    })
}

/// Of each method the greatest mean frame time over the scenes.
fn worst(evaluation: &Evaluation<'_>, count: u32, findings: &mut Findings) -> Option<Vec<Of>> {
    let mut of_scenes = evaluation
        .scenes
        .iter()
        .map(|scene| Place { evaluation, scene }.under(&SEVEN, count, frame_time, findings))
        .collect::<Vec<_>>()
        .into_iter();
    let mut worst = of_scenes.next()??;
    for scene in of_scenes {
        for (worst, here) in worst.iter_mut().zip(scene?) {
            worst.value = worst.value.max(here.value);
        }
    }
    Some(worst)
}
