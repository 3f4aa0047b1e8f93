//! All views drawn at once: images, counters and lists are those of views drawn one after the other.

use manylight::assign::Marking;
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::culling::Culling;
use manylight_tests::{Run, few_far_lights, methods, run};

const METHODS: [&str; 4] = ["all-lights", "indi-persp-64", "encl-persp-64", "encl-ortho-4"];

fn config(msaa: u32) -> Config {
    Config {
        methods: methods(&METHODS),
        lights: few_far_lights(),
        resolution: [48, 32],
        msaa,
        frames: FrameRange { first: 300, end: Some(581), step: 280 },
        runs: 1.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

/// Runs `config` one view after the other and all at once, and compares all that does not depend on time.
fn compare(config: Config) -> Vec<Run> {
    let single = run(Config { multiview: false, ..config.clone() });
    let at_once = run(Config { multiview: true, ..config });
    assert!(single.iter().any(|run| run.counts.iter().any(|counts| counts.counters.fragments_shaded > 500)));
    for (a, b) in single.iter().zip(&at_once) {
        let name = &a.planned.name;
        assert_eq!(a.counts, b.counts, "{name}: counters");
        assert!(a.lists == b.lists, "{name}: lists");
        assert!(a.images == b.images, "{name}: images");
    }
    at_once
}

/// Stages of the frame's last temporal run.
fn stages(run: &Run) -> Vec<&str> {
    run.times[0].stages.iter().map(|stage| stage.stage.as_str()).collect()
}

#[test]
fn stereo_is_the_same_and_its_stages_are_of_all_views() {
    let runs = compare(config(1));
    let count = |run: usize, stage: &str| stages(&runs[run]).iter().filter(|path| **path == stage).count();
    assert_eq!([count(0, "frame/cull"), count(0, "frame/depth"), count(0, "frame/shade")], [1; 3]);
    // Indi shares the prepass, and shades each view through its own clustering.
    assert_eq!([count(1, "frame/cluster[0]/depth"), count(1, "frame/cluster[1]/mark[1]")], [1; 2]);
    assert_eq!([count(1, "frame/shade[0]/opaque"), count(1, "frame/shade[1]/opaque")], [1; 2]);
    assert_eq!([count(2, "frame/cluster[0]/depth"), count(2, "frame/shade/opaque")], [1; 2]);
    assert_eq!([count(2, "frame/cluster[0]/depth[0]"), count(2, "frame/shade[0]")], [0; 2]);
}

#[test]
fn stereo_with_four_samples_is_the_same() {
    compare(config(4));
}

#[test]
fn it_is_the_same_marked_from_geometry_and_culled_on_the_host() {
    let recording = "suntem-vive".to_owned();
    let scene = "temple".to_owned();
    compare(Config {
        scene,
        recording,
        marking: Marking::Geometry,
        culling: Culling::Cpu,
        methods: methods(&METHODS[1..3]),
        ..config(4)
    });
}

#[test]
fn one_view_alone_is_drawn_as_ever() {
    let runs = compare(Config { recording: "bistro".into(), methods: methods(&METHODS[1..2]), ..config(1) });
    assert!(stages(&runs[0]).contains(&"frame/cluster[0]/depth[0]"));
}
