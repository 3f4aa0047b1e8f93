//! Tegelaers's tiled and clustered methods: rectangles of tiles in which lights are seen, and visible clusters by sorting the samples
//! of tiles. Pictures are those of all lights, lists the same by every way.

use manylight::assign::{Compaction, ListStore, Marking};
use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight_tests::program::refused;
use manylight_tests::{Run, assert_equal_the_truth, manylight, run, three_frames};

const TILED: &str = "tiled-mm-16";
const CLUSTERED: &str = "clustered-mm-12";

fn config(scene: &str, recording: &str, msaa: u32, names: &[&str]) -> Config {
    Config { scene: scene.into(), ..three_frames(recording, msaa, Marking::Depth, names) }
}

/// By rectangles, whose lists are those of brute force.
fn alike(scene: &str, recording: &str, msaa: u32) {
    let config = config(scene, recording, msaa, &["all-lights", TILED, CLUSTERED]);
    let assign = vec![Assign::Rectangles];
    assert_equal_the_truth(&run(Config { assign, ..config }), Marking::Depth);
}

#[test]
fn mono() {
    alike("street", "bistro", 1);
}

#[test]
fn stereo_with_four_samples() {
    alike("street", "bistro-vive", 4);
}

#[test]
fn the_hall_whose_veils_are_transparent() {
    alike("hall", "hall", 1);
}

fn one_frame(scene: &str, recording: &str, msaa: u32, names: &[&str]) -> Config {
    let frames = FrameRange { first: 300, end: Some(301), step: 1 };
    Config { frames, ..config(scene, recording, msaa, names) }
}

fn assert_same_lists(made: &Run, others: &Run) {
    assert!(made.lists == others.lists, "{} has other lists than {}", made.planned.name, others.planned.name);
    assert!(made.images == others.images, "{} has other pictures", made.planned.name);
}

#[test]
fn every_way_and_store_has_the_lists_of_brute_force() {
    let ways = [Assign::Brute, Assign::Hierarchy, Assign::Scatter, Assign::Rectangles];
    for (recording, store) in [
        ("bistro", ListStore::Offsets),
        ("bistro-vive", ListStore::Fixed(3)),
        ("bistro-vive", ListStore::Capped(7)),
    ] {
        let config = one_frame("street", recording, 1, &[TILED, CLUSTERED]);
        let runs = run(Config { assign: ways.to_vec(), lists: vec![store], ..config });
        for of_method in runs.chunks(ways.len()) {
            let (brute, others) = of_method.split_first().unwrap();
            assert!(brute.lists.iter().any(|lists| lists.indices.len() > 50));
            others.iter().for_each(|other| assert_same_lists(other, brute));
        }
    }
}

/// The clusters, and the counters too, whatever the way of assignment; transparent geometry has clusters that no sample marks.
#[test]
fn sorted_tiles_change_nothing() {
    let names = [CLUSTERED, "sc-e-12-10", "ortiz-8-4-9", "tiled-16"];
    for (scene, recording, msaa, assign) in [
        ("street", "bistro-mirror", 1, Assign::Brute),
        ("street", "bistro-vive", 4, Assign::Scatter),
        ("hall", "hall", 1, Assign::Hierarchy),
    ] {
        let compaction = vec![Compaction::Ranks, Compaction::Sort];
        let config = one_frame(scene, recording, msaa, &names);
        let runs = run(Config { assign: vec![assign], compaction, visible_cluster_capacity: 9, ..config });
        for pair in runs.chunks(2) {
            let [ranks, sorted] = pair else { panic!("two ways of compaction") };
            assert_same_lists(sorted, ranks);
            if assign == Assign::Brute {
                assert_eq!(sorted.counts, ranks.counts, "{}", sorted.planned.name);
            }
            let grown = |run: &Run| run.result.growth.iter().any(|event| event.buffer == "visible_clusters");
            assert!(grown(sorted) && grown(ranks), "{}", sorted.planned.name);
        }
    }
}

#[test]
fn stages_have_names_of_their_own() {
    let config = one_frame("street", "bistro", 1, &[CLUSTERED, TILED]);
    let of = |config: Config| {
        let runs = run(Config { runs: 1.into(), exr: ExrFrames::List(vec![]), ..config });
        let stages = |run: &Run| -> String {
            let paths = run.times[0].stages.iter().map(|stage| stage.stage.as_str());
            let own: Vec<&str> = paths.filter_map(|path| path.strip_prefix("frame/cluster[0]/")).collect();
            own.join(" ")
        };
        runs.iter().map(stages).collect::<Vec<_>>()
    };
    let lists = "light_rectangles count_rectangles light_offsets fill_rectangles";
    let rectangles = Config { assign: vec![Assign::Rectangles], ..config.clone() };
    assert_eq!(
        of(rectangles),
        [format!("depth[0] mark[0] compact {lists}"), format!("list_clusters {lists}")]
    );
    let sorted = one_frame("street", "bistro", 1, &[CLUSTERED]);
    let clusters = "depth[0] mark[0] sort_tiles[0] tile_offsets";
    let by_brute_force = "transform_lights count_lights light_offsets assign_lights";
    let sorted = Config { compaction: vec![Compaction::Sort], ..sorted };
    assert_eq!(of(sorted), [format!("{clusters} {by_brute_force}")]);
}

#[test]
fn what_does_not_serve_is_refused_in_one_line() {
    let out = tempfile::tempdir().unwrap();
    for (method, flags, told) in [
        ("t-i-28", &["--assign", "rectangles"][..], "use --test mm"),
        ("encl-ortho-4", &["--test", "mm"], "no pieces of a frustum"),
        ("tiled-mm-32", &["--compaction", "sort"], "all clusters of tiled-mm-32"),
        ("encl-persp-64", &["--compaction", "sort"], "do not lie in such"),
        ("clustered-mm-2000", &["--compaction", "sort"], "smaller tiles"),
        ("sc-i-48-2100", &["--compaction", "sort"], "up to 2048 slices"),
    ] {
        let mut command = manylight();
        command.args(["replay", "--quiet", "--resolution", "64x40", "--frames", "300", "--runs", "0"]);
        let message = refused(command.args(["--method", method]).args(flags).arg("--out").arg(out.path()));
        assert!(message.contains(told), "{method}: {message}");
    }
}
