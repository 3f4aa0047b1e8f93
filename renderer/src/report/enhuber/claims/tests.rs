//! Each claim on data for which it holds, for which it does not, that leave it open, and on none.

use super::CLAIMS;
use crate::report::claim::{self, Claim, Verdict};
use crate::report::enhuber::evaluation::judged;
use crate::report::enhuber::testing::{Costs, costs, elsewhere, everything, of, slower};
use crate::report::results::{Run, metric};
use crate::report::testing::{set, timed};

fn claim(id: &str, runs: Vec<Run>) -> Claim {
    let claims = claim::check(&CLAIMS, judged(&set(runs)));
    claims.into_iter().find(|claim| claim.id == id).unwrap()
}

fn verdict(id: &str, runs: Vec<Run>) -> Verdict {
    claim(id, runs).verdict
}

/// Everything, where one kind costs something else.
fn but(kind: &'static str, other: impl Fn(Costs) -> Costs) -> Vec<Run> {
    everything(|known| if known == kind { other(costs(known)) } else { costs(known) })
}

#[test]
fn without_data_nothing_is_said() {
    for claim in claim::check(&CLAIMS, judged(&set(vec![]))) {
        assert_eq!(claim.verdict, Verdict::NotEnoughData, "{}", claim.id);
        assert!(claim.evidence.is_empty() && !claim.missing.is_empty(), "{}", claim.id);
    }
}

#[test]
fn all_hold_of_results_as_the_thesis_has_them() {
    for claim in claim::check(&CLAIMS, judged(&set(everything(costs)))) {
        assert_eq!(
            (claim.verdict, &claim.missing),
            (Verdict::Holds, &vec![]),
            "{}: {:?}",
            claim.id,
            claim.evidence
        );
        assert!(
            !claim.evidence.is_empty() && claim.evidence.iter().all(|evidence| !evidence.numbers.is_empty())
        );
    }
}

#[test]
fn each_fails_where_its_numbers_say_so() {
    let steeper = |part: fn(&mut Costs) -> &mut [f64; 2], slope: f64| {
        move |mut costs: Costs| {
            part(&mut costs)[1] = slope;
            costs
        }
    };
    let swinging = |swing: f64| move |costs: Costs| Costs { swing, ..costs };
    let assignment: fn(&mut Costs) -> &mut [f64; 2] = |costs| &mut costs.assignment;
    let shading: fn(&mut Costs) -> &mut [f64; 2] = |costs| &mut costs.shading;
    let fails: [(&str, Vec<Run>); 14] = [
        ("E1", but("dc-e", |costs| slower(costs, 20.0))),
        ("E3", but("sc-i", steeper(shading, 1.1))),
        ("E3", but("t-e", |costs| slower(costs, 2.5))),
        ("E4", but("sc-e", swinging(0.1))),
        ("E4", but("m", swinging(0.02))),
        ("E6", but("t-e", |costs| slower(costs, 1.0))),
        ("E7", but("m", steeper(assignment, 0.3))),
        ("E7", but("t-i", steeper(shading, 91.0))),
        ("E8", but("g", |costs| slower(costs, 1.0))),
        ("E9", but("t-e", swinging(0.6))),
        ("E10", but("sc-e", |costs| Costs { growth: 15.25, ..costs })),
        ("E10", but("t-e", |costs| Costs { growth: -8.0, ..costs })),
        ("E12", but("dc-i", steeper(assignment, 2.1))),
        ("E13", but("sc-e", |costs| Costs { lists: 3201.0, ..costs })),
    ];
    for (place, (id, runs)) in fails.into_iter().enumerate() {
        let found = claim(id, runs);
        assert_eq!(found.verdict, Verdict::DoesNotHold, "{id}, case {place}: {:?}", found.evidence);
    }
}

#[test]
fn numbers_are_those_of_the_costs() {
    let numbers = |id, comparison: &str| -> Vec<(String, f64)> {
        let claim = claim(id, everything(costs));
        let evidence = claim.evidence.into_iter().find(|evidence| evidence.comparison == comparison).unwrap();
        evidence.numbers.into_iter().map(|number| (number.name, (number.value * 1e6).round() / 1e6)).collect()
    };
    let told = |values: &[(&str, f64)]| {
        values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect::<Vec<_>>()
    };
    let frame_time = "frame time, T-I 28 and T-E 28, 10\u{202f}000 lights";
    assert_eq!(numbers("E1", frame_time), told(&[("T-I 28", 42.9), ("T-E 28", 13.5)]));
    let offsets = [
        ("T-I 28", 0.5),
        ("T-E 28", 1.2),
        ("DC-I 128 64", 0.5),
        ("SC-I 48 40", 3.0),
        ("SC-E 48 40", 3.2),
        ("G 20", 0.6),
        ("M", 0.1),
    ];
    assert_eq!(numbers("E3", "offset of assignment"), told(&offsets));
    assert_eq!(numbers("E12", "slopes, M"), told(&[("shading", 90.0), ("assignment", 0.1)]));
    // Relative deviations are swings, of which a fifth of the frames has none.
    let relative = numbers("E9", "relative deviation, SC-I 48 40 and SC-E 48 40, 10\u{202f}000 lights");
    assert_eq!(relative, told(&[("SC-I 48 40", 0.071_554), ("SC-E 48 40", 0.044_721)]));
    assert_eq!(
        numbers("E13", "most lists of a frame, 10\u{202f}000 lights"),
        told(&[("SC-E 48 40", 900.0), ("DC-I 48 40", 6400.0), ("ratio", 0.140_625)])
    );
}

#[test]
fn times_off_a_line_are_not_linear() {
    let mut runs = everything(costs);
    let bent = of("sc-e-48-40", 1000, slower(costs("sc-e"), 3.0));
    assert_eq!(verdict("E2", runs.clone()), Verdict::Holds);
    runs.retain(|run| run.name != bent.name);
    runs.push(bent);
    assert_eq!(verdict("E2", runs), Verdict::DoesNotHold);
}

#[test]
fn another_test_may_be_faster_in_fewer_than_half_of_the_scenes_for_clusters_alone() {
    let faster = |method: &'static str| {
        let mut runs = everything(costs);
        let own = |run: &&mut Run| {
            run.method.to_string() == method && run.setting.way.value("test", run.method) == "hs"
        };
        let run = runs.iter_mut().find(own).unwrap();
        let better = run.frames.values(metric::FRAME).map(|ms| 0.5 * ms).collect();
        run.frames.replace(metric::FRAME, better);
        runs
    };
    let in_scenes = |others: [Vec<Run>; 3]| {
        let [first, second, mut third] = others;
        let second = second.into_iter().map(elsewhere);
        third.iter_mut().for_each(|run| run.setting.scene = "temple".into());
        verdict("E5", first.into_iter().chain(second).chain(third).collect())
    };
    let usual = || everything(costs);
    assert_eq!(in_scenes([usual(), faster("sc-e-48-40"), usual()]), Verdict::Holds);
    assert_eq!(in_scenes([faster("sc-e-48-40"), faster("sc-e-48-40"), usual()]), Verdict::DoesNotHold);
    assert_eq!(in_scenes([usual(), faster("t-e-28"), usual()]), Verdict::DoesNotHold);
}

#[test]
fn shading_by_the_usual_test_is_close_to_that_by_the_thorough_one() {
    let mut runs = everything(costs);
    let thorough = runs.iter_mut().filter(|run| run.setting.way.value("test", run.method) == "hs+sat-epv");
    for run in thorough {
        let less = run.frames.values(metric::SHADE).map(|ms| 0.89 * ms).collect();
        run.frames.replace(metric::SHADE, less);
    }
    assert_eq!(verdict("E5", runs), Verdict::DoesNotHold);
}

#[test]
fn the_worst_scene_decides_which_is_fastest() {
    let hall = |other: fn(Costs) -> Costs| {
        let there = everything(|kind| if kind == "sc-e" { other(costs(kind)) } else { costs(kind) });
        everything(costs).into_iter().chain(there.into_iter().map(elsewhere)).collect::<Vec<_>>()
    };
    assert_eq!(verdict("E6", hall(|costs| costs)), Verdict::Holds);
    let found = claim("E6", hall(|costs| slower(costs, 5.0)));
    assert_eq!(found.verdict, Verdict::DoesNotHold);
    let many = found.evidence.last().unwrap();
    let of = |name: &str| many.numbers.iter().find(|number| number.name == name).unwrap().value;
    assert!((of("SC-E 48 40") - 15.0).abs() < 1e-9 && (of("T-E 28") - 13.5).abs() < 1e-9, "{many:?}");
}

#[test]
fn lists_that_follow_the_view_or_lights_that_move_do_not_pass() {
    let mut runs = everything(costs);
    let models = runs.iter_mut().find(|run| run.method.to_string() == "m").unwrap();
    let mut indices: Vec<f64> = models.frames.values(metric::INDICES).collect();
    indices[2] += 1.0;
    models.frames.replace(metric::INDICES, indices);
    assert_eq!(verdict("E11", runs), Verdict::DoesNotHold);
    let mut runs = everything(costs);
    let cells = runs.iter_mut().find(|run| run.method.to_string() == "g-20").unwrap();
    cells.groups[1].clusterings[0][0].1 -= 1;
    assert_eq!(verdict("E11", runs), Verdict::DoesNotHold);
    let mut moving = everything(costs);
    moving.iter_mut().for_each(|run| run.setting.options.push("light motion bounce".into()));
    let found = claim("E11", moving);
    assert_eq!(found.verdict, Verdict::NotEnoughData);
    assert!(found.missing[0].contains("lights that stand still"), "{:?}", found.missing);
}

#[test]
fn what_is_missing_is_said() {
    let without = |name: &str| {
        everything(costs).into_iter().filter(|run| run.method.to_string() != name).collect::<Vec<_>>()
    };
    for (id, method, what) in [
        ("E1", "dc-e-64-40", "temporal runs of DC-E under 10\u{202f}000 lights in street (bistro)"),
        ("E3", "m", "temporal runs of M under three numbers of lights or more in street (bistro)"),
        (
            "E13",
            "dc-i-48-40",
            "runs of SC-E 48 40 and of DC-I or DC-E at the same size under 10\u{202f}000 lights in street (bistro)",
        ),
    ] {
        let found = claim(id, without(method));
        assert_eq!((found.verdict, found.missing), (Verdict::NotEnoughData, vec![what.to_owned()]), "{id}");
    }
    let three =
        everything(costs).into_iter().filter(|run| run.setting.way.value("test", run.method) != "sat-epv");
    let found = claim("E5", three.collect());
    assert_eq!(found.verdict, Verdict::NotEnoughData);
    assert_eq!(found.missing[0], "temporal runs of T-E by sat-epv in street (bistro)");
}

#[test]
fn what_measuring_cannot_tell_apart_is_undecided() {
    let factors = |run: &Run, noisy: bool| match (noisy, run.method.to_string().as_str()) {
        (true, "t-e-28") => [1.2, 1.0, 1.1],
        (true, _) => [1.0, 1.3, 1.1],
        (false, _) => [1.0, 1.001, 1.002],
    };
    let runs = |noisy: bool| -> Vec<Run> {
        let near = everything(|kind| if kind == "t-i" { slower(costs("t-e"), 0.3) } else { costs(kind) });
        let timed = |run: Run| {
            let factors = factors(&run, noisy);
            timed(timed(run, metric::FRAME, factors), metric::SHADE, factors)
        };
        near.into_iter().map(timed).collect()
    };
    let of_tiles = |noisy| {
        let evidence = claim("E1", runs(noisy)).evidence;
        evidence.into_iter().find(|evidence| evidence.comparison.contains("T-I")).unwrap()
    };
    let (noisy, steady) = (of_tiles(true), of_tiles(false));
    assert!(noisy.holds && !noisy.decided && noisy.interval.unwrap().straddles(0.0), "{noisy:?}");
    assert!(steady.holds && steady.decided && steady.interval.is_some(), "{steady:?}");
    assert_eq!(verdict("E1", runs(true)), Verdict::Undecided);
}

#[test]
fn results_by_another_way_are_judged_beside() {
    let scatter = |runs: Vec<Run>| {
        let by = |mut run: Run| {
            let test = run.setting.way.value("test", run.method);
            run.setting.way = crate::report::way::Way::named("scatter", &test, run.method);
            run
        };
        runs.into_iter().map(by).collect::<Vec<_>>()
    };
    let slow = but("sc-e", |costs| slower(costs, 9.0));
    let found = claim("E1", [scatter(slow), everything(costs)].concat());
    assert_eq!((found.verdict, found.way.as_str()), (Verdict::Holds, "brute force"));
    let others: Vec<_> = found.other_ways.iter().map(|other| (other.way.as_str(), other.verdict)).collect();
    assert_eq!(others, [("scatter", Verdict::DoesNotHold)]);
}
