//! Each claim on data for which it holds, for which it does not, and on none.

use super::CLAIMS;
use crate::report::claim::{self, Claim, Verdict};
use crate::report::results::{BuiltOctree, Run};
use crate::report::tegelaers::evaluation::{Pipeline, judged, node};
use crate::report::tegelaers::testing::{Costs, costs, elsewhere, everything};
use crate::report::testing::set;

fn claim(id: &str, runs: Vec<Run>) -> Claim {
    let stated = CLAIMS.iter().filter(|stated| stated.id == id);
    claim::check(stated, judged(&set(runs))).remove(0)
}

/// Everything, where some methods cost something else.
fn but(name: &'static str, other: impl Fn(&Run, Costs) -> Costs) -> Vec<Run> {
    everything(|run| {
        let usual = costs(run);
        if run.method.to_string().starts_with(name) { other(run, usual) } else { usual }
    })
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
    let street = everything(costs);
    let hall = street.clone().into_iter().map(elsewhere);
    for claim in claim::check(&CLAIMS, judged(&set(hall.chain(street.clone()).collect()))) {
        assert_eq!(
            (claim.verdict, &claim.missing),
            (Verdict::Holds, &vec![]),
            "{}: {:?}",
            claim.id,
            claim.evidence.iter().filter(|evidence| !evidence.holds).collect::<Vec<_>>()
        );
        assert!(claim.evidence.iter().all(|evidence| !evidence.numbers.is_empty()), "{}", claim.id);
        let scenes = ["street", "hall"]
            .map(|scene| claim.evidence.iter().any(|evidence| evidence.setting.starts_with(scene)));
        assert_eq!(scenes, [true; 2], "{}", claim.id);
    }
}

#[test]
fn each_fails_where_its_numbers_say_so() {
    let computing = |more: f64| {
        move |_: &Run, costs: Costs| Costs {
            computations: costs.computations.map(|part| more * part),
            ..costs
        }
    };
    let timed = |more: f64, wanted: Pipeline| {
        move |run: &Run, costs: Costs| match Pipeline::of(run) == wanted {
            true => Costs { ms: costs.ms.map(|part| more * part), ..costs },
            false => costs,
        }
    };
    let swinging = |swing: f64| move |_: &Run, costs: Costs| Costs { swing, ..costs };
    let fails: [(&str, Vec<Run>); 17] = [
        ("H1", but("hashed-0.5", computing(1.3))),
        ("H1", but("hashed-0.5", computing(0.7))),
        ("H2", but("hashed-0.5", timed(1.5, Pipeline::Forward))),
        ("H2", but("hashed-0.5", timed(1.5, Pipeline::Deferred))),
        ("H3", but("hashed-0.25", computing(1.25))),
        ("H7", but("tiled-mm", computing(1.6))),
        ("H7", but("tiled-mm", |_, costs| Costs { computations: [0.0, 0.28], ..costs })),
        ("H7", but("tiled-mm-8", computing(0.75))),
        ("H8", but("clustered-mm", computing(1.4))),
        ("H8", but("clustered-mm", swinging(0.31))),
        ("H9", but("hashed-0.5", timed(4.0, Pipeline::Deferred))),
        (
            "H9",
            but("tiled-mm", |run, costs| {
                if Pipeline::of(run) == Pipeline::Deferred { Costs { swing: 0.7, ..costs } } else { costs }
            }),
        ),
        ("H10", but("clustered-mm", bent)),
        ("H12", but("hashed-3", computing(1.06))),
        ("H13", but("hashed-3", timed(3.0, Pipeline::Deferred))),
        ("H14", but("hashed-0.5", |_, costs| Costs { bytes: [4e5, 0.02], ..costs })),
        ("H14", but("clustered-mm", |_, costs| Costs { bytes: [4e5, 0.0], ..costs })),
    ];
    for (place, (id, runs)) in fails.into_iter().enumerate() {
        let found = claim(id, runs);
        assert_eq!(found.verdict, Verdict::DoesNotHold, "{id}, case {place}: {:?}", found.evidence);
    }
}

/// Costs that grow with the square of the lights.
fn bent(run: &Run, costs: Costs) -> Costs {
    let lights = f64::from(run.lighting.count.unwrap());
    Costs { computations: costs.computations.map(|part| part * lights / 300.0), ..costs }
}

/// Everything, where octrees of some runs are others.
fn grown(is_other: impl Fn(&Run) -> bool, change: impl Fn(&mut BuiltOctree, f64)) -> Vec<Run> {
    let mut runs = everything(costs);
    for run in runs.iter_mut().filter(|run| is_other(run)) {
        let radii = node(run.method);
        if let (Some(built), Some(radii)) = (&mut run.octree, radii) {
            change(built, radii);
        }
    }
    runs
}

#[test]
fn claims_of_octrees_fail_where_tables_or_steps_say_so() {
    let swell = |built: &mut BuiltOctree, by: f64| {
        built.tables.iter_mut().for_each(|table| table.slot_bytes = (table.slot_bytes as f64 * by) as u64);
    };
    let slow = |built: &mut BuiltOctree, by: f64| built.steps.iter_mut().for_each(|step| step.1 *= by);
    let is_seed = |run: &Run| run.setting.way.other("octree") == Some("seed-2");
    let is_shallow = |run: &Run| run.method.to_string() == "hashed-0.25-1";
    let shallow_memory = |built: &mut BuiltOctree, _: f64| {
        let first = built.tables[0].depth;
        built
            .tables
            .iter_mut()
            .filter(|table| table.depth == first)
            .for_each(|table| table.slot_bytes *= 100);
    };
    let fails: [(&str, Vec<Run>); 7] = [
        ("H4", grown(|_| true, swell)),
        ("H4", grown(|_| true, |built, radii| slow(built, radii))),
        ("H5", grown(is_seed, |built, _| swell(built, 1.03))),
        ("H5", grown(is_seed, |built, _| slow(built, 1.3))),
        ("H6", grown(is_shallow, |built, _| swell(built, 1.3))),
        (
            "H6",
            but("hashed-0.25-1", |_, costs| Costs {
                computations: costs.computations.map(|part| 1.03 * part),
                ..costs
            }),
        ),
        ("H11", grown(|_| true, shallow_memory)),
    ];
    for (place, (id, runs)) in fails.into_iter().enumerate() {
        let found = claim(id, runs);
        assert_eq!(found.verdict, Verdict::DoesNotHold, "{id}, case {place}: {:?}", found.evidence);
    }
}

#[test]
fn growth_is_judged_by_the_smallest_nodes_and_told_of_all() {
    let of_size = |size: f64| move |run: &Run| node(run.method) == Some(size);
    let flat =
        |built: &mut BuiltOctree, _: f64| built.tables.iter_mut().for_each(|table| table.slot_bytes *= 2);
    // Twice the bytes with the largest of the nodes: half the growth from these on, the power is one less.
    let found = claim("H4", grown(of_size(1.0), flat));
    assert_eq!(found.verdict, Verdict::Holds);
    let memory = &found.evidence[0];
    assert_eq!(memory.comparison, "exponent of memory from size to size of nodes, 1200 lights");
    let told: Vec<&str> = memory.numbers.iter().map(|number| number.name.as_str()).collect();
    assert_eq!(told, ["0.5 to 0.25", "1 to 0.5"]);
    assert!((memory.numbers[0].value - 3.0).abs() < 0.01, "{:?}", memory.numbers);
    // Half of the bytes are light indices, which stay.
    assert!((memory.numbers[1].value - (3.0 - 1.5_f64.log2())).abs() < 0.01, "{:?}", memory.numbers);
    assert_eq!(claim("H4", grown(of_size(0.25), flat)).verdict, Verdict::DoesNotHold);
}

#[test]
fn nodes_beyond_the_diameter_may_cost_more_elsewhere() {
    let dear = but("hashed-3", |_, costs| Costs { computations: [9.0, 0.2], ..costs });
    let found = claim("H12", [dear, everything(costs).into_iter().map(elsewhere).collect()].concat());
    assert_eq!((found.verdict, found.evidence.len()), (Verdict::Holds, 1));
    assert!(found.evidence[0].setting.starts_with("hall"));
}

#[test]
fn each_scene_is_judged_by_the_sizes_that_it_has() {
    let mut hall: Vec<Run> = everything(costs).into_iter().map(elsewhere).collect();
    hall.retain(|run| !run.method.to_string().starts_with("hashed-0.25"));
    let found = claim("H13", [hall, everything(costs)].concat());
    assert_eq!((found.verdict, found.missing.len()), (Verdict::Holds, 0));
    let smallest: Vec<&str> = found.evidence.iter().map(|evidence| &*evidence.numbers[0].name).collect();
    assert_eq!(smallest, ["Hashed 0.5 3", "Hashed 0.25 3"]);
}

#[test]
fn numbers_are_those_of_the_costs() {
    let found = claim("H1", everything(costs));
    let evidence = &found.evidence[0];
    assert_eq!(
        evidence.comparison,
        "lighting computations, Hashed 0.5 3 over Tiled MM 32, deferred, 1200 lights, 640 × 640"
    );
    let numbers: Vec<(&str, f64)> = evidence
        .numbers
        .iter()
        .map(|number| (number.name.as_str(), (1000.0 * number.value).round() / 1000.0))
        .collect();
    let pixels = 640.0 * 640.0;
    let expected = [("Hashed 0.5 3", pixels * 159.0), ("Tiled MM 32", pixels * 318.0), ("ratio", 0.5)];
    assert_eq!(numbers, expected);
    let few = claim("H7", everything(costs)).evidence.remove(1);
    assert!(few.comparison.ends_with("60 lights, 160 × 160"), "{}", few.comparison);
    assert!((few.numbers[2].value - 60.0 / 33.0).abs() < 1e-9);
}

#[test]
fn what_is_missing_is_said() {
    let without = |name: &str| {
        everything(costs)
            .into_iter()
            .filter(|run| !run.method.to_string().starts_with(name))
            .collect::<Vec<_>>()
    };
    for (id, method, what) in [
        ("H1", "hashed-0.5", "runs of hashed-0.5-3 and tiled-mm-32, deferred, in street (bistro)"),
        ("H2", "tiled-mm", "runs of tiled-mm-32 and hashed-0.5-3, forward, in street (bistro)"),
        ("H9", "all-lights", "temporal runs of all-lights in both pipelines in street (bistro)"),
        (
            "H12",
            "hashed-3",
            "runs of hashed with nodes of two radii or fewer and of more, in street (bistro)",
        ),
    ] {
        let found = claim(id, without(method));
        assert_eq!((found.verdict, &found.missing[0][..]), (Verdict::NotEnoughData, what), "{id}");
    }
}

#[test]
fn results_with_a_prepass_are_judged_beside_those_with_overdraw() {
    let with_overdraw = |mut run: Run| {
        run.setting.way = run.setting.way.with("shading", "overdraw");
        run
    };
    let prepass = but("hashed-0.5", |_, costs| Costs { ms: costs.ms.map(|part| 3.0 * part), ..costs });
    let overdraw = everything(costs).into_iter().map(with_overdraw);
    let found = claim("H2", prepass.into_iter().chain(overdraw).collect());
    assert_eq!((found.verdict, found.other_ways.len()), (Verdict::Holds, 1));
    assert_eq!(found.other_ways[0].verdict, Verdict::DoesNotHold);
}
