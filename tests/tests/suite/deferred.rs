//! Deferred shading: light lists are those of forward shading, to the bit, and so is what is counted; pictures are, but for what
//! the G-buffer rounds.

use manylight::assign::Marking;
use manylight::config::{Config, ExrFrames, FrameRange, Scopes};
use manylight::culling::Culling;
use manylight::lights::{Attenuation, Lighting};
use manylight::material::MaterialModel;
use manylight::selftest::picture_fault;
use manylight::shading::{Shading, ShadingPipeline};
use manylight_tests::{Run, difference, run, three_frames};

/// Most that a colour is from that of forward shading after tone mapping, in steps of 1/255.
const MOST: u8 = 2;
/// Most that it is in HDR, in parts of itself.
const MOST_RELATIVE: f32 = 0.04;

/// One frame by these methods, each shaded forward after a prepass, and deferred after one and without.
fn config(recording: &str, msaa: u32, marking: Marking, names: &[&str]) -> Config {
    Config {
        shading: vec![Shading::Prepass, Shading::Overdraw],
        pipeline: vec![ShadingPipeline::Forward, ShadingPipeline::Deferred],
        exclude: vec!["shading=overdraw,pipeline=forward".parse().unwrap()],
        resolution: [64, 36],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        ..three_frames(recording, msaa, marking, names)
    }
}

/// Runs a configuration, whose first method is over all lights, and compares every deferred run with that of all lights, and with
/// its own method's forward one.
fn check(config: Config) -> Vec<Run> {
    let runs = run(config);
    let is_deferred = |run: &Run| run.planned.config.pipeline == [ShadingPipeline::Deferred];
    let deferred: Vec<&Run> = runs.iter().filter(|run| is_deferred(run)).collect();
    deferred[1..].iter().for_each(|run| equals(run, deferred[0]));
    for three in runs.chunks(3) {
        let [forward, after_prepass, over] = three else { panic!("three runs a method") };
        assert!(!is_deferred(forward) && is_deferred(after_prepass) && is_deferred(over));
        assert!(after_prepass.images == over.images, "{}: pictures", over.planned.name);
        assert_eq!(after_prepass.counts, over.counts, "{}", over.planned.name);
        compare(forward, after_prepass);
        compare(forward, over);
    }
    runs
}

/// Compares a deferred run with that of all lights: nothing is rounded otherwise, and no light is lost.
fn equals(run: &Run, truth: &Run) {
    let name = &run.planned.name;
    for ((_, views), (_, truths)) in run.images.iter().zip(&truth.images) {
        for (view, truth) in views.iter().zip(truths) {
            assert_eq!(picture_fault(view, truth), None, "{name}");
        }
    }
    for (counts, truth) in run.counts.iter().zip(&truth.counts) {
        let (counts, truth) = (&counts.counters, &truth.counters);
        assert_eq!(counts.fragments_without_cluster, 0, "{name}");
        assert_eq!(counts.fragments_shaded, truth.fragments_shaded, "{name}");
        assert_eq!(counts.needed_computations, truth.needed_computations, "{name}");
    }
}

fn compare(forward: &Run, deferred: &Run) {
    let name = &deferred.planned.name;
    assert_eq!(forward.planned.method, deferred.planned.method);
    assert!(forward.lists == deferred.lists, "{name}: lists");
    for ((_, views), (_, others)) in deferred.images.iter().zip(&forward.images) {
        for (view, other) in views.iter().zip(others) {
            let (mapped, relative) = difference(view, other);
            assert!(mapped <= MOST && relative <= MOST_RELATIVE, "{name}: {mapped}/255, {relative}");
        }
    }
    for (deferred, forward) in deferred.counts.iter().zip(&forward.counts) {
        assert_eq!(deferred.clusterings, forward.clusterings, "{name}");
        let (deferred, forward) = (&deferred.counters, &forward.counters);
        // Of surfaces in one plane forward shading shades each.
        let coplanar = forward.fragments_shaded - deferred.fragments_shaded;
        assert!(coplanar <= forward.fragments_shaded / 50, "{name}: {coplanar}");
        assert!(deferred.fragments_shaded > 1000, "{name}");
        if coplanar == 0 {
            assert_eq!(deferred, forward, "{name}");
        }
    }
}

#[test]
fn every_family_of_methods() {
    let names = [
        "all-lights",
        "indi-persp-64",
        "t-e-28",
        "sc-e-48-40",
        "encl-ortho-4",
        "ortiz-16-9-24",
        "g-20",
        "m",
        "hashed-0.5-3",
    ];
    check(config("bistro", 1, Marking::Depth, &names));
}

/// Leaves that are cut out, and several samples.
#[test]
fn four_samples() {
    let names = ["all-lights", "sc-e-48-40", "m"];
    check(Config { scene: "temple".to_owned(), ..config("suntem", 4, Marking::Depth, &names) });
}

#[test]
fn marked_from_geometry() {
    check(config("bistro-vive", 1, Marking::Geometry, &["all-lights", "encl-displ-64-32"]));
}

/// Tegelaers' shading.
#[test]
fn a_white_material() {
    check(Config {
        material: MaterialModel::White,
        attenuation: Attenuation::Tegelaers,
        ..config("bistro", 1, Marking::Depth, &["all-lights", "tiled-16"])
    });
}

/// Whatever is drawn with views one by one is drawn with all at once, some of them in a mirror, and culled on the host.
#[test]
fn all_views_at_once() {
    for (msaa, culling) in [(1, Culling::Gpu), (4, Culling::Cpu)] {
        let of = |multiview| {
            check(Config {
                multiview,
                culling,
                resolution: [40, 40],
                frames: FrameRange { first: 140, end: Some(141), step: 1 },
                ..config("bistro-mirror", msaa, Marking::Depth, &["all-lights", "encl-ortho-4"])
            })
        };
        for (single, at_once) in of(false).iter().zip(&of(true)) {
            let name = &single.planned.name;
            assert_eq!(single.counts, at_once.counts, "{name}: counters");
            assert!(single.images == at_once.images, "{name}: images");
        }
    }
}

/// Stages of a run's last frame.
fn stages(run: &Run) -> Vec<&str> {
    run.times[0].stages.iter().map(|stage| stage.stage.as_str()).collect()
}

/// No barrier but those that passes derive: timestamps of single stages, whose barriers would hide a missing one, are left out.
#[test]
fn validation_is_silent() {
    for (recording, msaa, multiview) in [("bistro-vive", 1, true), ("bistro", 4, false)] {
        let runs = run(Config {
            pipeline: vec![ShadingPipeline::Deferred],
            exclude: vec![],
            multiview,
            scopes: Scopes::Frame,
            runs: 1.into(),
            ..config(recording, msaa, Marking::Depth, &["all-lights", "sc-e-48-40"])
        });
        assert!(runs.iter().all(|run| run.times.iter().all(|frame| frame.stages[0].gpu_ms > 0.0)));
    }
}

/// The G-buffer takes the place of the prepass, also where clusters are marked and measured.
#[test]
fn overdraw_needs_no_prepass() {
    let runs = run(Config {
        pipeline: vec![ShadingPipeline::Deferred],
        exclude: vec![],
        runs: 1.into(),
        exr: ExrFrames::List(vec![]),
        ..config("bistro", 1, Marking::Depth, &["all-lights", "sc-e-48-40"])
    });
    let shading = ["frame/light[0]", "frame/shade[0]", "frame/shade[0]/transparent"];
    let marking = ["mark[0]", "compact", "bounds[0]"].map(|stage| format!("frame/cluster[0]/{stage}"));
    for (run, prepass) in
        runs.iter().zip([Some("frame/depth[0]"), None, Some("frame/cluster[0]/depth[0]"), None])
    {
        let stages = stages(run);
        let found = stages.iter().find(|stage| stage.contains("depth"));
        assert_eq!(found.copied(), prepass, "{}", run.planned.name);
        assert!(stages.ends_with(&shading), "{stages:?}");
        let place = |wanted: &str| stages.iter().position(|stage| *stage == wanted);
        let gbuffer = place("frame/gbuffer[0]").unwrap();
        if run.planned.method.has_lists() {
            assert!(
                marking.iter().all(|stage| place(stage).unwrap() > gbuffer) == prepass.is_none(),
                "{stages:?}"
            );
        }
    }
}

/// Panes of glass before columns.
#[test]
fn the_hall() {
    check(Config {
        scene: "hall".to_owned(),
        lights: vec![Lighting { count: 400, intensity: 2.0, cutoff: 0.5, r0: 0.1 }],
        ..config("hall", 1, Marking::Depth, &["all-lights", "t-e-28"])
    });
}
