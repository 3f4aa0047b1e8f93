//! Lights that generators make, as users meet them: a command each, `run.json`, stills, and what is refused.

use manylight_tests::manylight;
use manylight_tests::program::{printed, read, refused, small_unlit, stderr, succeed};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// What asks for each generator.
const SOURCES: [&[&str]; 3] = [
    &[
        "--lights",
        "200",
        "--light-source",
        "gamma",
        "--light-radius-mean",
        "3",
        "--light-motion",
        "bounce",
        "--light-box",
        "0,0,-10,60,12,40",
    ],
    &["--lights", "250", "--light-source", "volume", "--light-box", "rain"],
    &[
        "--lights",
        "400",
        "--light-source",
        "volume",
        "--light-volume",
        "-40,0,-40,60,12,40:10x2x10:0,1,0,3:8",
    ],
];

fn replay(out: &Path, source: &[&str]) {
    succeed(small_unlit(out).args(source).args(["--exr", "300"]));
}

fn manifest(out: &Path) -> Value {
    serde_json::from_str(&read(out.join("indi-persp-64/run.json"))).unwrap()
}

/// A table without the columns of times.
fn counters(path: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let timed: Vec<bool> = reader.headers().unwrap().iter().map(|name| name.contains("_ms")).collect();
    let counted = |row: csv::StringRecord| {
        row.iter().zip(&timed).filter(|(_, timed)| !**timed).map(|(cell, _)| cell.to_owned()).collect()
    };
    reader.records().map(|row| counted(row.unwrap())).collect()
}

/// Light indices of the first frame of a table.
fn light_indices(path: &Path) -> u64 {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let row: BTreeMap<String, String> = reader.deserialize().next().unwrap().unwrap();
    row["light_indices"].parse().unwrap()
}

#[test]
fn two_replays_are_equal_and_all_methods_show_the_same_picture() {
    for source in SOURCES {
        let [a, b] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        replay(a.path(), source);
        replay(b.path(), source);
        for run in ["indi-persp-64", "encl-ortho-4"] {
            let [a, b] = [a.path().join(run), b.path().join(run)];
            assert_eq!(counters(&a.join("frames.csv")), counters(&b.join("frames.csv")));
            for name in ["clusterings.csv", "frames/000300.exr"] {
                assert_eq!(
                    std::fs::read(a.join(name)).unwrap(),
                    std::fs::read(b.join(name)).unwrap(),
                    "{run}"
                );
            }
        }
        let picture =
            |run: &str| image::open(a.path().join(run).join("frames/000300.png")).unwrap().to_rgb8();
        let (one, other) = (picture("indi-persp-64"), picture("encl-ortho-4"));
        let farthest = one.iter().zip(other.iter()).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(farthest <= Some(1), "{source:?}: {farthest:?}");
        let listed = light_indices(&a.path().join("indi-persp-64/frames.csv"));
        assert!(listed > 100, "{source:?}: {listed}");
    }
}

#[test]
fn a_frame_of_bouncing_lights_is_the_same_alone_and_in_a_replay() {
    let [alone, within] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    succeed(small_unlit(alone.path()).args(SOURCES[0]).args(["--frames", "380", "--runs", "0"]));
    succeed(small_unlit(within.path()).args(SOURCES[0]).args(["--runs", "0"]));
    let frames = |out: &Path| counters(&out.join("encl-ortho-4/frames.csv"));
    assert_eq!(frames(alone.path()).last(), frames(within.path()).last());
    let [first, last] = [&frames(within.path())[0], &frames(within.path())[1]];
    assert_ne!(first[1..], last[1..]);
}

#[test]
fn a_run_tells_what_made_its_lights() {
    let out = tempfile::tempdir().unwrap();
    replay(out.path(), SOURCES[0]);
    let Value::Object(made) = &manifest(out.path())["generated"] else { panic!("generated lights are told") };
    let told = |name: &str| made[name].clone();
    assert_eq!([told("source"), told("seed"), told("motion")], [json!("gamma"), json!(1), json!("bounce")]);
    assert_eq!(told("radii"), json!({ "mode": 0.25, "mean": 3.0 }));
    assert!(told("boxes")[0]["min"][0].as_f64() < told("boxes")[0]["max"][0].as_f64());

    replay(out.path(), SOURCES[1]);
    let made = &manifest(out.path())["generated"];
    let rain = json!({ "min": [-60.0, -20.0, -60.0], "max": [80.0, 60.0, 60.0], "lattice": [10, 5, 5] });
    assert_eq!(
        (&made["source"], &made["motion"], &made["boxes"]),
        (&json!("volume"), &json!("static"), &json!([rain]))
    );

    replay(out.path(), SOURCES[2]);
    let made = &manifest(out.path())["generated"]["boxes"][0];
    assert_eq!((&made["lattice"], &made["turn"]), (&json!([20, 2, 10]), &json!([0.0, 1.0, 0.0, 3.0])));

    let table = out.path().join("table.csv");
    succeed(manylight().arg("export").arg(out.path()).arg("--out").arg(&table));
    let row: BTreeMap<String, String> =
        csv::Reader::from_path(&table).unwrap().deserialize().next().unwrap().unwrap();
    let told = ["light_source", "light_seed", "light_motion", "light_boxes"].map(|name| row[name].as_str());
    assert_eq!(told, ["volume", "1", "static", "-40,0,-40,60,12,40:20x2x10:0,1,0,3"]);

    succeed(small_unlit(out.path()).args(["--lights", "50"]));
    let made = &manifest(out.path())["generated"];
    assert_eq!(
        (&made["source"], &made["seed"], &made["motion"]),
        (&json!("rain"), &json!(1), &json!("fall"))
    );
}

#[test]
fn what_makes_lights_tells_runs_apart() {
    let [a, b] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    replay(a.path(), SOURCES[0]);
    let again = succeed(small_unlit(a.path()).args(SOURCES[0]).args(["--exr", "300"]));
    assert!(!stderr(&again).contains("made again"), "{}", stderr(&again));
    replay(b.path(), &[SOURCES[0], &["--light-seed", "2"]].concat());
    let compared = manylight().arg("compare").args([a.path(), b.path()]).output().unwrap();
    let said = String::from_utf8_lossy(&compared.stdout).into_owned();
    assert!(said.contains("missing in") && said.contains("200 lights by gamma (I0 0.5, R0 0.1)"), "{said}");
    let report = printed(manylight().arg("report").args([a.path(), b.path()]).current_dir(b.path()));
    assert!(report.starts_with("4 runs;"), "{report}");
    let page = read(a.path().join("report/index.html"));
    assert!(page.contains("light source gamma") && !page.contains("200 lights, I 100"));
}

#[test]
fn stills_show_them_from_any_camera() {
    let out = tempfile::tempdir().unwrap();
    for source in SOURCES {
        for view in ["left", "birdseye"] {
            let mut command = manylight();
            command.args(["still", "--frame", "300", "--resolution", "96x64", "--method", "indi-persp-64"]);
            command.args(["--show", "lights", "--view", view, "--validate"]).args(source);
            let written: Value =
                serde_json::from_str(&printed(command.arg("--json").arg("--out").arg(out.path()))).unwrap();
            assert!(Path::new(written["png"].as_str().unwrap()).is_file(), "{source:?} {view}");
            assert!(written["light_indices"].as_u64() > Some(0), "{source:?} {view}");
        }
    }
}

#[test]
fn what_cannot_be_is_refused_in_a_line() {
    let out = tempfile::tempdir().unwrap();
    let refused = |args: &[&str]| refused(small_unlit(out.path()).args(args));
    let volume = ["--light-source", "volume"];
    let message = refused(&[&volume[..], &["--light-volume", "10x4x5", "--lights", "500"]].concat());
    assert!(
        message
            .contains("500 lights: no set of lattices with 200 in all has so many: ask for one of 200, 400"),
        "{message}"
    );
    let message = refused(&[&volume[..], &["--light-set", "3x_1y_1z", "--lights", "1000"]].concat());
    assert!(message.contains("such as 999"), "{message}");
    assert!(refused(&["--light-seed", "2"]).contains("light_seed: lights by rain have none"));
    assert!(
        refused(&["--light-source", "gamma", "--light-radius-mode", "2"])
            .contains("below the mean radius, 1 m")
    );
    assert!(refused(&["--light-source", "gamma", "--lights", "9,20"]).contains("leave I out, or at 100"));
    assert!(refused(&["--light-source", "hail"]).contains("hail"));
    assert!(refused(&["--light-source", "gamma", "--light-box", "1,2,3"]).contains("`1,2,3` is no box"));
    let no_rain = out.path().join("no_rain.json");
    let recording = recording_without_rain();
    std::fs::write(&no_rain, recording).unwrap();
    let no_rain = no_rain.to_str().unwrap();
    let message = refused(&["--light-source", "gamma", "--light-box", "rain", "--recording", no_rain]);
    assert!(message.contains("brings no rain that has a box: give `scene` or corners"), "{message}");
}

/// The bundled recording without what falls in it.
fn recording_without_rain() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../recordings/bistro-vive.json");
    let mut recording: Value = serde_json::from_str(&read(path)).unwrap();
    recording.as_object_mut().unwrap().remove("rain").expect("the recording brings rain");
    recording.to_string()
}
