//! The counts that an independent implementation, the thesis's own program, gave for one frame.

use manylight::config::{Config, FrameRange};
use manylight_tests::{Run, run, unpacked};
use std::collections::BTreeMap;

struct Reference {
    grid: [u32; 3],
    light_indices: u64,
    lighting_computations: u64,
    fragments: u64,
    /// Fragments and list of each visible cluster, by this project's index.
    clusters: BTreeMap<u32, (u32, Vec<u32>)>,
}

fn clusters(file: &str, index: impl Fn(u32) -> u32) -> BTreeMap<u32, (u32, Vec<u32>)> {
    let text = unpacked(&format!("reference/{file}"));
    csv::Reader::from_reader(text.as_slice())
        .records()
        .map(|row| {
            let row = row.unwrap();
            let number = |column: usize| row[column].parse::<u32>().unwrap();
            let lights = row[4].split_whitespace().map(|light| light.parse().unwrap()).collect();
            (index(number(0)), (number(1), lights))
        })
        .collect()
}

fn frame_300(recording: &str, method: &str, resolution: [u32; 2]) -> Run {
    let directory = tempfile::tempdir().unwrap();
    let unpack = |name: &str| {
        let path = directory.path().join(name);
        std::fs::write(&path, unpacked(&format!("reference/{name}"))).unwrap();
        path
    };
    let scene = unpack("street.gltf");
    unpack("scene_gltf.bin");
    let config = Config {
        scene: scene.to_str().unwrap().to_owned(),
        recording: recording.to_owned(),
        methods: vec![method.parse().unwrap()],
        lights: vec![],
        lights_file: Some(unpack("lights_1000_frame300.csv")),
        resolution,
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 0.into(),
        ..Config::default()
    };
    run(config).remove(0)
}

/// Within a thousandth.
fn close(measured: u64, expected: u64) -> bool {
    measured.abs_diff(expected) * 1000 <= expected
}

fn compare(run: &Run, reference: &Reference) {
    let counts = &run.counts[0];
    let clustering = &counts.clusterings[0];
    assert_eq!(clustering.dimensions, reference.grid);
    let visible = reference.clusters.len() as u64;
    assert!(close(clustering.visible_clusters, visible), "{} clusters", clustering.visible_clusters);
    assert!(close(clustering.light_indices, reference.light_indices), "{} indices", clustering.light_indices);
    assert!(
        close(counts.counters.lighting_computations, reference.lighting_computations),
        "{} lighting computations",
        counts.counters.lighting_computations
    );
    assert!(
        close(counts.counters.fragments_shaded, reference.fragments),
        "{} fragments",
        counts.counters.fragments_shaded
    );
    assert_eq!(counts.counters.fragments_without_cluster, 0);

    let lists = &run.lists[0];
    let mut seen_by_both = 0;
    for (position, cluster) in clustering.clusters.iter().enumerate() {
        if let Some((_, list)) = reference.clusters.get(&cluster.index) {
            seen_by_both += 1;
            assert_eq!(lists.list(position), list, "lights of cluster {}", cluster.index);
        }
    }
    assert!(seen_by_both as u64 * 100 >= visible * 99, "only {seen_by_both} clusters are seen by both");
}

#[test]
fn mono_persp_64_gives_the_reference_counts() {
    let grid = [20, 12, 79];
    // That program counts slices of a perspective grid from the far end.
    let flip = |index: u32| {
        let slice = grid[0] * grid[1];
        index % slice + slice * (grid[2] - 1 - index / slice)
    };
    let reference = Reference {
        grid,
        light_indices: 11_624,
        lighting_computations: 11_878_379,
        fragments: 915_972,
        clusters: clusters("mono_persp64_frame300_clusters.csv", flip),
    };
    compare(&frame_300("bistro", "indi-persp-64", [1280, 720]), &reference);
}

#[test]
fn vive_encl_ortho_4_gives_the_reference_counts() {
    let reference = Reference {
        grid: [70, 74, 25],
        light_indices: 3_124,
        lighting_computations: 7_942_569,
        fragments: 802_003,
        clusters: clusters("vive_encl_ortho4_frame300_clusters.csv", |index| index),
    };
    compare(&frame_300("bistro-vive", "encl-ortho-4", [640, 720]), &reference);
}
