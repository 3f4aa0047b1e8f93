//! Normal cones: lights behind all samples of a cluster get onto no list, and pictures are the same to the bit.

use manylight::assign::{Bounds, Marking};
use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::geometry::NormalCones;
use manylight::lights::Attenuation;
use manylight::material::MaterialModel;
use manylight::shading::{Shading, ShadingPipeline};
use manylight_tests::program::refused;
use manylight_tests::{Run, manylight, run, three_frames};

fn cones(divisions: &[&str]) -> Vec<NormalCones> {
    divisions.iter().map(|divisions| divisions.parse().unwrap()).collect()
}

/// A frame by methods that measure, forward and deferred, without cones and with some.
fn config(scene: &str, recording: &str, msaa: u32, names: &[&str]) -> Config {
    Config {
        scene: scene.into(),
        bounds: vec![Bounds::Measured.into()],
        normal_cones: cones(&["0", "3"]),
        pipeline: vec![ShadingPipeline::Forward, ShadingPipeline::Deferred],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        ..three_frames(recording, msaa, Marking::Depth, names)
    }
}

fn sum(run: &Run, of: impl Fn(&manylight::measure::FrameCounts) -> u64) -> u64 {
    run.counts.iter().map(of).sum()
}

/// Compares a run with the same one without cones; gives how many lights it skipped.
fn compare(run: &Run, without: &Run) -> u64 {
    let name = &run.planned.name;
    for ((_, views), (_, others)) in run.images.iter().zip(&without.images) {
        let same = views.iter().zip(others).all(|(view, other)| view.color == other.color);
        assert!(same && !views.is_empty(), "{name} has other pictures than {}", without.planned.name);
    }
    let indices = |run: &Run| sum(run, |frame| frame.clusterings.iter().map(|one| one.light_indices).sum());
    let computations = |run: &Run| sum(run, |frame| frame.counters.lighting_computations);
    let skipped = sum(run, |frame| frame.counters.lights_skipped);
    assert_eq!(sum(without, |frame| frame.counters.lights_skipped), 0);
    assert_eq!(indices(without) - indices(run), skipped, "{name}: what is skipped is not on lists");
    assert_eq!(skipped > 0, computations(run) < computations(without), "{name}: {skipped}");
    for (run, without) in run.counts.iter().zip(&without.counts) {
        let (run, without) = (&run.counters, &without.counters);
        assert_eq!(run.fragments_without_cluster, 0, "{name}");
        assert_eq!(run.fragments_shaded, without.fragments_shaded, "{name}");
        assert_eq!(run.intersection_tests, without.intersection_tests, "{name}");
    }
    skipped
}

/// Compares every run with cones with the one without, of which the first skips some lights; gives what each skipped.
fn check(config: Config) -> Vec<u64> {
    let runs = run(config);
    let is_without = |run: &Run| run.planned.config.normal_cones == [NormalCones::OFF];
    let rest = |run: &Run| Config { normal_cones: vec![], ..run.planned.config.clone() };
    let with: Vec<&Run> = runs.iter().filter(|run| !is_without(run)).collect();
    let find = |run: &Run| runs.iter().find(|other| is_without(other) && rest(other) == rest(run));
    let skipped: Vec<u64> =
        with.iter().map(|run| compare(run, find(run).expect("the same without cones"))).collect();
    assert!(!with[0].images.is_empty() && skipped[0] > 0, "{skipped:?}");
    skipped
}

#[test]
fn every_family() {
    let names = ["sc-e-48-40", "t-e-28", "clustered-mm-16", "encl-ortho-4", "ortiz-16-9-24"];
    let skipped = check(Config {
        normal_cones: cones(&["0", "1", "2", "3"]),
        pipeline: vec![ShadingPipeline::Forward],
        ..config("street", "bistro", 1, &names)
    });
    // The depths of a tile alone make a large ball, which hardly any light lies behind.
    let some = skipped.chunks(3).filter(|of_method| of_method.iter().all(|&count| count > 0)).count();
    assert!(some >= 4, "{skipped:?}");
}

#[test]
fn stereo_with_four_samples() {
    check(Config { multiview: true, ..config("street", "bistro-vive", 4, &["encl-persp-64"]) });
}

/// Leaves have two sides, and some are seen in a mirror.
#[test]
fn cut_out_and_mirrored() {
    check(config("temple", "suntem", 4, &["sc-e-48-40"]));
    check(config("street", "bistro-mirror", 1, &["indi-persp-64"]));
}

/// Veils are transparent, and hidden surfaces shaded.
#[test]
fn seen_through_and_drawn_over() {
    check(Config { shading: vec![Shading::Overdraw], ..config("hall", "hall", 1, &["clustered-mm-4"]) });
}

#[test]
fn marked_from_geometry_at_the_centre_of_pixels() {
    let pipeline = vec![ShadingPipeline::Forward];
    check(Config { marking: Marking::Geometry, pipeline, ..config("street", "bistro", 4, &["sc-e-48-40"]) });
}

#[test]
fn a_white_material() {
    let white = config("street", "bistro", 1, &["tiled-16"]);
    check(Config { material: MaterialModel::White, attenuation: Attenuation::Tegelaers, ..white });
}

#[test]
fn every_way_has_the_lists_of_brute_force() {
    let ways = vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter, Assign::Rectangles];
    let pipeline = vec![ShadingPipeline::Forward];
    let mixed = config("street", "bistro", 1, &["clustered-mm-12"]);
    let runs = run(Config { normal_cones: cones(&["2"]), assign: ways, pipeline, ..mixed });
    let skipped = |run: &Run| sum(run, |frame| frame.counters.lights_skipped);
    assert!(skipped(&runs[0]) > 0);
    for other in &runs[1..] {
        assert!(other.lists == runs[0].lists, "{}", other.planned.name);
        assert_eq!(skipped(other), skipped(&runs[0]), "{}", other.planned.name);
    }
}

#[test]
fn gathering_cones_is_a_stage_of_its_own() {
    let runs = run(Config {
        runs: 1.into(),
        exr: ExrFrames::List(vec![]),
        pipeline: vec![ShadingPipeline::Forward],
        ..config("street", "bistro", 1, &["sc-e-48-40"])
    });
    let has = |run: &Run| run.times[0].stages.iter().any(|stage| stage.stage == "frame/cluster[0]/cones[0]");
    assert_eq!(runs.iter().map(has).collect::<Vec<_>>(), [false, true]);
}

#[test]
fn what_is_not_measured_has_no_cones() {
    let out = tempfile::tempdir().unwrap();
    for (method, flags, told) in [
        ("clustered-mm-32", &["--normal-cones", "1"][..], "use --bounds measured"),
        ("sc-e-48-40", &["--normal-cones", "1", "--bounds", "implicit"], "use --bounds measured"),
        ("g-20", &["--normal-cones", "2"], "of clusters of views alone"),
        ("hashed-0.5-3", &["--normal-cones", "2"], "of clusters of views alone"),
        ("sc-e-48-40", &["--normal-cones", "4"], "0 (no cones) to 3"),
    ] {
        let mut command = manylight();
        command.args(["replay", "--quiet", "--resolution", "64x40", "--frames", "300", "--runs", "0"]);
        let message = refused(command.args(["--method", method]).args(flags).arg("--out").arg(out.path()));
        assert!(message.contains(told), "{method}: {message}");
    }
}
