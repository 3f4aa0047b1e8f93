//! Golden image and counters of every method on lavapipe. `MANYLIGHT_BLESS=1` rewrites them.
//!
//! Other devices rasterise edges and filter textures differently: there the test only says that it compared nothing.

use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::lights::Lighting;
use manylight::output::image_preview;
use manylight::selftest::{GOLDEN_COLUMNS, GOLDEN_METHODS, golden_row};
use manylight_tests::{Run, blessing, data, methods, run};
use std::fs;

/// Compares methods in a scene, by its name in files too, along a recording under the lights; `pictured` is the frame whose
/// image is compared.
fn golden(names: &[&str], [scene, recording]: [&str; 2], lighting: Lighting, pictured: u32) {
    let runs = run(Config {
        scene: scene.to_owned(),
        recording: recording.to_owned(),
        methods: methods(names),
        lights: vec![lighting],
        resolution: [96, 64],
        frames: FrameRange { first: 300, end: Some(581), step: 280 },
        runs: 0.into(),
        exr: ExrFrames::List(vec![pictured]),
        ..Config::default()
    });
    if !runs[0].result.device.name.contains("llvmpipe") {
        eprintln!("golden files are lavapipe's; {} was not compared", runs[0].result.device.name);
        return;
    }
    for run in &runs {
        compare_image(run, scene);
    }
    compare_counters(&runs, scene);
}

fn compare_image(run: &Run, scene: &str) {
    let (frame, views) = &run.images[0];
    let image = image_preview(views);
    let path = data(&format!("golden/{scene}_{}_{frame}.png", run.planned.name));
    if blessing() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        image.save(&path).unwrap();
        return;
    }
    let expected = image::open(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())).into_rgb8();
    assert_eq!(image.dimensions(), expected.dimensions());
    let most = image.iter().zip(expected.iter()).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    // Machines differ in vector width, and so in the last bit of what lavapipe computes.
    assert!(most <= 2, "{} differs from {} by {most}/255", run.planned.name, path.display());
}

fn compare_counters(runs: &[Run], file: &str) {
    let rows =
        runs.iter().flat_map(|run| run.counts.iter().map(|counts| golden_row(&run.planned.name, counts)));
    let lines: Vec<String> = [GOLDEN_COLUMNS.join(",")].into_iter().chain(rows).collect();
    let text = lines.join("\n") + "\n";
    let path = data(&format!("golden/{file}.csv"));
    if blessing() {
        fs::write(&path, text).unwrap();
        return;
    }
    let expected = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    assert_eq!(text, expected, "counters differ from {}", path.display());
}

#[test]
fn street() {
    golden(&GOLDEN_METHODS, ["street", "bistro-vive"], Lighting::with_count(1000), 300);
}

#[test]
fn hall() {
    // They reach two metres: those of outdoors would light all of the hall at once.
    let lighting = Lighting { count: 1000, intensity: 2.0, cutoff: 0.5, r0: 0.1 };
    golden(&["encl-persp-64", "indi-ortho-4", "hashed-0.5-3"], ["hall", "hall-vive"], lighting, 580);
}

#[test]
fn temple() {
    golden(
        &["indi-persp-64", "encl-ortho-4", "tiled-mm-16", "clustered-mm-16"],
        ["temple", "suntem"],
        Lighting::with_count(1000),
        300,
    );
}
