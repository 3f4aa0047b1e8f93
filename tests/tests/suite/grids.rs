//! Methods of grids by what is independent in them: which clusters get lists, bounds, slice laws. Pictures and counts are those
//! of all lights; lists of coarser groups hold those of finer ones.

use manylight::assign::{Bounds, Clusters, Marking};
use manylight::config::{Assign, Choice, Config, ExrFrames, FrameRange};
use manylight::geometry::SliceLaw;
use manylight::lights::Lighting;
use manylight::measure::{ClusterLists, ClusteringCounts};
use manylight_tests::{Run, assert_equal_the_truth, run, three_frames};
use std::collections::BTreeSet;

/// Tiles and clusters by name, as small as the pictures ask for.
const NAMES: [&str; 6] = ["t-i-9", "t-e-9", "dc-i-16-12", "dc-e-12-10", "sc-i-12-10", "sc-e-12-10"];

/// Runs of a configuration, the first of all lights, whose pictures and counts are those of the first.
fn alike(config: Config) -> Vec<Run> {
    let marking = config.marking;
    let runs = run(config);
    assert_equal_the_truth(&runs, marking);
    runs
}

fn named_methods_are_alike(recording: &str, msaa: u32, marking: Marking) {
    let names = [&["all-lights"][..], &NAMES].concat();
    alike(three_frames(recording, msaa, marking, &names));
}

#[test]
fn mono() {
    named_methods_are_alike("bistro", 1, Marking::Depth);
}

#[test]
fn stereo_marked_from_geometry() {
    named_methods_are_alike("bistro-vive", 1, Marking::Geometry);
}

#[test]
fn stereo_with_four_samples() {
    named_methods_are_alike("bistro-vive", 4, Marking::Depth);
}

#[test]
fn mono_with_four_samples_marked_from_geometry() {
    named_methods_are_alike("bistro", 4, Marking::Geometry);
}

/// Bounds of shared grids hold what all views see, of boxes too.
#[test]
fn any_grid_can_be_measured() {
    let names = ["all-lights", "encl-persp-16", "encl-ortho-4", "indi-displ-16-32", "tiled-9"];
    for msaa in [1, 4] {
        alike(Config {
            bounds: vec![Bounds::Measured.into()],
            clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
            ..three_frames("bistro-vive", msaa, Marking::Depth, &names)
        });
    }
}

#[test]
fn slices_may_begin_by_any_law() {
    let laws = SliceLaw::EXAMPLES.map(Choice::Named).to_vec();
    let runs = alike(Config {
        slices: laws,
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        ..three_frames("bistro-vive", 1, Marking::Depth, &["all-lights", "dc-e-12-10", "encl-persp-16"])
    });
    assert_eq!(runs.len(), 1 + 2 * SliceLaw::EXAMPLES.len());
    let visible: BTreeSet<u64> =
        runs[1..7].iter().map(|run| run.counts[0].clusterings[0].light_indices).collect();
    assert!(visible.len() >= 5, "laws divide alike: {visible:?}");
}

/// The lists of one frame and clustering, by the linear index of their cluster.
fn lists(run: &Run, place: usize) -> impl Iterator<Item = (u32, &[u32])> {
    let counts: Vec<&ClusteringCounts> = run.counts.iter().flat_map(|frame| &frame.clusterings).collect();
    let lists: &ClusterLists = &run.lists[place];
    counts[place].clusters.iter().enumerate().map(|(number, cluster)| (cluster.index, lists.list(number)))
}

/// Lists of one run within those of another, cluster by cluster.
fn assert_within(few: &Run, many: &Run) {
    assert_eq!(few.lists.len(), many.lists.len());
    for place in 0..few.lists.len() {
        let of_many: std::collections::BTreeMap<u32, &[u32]> = lists(many, place).collect();
        for (cluster, list) in lists(few, place) {
            let all = of_many[&cluster];
            let missing = list.iter().find(|light| all.binary_search(light).is_err());
            assert_eq!(missing, None, "{} and {}", few.planned.name, many.planned.name);
        }
    }
}

#[test]
fn measured_lists_are_within_those_of_cells_and_the_same_by_all_ways() {
    let names = ["t-e-9", "dc-e-12-10", "sc-e-12-10", "encl-ortho-4"];
    let runs = run(Config {
        bounds: vec![Bounds::Implicit.into(), Bounds::Measured.into()],
        assign: vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter],
        exr: ExrFrames::List(vec![]),
        ..three_frames("bistro-vive", 1, Marking::Depth, &names)
    });
    for of_method in runs.chunks(6) {
        let [implicit, measured] = [0, 1].map(|bounds| &of_method[bounds]);
        assert_within(measured, implicit);
        let indices = |run: &Run| -> usize { run.lists.iter().map(|lists| lists.indices.len()).sum() };
        assert!(indices(measured) * 10 < indices(implicit) * 9, "{}", measured.planned.name);
        for (place, run) in of_method.iter().enumerate() {
            assert!(run.lists == of_method[place % 2].lists, "{}", run.planned.name);
        }
        let tests = |run: &Run| -> u64 { run.counts.iter().map(|c| c.counters.intersection_tests).sum() };
        let dense = measured.planned.method.own_clusters() == Clusters::All;
        assert!(tests(measured) <= tests(implicit) && (dense || tests(measured) == tests(implicit)));
    }
}

#[test]
fn visible_clusters_have_the_same_lists_among_all() {
    for bounds in [Bounds::Implicit, Bounds::Measured] {
        let runs = run(Config {
            bounds: vec![bounds.into()],
            clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
            exr: ExrFrames::List(vec![]),
            ..three_frames("bistro-vive", 1, Marking::Depth, &["tiled-9", "sc-i-12-10"])
        });
        for pair in runs.chunks(2) {
            let [sparse, dense] = pair else { panic!("two runs a method") };
            assert_within(sparse, dense);
            for place in 0..sparse.lists.len() {
                let of_dense: Vec<(u32, &[u32])> = lists(dense, place).collect();
                for (cluster, list) in lists(sparse, place) {
                    assert_eq!((cluster, list), of_dense[cluster as usize], "{}", sparse.planned.name);
                }
                let empty = of_dense.len() - lists(sparse, place).count();
                let lists_of_nothing = of_dense.iter().filter(|(_, list)| list.is_empty()).count();
                assert!(bounds == Bounds::Implicit || lists_of_nothing >= empty);
            }
        }
    }
}

/// By half spaces, a tile meets what one of its clusters meets: they share their sides, and their slices leave no gap.
#[test]
fn a_tiles_list_is_that_of_all_its_clusters() {
    let runs = run(Config {
        lights: vec![Lighting::with_count(3000)],
        exr: ExrFrames::List(vec![]),
        ..three_frames("bistro", 1, Marking::Depth, &["t-i-12", "dc-i-12-10", "t-e-12", "dc-e-12-10"])
    });
    for (tiles, clusters, equal) in [(&runs[0], &runs[1], true), (&runs[2], &runs[3], false)] {
        for place in 0..tiles.lists.len() {
            let tiles: Vec<BTreeSet<u32>> =
                lists(tiles, place).map(|(_, list)| list.iter().copied().collect()).collect();
            let mut of_clusters = vec![BTreeSet::new(); tiles.len()];
            for (cluster, list) in lists(clusters, place) {
                of_clusters[cluster as usize % tiles.len()].extend(list.iter().copied());
            }
            for (tile, clusters) in tiles.iter().zip(&of_clusters) {
                assert!(if equal { tile == clusters } else { tile.is_superset(clusters) });
            }
            assert!(tiles.iter().map(BTreeSet::len).sum::<usize>() > 1000);
        }
    }
}
