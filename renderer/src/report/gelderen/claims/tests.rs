//! Each claim on data for which it holds, data for which it does not, and none.

use super::{CLAIMS, is_far};
use crate::report::claim::{self, Claim, Verdict};
use crate::report::results::{Run, metric};
use crate::report::testing::{run, set, timed};

fn check(runs: Vec<Run>) -> Vec<Claim> {
    claim::check(&CLAIMS, claim::by_way(&set(runs)))
}

fn claim(id: &str, runs: Vec<Run>) -> Claim {
    check(runs).into_iter().find(|claim| claim.id == id).unwrap()
}

fn verdict(id: &str, runs: Vec<Run>) -> Verdict {
    claim(id, runs).verdict
}

/// A run whose metric `name` is `value` at every frame, and all others 1.
fn flat(method: &str, views: u32, lights: u32, name: &'static str, value: f64) -> Run {
    run(method, views, lights, move |metric, _| Some(if metric == name { value } else { 1.0 }))
}

#[test]
fn without_data_nothing_is_said() {
    for claim in check(vec![]) {
        assert_eq!(claim.verdict, Verdict::NotEnoughData, "{}", claim.id);
        assert!(claim.evidence.is_empty() && !claim.missing.is_empty(), "{}", claim.id);
    }
}

#[test]
fn halving_is_from_two_fifths_to_three_fifths() {
    let runs = |encl| {
        vec![
            flat("indi-ortho-4", 2, 1000, metric::VISIBLE, 1000.0),
            flat("encl-ortho-4", 2, 1000, metric::VISIBLE, encl),
        ]
    };
    assert_eq!(verdict("G1", runs(510.0)), Verdict::Holds);
    assert_eq!(verdict("G1", runs(610.0)), Verdict::DoesNotHold);
    assert_eq!(verdict("G1", runs(390.0)), Verdict::DoesNotHold);
    let numbers = claim("G1", runs(510.0)).evidence[0].numbers.clone();
    assert_eq!(numbers.iter().map(|number| number.value).collect::<Vec<_>>(), [1000.0, 510.0, 0.51]);
}

#[test]
fn clustering_time_needs_all_three_parts() {
    let pair = |lights: u32, saved: f64, saved_afar: f64| {
        let time = move |by: f64| {
            move |name: &str, frame: u32| match name {
                metric::CLUSTER => Some(by * if is_far(frame) { saved_afar } else { saved } + 1.0),
                _ => Some(1.0),
            }
        };
        [run("indi-ortho-4", 2, lights, time(1.0)), run("encl-ortho-4", 2, lights, time(0.0))]
    };
    let both = |few, many| [pair(1000, few, 2.0 * few), pair(100_000, many, 2.0 * many)].concat();
    assert_eq!(verdict("G2", both(1.0, 9.0)), Verdict::Holds);
    assert_eq!(verdict("G2", both(9.0, 1.0)), Verdict::DoesNotHold);
    assert_eq!(verdict("G2", pair(1000, 1.0, 2.0).to_vec()), Verdict::NotEnoughData);
    assert_eq!(verdict("G2", [pair(1000, 1.0, 0.5), pair(100_000, 2.0, 3.0)].concat()), Verdict::DoesNotHold);
    assert_eq!(verdict("G2", pair(1000, -1.0, -1.0).to_vec()), Verdict::DoesNotHold);
}

#[test]
fn a_margin_within_the_noise_of_the_runs_is_undecided() {
    let time = |method: &str, ms: f64, factors| {
        timed(flat(method, 2, 1000, metric::CLUSTER, ms), metric::CLUSTER, factors)
    };
    let noisy = [1.0, 1.3, 1.1];
    let compared = |by_encl: f64, factors: [[f64; 3]; 2]| {
        let runs = [("indi-persp-64", 10.0), ("encl-persp-64", by_encl)];
        let runs = runs.iter().zip(factors).map(|((method, ms), factors)| time(method, *ms, factors));
        let evidence = claim("G2", runs.collect()).evidence;
        evidence.into_iter().find(|evidence| evidence.comparison.starts_with("clustering time")).unwrap()
    };
    let close = compared(9.5, [noisy, [1.2, 1.0, 1.05]]);
    assert!(close.holds && !close.decided && close.interval.unwrap().straddles(0.0), "{close:?}");
    assert!((close.margin - 0.5).abs() < 1e-9);
    let paired = compared(9.5, [noisy, noisy]);
    assert!(paired.decided, "what both share in a run cancels: {paired:?}");
    let steady = compared(9.5, [[1.0, 1.001, 1.002]; 2]);
    assert!(steady.decided && steady.interval.is_some(), "{steady:?}");
    let runs = vec![time("indi-persp-64", 10.0, noisy), time("encl-persp-64", 9.5, [1.2, 1.0, 1.05])];
    assert_eq!(verdict("G2", runs), Verdict::Undecided);
    let counts =
        claim("G3", vec![time("indi-persp-64", 10.0, noisy), time("encl-persp-64", 5.0, noisy)]).evidence;
    assert!(counts.iter().all(|evidence| evidence.decided && evidence.interval.is_none()));
}

#[test]
fn lighting_computations_are_compared_for_persp() {
    let runs = |encl| {
        vec![
            flat("indi-persp-64", 2, 1000, metric::COMPUTATIONS, 100.0),
            flat("encl-persp-64", 2, 1000, metric::COMPUTATIONS, encl),
        ]
    };
    assert_eq!(verdict("G3", runs(99.0)), Verdict::Holds);
    assert_eq!(verdict("G3", runs(100.0)), Verdict::DoesNotHold);
}

#[test]
fn far_geometry_is_compared_with_the_rest() {
    let persp = |visible_afar: f64| {
        run("indi-persp-64", 1, 1000, move |name, frame| {
            let far = is_far(frame);
            Some(match name {
                metric::VISIBLE if far => visible_afar,
                metric::VISIBLE => 100.0,
                metric::INDICES => 1000.0,
                metric::SHADE if far => 3.0,
                _ => 1.0,
            })
        })
    };
    assert_eq!(verdict("G4", vec![persp(10.0)]), Verdict::Holds);
    assert_eq!(verdict("G4", vec![persp(200.0)]), Verdict::DoesNotHold);
    let ortho =
        |peak: u32| run("indi-ortho-4", 1, 1000, move |_, frame| Some(if frame == peak { 9.0 } else { 1.0 }));
    assert_eq!(verdict("G5", vec![ortho(580)]), Verdict::Holds);
    assert_eq!(verdict("G5", vec![ortho(300)]), Verdict::DoesNotHold);
    let mut elsewhere = ortho(580);
    elsewhere.setting.recording = "mine".into();
    assert_eq!(verdict("G5", vec![elsewhere]), Verdict::NotEnoughData);
}

#[test]
fn steadiness_is_the_deviation_of_the_frame() {
    let runs = |displ: f64| {
        [("indi-persp-64", 2.0), ("indi-ortho-4", 3.0), ("indi-displ-64-32", displ)]
            .map(|(method, swing)| {
                run(method, 1, 1000, move |_, frame| Some(if frame > 400 { 10.0 + swing } else { 10.0 }))
            })
            .to_vec()
    };
    assert_eq!(verdict("G6", runs(1.0)), Verdict::Holds);
    assert_eq!(verdict("G6", runs(2.5)), Verdict::DoesNotHold);
    assert_eq!(verdict("G6", runs(1.0)[..2].to_vec()), Verdict::NotEnoughData);
}

#[test]
fn fragments_have_a_bound_at_one_sample_a_pixel() {
    let with = |most, msaa| {
        let mut run = flat("indi-persp-64", 1, 1000, metric::VISIBLE, 1.0);
        run.most_fragments = Some(most);
        run.setting.msaa = msaa;
        vec![run]
    };
    assert_eq!(verdict("G7", with(4096, 1)), Verdict::Holds);
    assert_eq!(verdict("G7", with(4097, 1)), Verdict::DoesNotHold);
    assert_eq!(verdict("G7", with(4097, 4)), Verdict::NotEnoughData);
}

#[test]
fn growth_is_an_exponent() {
    let runs = |exponent: f64| {
        [1000, 10_000, 100_000]
            .map(|lights| run("indi-ortho-4", 1, lights, move |_, _| Some(f64::from(lights).powf(exponent))))
            .to_vec()
    };
    assert_eq!(verdict("G8", runs(1.0)), Verdict::Holds);
    assert_eq!(verdict("G8", runs(0.5)), Verdict::DoesNotHold);
    assert_eq!(verdict("G8", runs(1.0)[..1].to_vec()), Verdict::NotEnoughData);
}

#[test]
fn ways_of_assignment_are_judged_apart() {
    use crate::report::way::Way;
    let by = |assign: &str, indi: f64| {
        let mut runs = [
            flat("indi-ortho-4", 2, 1000, metric::VISIBLE, indi),
            flat("encl-ortho-4", 2, 1000, metric::VISIBLE, 50.0),
        ];
        for run in &mut runs {
            run.setting.way = Way::named(assign, "auto", run.method);
        }
        runs
    };
    let first = claim("G1", [by("scatter", 60.0), by("brute", 100.0)].concat());
    assert_eq!((first.verdict, first.way.as_str(), first.evidence.len()), (Verdict::Holds, "brute force", 1));
    let others: Vec<_> = first.other_ways.iter().map(|other| (other.way.as_str(), other.verdict)).collect();
    assert_eq!(others, [("scatter", Verdict::DoesNotHold)]);
    let alone = claim("G1", by("scatter", 60.0).to_vec());
    assert_eq!((alone.verdict, alone.way.as_str()), (Verdict::DoesNotHold, "scatter"));
}
