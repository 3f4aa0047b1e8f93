//! Whatever decides who is on a light list, and however the list is built: no light is lost that a fragment needs, and
//! lists are the same by all ways.

use manylight::config::{Assign, Config, FrameRange};
use manylight::lights::Lighting;
use manylight_tests::{METHODS, Run, methods, run};

const TESTS: [&str; 4] = ["hs", "hs+sat-n", "sat-epv", "exact"];

/// Brute force, and the methods whose lists the device assigns lights to: trees have no such tests.
fn names() -> impl Iterator<Item = &'static str> {
    METHODS.into_iter().filter(|name| !methods(&[name])[0].has_octree())
}

fn lightings() -> Vec<Lighting> {
    [(60, 100.0), (600, 20.0), (20_000, 4.0)]
        .map(|(count, intensity)| Lighting { intensity, ..Lighting::with_count(count) })
        .to_vec()
}

fn runs(recording: &str, assign: Vec<Assign>, lights: Vec<Lighting>) -> Vec<Run> {
    run(Config {
        recording: recording.to_owned(),
        methods: methods(&names().collect::<Vec<_>>()),
        lights,
        assign,
        test: TESTS.map(|name| name.parse().unwrap()).to_vec(),
        // The boxes of models are asked by the exact test alone.
        exclude: vec!["method=m,test=hs*|sat*".parse().unwrap()],
        resolution: [48, 32],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 0.into(),
        ..Config::default()
    })
}

/// How many tests ask for a method's lists; once without lists.
fn asked(name: &str) -> usize {
    if name == "m" || !assigns(name) { 1 } else { TESTS.len() }
}

/// Whether the device assigns lights to a method's lists, so that tests and ways bear on it.
fn assigns(name: &str) -> bool {
    methods(&[name])[0].assigns()
}

/// Runs that differ from `of` in their test or way alone, by what they found.
fn siblings<'a>(runs: &'a [Run], of: &'a Run) -> impl Iterator<Item = &'a Run> {
    let axes = |run: &Run| (run.planned.method, run.planned.lights.clone());
    runs.iter().filter(move |run| axes(run) == axes(of))
}

fn no_needed_light_is_lost(recording: &str) {
    let runs = runs(recording, vec![Assign::Hierarchy], lightings());
    assert_eq!(runs.len(), 3 * names().map(asked).sum::<usize>());
    for of_lighting in runs.chunk_by(|a, b| a.planned.lights == b.planned.lights) {
        let needed = of_lighting[0].counts[0].counters.needed_computations;
        assert!(needed > 100, "next to nothing is lit");
        for run in of_lighting {
            assert_eq!(
                run.counts[0].counters.needed_computations, needed,
                "{} lost a light",
                run.planned.name
            );
        }
    }
    for run in runs.iter().filter(|run| run.planned.name.ends_with("_exact")) {
        let exact = run.counts[0].light_indices();
        let least = siblings(&runs, run).map(|other| other.counts[0].light_indices()).min();
        assert_eq!(least, Some(exact), "{}: another test has fewer", run.planned.name);
    }
}

fn lists_are_the_same_by_all_ways(recording: &str) {
    let ways = vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter];
    let runs = runs(recording, ways, lightings()[1..2].to_vec());
    let hashes = |run: &Run| -> Vec<u64> {
        run.counts[0].clusterings.iter().map(|clustering| clustering.lists_hash).collect()
    };
    let mut compared = 0;
    for run in &runs {
        for other in siblings(&runs, run).filter(|other| other.planned.test == run.planned.test) {
            assert_eq!(hashes(run), hashes(other), "{} and {}", run.planned.name, other.planned.name);
            compared += 1;
        }
    }
    let (assigned, others): (Vec<&str>, Vec<&str>) = names().partition(|name| assigns(name));
    assert_eq!(compared, others.len() + 9 * assigned.iter().map(|name| asked(name)).sum::<usize>());
}

#[test]
fn no_needed_light_is_lost_in_mono() {
    no_needed_light_is_lost("bistro");
}

#[test]
fn no_needed_light_is_lost_in_stereo() {
    no_needed_light_is_lost("bistro-vive");
}

#[test]
fn lists_are_the_same_by_all_ways_in_mono() {
    lists_are_the_same_by_all_ways("bistro");
}

#[test]
fn lists_are_the_same_by_all_ways_in_stereo() {
    lists_are_the_same_by_all_ways("bistro-vive");
}
