//! Groups that do not depend on the views: pictures are those over all lights, lists are their twins', and the same from
//! wherever one looks.

use glam::DVec3;
use manylight::assign::{Clusters, Marking};
use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::cpu::Visible;
use manylight::culling::Culling;
use manylight::engine::plan_frames;
use manylight::geometry::SphereTest;
use manylight::inputs::Inputs;
use manylight::lights::Lighting;
use manylight::measure::{ClusterLists, ViewPixels};
use manylight::methods::grid::twin;
use manylight::methods::{GridBox, Scenery};
use manylight::output::planned_runs;
use manylight::still::{self, Item, Show, Viewpoint};
use manylight_tests::scenes::write_lights;
use manylight_tests::{Run, assert_equal_the_truth, methods, run, three_frames};
use std::collections::BTreeSet;
use std::path::Path;

const METHODS: [&str; 3] = ["all-lights", "g-20", "m"];

/// Methods whose lists are the same whatever the views are.
const APART: [&str; 3] = ["g-20", "m", "hashed-2m-3"];

fn config(scene: &str, recording: &str) -> Config {
    Config { scene: scene.into(), ..three_frames(recording, 1, Marking::Depth, &METHODS) }
}

/// Checks pictures and counts of every run against those of the first, over all lights.
fn equal_the_truth(runs: &[Run], marking: Marking) {
    assert_equal_the_truth(runs, marking);
    for run in &runs[1..] {
        let one_each = run.counts.iter().all(|counts| counts.clusterings.len() == 1);
        assert!(one_each, "{}: one clustering serves all views", run.planned.name);
    }
}

fn check(config: Config) {
    let marking = config.marking;
    equal_the_truth(&run(config), marking);
}

#[test]
fn one_sample_in_stereo() {
    check(config("street", "bistro-vive"));
}

#[test]
fn four_samples() {
    check(Config { msaa: 4, ..config("street", "bistro") });
}

#[test]
fn four_samples_in_stereo() {
    check(Config { msaa: 4, ..config("temple", "suntem-vive") });
}

/// What is shaded at the centre of its pixel may lie off its model, but not off its cell.
#[test]
fn four_samples_in_stereo_shaded_by_fragment() {
    let methods = methods(&METHODS[..2]);
    check(Config { methods, msaa: 4, marking: Marking::Geometry, ..config("temple", "suntem-vive") });
}

#[test]
fn views_in_mirrors_drawn_at_once() {
    let frames = FrameRange { first: 140, end: Some(141), step: 1 };
    for (culling, multiview) in [(Culling::Cpu, true), (Culling::Gpu, false)] {
        let config = config("street", "bistro-mirror");
        let methods = methods(&["all-lights", "g-20", "m", "hashed-1-3"]);
        check(Config { methods, multiview, culling, frames, resolution: [56, 56], ..config });
    }
}

#[test]
fn the_box_of_all_geometry_loses_nothing_either() {
    let lights = vec![Lighting { count: 500, intensity: 40.0, cutoff: 0.5, r0: 0.1 }];
    let of = |grid_box| run(Config { grid_box, lights: lights.clone(), ..config("street", "bistro") });
    let (around_lights, around_scene) = (of(GridBox::Lights), of(GridBox::Scene));
    equal_the_truth(&around_scene, Marking::Depth);
    assert_ne!(around_lights[1].lists, around_scene[1].lists, "the boxes differ");
}

/// A frame's lists that every way of assignment makes.
#[test]
fn every_way_of_assignment_makes_the_same_lists() {
    let assign = vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter];
    let frames = FrameRange { first: 100, end: Some(101), step: 1 };
    let names = methods(&METHODS[1..]);
    let runs = run(Config { methods: names, assign, frames, ..config("temple", "suntem-vive") });
    for ways in runs.chunks(3) {
        for run in ways {
            assert_eq!(run.lists, ways[0].lists, "{}", run.planned.name);
            assert!(run.lists[0].indices.len() > 1000, "{}", run.planned.name);
        }
    }
}

/// The lists of these methods, one of each frame.
fn lists_seen_from(recording: &str, lights: &Path) -> Vec<Vec<ClusterLists>> {
    let config = Config {
        methods: methods(&APART),
        lights: vec![],
        lights_file: Some(lights.into()),
        exr: ExrFrames::List(vec![]),
        ..config("street", recording)
    };
    run(config).into_iter().map(|run| run.lists).collect()
}

#[test]
fn lists_do_not_depend_on_the_view() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("lights.csv");
    // In the street and around it.
    write_lights(&file, 600, [[-40.0, -1.0, -40.0], [40.0, 12.0, 40.0]], (23, 23.0));
    let seen = ["bistro", "bistro-vive", "suntem"].map(|recording| lists_seen_from(recording, &file));
    for (method, name) in APART.iter().enumerate() {
        let first = &seen[0][method][0];
        assert!(first.indices.len() > 2000, "{name}");
        for lists in seen.iter().flat_map(|recording| &recording[method]) {
            assert_eq!((&lists.offsets, &lists.indices), (&first.offsets, &first.indices), "{name}");
        }
    }
}

/// Whoever looks on from elsewhere sees a group with its lights at every pixel: none is without.
#[test]
fn an_onlooker_sees_a_group_wherever_there_is_something() {
    let frames = FrameRange { first: 300, end: Some(301), step: 1 };
    for name in &METHODS[1..] {
        let config =
            Config { methods: methods(&[name]), frames, validate: true, ..config("street", "bistro") };
        let inputs = Inputs::load(&config).unwrap();
        let show = Show::from_items(&[Item::LightCount, Item::Frusta, Item::Missing], None).unwrap();
        for view in [None, Some("birdseye")] {
            let run = &planned_runs(&config)[0];
            let seen = still::render(&inputs, run, Viewpoint::Named(view), &show).unwrap().pixels;
            let groups = seen.cluster_index.iter().zip(&seen.depth);
            assert!(
                groups.into_iter().all(|(&group, depth)| (group == u32::MAX) == depth.is_infinite()),
                "{name}"
            );
            let kinds: BTreeSet<u32> = seen.cluster_index.iter().copied().collect();
            assert!(kinds.len() > 8, "{name} {view:?}: {}", kinds.len());
            assert!(seen.light_count.iter().any(|&count| count > 0));
        }
    }
}

/// Pixels of one view whose cell is not the twin's, for what is farther than a millimetre from where cells meet.
fn wrong_cells(view: &ViewPixels, cell_of: impl Fn(DVec3) -> Option<u32>) -> usize {
    let wrong = |&pixel: &usize| {
        view.place(pixel).and_then(&cell_of).is_some_and(|cell| cell != view.cluster_index[pixel])
    };
    (0..view.depth.len()).filter(wrong).count()
}

#[test]
fn cells_and_lists_of_a_world_grid_are_their_twins() {
    let config = Config {
        methods: methods(&["g-20"]),
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        clusters: vec![Clusters::Visible.into()],
        ..config("street", "bistro")
    };
    let run = &run(config.clone())[0];
    let inputs = Inputs::load(&config).unwrap();
    let mut source = inputs.light_source(&run.planned.lights).unwrap();
    let lights = source.at_frame(300).list;
    let around = Scenery { lights, scene: inputs.scene.bounds(), models: 0, grid_box: config.grid_box };
    let plan = plan_frames(&config, &inputs.recording).unwrap().remove(0);
    let grid = plan.settled(config.methods[0], &around).grids[0];
    let clusters: Vec<u32> = (0..8000).collect();
    assert_eq!(run.counts[0].clusterings[0].visible_clusters, 8000, "all cells have lists");
    let listed = Visible { grid: &grid, clusters: &clusters };
    let lists = twin::light_lists(listed, lights, SphereTest::Box, 2e-3);
    for cell in 0..8000 {
        let close = &lists.borderline[cell];
        let sure = |list: &[u32]| -> Vec<u32> {
            list.iter().copied().filter(|light| !close.contains(light)).collect()
        };
        assert_eq!(sure(run.lists[0].list(cell)), sure(lists.list(cell)), "cell {cell}");
    }
    assert!(lists.indices.len() > 3000);
    let cell_of = |world: DVec3| {
        let local = grid.pose.inverse_transform_point(world);
        let near = |sign: f64| grid.nearest_cluster(local + DVec3::splat(sign * 1e-3));
        let cell = near(0.0)?;
        (near(-1.0) == near(1.0)).then(|| grid.linear(cell))
    };
    assert_eq!(wrong_cells(&run.images[0].1[0], cell_of), 0);
}
