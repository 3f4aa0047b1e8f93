//! E5: which test of sphere against frustum is the fastest.

use super::compared::{Place, frame_time, in_every_evaluation, title};
use crate::report::claim::{Findings, Number, Outcome, mean, milliseconds, number};
use crate::report::enhuber::evaluation::{Evaluation, TESTS, USUAL_TEST, name, test};
use crate::report::results::{ResultSet, Run, metric};

/// The test with the fewest false positives of the thesis's.
const THOROUGH: &str = "hs+sat-epv";
/// How far shading times may differ, in parts of that by [`THOROUGH`].
const ALIKE: f64 = 0.1;

pub(super) fn best(set: &ResultSet) -> Findings {
    in_every_evaluation(set, |evaluation, findings| {
        fastest_everywhere(evaluation, findings);
        fastest_in_most(evaluation, findings);
        for scene in &evaluation.scenes {
            for kind in ["t-e", "sc-e"] {
                shading(Place { evaluation, scene }, kind, findings);
            }
        }
    })
}

/// T-E in every scene.
fn fastest_everywhere(evaluation: &Evaluation<'_>, findings: &mut Findings) {
    for scene in &evaluation.scenes {
        let place = Place { evaluation, scene };
        let Some(times) = times(place, "t-e", findings) else { continue };
        findings.compare_in(place.name(), comparison(evaluation, "t-e"), told(&times), usual_below(&times));
    }
}

/// SC-E in more than half of the scenes: what decides is how far the usual test is ahead in the scene that makes the majority.
fn fastest_in_most(evaluation: &Evaluation<'_>, findings: &mut Findings) {
    let of_scene = |scene| times(Place { evaluation, scene }, "sc-e", findings);
    let times: Vec<_> = evaluation.scenes.iter().map(of_scene).collect();
    let Some(times) = times.into_iter().collect::<Option<Vec<_>>>() else { return };
    let mut ahead: Vec<f64> = times.iter().map(|times| usual_below(times).margin).collect();
    let wins = ahead.iter().filter(|margin| **margin > 0.0).count();
    ahead.sort_by(|a, b| b.total_cmp(a));
    let deciding = ahead[ahead.len() / 2];
    let numbers = vec![
        number("scenes", ahead.len() as f64),
        number("fastest by hs+sat-n in", wins as f64),
        milliseconds("ahead in the deciding scene", deciding),
    ];
    let comparison = comparison(evaluation, "sc-e");
    findings.compare_in(evaluation.setting.to_string(), comparison, numbers, Outcome::above(deciding, 0.0));
}

fn comparison(evaluation: &Evaluation<'_>, kind: &str) -> String {
    let method = evaluation.chosen(kind).map_or_else(|| title(kind).to_owned(), name);
    format!("frame time by test, {method}")
}

/// (test, mean frame time) of a kind in a scene; what is missing is said, and `None` where that leaves nothing to compare.
fn times(place: Place<'_>, kind: &str, findings: &mut Findings) -> Option<Vec<(String, f64)>> {
    let runs = place.evaluation.tests_of(place.scene, kind);
    let times: Vec<(String, f64)> =
        runs.into_iter().filter_map(|run: &Run| Some((test(run), frame_time(run)?))).collect();
    let has = |test: &str| times.iter().any(|(known, _)| known == test);
    let missing: Vec<&str> = TESTS.into_iter().filter(|test| !has(test)).collect();
    if !missing.is_empty() {
        let tests = if missing.len() == TESTS.len() { "18 tests".into() } else { missing.join(", ") };
        findings.lack(format!("temporal runs of {} by {tests} in {}", title(kind), place.scene.name()));
    }
    (has(USUAL_TEST) && times.len() > 1).then_some(times)
}

/// Of the claim that the usual test takes less than all others of the thesis's.
fn usual_below(times: &[(String, f64)]) -> Outcome {
    let of = |usual: bool| {
        let wanted =
            times.iter().filter(|(test, _)| (test == USUAL_TEST) == usual && TESTS.contains(&test.as_str()));
        wanted.map(|(_, ms)| *ms).fold(f64::INFINITY, f64::min)
    };
    Outcome::above(of(false), of(true))
}

fn told(times: &[(String, f64)]) -> Vec<Number> {
    times.iter().map(|(test, ms)| milliseconds(test, *ms)).collect()
}

/// The usual test shades about as fast as the thorough one.
fn shading(place: Place<'_>, kind: &str, findings: &mut Findings) {
    let runs = place.evaluation.tests_of(place.scene, kind);
    let of =
        |wanted: &str| runs.iter().find(|run| test(run) == wanted).and_then(|run| mean(run, metric::SHADE));
    let (Some(usual), Some(thorough)) = (of(USUAL_TEST), of(THOROUGH)) else { return };
    let ratio = usual / thorough;
    let numbers =
        vec![milliseconds(USUAL_TEST, usual), milliseconds(THOROUGH, thorough), number("ratio", ratio)];
    let comparison = format!("shading time by test, {}", title(kind));
    findings.compare_in(
        place.name(),
        comparison,
        numbers,
        Outcome::within(ratio, [1.0 - ALIKE, 1.0 + ALIKE]),
    );
}
