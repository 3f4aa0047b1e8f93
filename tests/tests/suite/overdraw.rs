//! Shading with overdraw: what is seen is what it is after a prepass, to the bit, and found in the same groups; what is shaded
//! beside is counted as hidden. Methods whose groups do not come from what is seen draw no prepass.

use manylight::assign::{Clusters, Marking};
use manylight::config::{Config, ExrFrames, FrameRange, Scopes};
use manylight::culling::Culling;
use manylight::lights::Lighting;
use manylight::measure::DeviceCounts;
use manylight::shading::{Shading, ShadingPipeline};
use manylight_tests::scenes::{Quad, recording, write_quads};
use manylight_tests::{Run, assert_equal_the_truth, methods, run, three_frames};

const METHODS: [&str; 7] =
    ["all-lights", "indi-persp-64", "t-e-28", "sc-e-48-40", "dc-i-128-64", "g-20", "m"];

fn config(recording: &str, msaa: u32, marking: Marking) -> Config {
    Config {
        shading: vec![Shading::Prepass, Shading::Overdraw],
        ..three_frames(recording, msaa, marking, &METHODS)
    }
}

/// Runs a configuration, whose first method is over all lights, and compares every run with that of all lights after a prepass,
/// and with that of its own method after one.
fn check(config: Config) -> Vec<Run> {
    let marking = config.marking;
    let runs = run(config);
    assert_equal_the_truth(&runs, marking);
    for pair in runs.chunks(2) {
        let [prepass, overdraw] = pair else { panic!("two runs a method") };
        let name = &overdraw.planned.name;
        assert_eq!(prepass.planned.method, overdraw.planned.method);
        assert!(prepass.images == overdraw.images, "{name}: pictures");
        assert!(prepass.lists == overdraw.lists, "{name}: lists");
        let hidden: u64 = overdraw.counts.iter().map(|counts| counts.counters.fragments_hidden).sum();
        assert!(hidden > 1000, "{name}: {hidden}");
        for (before, counts) in prepass.counts.iter().zip(&overdraw.counts) {
            let (before, counts) = (&before.counters, &counts.counters);
            assert_eq!(before.fragments_hidden, 0, "{name}");
            let seen = counts.fragments_shaded - counts.fragments_hidden;
            assert_eq!(seen, before.fragments_shaded, "{name}");
            assert!(counts.lighting_computations >= before.lighting_computations, "{name}");
        }
    }
    runs
}

#[test]
fn mono() {
    check(config("bistro", 1, Marking::Depth));
}

#[test]
fn stereo_marked_from_geometry() {
    let names = ["all-lights", "encl-persp-64", "dc-e-64-40"];
    check(Config { methods: methods(&names), ..config("bistro-vive", 1, Marking::Geometry) });
}

/// Leaves that are cut out.
#[test]
fn four_samples() {
    check(Config { scene: "temple".to_owned(), ..config("suntem", 4, Marking::Depth) });
}

#[test]
fn four_samples_in_stereo_marked_from_geometry() {
    let names = ["all-lights", "indi-persp-64", "g-20"];
    check(Config { methods: methods(&names), ..config("bistro-vive", 4, Marking::Geometry) });
}

/// Columns before columns, cloths, panes of glass.
#[test]
fn the_hall() {
    check(Config {
        scene: "hall".to_owned(),
        methods: methods(&["all-lights", "sc-e-48-40", "m"]),
        lights: vec![Lighting { count: 400, intensity: 2.0, cutoff: 0.5, r0: 0.1 }],
        frames: FrameRange { first: 300, end: Some(831), step: 265 },
        ..config("hall", 1, Marking::Depth)
    });
}

/// Whatever is drawn with views one by one is drawn with all at once, and culled on the host.
#[test]
fn all_views_at_once() {
    for (msaa, culling) in [(1, Culling::Gpu), (4, Culling::Cpu)] {
        let of = |multiview| {
            check(Config {
                methods: methods(&["all-lights", "encl-persp-64", "sc-e-48-40"]),
                multiview,
                culling,
                frames: FrameRange { first: 300, end: Some(301), step: 1 },
                ..config("bistro-vive", msaa, Marking::Depth)
            })
        };
        for (single, at_once) in of(false).iter().zip(&of(true)) {
            let name = &single.planned.name;
            assert_eq!(single.counts, at_once.counts, "{name}: counters");
            assert!(single.images == at_once.images, "{name}: images");
        }
    }
}

/// The quads of a square of `side` metres at each distance, in the order in which they are drawn.
fn squares(distances: &[(f32, f32)]) -> Vec<Quad> {
    let square = |&(distance, side): &(f32, f32)| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]: [f32; 2]| [side * x, side * y, -distance])
    };
    distances.iter().map(square).collect()
}

/// What is counted of squares under one light by all lights and by clusters that hold something visible, with overdraw.
fn counted(distances: &[(f32, f32)], pipeline: ShadingPipeline) -> [DeviceCounts; 2] {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    write_quads(&path("squares.gltf"), &squares(distances), [0.0; 3], &[([0.5, 0.0, -1.0], 50.0)]);
    let head = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0];
    let seen = recording([0.1, 100.0], head, [[-1.0; 3], [1.0; 3]], &[]);
    std::fs::write(path("still.json"), seen.to_string()).unwrap();
    let text = |name: &str| path(name).to_str().unwrap().to_owned();
    let runs = run(Config {
        scene: text("squares.gltf"),
        recording: text("still.json"),
        methods: methods(&["all-lights", "sc-e-12-40"]),
        shading: vec![Shading::Overdraw],
        pipeline: vec![pipeline],
        lights: vec![],
        scene_lights: true,
        resolution: [64, 64],
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        runs: 0.into(),
        ..Config::default()
    });
    [0, 1].map(|run| runs[run].counts[0].counters)
}

/// (Fragments shaded, hidden) of squares, by both methods.
fn shaded(distances: &[(f32, f32)], pipeline: ShadingPipeline) -> [(u64, u64); 2] {
    counted(distances, pipeline).map(|counts| (counts.fragments_shaded, counts.fragments_hidden))
}

#[test]
fn what_is_drawn_behind_is_not_shaded_and_what_is_drawn_over_is_hidden() {
    let shaded = |distances: &[(f32, f32)]| shaded(distances, ShadingPipeline::Forward);
    let [alone, far] = [&[(2.0, 0.25)][..], &[(4.0, 1.0)]].map(|square| shaded(square)[0]);
    assert!(alone.0 > 20 && far.0 > 2 * alone.0 && (alone.1, far.1) == (0, 0), "{alone:?} {far:?}");
    // The near square hides as much as it covers, and is hidden by nothing.
    assert_eq!(shaded(&[(2.0, 0.25), (4.0, 1.0)]), [(far.0, 0); 2]);
    assert_eq!(shaded(&[(4.0, 1.0), (2.0, 0.25)]), [(far.0 + alone.0, alone.0); 2]);
    // Of surfaces at one depth the last is seen; all of them are found at that depth.
    assert_eq!(shaded(&[(4.0, 1.0), (4.0, 1.0)]), [(2 * far.0, 0); 2]);
}

#[test]
fn deferred_shading_evaluates_lights_once_for_what_is_seen() {
    let shaded = |distances: &[(f32, f32)]| shaded(distances, ShadingPipeline::Deferred);
    let far = shaded(&[(4.0, 1.0)]);
    assert!(far[0].0 > 100 && far == [(far[0].0, 0); 2], "{far:?}");
    for distances in [[(2.0, 0.25), (4.0, 1.0)], [(4.0, 1.0), (2.0, 0.25)], [(4.0, 1.0), (4.0, 1.0)]] {
        assert_eq!(shaded(&distances), far, "{distances:?}");
    }
}

/// A square that is hidden altogether lies in clusters that nobody sees: it is shaded by none of the lights on the lists of others.
#[test]
fn what_finds_no_group_has_no_lights() {
    let near = counted(&[(2.0, 1.0)], ShadingPipeline::Forward);
    let over = counted(&[(4.0, 1.0), (2.0, 1.0)], ShadingPipeline::Forward);
    let evaluated = |counts: [DeviceCounts; 2]| counts.map(|counts| counts.lighting_computations);
    let ([all, clustered], shaded) = (evaluated(over), near[0].fragments_shaded + over[0].fragments_hidden);
    assert!(over[0].fragments_hidden > 100 && over[0].fragments_hidden == over[1].fragments_hidden);
    assert_eq!((all, evaluated(near)), (shaded, [near[0].fragments_shaded; 2]));
    assert_eq!((clustered, over[1].fragments_shaded), (near[0].fragments_shaded, shaded));
}

/// Stages of a run's last frame.
fn stages(run: &Run) -> Vec<&str> {
    run.times[0].stages.iter().map(|stage| stage.stage.as_str()).collect()
}

#[test]
fn there_is_no_prepass_but_where_groups_come_from_it() {
    let runs = run(Config {
        methods: methods(&METHODS),
        clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
        shading: vec![Shading::Overdraw],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 1.into(),
        exr: ExrFrames::List(vec![]),
        ..config("bistro-vive", 1, Marking::Depth)
    });
    let has_prepass = |run: &Run| stages(run).iter().any(|path| path.contains("depth"));
    let with: Vec<&str> =
        runs.iter().filter(|run| has_prepass(run)).map(|run| run.planned.name.as_str()).collect();
    // Measured bounds need it even where nothing is marked.
    let expected = [
        "indi-persp-64_visible",
        "t-e-28_visible",
        "t-e-28_all",
        "sc-e-48-40_visible",
        "sc-e-48-40_all",
        "dc-i-128-64_visible",
    ];
    assert_eq!(with, expected);
    assert_eq!(runs.len(), 1 + 2 * 4 + 2);
    assert!(runs.iter().all(|run| stages(run).contains(&"frame/shade[0]/masked")));
}

/// No barrier but those that passes derive: timestamps of single stages, whose barriers would hide a missing one, are left out.
#[test]
fn validation_is_silent() {
    for (recording, msaa, marking, multiview) in
        [("bistro-vive", 1, Marking::Depth, true), ("bistro", 4, Marking::Depth, false)]
    {
        let runs = run(Config {
            methods: methods(&["all-lights", "encl-persp-64", "sc-e-48-40"]),
            shading: vec![Shading::Overdraw],
            multiview,
            resolution: [48, 32],
            scopes: Scopes::Frame,
            frames: FrameRange { first: 290, end: Some(320), step: 10 },
            runs: 1.into(),
            exr: ExrFrames::List(vec![300]),
            ..config(recording, msaa, marking)
        });
        assert!(runs.iter().all(|run| run.times.iter().all(|frame| frame.stages[0].gpu_ms > 0.0)));
    }
}
