//! Views in mirrors: as brute force shades them, as the reflected scene looks, and with nothing from behind the mirror.

use glam::{DVec2, DVec3, DVec4, Mat4};
use manylight::assign::Marking;
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::culling::Culling;
use manylight::geometry::views::Mirror;
use manylight::inputs::Inputs;
use manylight::measure::ViewPixels;
use manylight::output::tone_map;
use manylight::recording::{self, Recording};
use manylight_tests::{METHODS, Run, difference, few_far_lights, methods, run, run_inputs};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

const FRAME: u32 = 140;

/// The methods that serve views in mirrors, behind the truth.
fn serving() -> Vec<&'static str> {
    METHODS.into_iter().filter(|name| !matches!(*name, "encl-persp-64" | "encl-displ-64-32")).collect()
}

fn config(names: &[&str]) -> Config {
    Config {
        recording: "bistro-mirror".into(),
        methods: methods(names),
        lights: few_far_lights(),
        resolution: [56, 56],
        frames: FrameRange { first: FRAME, end: Some(581), step: 220 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

/// The bundled recording with other eyes, a far plane at 300 m, and the one frame that is asked for.
fn recording_with(directory: &Path, eyes: Vec<Value>) -> Recording {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../recordings/bistro-mirror.json"));
    let mut file: Value = serde_json::from_str(&text.unwrap()).unwrap();
    file["far"] = 300.into();
    file["frames"] = json!([file["frames"][FRAME as usize]]);
    file["hmd"]["eyes"] = eyes.into();
    let path = directory.join("views.json");
    std::fs::write(&path, file.to_string()).unwrap();
    recording::load(path.to_str().unwrap()).unwrap()
}

/// An eye that looks aside by `yaw` radians, in a mirror or not.
fn eye(name: &str, yaw: f64, mirror: Option<[f64; 4]>) -> Value {
    let (sin, cos) = (yaw / 2.0).sin_cos();
    let mut eye =
        json!({"name": name, "rows": [[0.05 * yaw, 0.0, 0.0, 0.0, sin, 0.0, cos, -1.2, 1.0, -0.9, 1.1]]});
    if let Some(plane) = mirror {
        eye["mirror"] = json!([plane]);
    }
    eye
}

/// Eight views: eyes that look around, puddles, a shop window, a tilted pane.
fn eight_eyes() -> Vec<Value> {
    let puddle = Some([0.0, 1.0, 0.0, 0.05]);
    let window = Some([0.0, 0.0, -1.0, -15.0]);
    let pane = Some([-0.6, 0.64, -0.48, -9.0]);
    vec![
        eye("left", 0.1, None),
        eye("right", -0.1, None),
        eye("puddle-left", 0.1, puddle),
        eye("puddle-right", -0.1, puddle),
        eye("window", 0.0, window),
        eye("pane", 0.0, pane),
        eye("back", 3.0, None),
        eye("back-puddle", 2.5, puddle),
    ]
}

/// Checks every picture of every run against those of the first, over all lights.
fn pictures_equal_the_truth(runs: &[Run], views: usize) {
    let truth = &runs[0];
    for run in &runs[1..] {
        let name = &run.planned.name;
        for ((frame, pictures), (_, truths)) in run.images.iter().zip(&truth.images) {
            assert_eq!((pictures.len(), truths.len()), (views, views));
            for (picture, truth) in pictures.iter().zip(truths) {
                let (mapped, relative) = difference(picture, truth);
                assert!(
                    mapped <= 1 && relative <= 0.005,
                    "{name}, frame {frame}, {}: {mapped}",
                    picture.name
                );
            }
        }
        for (counts, truth) in run.counts.iter().zip(&truth.counts) {
            assert_eq!(counts.counters.fragments_without_cluster, 0, "{name}");
            assert_eq!(counts.counters.fragments_shaded, truth.counters.fragments_shaded, "{name}");
            assert_eq!(
                counts.counters.needed_computations, truth.counters.needed_computations,
                "{name} lost a light"
            );
        }
    }
}

fn lit(pixels: &ViewPixels) -> usize {
    pixels.depth.iter().filter(|depth| depth.is_finite()).count()
}

#[test]
fn two_eyes_and_a_mirror_are_shaded_as_by_brute_force() {
    for msaa in [1, 4] {
        let runs = run(Config { msaa, ..config(&serving()) });
        pictures_equal_the_truth(&runs, 3);
        for (frame, pictures) in &runs[0].images {
            assert!(lit(&pictures[2]) * 10 > pictures[2].depth.len(), "frame {frame}: the mirror is empty");
            assert!(pictures[0].color != pictures[2].color);
        }
    }
}

#[test]
fn eight_views_of_which_five_are_in_mirrors_are_shaded_as_by_brute_force() {
    let directory = tempfile::tempdir().unwrap();
    let frames = FrameRange { first: 0, end: None, step: 1 };
    let config = Config { frames, resolution: [40, 40], ..config(&serving()) };
    let inputs = Inputs::load_with(&config, recording_with(directory.path(), eight_eyes()), None).unwrap();
    let runs = run_inputs(config, &inputs);
    pictures_equal_the_truth(&runs, 8);
    assert!(runs[0].images[0].1.iter().all(|picture| lit(picture) > 40), "a view sees nothing");
}

#[test]
fn views_of_both_handednesses_are_drawn_at_once_as_one_by_one() {
    let directory = tempfile::tempdir().unwrap();
    let recording = recording_with(directory.path(), eight_eyes());
    for (culling, marking, msaa) in [(Culling::Gpu, Marking::Depth, 1), (Culling::Cpu, Marking::Geometry, 4)]
    {
        let config = Config {
            frames: FrameRange { first: 0, end: None, step: 1 },
            resolution: [40, 40],
            culling,
            marking,
            msaa,
            ..config(&["all-lights", "indi-persp-64", "encl-ortho-4"])
        };
        let inputs = Inputs::load_with(&config, recording.clone(), None).unwrap();
        let [single, at_once] =
            [false, true].map(|multiview| run_inputs(Config { multiview, ..config.clone() }, &inputs));
        for (a, b) in single.iter().zip(&at_once) {
            assert_eq!(a.counts, b.counts, "{}", a.planned.name);
            assert!(a.lists == b.lists && a.images == b.images, "{}", a.planned.name);
            assert!(a.counts[0].counters.fragments_shaded > 2000);
        }
    }
}

#[test]
fn what_lies_behind_the_mirror_is_not_seen() {
    let directory = tempfile::tempdir().unwrap();
    let config = Config { frames: FrameRange { first: 0, end: None, step: 1 }, ..config(&["indi-persp-64"]) };
    let inputs = Inputs::load_with(&config, recording_with(directory.path(), eight_eyes()), None).unwrap();
    let pictures = run_inputs(config, &inputs).remove(0).images.remove(0).1;
    let mut close = 0;
    for (view, picture) in inputs.recording.views(0, [56, 56]).unwrap().iter().zip(&pictures) {
        let Some(mirror) = view.pose.mirror else { continue };
        let sides = (0..picture.depth.len()).filter(|&pixel| picture.depth[pixel].is_finite()).map(|pixel| {
            let point = world(picture, pixel);
            mirror.plane().dot(point.extend(1.0))
        });
        let nearest = sides.fold(f64::INFINITY, f64::min);
        assert!(nearest > -0.01, "{}: {nearest} m behind the mirror", picture.name);
        close += i32::from(nearest < 0.5);
    }
    assert!(close >= 2, "no mirror cuts anything");
}

/// The world position of a pixel's centre.
fn world(picture: &ViewPixels, pixel: usize) -> DVec3 {
    let (x, y) = (pixel as u32 % picture.width, pixel as u32 / picture.width);
    let part = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
        / DVec2::new(f64::from(picture.width), f64::from(picture.height));
    let clip = DVec4::new(2.0 * part.x - 1.0, 1.0 - 2.0 * part.y, 1.0, 1.0);
    let ahead = picture.clip_from_view.inverse() * clip;
    let ahead = ahead.truncate() / ahead.w;
    picture.world_from_view.transform_point3(ahead * (f64::from(picture.depth[pixel]) / -ahead.z))
}

/// Lights along the streets, a row each.
fn lights_file(path: &Path, place: impl Fn(DVec3) -> DVec3) {
    let mut text = "x,y,z,r,g,b,i,i0,r0\n".to_owned();
    for i in 0..120 {
        let part = |step: f64| (f64::from(i) * step).fract();
        let at =
            place(DVec3::new(80.0 * part(0.618) - 10.0, 8.0 * part(0.414) + 1.0, 70.0 * part(0.732) - 40.0));
        writeln!(text, "{},{},{},{},0.8,0.6,40,0.5,0.1", at.x, at.y, at.z, part(0.236)).unwrap();
    }
    std::fs::write(path, text).unwrap();
}

/// A mirror shows what a camera without one sees where scene and lights themselves are reflected: the same picture and,
/// clustered view by view, the same counts.
#[test]
fn a_mirror_shows_the_reflected_scene() {
    let directory = tempfile::tempdir().unwrap();
    // Below, and beyond, all of the scene: nothing lies behind them.
    for plane in [[0.0, 1.0, 0.0, -1.0], [0.28, 0.0, -0.96, -44.5]] {
        let [x, y, z, offset] = plane;
        let mirror = Mirror { normal: DVec3::new(x, y, z), offset };
        let file = directory.path().join("lights.csv");
        let config = Config {
            lights: vec![],
            lights_file: Some(file.clone()),
            resolution: [120, 120],
            frames: FrameRange { first: 0, end: None, step: 1 },
            ..config(&["indi-persp-16", "indi-ortho-4", "indi-displ-16-8"])
        };
        let recording = |mirror| recording_with(directory.path(), vec![eye("eye", 0.0, mirror)]);
        lights_file(&file, |at| at);
        let seen = Inputs::load_with(&config, recording(Some(plane)), None).unwrap();
        lights_file(&file, |at| mirror.reflect_point(at));
        let mut scene = seen.scene.clone();
        let reflection: Mat4 = mirror.to_matrix().as_mat4();
        for instance in &mut scene.instances {
            instance.world_from_object = reflection.as_dmat4() * instance.world_from_object;
        }
        let reflected = Inputs::load_with(&config, recording(None), Some(scene)).unwrap();
        let [seen, reflected] = [seen, reflected].map(|inputs| run_inputs(config.clone(), &inputs));
        for (a, b) in seen.iter().zip(&reflected) {
            same_pictures(&a.images[0].1[0], &b.images[0].1[0]);
            let of = |run: &Run| {
                let counts = &run.counts[0];
                [
                    counts.visible_clusters(),
                    counts.light_indices(),
                    counts.counters.fragments_shaded,
                    counts.counters.needed_computations,
                ]
            };
            for (one, other) in of(a).into_iter().zip(of(b)) {
                assert!(
                    one > 5 && one.abs_diff(other) * 100 <= one + 100,
                    "{}: {one}, {other}",
                    a.planned.name
                );
            }
        }
    }
}

/// Equal but for a few pixels, where rounding decides which surface is seen.
fn same_pictures(a: &ViewPixels, b: &ViewPixels) {
    let shown = |pixels: &ViewPixels, at: usize| tone_map([0, 1, 2].map(|i| pixels.color[at][i].to_f32()));
    let differ = (0..a.color.len()).filter(|&at| {
        let (one, other) = (shown(a, at), shown(b, at));
        one.iter().zip(&other).any(|(x, y)| x.abs_diff(*y) > 3)
    });
    let (differ, lit) = (differ.count(), lit(a));
    assert!(lit > 200, "{lit} pixels see something");
    assert!(differ * 50 < lit, "{differ} of {lit} pixels differ");
}
