//! Lists of models: one for each instance of what is drawn several times, turned, mirrored by negative scales, flattened, or
//! sheared.

use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::draw_list::Batches;
use manylight::geometry::ConeTest;
use manylight::inputs::Inputs;
use manylight::lights::Attenuation;
use manylight::methods::{Method, model};
use manylight_tests::scenes::{recording, write_cubes, write_lights};
use manylight_tests::{assert_equal_the_truth, methods, run};
use serde_json::json;
use std::path::Path;

/// Cubes on a floor, of which the sixth is sheared by the node above it.
fn write_scene(path: &Path) {
    let turned = |[x, y, z]: [f64; 3]| {
        let w = (1.0 - x * x - y * y - z * z).sqrt();
        json!([x, y, z, w])
    };
    let nodes = [
        json!({ "mesh": 0, "translation": [0, -1.1, -8], "scale": [14, 0.1, 12] }),
        json!({ "mesh": 0, "translation": [-5, 0.25, -6] }),
        json!({ "mesh": 0, "translation": [-1, 0.5, -7], "scale": [-1.5, 1, 0.5], "rotation": turned([0.1, 0.4, 0.2]) }),
        json!({ "mesh": 0, "translation": [3, 0, -6], "scale": [0.5, -1, -0.75], "rotation": turned([0.3, -0.2, 0.5]) }),
        json!({ "mesh": 0, "translation": [6, 1, -9], "scale": [-1, -1, -1], "rotation": turned([0.0, 0.6, 0.0]) }),
        json!({ "mesh": 0, "translation": [-3, 2, -12], "scale": [2, 1.5, 0], "rotation": turned([0.2, 0.1, 0.0]) }),
        json!({ "translation": [2, 2, -12], "scale": [1, 3, 1], "children": [7] }),
        json!({ "mesh": 0, "scale": [0.8, 0.4, 0.6], "rotation": turned([0.0, 0.2, 0.4]) }),
    ];
    write_cubes(path, &nodes, &[0, 1, 2, 3, 4, 5, 6]);
}

fn config(directory: &Path) -> Config {
    let file = |name: &str| directory.join(name);
    write_scene(&file("s.gltf"));
    write_lights(&file("lights.csv"), 500, [[-10.0, -1.0, -18.0], [10.0, 6.0, 0.0]], (61, 1.3));
    let head = [0.5, 2.0, 3.0, -0.1, 0.05, 0.0, (1.0f64 - 0.01 - 0.0025).sqrt(), 1.2];
    let recording = recording([0.125, 64.0], head, [[-5.0; 3], [5.0; 3]], &[]);
    std::fs::write(file("r.json"), recording.to_string()).unwrap();
    let path = |name: &str| file(name).to_str().unwrap().to_owned();
    Config {
        scene: path("s.gltf"),
        recording: path("r.json"),
        lights: vec![],
        lights_file: Some(file("lights.csv")),
        // Light that ends at once shows one that is lost.
        attenuation: Attenuation::Stp,
        methods: methods(&["all-lights", "m"]),
        resolution: [96, 64],
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

#[test]
fn pictures_are_those_over_all_lights() {
    let directory = tempfile::tempdir().unwrap();
    let config = config(directory.path());
    for msaa in [1, 4] {
        let runs = run(Config { msaa, ..config.clone() });
        assert!(runs[0].counts[0].counters.needed_computations > 2000);
        assert_equal_the_truth(&runs, config.marking);
    }
}

#[test]
fn every_instance_has_the_list_of_its_own_box() {
    let directory = tempfile::tempdir().unwrap();
    let config = Config { methods: vec![Method::Models], ..config(directory.path()) };
    let inputs = Inputs::load(&config).unwrap();
    let batches = Batches::new(&inputs.scene);
    let mut source = inputs.light_source(&config.lights_of_run()).unwrap();
    let lights = source.at_frame(0).list.to_vec();
    let twin = model::twin::light_lists(&inputs.scene, &batches, (&lights, ConeTest::Unasked), 1e-3);
    let ways = vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter];
    for run in run(Config { assign: ways, ..config.clone() }) {
        let (lists, counts) = (&run.lists[0], &run.counts[0].clusterings[0]);
        assert_eq!((counts.dimensions, counts.clusters.len()), ([7, 1, 1], 7), "one for each instance");
        for place in 0..7 {
            let close = &twin.borderline[place];
            let sure = |list: &[u32]| -> Vec<u32> {
                list.iter().copied().filter(|light| !close.contains(light)).collect()
            };
            assert_eq!(sure(lists.list(place)), sure(twin.list(place)), "{} {place}", run.planned.name);
            assert!(lists.list(place).len() > 5 && lists.list(place).len() < 500);
        }
        let seen = &run.images[0].1[0];
        let of_pixels = |model: u32| seen.cluster_index.iter().filter(|&&index| index == model).count();
        for cluster in &counts.clusters {
            // Both sides of the flattened cube have a fragment at each of its pixels.
            let (pixels, fragments) = (of_pixels(cluster.index), cluster.fragments as usize);
            assert!(pixels > 0 && (fragments == pixels || fragments == 2 * pixels), "{pixels} {fragments}");
        }
    }
    let notes: Vec<_> = inputs.notes(&config.methods).collect();
    assert!(notes.len() == 1 && notes[0].starts_with("1 of 7 models are sheared"), "{notes:?}");
    assert_eq!(inputs.notes(&methods(&["g-6"])).count(), 0, "what is not run needs no note");
}
