//! What light lists are to each other and to what is seen, light by light: every list has what its fragments need, none has
//! more than half spaces let pass, and what holds more cells has more lights.

use glam::DVec3;
use manylight::assign::{Clusters, Marking};
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::inputs::Inputs;
use manylight::lights::{Light, Lighting};
use manylight_tests::{METHODS, Run, methods, run_inputs};
use std::collections::BTreeMap;

const FRAME: u32 = 300;

fn config([scene, recording]: [&str; 2], names: &[&str]) -> Config {
    // In the hall they reach two metres: it would else be lit by all at once.
    let intensity = if scene == "hall" { 2.0 } else { 40.0 };
    let lights = vec![Lighting { intensity, ..Lighting::with_count(1500) }];
    Config {
        scene: scene.to_owned(),
        recording: recording.to_owned(),
        methods: methods(names),
        lights,
        resolution: [64, 40],
        marking: Marking::Depth,
        frames: FrameRange { first: FRAME, end: Some(FRAME + 1), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

const STREET: [&str; 2] = ["street", "bistro-vive"];
const HALL: [&str; 2] = ["hall", "hall"];

/// The runs of a configuration, and the lights of its frame.
fn runs(config: &Config) -> (Vec<Run>, Vec<Light>) {
    let inputs = Inputs::load(config).unwrap();
    let runs = run_inputs(config.clone(), &inputs);
    let mut source = inputs.light_source(&runs[0].planned.lights).unwrap();
    let lights = source.at_frame(FRAME).list.to_vec();
    (runs, lights)
}

/// The lists of a run's frame, by clustering and by the linear index of the cluster.
fn lists(run: &Run) -> Vec<BTreeMap<u32, &[u32]>> {
    let mut all = vec![];
    for (lists, counts) in run.lists.iter().zip(&run.counts[0].clusterings) {
        let clusters = counts.clusters.iter().enumerate();
        all.push(clusters.map(|(number, cluster)| (cluster.index, lists.list(number))).collect());
    }
    all
}

/// Checks the list of every pixel of a run; gives how many lights its pixels need together.
fn lists_have_what_is_needed(run: &Run, lights: &[Light]) -> usize {
    let lists = lists(run);
    let mut needed = 0;
    for (number, view) in run.images[0].1.iter().enumerate() {
        let of_view = &lists[number % lists.len()];
        for pixel in 0..view.depth.len() {
            let Some(place) = view.place(pixel) else { continue };
            // Where no leaf of an octree is, no light may be needed.
            let list = of_view.get(&view.cluster_index[pixel]).copied().unwrap_or_default();
            let reaches = |light: &Light| {
                // Depth that was rounded on the way here is off by less than this.
                let distance = DVec3::from_array(light.position.map(f64::from)).distance(place);
                distance < f64::from(light.r1) - 2e-3 && light.cone_part(place) > 1e-3
            };
            let of_pixel: Vec<u32> =
                (0..).zip(lights).filter(|(_, light)| reaches(light)).map(|(index, _)| index).collect();
            let lost = of_pixel.iter().find(|light| list.binary_search(light).is_err());
            assert_eq!(lost, None, "{} pixel {pixel} of view {number}", run.planned.name);
            needed += of_pixel.len();
        }
    }
    needed
}

#[test]
fn every_list_has_the_lights_that_its_pixels_need() {
    for (scene, spots) in [(STREET, 0.0), (HALL, 0.0), (STREET, 0.7)] {
        let spots = spots.try_into().unwrap();
        let (runs, lights) = runs(&Config { spots, ..config(scene, &METHODS[1..]) });
        let needed: Vec<usize> = runs.iter().map(|run| lists_have_what_is_needed(run, &lights)).collect();
        assert!(needed[0] > 500 && needed.iter().all(|&count| count == needed[0]), "{scene:?} {needed:?}");
    }
}

/// Whether every list of one run is part of the list of the same cluster of another.
fn assert_within(few: &Run, many: &Run) {
    for (few_lists, many_lists) in lists(few).iter().zip(&lists(many)) {
        for (cluster, list) in few_lists {
            let all = many_lists[cluster];
            let beyond = list.iter().find(|light| all.binary_search(light).is_err());
            assert_eq!(beyond, None, "{} has more than {}", few.planned.name, many.planned.name);
        }
    }
}

/// Half spaces let pass what any test does that begins with them or, by the planes' normals, contains them; and all tests let
/// pass what the exact one does.
#[test]
fn lists_lie_between_what_reaches_a_cluster_and_what_half_spaces_let_pass() {
    let names = ["indi-persp-64", "encl-ortho-4", "indi-displ-64-32", "t-e-28", "dc-e-64-40", "g-8"];
    for scene in [STREET, HALL] {
        let tests = ["hs", "exact", "hs+sat-n", "sat-p", "sat-epv"];
        let test = tests.map(|name| name.parse().unwrap()).to_vec();
        let (runs, _) = runs(&Config { test, exr: ExrFrames::List(vec![]), ..config(scene, &names) });
        for of_method in runs.chunks(tests.len()) {
            let [half_spaces, exact, ..] = of_method else { panic!("a run a test") };
            for run in of_method {
                assert_within(run, half_spaces);
                assert_within(exact, run);
            }
            assert!(exact.counts[0].light_indices() < half_spaces.counts[0].light_indices());
        }
    }
}

/// A rectangle in which a light is seen holds the light's projection, and no more than the half spaces of tiles let pass.
#[test]
fn rectangles_lie_between_what_reaches_a_cluster_and_what_half_spaces_let_pass() {
    let names = ["t-i-28", "t-e-16", "clustered-mm-32", "encl-persp-64", "indi-displ-64-32"];
    for scene in [STREET, HALL] {
        let test = ["hs", "mm", "exact"].map(|name| name.parse().unwrap()).to_vec();
        let (runs, _) = runs(&Config { test, exr: ExrFrames::List(vec![]), ..config(scene, &names) });
        for of_method in runs.chunks(3) {
            let [half_spaces, seen, exact] = of_method else { panic!("three tests") };
            assert_within(seen, half_spaces);
            assert_within(exact, seen);
        }
        let indices = |test: usize| -> u64 {
            runs.chunks(3).map(|of_method| of_method[test].counts[0].light_indices()).sum()
        };
        assert!(
            indices(2) < indices(1) && indices(1) < indices(0),
            "{scene:?}: {:?}",
            [0, 1, 2].map(indices)
        );
    }
}

/// A tile is the union of its clusters: they share their sides, and their slices leave no gap. So what half spaces or the exact
/// test find of it they find of one of these, and the other way round. Separating axes of a tile, which its clusters do not have,
/// may keep out what one of them lets pass.
#[test]
fn a_tile_has_the_lights_of_all_its_clusters() {
    for (scene, test) in [(HALL, "hs"), (STREET, "exact"), (HALL, "exact")] {
        let clusters = vec![Clusters::All.into()];
        let test = vec![test.parse().unwrap()];
        let config = config(scene, &["t-i-8", "dc-i-8-12", "dc-i-8-40"]);
        let (runs, _) = runs(&Config { test, clusters, exr: ExrFrames::List(vec![]), ..config });
        let tiles = lists(&runs[0]);
        for run in &runs[1..] {
            for (tiles, clusters) in tiles.iter().zip(lists(run)) {
                let mut united = vec![vec![]; tiles.len()];
                for (cluster, list) in clusters {
                    united[cluster as usize % tiles.len()].extend_from_slice(list);
                }
                for (tile, mut lights) in united.into_iter().enumerate() {
                    lights.sort_unstable();
                    lights.dedup();
                    assert_eq!(tiles[&(tile as u32)], lights, "{} tile {tile}", run.planned.name);
                }
            }
        }
        let indices = runs[0].counts[0].light_indices();
        assert!(indices > 200, "{scene:?}: {indices}");
    }
}
