//! Sweeps: the product of axes, skipping, failing, sharing, and going on after being killed.

use manylight_tests::program::{printed, read, refused_with};
use manylight_tests::{copy_shaders, manylight};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const METHODS: [&str; 2] = ["indi-ortho-16", "encl-persp-32"];

/// A sweep small enough for a test: two lightings and two methods, counted in two frames.
fn small(out: &Path) -> Command {
    let mut command = manylight();
    command.args(["replay", "--quiet", "--resolution", "48x32", "--frames", "300..381/80", "--runs", "0"]);
    command.args(["--lights", "50", "--lights", "90"]);
    command.args(METHODS.iter().flat_map(|method| ["--method", method]));
    command.arg("--out").arg(out);
    command
}

/// When the run at `path` was put there, as its manifest's bytes and its directory's identity tell.
fn made(path: &Path) -> String {
    let time = fs::metadata(path.join("run.json")).unwrap().modified().unwrap();
    format!("{time:?} {}", read(path.join("run.json")))
}

/// Every table below `out` by its path; counters alone, for nothing was timed.
fn tables(out: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut pending = vec![out.to_owned()];
    while let Some(directory) = pending.pop() {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                pending.push(path);
            } else if path.extension().is_some_and(|extension| extension == "csv") {
                found.insert(path.strip_prefix(out).unwrap().to_owned(), fs::read(&path).unwrap());
            }
        }
    }
    found
}

fn no_temporaries(out: &Path) {
    for entry in fs::read_dir(out).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.starts_with(".manylight-"), "{name} was left");
    }
}

#[test]
fn every_resolution_is_replayed_and_has_a_directory_of_its_own() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args(["replay", "--quiet", "--resolutions", "48x32,24x24", "--frames", "300", "--runs", "0"]);
    command.args(["--lights", "50", "--method", "indi-ortho-16", "--out"]).arg(out.path());
    printed(&mut command);
    for (directory, sides) in [("street-48x32", [48, 32]), ("street-24x24", [24, 24])] {
        let manifest = read(out.path().join(directory).join("indi-ortho-16/run.json"));
        let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        assert_eq!(manifest["config"]["resolution"], serde_json::json!(sides));
        assert_eq!(manifest["config"]["resolutions"], serde_json::Value::Null);
    }
    let shaded = |directory: &str| {
        let table = read(out.path().join(directory).join("indi-ortho-16/frames.csv"));
        let cells = |line: usize| table.lines().nth(line).unwrap().split(',').map(str::to_owned);
        let place = cells(0).position(|name| name == "fragments_shaded").unwrap();
        cells(1).nth(place).unwrap().parse::<u32>().unwrap()
    };
    // Two eyes of so many pixels, less the sky's, and glass before what is seen.
    let (wide, square) = (shaded("street-48x32"), shaded("street-24x24"));
    assert!((2500..3600).contains(&wide) && (900..1400).contains(&square), "{wide} {square}");
}

#[test]
fn a_still_of_a_sweep_is_of_its_first_scene_in_its_first_resolution() {
    let directory = tempfile::tempdir().unwrap();
    let (file, out) = (directory.path().join("sweep.json"), directory.path().join("out"));
    let scenes = r#"{"scene": "hall", "recording": "hall", "lights": [{"count": 5}, {"count": 9}]},
        {"scene": "street", "recording": "bistro"}"#;
    let text = format!(
        r#"{{"scenes": [{scenes}], "resolutions": [[24, 16], [8, 8]], "methods": ["indi-ortho-4"]}}"#
    );
    fs::write(&file, text).unwrap();
    let still = || {
        let mut command = manylight();
        command.args(["still", "--frame", "1100", "--config"]).arg(&file).arg("--out").arg(&out);
        command
    };
    // A frame that bistro lacks.
    printed(&mut still());
    let picture = fs::read(out.join("001100_indi-ortho-4_mono.png")).unwrap();
    let side = |at: usize| u32::from_be_bytes(picture[at..at + 4].try_into().unwrap());
    assert_eq!([side(16), side(20)], [24, 16]);
    let message = refused_with(still().args(["--resolutions", "8x8,9x9"]), 2);
    assert!(message.contains("one scene in one resolution"), "{message}");
}

#[test]
fn axes_are_multiplied_without_what_is_excluded() {
    let out = tempfile::tempdir().unwrap();
    let scenes = ["--scenes", "street=bistro-vive", "--scenes", "temple=suntem,40x24"];
    let rules = ["--exclude", "scene=temple,method=encl-*", "--exclude", "recording=*-vive,lights=90"];
    let names = printed(small(out.path()).args(scenes).args(rules).arg("--list-runs"));
    let expected = [
        "street/indi-ortho-16_50",
        "street/encl-persp-32_50",
        "temple/indi-ortho-16_50",
        "temple/indi-ortho-16_90",
    ];
    assert_eq!(names.lines().collect::<Vec<_>>(), expected);
    printed(small(out.path()).args(scenes).args(rules));
    for name in expected {
        assert!(out.path().join(name).join("run.json").is_file(), "{name}");
    }
    let table = read(out.path().join("summary.csv"));
    assert_eq!(table.lines().count(), 5, "{table}");
    assert!(table.starts_with("scene,method,lighting,"), "{table}");
    let manifest: serde_json::Value =
        serde_json::from_str(&read(out.path().join("temple/indi-ortho-16_90/run.json"))).unwrap();
    assert_eq!(manifest["config"]["resolution"], serde_json::json!([40, 24]));
    assert_eq!(manifest["config"]["methods"], serde_json::json!(["indi-ortho-16"]));
    assert_eq!(manifest["config"]["scene"], "temple");
}

#[test]
fn complete_runs_are_made_again_only_where_something_changed() {
    let out = tempfile::tempdir().unwrap();
    let run = out.path().join("indi-ortho-16_50");
    printed(&mut small(out.path()));
    let first = made(&run);
    let table = read(out.path().join("summary.csv"));
    printed(&mut small(out.path()));
    assert_eq!(made(&run), first, "an unchanged run was made again");
    assert_eq!(read(out.path().join("summary.csv")), table);
    printed(small(out.path()).arg("--force"));
    let forced = made(&run);
    assert_ne!(forced, first, "--force made nothing");
    printed(small(out.path()).args(["--resolution", "48x34"]));
    let changed = made(&run);
    assert_ne!(changed, forced, "a changed resolution was not noticed");
    assert_ne!(read(out.path().join("summary.csv")), table);
}

#[test]
fn changed_shaders_are_noticed() {
    let directory = tempfile::tempdir().unwrap();
    let shaders = directory.path().join("shaders");
    copy_shaders(&shaders);
    let out = directory.path().join("out");
    let replay = || printed(small(&out).args(["--only", "indi-ortho-16_50", "--shaders"]).arg(&shaders));
    replay();
    let first = made(&out.join("indi-ortho-16_50"));
    let changed = shaders.join("lib/brdf.glsl");
    fs::write(&changed, read(&changed) + "\n// another line\n").unwrap();
    replay();
    assert_ne!(made(&out.join("indi-ortho-16_50")), first);
}

/// A glTF scene of one triangle in front of the first camera.
fn triangle(path: &Path) {
    let corners: [f32; 9] = [-60.0, -20.0, -60.0, 80.0, -20.0, -60.0, 0.0, 60.0, 60.0];
    let bytes: Vec<u8> = corners.iter().flat_map(|corner| corner.to_le_bytes()).collect();
    fs::write(path.with_extension("bin"), bytes).unwrap();
    let stem = path.file_stem().unwrap().to_str().unwrap();
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [-60, -20, -60], "max": [80, 60, 60]}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "buffers": [{{"uri": "{stem}.bin", "byteLength": 36}}]}}"#
    );
    fs::write(path, text).unwrap();
}

#[test]
fn a_failing_run_is_recorded_and_the_rest_go_on() {
    let directory = tempfile::tempdir().unwrap();
    let (out, broken) = (directory.path().join("out"), directory.path().join("broken.gltf"));
    fs::write(&broken, "{").unwrap();
    let scenes = [
        "street=bistro-vive".to_owned(),
        format!("{}=bistro-vive", broken.display()),
        "temple=suntem-vive".to_owned(),
    ];
    let sweep = || {
        let mut command = small(&out);
        command.args(scenes.iter().flat_map(|scene| ["--scenes", scene]));
        command.args(["--exclude", "lights=90"]);
        command
    };
    let message = refused_with(&mut sweep(), 3);
    assert!(message.contains("2 of 6 runs failed") && message.contains("broken.gltf"), "{message}");
    let record = out.join("broken/indi-ortho-16_50.error.json");
    let error: serde_json::Value = serde_json::from_str(&read(&record)).unwrap();
    assert_eq!(error["run"], "broken/indi-ortho-16_50");
    assert!(error["error"].as_str().unwrap().contains("broken.gltf"), "{error}");
    assert_eq!(read(out.join("summary.csv")).lines().count(), 5);
    let street = made(&out.join("street/encl-persp-32_50"));

    triangle(&broken);
    printed(&mut sweep());
    assert!(!record.exists(), "the mended run's failure stayed");
    assert_eq!(read(out.join("summary.csv")).lines().count(), 7);
    assert_eq!(made(&out.join("street/encl-persp-32_50")), street);
}

#[test]
fn two_shards_are_one_sweep() {
    let [whole, shared] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    printed(&mut small(whole.path()));
    printed(small(shared.path()).args(["--shard", "1/2"]));
    assert_eq!(read(shared.path().join("summary.csv")).lines().count(), 3);
    printed(small(shared.path()).args(["--shard", "2/2"]));
    assert_eq!(tables(whole.path()), tables(shared.path()));

    // By name, one after the other, as a workflow does; then the table alone.
    let named = tempfile::tempdir().unwrap();
    for name in printed(small(named.path()).arg("--list-runs")).lines() {
        printed(small(named.path()).args(["--only", name]));
    }
    fs::remove_file(named.path().join("summary.csv")).unwrap();
    printed(small(named.path()).arg("--summarize"));
    assert_eq!(tables(whole.path()), tables(named.path()));
}

#[test]
fn twenty_kills_leave_no_trace_in_the_result() {
    let [undisturbed, disturbed] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let began = Instant::now();
    printed(&mut small(undisturbed.path()));
    let whole = began.elapsed();
    // A fixed sequence of moments that falls everywhere in a sweep: multiples of the golden ratio, modulo one.
    for kill in 1..=20_u32 {
        let moment = (f64::from(kill) * 0.618_033_988_749_895).fract();
        let mut command = small(disturbed.path());
        // Half of them make everything anew, so that there is always something to disturb.
        if kill % 2 == 0 {
            command.arg("--force");
        }
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(moment).min(Duration::from_secs(20)));
        // It may have ended before: that is a moment too.
        let _ = child.kill();
        child.wait().unwrap();
    }
    printed(&mut small(disturbed.path()));
    assert_eq!(tables(undisturbed.path()), tables(disturbed.path()));
    no_temporaries(disturbed.path());
}

#[test]
fn what_cannot_be_swept_is_refused_in_one_line() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out");
    let cases: [(&[&str], &str); 9] = [
        (&["--exclude", "method=indi-orto-16"], "matches no run"),
        (&["--exclude", "lights=50|90"], "no run is left"),
        (&["--exclude", "methods=*"], "did you mean `method`?"),
        (&["--shard", "3/2"], "1 to N"),
        (&["--only", "indi-ortho-16_51"], "did you mean `indi-ortho-16_50`?"),
        (&["--scenes", "street"], "street=bistro"),
        (&["--scenes", "street=bistro", "--scene", "temple"], "scenes excludes scene"),
        (&["--scenes", "nowhere.gltf=bistro", "--scenes", "street=bistro"], "nowhere.gltf"),
        (&["--summarize"], "no complete run"),
    ];
    for (flags, named) in cases {
        let message = refused_with(small(&out).args(flags), 2);
        assert!(message.contains(named), "{flags:?}: {message}");
        assert!(!out.exists(), "{flags:?} left output behind");
    }
    for (text, named) in [
        ("{\"scenes\": []}", "no scene"),
        ("{\"methods\": []}", "no method"),
        ("{\"lights\": []}", "no lighting"),
        ("{\"exclude\": [{}]}", "leaves everything out"),
        ("{\"exclude\": [{\"method\": \"encl-perps-64\"}]}", "matches no run"),
        ("{\"exclude\": [{\"mehtod\": \"encl-*\"}]}", "`method`"),
        ("{\"scenes\": [{\"scene\": \"street\"}]}", "recording"),
    ] {
        let file = directory.path().join("sweep.json");
        fs::write(&file, text).unwrap();
        let message = refused_with(manylight().args(["replay", "--quiet", "--config"]).arg(&file), 2);
        assert!(message.contains("sweep.json") && message.contains(named), "{text}: {message}");
    }
}
