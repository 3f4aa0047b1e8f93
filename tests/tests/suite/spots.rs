//! Spot lights, as users meet them: by every method the pictures of all lights, from rain, from a file, from a scene.

use manylight::assign::{Conservative, Marking};
use manylight::config::{Assign, Config, FrameRange};
use manylight::lights::Lighting;
use manylight::shading::ShadingPipeline;
use manylight_tests::program::{read, refused, small_unlit, succeed};
use manylight_tests::{assert_equal_the_truth, methods, methods_serving, run, three_frames};
use serde_json::Value;

fn config(recording: &str, msaa: u32, spots: f64) -> Config {
    Config {
        methods: methods_serving(msaa, Marking::Depth),
        lights: vec![Lighting { intensity: 40.0, ..Lighting::with_count(600) }],
        spots: spots.try_into().unwrap(),
        ..three_frames(recording, msaa, Marking::Depth, &[])
    }
}

#[test]
fn every_method_shades_spots_among_points_as_all_lights_do() {
    let pipeline = vec![ShadingPipeline::Forward, ShadingPipeline::Deferred];
    let runs = run(Config { pipeline, ..config("bistro", 1, 0.5) });
    let (forward, deferred): (Vec<_>, Vec<_>) =
        runs.into_iter().partition(|run| run.planned.config.pipeline == [ShadingPipeline::Forward]);
    assert_equal_the_truth(&forward, Marking::Depth);
    assert_equal_the_truth(&deferred, Marking::Depth);
    let [points, spots] = [0.0, 1.0].map(|part| {
        let names = methods(&["all-lights"]);
        let counts = run(Config { methods: names, ..config("bistro", 1, part) }).remove(0).counts;
        counts.iter().map(|frame| frame.counters.needed_computations).sum::<u64>()
    });
    let both: u64 = forward[0].counts.iter().map(|frame| frame.counters.needed_computations).sum();
    assert!(spots > 100 && spots < both && both < points, "{spots} {both} {points}");
}

#[test]
fn every_way_of_assignment_shades_spots_in_both_eyes_with_four_samples() {
    let names = [
        "all-lights",
        "indi-persp-32",
        "encl-ortho-4",
        "encl-displ-64-32",
        "sc-e-48-40",
        "g-20",
        "raster-16-9-24-e",
        "raster-12-6-32-l",
        "encl-raster-18-9-24-e",
    ];
    let assign = vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter];
    let frames = FrameRange { first: 340, end: Some(341), step: 1 };
    let runs = run(Config { methods: methods(&names), assign, frames, ..config("bistro-vive", 4, 1.0) });
    assert_equal_the_truth(&runs, Marking::Depth);
}

#[test]
fn meshes_of_any_detail_and_way_of_drawing_them_shade_spots_among_points() {
    let mesh_detail = ["12", "auto-0.25"].map(|detail| detail.parse().unwrap()).to_vec();
    let conservative = vec![Conservative::Software, Conservative::SoftwareLayers];
    let frames = FrameRange { first: 340, end: Some(341), step: 1 };
    let methods = methods(&["all-lights", "raster-16-9-24-e"]);
    let runs = run(Config { methods, mesh_detail, conservative, frames, ..config("bistro", 1, 0.5) });
    assert_eq!(runs.len(), 1 + 2 * 2);
    assert_equal_the_truth(&runs, Marking::Depth);
}

/// Cones are asked of cells of every shape, and of what is measured in them.
#[test]
fn tests_of_cones_lose_no_light_that_is_needed() {
    let names =
        ["all-lights", "indi-persp-32", "encl-ortho-4", "t-e-28", "dc-e-48-20", "tiled-mm-32", "g-20", "m"];
    let test = ["exact", "exact+cone-sat", "exact+cone"].map(|name| name.parse().unwrap()).to_vec();
    let frames = FrameRange { first: 340, end: Some(341), step: 1 };
    let runs = run(Config { methods: methods(&names), test, frames, ..config("bistro", 1, 0.8) });
    assert_equal_the_truth(&runs, Marking::Depth);
    for of_method in runs[1..].chunks(3) {
        let computed = |place: usize| -> u64 {
            of_method[place].counts.iter().map(|frame| frame.counters.lighting_computations).sum()
        };
        let [sphere, axes, exact] = [0, 1, 2].map(computed);
        assert!(exact <= axes && axes < sphere, "{}: {sphere} {axes} {exact}", of_method[0].planned.name);
    }
}

#[test]
fn replays_tell_which_part_are_spots_and_say_what_no_part_is() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("half");
    succeed(small_unlit(&out).args(["--lights", "40", "--spots", "0.5"]));
    let manifest: Value = serde_json::from_str(&read(out.join("indi-persp-64/run.json"))).unwrap();
    assert_eq!(manifest["generated"]["spots"], 0.5, "{manifest}");
    assert_eq!(manifest["config"]["spots"], 0.5);
    for wrong in ["1.5", "-1", "many"] {
        let told = refused(small_unlit(&directory.path().join("wrong")).args(["--spots", wrong]));
        assert!(told.contains("--spots"), "{told}");
    }
}

#[test]
fn files_bring_spots_beside_points() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("lights.csv");
    let header = "x,y,z,r,g,b,i,i0,r0,dx,dy,dz,inner,outer";
    std::fs::write(
        &file,
        format!("{header}\n0,6,0,1,1,1,60,0.5,0.1,0,-1,0,,25\n0,6,0,1,1,1,60,0.5,0.1,,,,,\n"),
    )
    .unwrap();
    let path = file.to_str().unwrap();
    succeed(small_unlit(&directory.path().join("out")).args(["--lights-file", path]));
    std::fs::write(&file, format!("{header}\n0,6,0,1,1,1,60,0.5,0.1,0,-1,0,,125\n")).unwrap();
    let told = refused(small_unlit(&directory.path().join("wrong")).args(["--lights-file", path]));
    assert!(told.contains("line 2, column outer: 125 is not a half angle"), "{told}");
}
