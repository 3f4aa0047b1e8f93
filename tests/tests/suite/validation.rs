//! Every method under the validation layers, with synchronization validation, and no barrier but those that passes
//! derive: timestamps of single stages, whose barriers would hide a missing one, are left out.

use manylight::assign::{Clusters, Marking};
use manylight::config::{Config, ExrFrames, FrameRange, Scopes};
use manylight_tests::{methods, methods_serving, run};

fn silent(recording: &str, msaa: u32, marking: Marking) {
    let runs = run(Config {
        recording: recording.to_owned(),
        methods: [methods_serving(msaa, marking), methods(&["ortiz-16-9-24"])].concat(),
        resolution: [48, 32],
        msaa,
        marking,
        clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
        scopes: Scopes::Frame,
        frames: FrameRange { first: 290, end: Some(320), step: 10 },
        runs: 1.into(),
        exr: ExrFrames::List(vec![300]),
        ..Config::default()
    });
    for run in &runs {
        assert_eq!(run.times.len(), 3, "{}", run.planned.name);
        assert!(run.times.iter().all(|frame| frame.stages[0].gpu_ms > 0.0), "{}", run.planned.name);
    }
}

#[test]
fn marked_from_depth() {
    silent("bistro-vive", 1, Marking::Depth);
}

#[test]
fn marked_from_geometry_with_four_samples() {
    silent("bistro", 4, Marking::Geometry);
}

#[test]
fn marked_from_depth_with_four_samples() {
    silent("suntem-vive", 4, Marking::Depth);
}
