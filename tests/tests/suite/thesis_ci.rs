//! Golden counters of every run of `configs/thesis-ci.json` on lavapipe: `MANYLIGHT_BLESS=1` rewrites them.
//!
//! Nothing is timed, and of the configuration's frames those of its images are rendered: the whole takes three times as
//! long and passes through no other code.

use manylight::config::FrameRange;
use manylight_tests::{blessing, data, manylight};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

const GOLDEN: &str = "golden/thesis-ci.csv";
/// Counters of `frames.csv` that are not sums over `clusterings.csv`.
const OF_FRAMES: [&str; 3] = ["lighting_computations", "needed_computations", "fragments_shaded"];
/// Cells of `clusterings.csv`.
const OF_CLUSTERINGS: [&str; 5] =
    ["clustering", "visible_clusters", "light_indices", "intersection_tests", "lists_hash"];

/// The configuration with the frames of its images alone, no images, and the results below `out`.
fn configuration(out: &Path) -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../configs/thesis-ci.json");
    let mut config: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let images: Vec<u64> =
        config["exr"].as_array().unwrap().iter().map(|frame| frame.as_u64().unwrap()).collect();
    for scene in config["scenes"].as_array_mut().unwrap() {
        let frames: FrameRange = scene["frames"].as_str().unwrap().parse().unwrap();
        let of_scene: Vec<u64> =
            images.iter().copied().filter(|&frame| frames.contains(frame as u32)).collect();
        let [first, last] = of_scene[..] else { panic!("two images of each scene") };
        scene["frames"] = json!(format!("{first}..{}/{}", last + 1, last - first));
    }
    config["exr"] = json!([]);
    config["runs"] = json!(0);
    let path = out.join("config.json");
    fs::write(&path, config.to_string()).unwrap();
    path
}

/// The cells of a table, by row, under these headings.
fn cells<const N: usize>(path: &Path, headings: [&str; N]) -> Vec<[String; N]> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let known = reader.headers().unwrap().clone();
    let columns = headings.map(|heading| known.iter().position(|name| name == heading).unwrap());
    reader.records().map(|row| row.unwrap()).map(|row| columns.map(|column| row[column].to_owned())).collect()
}

/// A line a run, frame and clustering.
fn counters(run: &str, directory: &Path) -> String {
    let [a, b, c] = OF_FRAMES;
    let frames = cells(&directory.join("frames.csv"), ["frame", a, b, c]);
    let [d, e, f, g, h] = OF_CLUSTERINGS;
    let clusterings = cells(&directory.join("clusterings.csv"), ["frame", d, e, f, g, h]);
    let mut text = String::new();
    for [frame, of_frame @ ..] in &frames {
        for [_, of_clustering @ ..] in clusterings.iter().filter(|row| row[0] == *frame) {
            writeln!(text, "{run},{frame},{},{}", of_frame.join(","), of_clustering.join(",")).unwrap();
        }
    }
    text
}

#[test]
fn counters_of_thesis_ci() {
    let out = tempfile::tempdir().unwrap();
    let results = out.path().join("results");
    let replay = || {
        let mut command = manylight();
        command.args(["replay", "--quiet", "--config"]).arg(configuration(out.path()));
        command.arg("--out").arg(&results);
        command
    };
    let listed = replay().arg("--list-runs").output().unwrap();
    let listed = String::from_utf8(listed.stdout).unwrap();
    let made = replay().output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));

    let first = results.join(listed.lines().next().unwrap()).join("run.json");
    let manifest: Value = serde_json::from_str(&fs::read_to_string(first).unwrap()).unwrap();
    let device = manifest["device"]["name"].as_str().unwrap();
    if !device.contains("llvmpipe") {
        eprintln!("golden files are lavapipe's; {device} was not compared");
        return;
    }
    let mut text = format!("run,frame,{},{}\n", OF_FRAMES.join(","), OF_CLUSTERINGS.join(","));
    text.extend(listed.lines().map(|run| counters(run, &results.join(run))));
    let path = data(GOLDEN);
    if blessing() {
        fs::write(&path, text).unwrap();
        return;
    }
    let expected = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let differing = text.lines().zip(expected.lines()).find(|(found, golden)| found != golden);
    assert_eq!(differing, None, "(found, golden) in {}", path.display());
    assert_eq!(text.lines().count(), expected.lines().count(), "lines of {}", path.display());
}
