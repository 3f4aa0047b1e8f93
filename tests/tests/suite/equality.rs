//! All methods shade every frame alike: as brute force over all lights does, mono and stereo, at one and at four
//! samples a pixel, marked from depth and from geometry, with lists for visible clusters and for all.

use manylight::assign::{Clusters, Marking};
use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::lights::Lighting;
use manylight::measure::ClusteringCounts;
use manylight_tests::{Run, assert_equal_the_truth, methods, methods_serving, run, three_frames};

fn config(recording: &str, msaa: u32, marking: Marking) -> Config {
    Config {
        methods: methods_serving(msaa, marking),
        clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
        ..three_frames(recording, msaa, marking, &[])
    }
}

fn check(recording: &str, msaa: u32, marking: Marking) {
    check_runs(config(recording, msaa, marking));
}

fn check_runs(config: Config) {
    let marking = config.marking;
    assert_equal_the_truth(&run(config), marking);
}

#[test]
fn mono() {
    check("bistro", 1, Marking::Depth);
}

#[test]
fn mono_marked_from_geometry() {
    check("bistro", 1, Marking::Geometry);
}

#[test]
fn stereo() {
    check("bistro-vive", 1, Marking::Depth);
}

#[test]
fn mono_with_four_samples() {
    check("bistro", 4, Marking::Depth);
}

#[test]
fn stereo_with_four_samples_marked_from_geometry() {
    check("bistro-vive", 4, Marking::Geometry);
}

#[test]
fn stereo_with_four_samples() {
    check("bistro-vive", 4, Marking::Depth);
}

/// An interior: columns before columns, cloths, panes of glass and lights that reach a few metres.
#[test]
fn stereo_in_the_hall() {
    check_runs(Config {
        scene: "hall".to_owned(),
        methods: methods(&[
            "all-lights",
            "indi-persp-64",
            "encl-ortho-4",
            "encl-displ-64-32",
            "sc-e-48-40",
            "g-20",
            "m",
        ]),
        lights: vec![Lighting { count: 400, intensity: 2.0, cutoff: 0.5, r0: 0.1 }],
        frames: FrameRange { first: 300, end: Some(831), step: 530 },
        clusters: vec![Clusters::Visible.into()],
        ..config("hall-vive", 4, Marking::Depth)
    });
}

/// What is listed where all clusters get lists has the lists of the visible ones among them, light by light.
#[test]
fn visible_clusters_have_the_same_lists_among_all() {
    let names = ["indi-persp-64", "encl-ortho-4", "encl-displ-64-32", "tiled-16"];
    for assign in [Assign::Brute, Assign::Hierarchy, Assign::Scatter] {
        let config = config("bistro-vive", 1, Marking::Depth);
        let exr = ExrFrames::List(vec![]);
        let runs = run(Config { methods: methods(&names), assign: vec![assign], exr, ..config });
        for pair in runs.chunks(2) {
            let [sparse, dense] = pair else { panic!("two runs a method") };
            assert_eq!(sparse.planned.method, dense.planned.method);
            assert_eq!(sparse.counts.len(), dense.counts.len());
            for (few, every) in sparse.counts.iter().zip(&dense.counts) {
                assert_eq!(few.counters.lighting_computations, every.counters.lighting_computations);
                for (visible, all) in few.clusterings.iter().zip(&every.clusterings) {
                    let clusters: u32 = all.dimensions.iter().product();
                    assert_eq!(all.visible_clusters, u64::from(clusters));
                    for cluster in &visible.clusters {
                        assert_eq!(all.clusters[cluster.index as usize], *cluster);
                    }
                    let fragments = |counts: &ClusteringCounts| -> u64 {
                        counts.clusters.iter().map(|cluster| u64::from(cluster.fragments)).sum()
                    };
                    assert_eq!(fragments(visible), fragments(all));
                }
            }
            check_lists(sparse, dense);
        }
    }
}

fn check_lists(sparse: &Run, dense: &Run) {
    let indices = sparse.counts.iter().flat_map(|frame| &frame.clusterings);
    for ((few, every), counts) in sparse.lists.iter().zip(&dense.lists).zip(indices) {
        for (number, cluster) in counts.clusters.iter().enumerate() {
            assert_eq!(few.list(number), every.list(cluster.index as usize), "{}", dense.planned.name);
        }
    }
}

/// More lights than the 65535 turns that lavapipe lets a loop have.
#[test]
fn seventy_thousand_lights() {
    check_runs(Config {
        methods: methods(&["all-lights", "indi-persp-16", "indi-ortho-4"]),
        lights: vec![Lighting { count: 70_000, intensity: 6.0, cutoff: 0.5, r0: 0.1 }],
        resolution: [24, 14],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        ..config("bistro", 1, Marking::Depth)
    });
}
