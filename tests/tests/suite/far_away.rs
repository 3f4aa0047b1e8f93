//! Far from the world's origin everything is as at it: no method loses a light, and the picture is the same.

use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::lights::{Attenuation, Lighting};
use manylight_tests::scenes::{Quad, recording, write_quads};
use manylight_tests::{METHODS, Run, difference, methods, run};
use std::fmt::Write as _;
use std::path::Path;

/// A floor, a back wall, a board that leans and one that stands.
const QUADS: [Quad; 4] = [
    [[-12.0, 0.0, 6.0], [12.0, 0.0, 6.0], [12.0, 0.0, -18.0], [-12.0, 0.0, -18.0]],
    [[-12.0, 0.0, -18.0], [12.0, 0.0, -18.0], [12.0, 9.0, -18.0], [-12.0, 9.0, -18.0]],
    [[-6.0, 0.0, -4.0], [-2.0, 0.0, -6.0], [-2.0, 3.0, -9.0], [-6.0, 3.0, -7.0]],
    [[1.0, 0.0, -3.0], [3.0, 0.0, -2.0], [3.0, 4.0, -2.0], [1.0, 4.0, -3.0]],
];

#[derive(Debug, Clone, Copy, PartialEq)]
enum Lights {
    Rain,
    File,
    Scene,
}

/// Places in the scene that single precision holds at 1000 km as well, without any order.
fn places(count: u32) -> impl Iterator<Item = [f64; 3]> {
    let part = |k: u32, step: u32, span: f64| f64::from(k.wrapping_mul(step) >> 16 & 255) / 256.0 * span;
    let sixteenth = |value: f64| (value * 16.0).round() / 16.0;
    (1..=count).map(move |k| {
        [
            sixteenth(part(k, 2_654_435_761, 20.0) - 10.0),
            sixteenth(part(k, 2_246_822_519, 5.0)),
            sixteenth(part(k, 3_266_489_917, 22.0) - 18.0),
        ]
    })
}

fn write_lights(path: &Path, away: [f64; 3]) {
    let mut text = String::from("x,y,z,r,g,b,i,i0,r0\n");
    for (place, k) in places(900).zip(0u32..) {
        let [x, y, z] = [0, 1, 2].map(|axis| place[axis] + away[axis]);
        writeln!(text, "{x},{y},{z},1,0.9,0.8,{},0.5,0.01", 0.1 + 0.013 * f64::from(k % 97)).unwrap();
    }
    std::fs::write(path, text).unwrap();
}

/// Brute force, the usual methods and those that views are nothing to over the scene at `away`.
fn runs(away: [f64; 3], lights: Lights, stereo: bool) -> Vec<Run> {
    let directory = tempfile::tempdir().unwrap();
    let file = |name: &str| directory.path().join(name);
    let scene_lights: Vec<_> = places(200).map(|place| (place, 3.0)).collect();
    write_quads(&file("s.gltf"), &QUADS, away, if lights == Lights::Scene { &scene_lights } else { &[] });
    write_lights(&file("lights.csv"), away);
    let place = |p: [f64; 3]| [0, 1, 2].map(|axis| p[axis] + away[axis]);
    let [x, y, z] = place([0.5, 1.75, 4.0]);
    let eye = |side: f64| [0.03 * side, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0 + 0.1 * side, 1.0, -0.8, 0.7];
    let eyes = if stereo { vec![eye(-1.0), eye(1.0)] } else { vec![] };
    let rain_box = [place([-10.0, 0.0, -18.0]), place([10.0, 6.0, 4.0])];
    // Turned a little about each axis.
    let head = [x, y, z, 0.05, 0.1, 0.02, (1.0f64 - 0.0025 - 0.01 - 0.0004).sqrt(), 1.3];
    let recording = recording([0.125, 32.0], head, rain_box, &eyes);
    std::fs::write(file("r.json"), recording.to_string()).unwrap();
    let path = |name: &str| file(name).to_str().unwrap().to_owned();
    let rain = Lighting { count: 700, intensity: 0.6, cutoff: 0.5, r0: 0.01 };
    run(Config {
        scene: path("s.gltf"),
        recording: path("r.json"),
        lights: if lights == Lights::Rain { vec![rain] } else { vec![] },
        lights_file: (lights == Lights::File).then(|| file("lights.csv")),
        scene_lights: lights == Lights::Scene,
        attenuation: Attenuation::Stp,
        methods: methods(&names()),
        resolution: [64, 40],
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    })
}

/// The usual methods, and those that lie in the world by sizes that suit: the least of these lights would have nodes of millimetres.
fn names() -> Vec<&'static str> {
    let usual = METHODS.into_iter().filter(|name| !methods(&[name])[0].has_octree());
    usual.chain(["g-6", "hashed-1m-3"]).collect()
}

fn all_equal_brute_force(runs: &[Run], about: &str) {
    let truth = &runs[0];
    assert!(truth.counts[0].counters.needed_computations > 1000, "{about}: next to nothing is lit");
    for run in &runs[1..] {
        let (counts, name) = (&run.counts[0], &run.planned.name);
        assert_eq!(
            counts.counters.needed_computations, truth.counts[0].counters.needed_computations,
            "{about}, {name} lost a light"
        );
        for (view, truth) in run.images[0].1.iter().zip(&truth.images[0].1) {
            let (mapped, relative) = difference(view, truth);
            assert!(mapped <= 1 && relative <= 0.005, "{about}, {name}: {mapped}/255, {relative} in HDR");
        }
    }
}

/// The same scene at home and away: all but pixels at edges, of surfaces and of lights, look the same.
fn looks_as_at_home(home: &Run, away: &Run, about: &str) {
    let [near, far] = [home, away].map(|run| run.counts[0].counters.needed_computations as f64);
    assert!((near - far).abs() < 0.002 * near, "{about}: {near} needed computations at home, {far} away");
    for (a, b) in home.images[0].1.iter().zip(&away.images[0].1) {
        let off = |at: &usize| {
            let red = [a, b].map(|pixels| pixels.color[*at][0].to_f32());
            (red[0] - red[1]).abs() > 0.01 * red[0].abs().max(1e-3)
        };
        let count = (0..a.color.len()).filter(off).count();
        assert!(count * 50 < a.color.len(), "{about}: {count} pixels differ from those at home");
    }
}

fn check(lights: Lights, stereo: bool, distances: &[f64]) {
    let home = runs([0.0; 3], lights, stereo);
    all_equal_brute_force(&home, "at home");
    for &distance in distances {
        // Multiples of 64 m: single precision holds the lights of the file exactly, up to 1000 km.
        let away =
            [0.75 * distance, 0.001 * distance, -0.65625 * distance].map(|x: f64| (x / 64.0).round() * 64.0);
        let about = format!("{lights:?} at {distance} m");
        let there = runs(away, lights, stereo);
        all_equal_brute_force(&there, &about);
        // Rain falls in steps of single precision, which are coarse out there.
        if lights != Lights::Rain {
            looks_as_at_home(&home[0], &there[0], &about);
        }
    }
}

#[test]
fn lights_of_a_file_mono() {
    check(Lights::File, false, &[1e3, 1e4, 1e5, 1.25e6]);
}

#[test]
fn lights_of_a_file_stereo() {
    check(Lights::File, true, &[1e5]);
}

#[test]
fn lights_of_the_scene_mono_and_stereo() {
    check(Lights::Scene, false, &[1e5]);
    check(Lights::Scene, true, &[1e5]);
}

#[test]
fn rain_mono_and_stereo() {
    check(Lights::Rain, false, &[1e5]);
    check(Lights::Rain, true, &[1e5]);
}
