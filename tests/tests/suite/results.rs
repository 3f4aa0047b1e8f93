//! Results on disk: damaged ones are refused, a run is known by what it was asked to do, lights by what they are.

use manylight_tests::manylight;
use manylight_tests::program::{output, refused, succeed, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A scene of one floor of 40 by 40 metres, a camera above it, and two lights.
struct Inputs {
    directory: tempfile::TempDir,
}

const LIGHTS: &str = "x,y,z,r,g,b,i,i0,r0\n1,1,1,1,1,1,20,0.5,0.1\n-4,2,3,1,0.5,0.5,50,0.5,0.1\n";

impl Inputs {
    fn new() -> Self {
        let inputs = Self { directory: tempfile::tempdir().unwrap() };
        inputs.write("floor.obj", "v -20 0 -20\nv -20 0 20\nv 20 0 20\nv 20 0 -20\nf 1 2 3 4\n");
        inputs.write("lights.csv", LIGHTS);
        inputs.write(
            "way.json",
            r#"{"format": "manylight.waypoints/1", "dt_s": 0.05, "near": 0.4, "far": 100, "fov": 1.2, "waypoints": [
                {"position": [0, 4, 12], "target": [0, 0, 0], "time_s": 0},
                {"position": [2, 4, 12], "target": [0, 0, 0], "time_s": 0.1}]}"#,
        );
        succeed(inputs.command().args(["bake-recording", "way.json", "--out", "flight.json"]));
        inputs
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// The program, among the inputs.
    fn command(&self) -> Command {
        let mut command = manylight();
        command.current_dir(self.directory.path());
        command
    }

    fn replay(&self, out: &str, more: &[&str]) -> Command {
        let mut command = self.command();
        command.args([
            "replay",
            "--scene",
            "floor.obj",
            "--recording",
            "flight.json",
            "--resolution",
            "48x32",
        ]);
        command
            .args(["--frames", "0..2", "--runs", "1", "--method", "indi-persp-16", "--out", out])
            .args(more);
        command
    }

    /// The same under the lights of a file.
    fn lit(&self, out: &str, lights: &str) -> Command {
        self.replay(out, &["--lights-file", lights])
    }

    fn compare(&self, a: &str, b: &str) -> Output {
        output(self.command().args(["compare", a, b]))
    }
}

/// Puts `cell` into a column of the first row of a table.
fn put(path: &Path, column: &str, cell: &str) {
    let text = fs::read_to_string(path).unwrap();
    let mut lines: Vec<Vec<String>> =
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    let place = lines[0].iter().position(|name| name == column).unwrap();
    lines[1][place] = cell.to_owned();
    fs::write(path, lines.iter().map(|line| line.join(",") + "\n").collect::<String>()).unwrap();
}

#[test]
fn damaged_runs_are_refused_by_every_reader_and_made_again_by_a_replay() {
    let inputs = Inputs::new();
    succeed(inputs.lit("good", "lights.csv").arg("--quiet"));
    succeed(inputs.lit("out", "lights.csv").arg("--quiet"));
    let whole = |name: &str| inputs.read(&format!("good/indi-persp-16/{name}"));
    let cut = |name: &str| whole(name)[..whole(name).len() / 2].to_owned();
    let at = |name: &str| inputs.path("out/indi-persp-16").join(name);
    type Damage<'a> = (&'a str, &'a str, Box<dyn Fn() + 'a>);
    let table = |name: &'static str, column: &'static str, cell: &'static str| -> Box<dyn Fn() + '_> {
        Box::new(move || put(&at(name), column, cell))
    };
    let damages: Vec<Damage> = vec![
        ("frames.csv", "is empty", Box::new(|| fs::write(at("frames.csv"), "").unwrap())),
        ("frames.csv", "line 2", table("frames.csv", "lighting_computations", "NaN")),
        ("frames.csv", "line 2", table("frames.csv", "visible_clusters", "-1")),
        ("frames.csv", "line 2", table("frames.csv", "gpu_ms_frame", "inf")),
        ("frames.csv", "line 2", table("frames.csv", "gpu_ms_shade", "NaN")),
        ("frames.csv", "within line", Box::new(|| fs::write(at("frames.csv"), cut("frames.csv")).unwrap())),
        ("timings.csv", "line 2", table("timings.csv", "gpu_ms", "-3")),
        ("timings.csv", "is missing", Box::new(|| fs::remove_file(at("timings.csv")).unwrap())),
        ("histograms.csv", "add up to", table("histograms.csv", "clusters", "99")),
        ("clusterings.csv", "add up to", table("clusterings.csv", "light_indices", "7")),
        ("run.json", "line", Box::new(|| fs::write(at("run.json"), cut("run.json")).unwrap())),
    ];
    let [mut summarize, mut report, mut compare] =
        [inputs.lit("out", "lights.csv"), inputs.command(), inputs.command()];
    summarize.arg("--summarize");
    report.args(["report", "out"]);
    compare.args(["compare", "good", "out"]);
    for (file, expected, damage) in &damages {
        damage();
        for reader in [&mut summarize, &mut report, &mut compare] {
            let message = refused(reader);
            assert!(message.contains(file) && message.contains(expected), "{reader:?}: {message}");
        }
        let again = text(&succeed(&mut inputs.lit("out", "lights.csv")).stderr);
        assert!(again.contains("the run is made again"), "{file}: {again}");
        let good = text(&succeed(&mut inputs.lit("out", "lights.csv")).stderr);
        assert!(good.contains("1 of 1 runs were complete and unchanged"), "{file}: {good}");
    }
    assert_eq!(inputs.compare("good", "out").status.code(), Some(0));
}

#[test]
fn a_lights_file_is_known_by_what_it_holds() {
    let inputs = Inputs::new();
    inputs.write("elsewhere/other.csv", LIGHTS);
    succeed(inputs.lit("a", "lights.csv").arg("--quiet"));
    for (out, spelled) in [("b", "./lights.csv"), ("c", "elsewhere/other.csv")] {
        succeed(inputs.lit(out, spelled).arg("--quiet"));
        let compared = inputs.compare("a", out);
        assert_eq!(compared.status.code(), Some(0), "{}", text(&compared.stdout));
    }
    let manifest: serde_json::Value = serde_json::from_str(&inputs.read("a/indi-persp-16/run.json")).unwrap();
    assert_eq!(manifest["lights_file"]["name"], "lights.csv");
    assert_eq!(manifest["lights_file"]["sha256"].as_str().unwrap().len(), 64);
    let same = text(&succeed(inputs.command().args(["report", "a", "b", "c"])).stdout);
    assert!(same.starts_with("1 runs;") && same.contains("is the same run, made later"), "{same}");

    inputs.write("lights.csv", &LIGHTS.replace("50", "51"));
    succeed(inputs.lit("d", "lights.csv").arg("--quiet"));
    let compared = inputs.compare("a", "d");
    assert_eq!(compared.status.code(), Some(1));
    let said = text(&compared.stdout);
    assert!(
        said.contains("missing in A: indi-persp-16, lights.csv (") && !said.contains("counters"),
        "{said}"
    );
    let both = text(&succeed(inputs.command().args(["report", "a", "d"])).stdout);
    assert!(both.starts_with("2 runs;") && !both.contains("made later"), "{both}");
}

#[test]
fn two_sweeps_into_one_directory_are_reported_and_compared() {
    let inputs = Inputs::new();
    for sweep in [
        &["--lights", "10"][..],
        &["--lights", "10", "--assign", "brute,scatter"],
        &["--lights", "10", "--lights", "20"],
    ] {
        succeed(inputs.replay("out", sweep).arg("--quiet"));
    }
    for name in ["", "_brute", "_scatter", "_10", "_20"] {
        assert!(inputs.path(&format!("out/indi-persp-16{name}/run.json")).is_file(), "{name}");
    }
    let report: serde_json::Value =
        serde_json::from_slice(&succeed(inputs.command().args(["report", "out", "--json"])).stdout).unwrap();
    assert_eq!(report["runs"], 3);
    let newest: Vec<&str> =
        report["older"].as_array().unwrap().iter().map(|older| older["newer"].as_str().unwrap()).collect();
    assert_eq!(newest, ["indi-persp-16_10", "indi-persp-16_10"]);
    assert_eq!(inputs.compare("out", "out").status.code(), Some(0));
}

#[test]
fn a_recording_without_rain_rains_in_the_scene() {
    let inputs = Inputs::new();
    assert!(!inputs.read("flight.json").contains("rain"));
    let replayed = succeed(&mut inputs.replay("out", &["--lights", "200,1"]));
    let said = text(&replayed.stderr);
    assert!(
        said.contains("it rains in the scene's box, from [-20.0, 0.0, -20.0] to [20.0, 4.0, 20.0]"),
        "{said}"
    );
    assert!(!said.contains("no light reaches"), "{said}");
    let needed = needed(&inputs.path("out/indi-persp-16/frames.csv"));
    assert!(needed.iter().all(|&count| count > 0), "{needed:?}");
}

#[test]
fn a_run_tells_its_machine_and_no_name_of_a_host_or_a_user() {
    let inputs = Inputs::new();
    succeed(&mut inputs.lit("out", "lights.csv"));
    let manifest: serde_json::Value =
        serde_json::from_str(&inputs.read("out/indi-persp-16/run.json")).unwrap();
    let keys = |value: &serde_json::Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let [host, device] = ["host", "device"].map(|part| &manifest["machine"][part]);
    let of_host = "cpu cores threads usable_threads memory_bytes os kernel architecture";
    assert!(keys(host).iter().all(|key| of_host.split(' ').any(|known| known == key)), "{host}");
    let of_device = "kind uuid driver_id vendor_id device_id pci heaps";
    assert!(keys(device).iter().all(|key| of_device.split(' ').any(|known| known == key)), "{device}");
    assert_eq!(device["uuid"].as_str().unwrap().len(), 36, "{device}");
    assert!(device["heaps"][0]["bytes"].as_u64().unwrap() > 0, "{device}");
    let conditions = &manifest["conditions"];
    assert!(conditions["timed_s"].as_f64().unwrap() > 0.0, "{conditions}");
    if cfg!(target_os = "linux") {
        let count = |key: &str| conditions["cpu"][key].as_u64().unwrap();
        assert!(count("cpus") > 0 && count("own") + count("others") <= count("all") + 20, "{conditions}");
        assert!(host["memory_bytes"].as_u64().unwrap() > 0 && !host["kernel"].as_str().unwrap().is_empty());
    }
}

#[test]
fn doubts_are_told_and_do_not_make_a_run_anew() {
    let inputs = Inputs::new();
    succeed(&mut inputs.lit("out", "lights.csv"));
    let manifest = "out/indi-persp-16/run.json";
    let mut value: serde_json::Value = serde_json::from_str(&inputs.read(manifest)).unwrap();
    value["doubts"] = serde_json::json!(["somebody <sang>"]);
    value["machine"]["device"]["uuid"] = "another card".into();
    inputs.write(manifest, &value.to_string());
    let again = text(&succeed(&mut inputs.lit("out", "lights.csv")).stderr);
    assert!(again.contains("times of 1 of 1 runs are doubtful"), "{again}");
    assert!(again.contains("\n  indi-persp-16: somebody <sang>\n"), "{again}");
    assert!(again.contains("1 of 1 runs were complete and unchanged"), "{again}");
    assert_eq!(text(&succeed(inputs.lit("out", "lights.csv").arg("--quiet")).stderr), "");
    succeed(inputs.command().args(["report", "out"]));
    let page = inputs.read("out/report/index.html");
    assert!(page.contains("Times of 1 of 1 runs are doubtful"));
    assert!(page.contains("<th>indi-persp-16</th><td>somebody &lt;sang&gt;</td>"));
    assert!(page.contains("<td>another card</td>"));
}

fn needed(path: &Path) -> Vec<u64> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let column = reader.headers().unwrap().iter().position(|name| name == "needed_computations").unwrap();
    reader.records().map(|row| row.unwrap()[column].parse().unwrap()).collect()
}

#[test]
fn a_replay_in_the_dark_says_so() {
    let inputs = Inputs::new();
    inputs.write("far.csv", "x,y,z,r,g,b,i,i0,r0\n0,900,0,1,1,1,20,0.5,0.1\n");
    for json in ["--quiet", "--json"] {
        let replayed = succeed(inputs.lit("dark", "far.csv").args([json, "--force"]));
        let said = text(&replayed.stderr);
        assert!(said.contains("WARN") && said.contains("no light reaches anything that is seen"), "{said}");
    }
    assert_eq!(needed(&inputs.path("dark/indi-persp-16/frames.csv")), [0, 0]);
}
