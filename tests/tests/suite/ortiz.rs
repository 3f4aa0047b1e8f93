//! Ortiz's recipe: tiles and slices by their number, tested as boxes that are built where the projection changes. Pictures and
//! counts are those of all lights.

use manylight::assign::{Bounds, Clusters, Marking};
use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::geometry::{SliceLaw, SphereTest};
use manylight::lights::Lighting;
use manylight_tests::program::{refused, small};
use manylight_tests::scenes::recording;
use manylight_tests::{Run, assert_equal_the_truth, run, three_frames};
use std::path::Path;

const NAME: &str = "ortiz-16-9-24";

fn config(scene: &str, recording: &str, names: &[&str]) -> Config {
    Config { scene: scene.into(), ..three_frames(recording, 1, Marking::Depth, names) }
}

/// Visible clusters and all, by boxes and by the pieces of the frustum themselves.
fn alike(scene: &str, recording: &str, msaa: u32, marking: Marking) {
    let runs = run(Config {
        msaa,
        marking,
        clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
        test: vec![SphereTest::Box.into(), SphereTest::Exact.into()],
        ..config(scene, recording, &["all-lights", NAME])
    });
    assert_eq!(runs.len(), 1 + 4);
    assert_equal_the_truth(&runs, marking);
}

#[test]
fn mono() {
    alike("street", "bistro", 1, Marking::Depth);
}

#[test]
fn mono_with_four_samples() {
    alike("street", "bistro", 4, Marking::Depth);
}

#[test]
fn stereo_marked_from_geometry() {
    alike("street", "bistro-vive", 1, Marking::Geometry);
}

#[test]
fn stereo_with_four_samples() {
    alike("temple", "suntem-vive", 4, Marking::Depth);
}

#[test]
fn the_hall_whose_veils_are_transparent() {
    alike("hall", "hall", 1, Marking::Depth);
}

#[test]
fn views_in_mirrors() {
    alike("street", "bistro-mirror", 1, Marking::Depth);
}

#[test]
fn any_slices_and_measured_clusters_are_tested_as_boxes() {
    let laws = SliceLaw::EXAMPLES.map(Into::into).to_vec();
    let frames = FrameRange { first: 300, end: Some(301), step: 1 };
    let config = config("street", "bistro-vive", &["all-lights", NAME]);
    let bounds = vec![Bounds::Implicit.into(), Bounds::Measured.into()];
    assert_equal_the_truth(&run(Config { slices: laws, bounds, frames, ..config }), Marking::Depth);
}

fn indices(run: &Run) -> usize {
    run.lists.iter().map(|lists| lists.indices.len()).sum()
}

#[test]
fn lists_are_the_same_by_all_ways_and_hold_those_of_the_exact_test() {
    let runs = run(Config {
        assign: vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter],
        test: vec![SphereTest::Box.into(), SphereTest::Exact.into()],
        lights: vec![Lighting { intensity: 20.0, ..Lighting::with_count(3000) }],
        exr: ExrFrames::List(vec![]),
        ..config("street", "bistro-vive", &[NAME])
    });
    let (boxed, exact): (Vec<&Run>, Vec<&Run>) =
        runs.iter().partition(|run| run.planned.test == SphereTest::Box.into());
    for ways in [&boxed, &exact] {
        assert_eq!(ways.len(), 3);
        assert!(ways.iter().all(|run| run.lists == ways[0].lists));
    }
    let [boxed, exact] = [boxed[0], exact[0]];
    for (many, few) in boxed.lists.iter().zip(&exact.lists) {
        assert_eq!(many.offsets.len(), few.offsets.len());
        for cluster in 0..many.offsets.len() - 1 {
            let all = many.list(cluster);
            assert!(few.list(cluster).iter().all(|light| all.binary_search(light).is_ok()));
        }
    }
    assert!(indices(exact) > 1000 && indices(exact) < indices(boxed));
}

/// The same grid, whose slices are found by a logarithm and a sum, and by the logarithm of a ratio.
#[test]
fn a_sum_finds_the_clusters_that_a_ratio_finds() {
    for (recording, msaa) in [("bistro", 1), ("bistro-vive", 4)] {
        let runs = run(Config {
            resolution: [320, 180],
            test: vec![SphereTest::Exact.into()],
            msaa,
            ..config("street", recording, &[NAME, "sc-i-20-24"])
        });
        let [by_sum, by_ratio] = &runs[..] else { panic!("two runs") };
        assert_eq!(by_sum.counts[0].clusterings[0].dimensions, [16, 9, 24]);
        assert_eq!(by_sum.counts, by_ratio.counts);
        assert_eq!(by_sum.lists, by_ratio.lists);
        for ((_, views), (_, others)) in by_sum.images.iter().zip(&by_ratio.images) {
            for (view, other) in views.iter().zip(others) {
                assert!(view.cluster_index == other.cluster_index, "{recording}");
                assert!(view.cluster_index.iter().any(|&cluster| cluster != u32::MAX));
            }
        }
    }
}

/// Writes a recording whose fields of view are these, frame by frame.
fn write_fields_of_view(path: &Path, fields: &[f64]) {
    let head = |fov: f64| [0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, fov];
    let mut value = recording([0.4, 100.0], head(1.2), [[-20.0; 3], [20.0; 3]], &[]);
    value["frames"] = fields.iter().map(|&fov| serde_json::json!(head(fov))).collect();
    std::fs::write(path, value.to_string()).unwrap();
}

#[test]
fn boxes_are_built_in_frames_that_see_through_another_frustum() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("zoom.json");
    write_fields_of_view(&path, &[1.2, 1.2, 0.9, 0.9, 1.2]);
    for (test, building) in [(SphereTest::Box, &[2, 4][..]), (SphereTest::Exact, &[])] {
        let run = run(Config {
            test: vec![test.into()],
            frames: FrameRange { first: 0, end: None, step: 1 },
            runs: 2.into(),
            exr: ExrFrames::List(vec![]),
            ..config("street", path.to_str().unwrap(), &[NAME])
        })
        .remove(0);
        assert_eq!(run.times.len(), 10);
        for frame in &run.times {
            let stages = frame.stages.iter().filter(|stage| stage.stage == "frame/cluster[0]/build_boxes");
            let expected = usize::from(building.contains(&frame.frame));
            assert_eq!(stages.count(), expected, "{test}, run {} frame {}", frame.run, frame.frame);
            assert!(frame.stages.iter().any(|stage| stage.stage == "frame/shade[0]"));
        }
    }
}

#[test]
fn counts_that_cannot_be_are_refused_in_one_line() {
    let out = tempfile::tempdir().unwrap();
    for name in ["ortiz", "ortiz-16-9", "ortiz-16-9-0", "ortiz-0-9-24", "ortiz-16.5-9-24", "ortiz-16-9-24-2"]
    {
        let message = refused(small(out.path()).args(["--method", name]));
        assert!(message.contains("'ortiz-16-9-24'"), "{message}");
    }
    let message = refused(small(out.path()).args(["--method", "ortiz-4000-4000-100"]));
    assert!(
        message.contains("4000 x 4000 x 100 clusters") && message.contains("larger clusters"),
        "{message}"
    );
    let message = refused(small(out.path()).args(["--method", "ortiz-16-9-200000"]));
    assert!(message.contains("200000 slices"), "{message}");
    let message = refused(small(out.path()).args(["--method", "sc-i-48-40", "--test", "box"]));
    assert!(message.contains("are no boxes"), "{message}");
}
