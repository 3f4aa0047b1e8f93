//! Tuning as its users meet it: the table, and the configuration that replays what was found.

use manylight_tests::manylight;
use manylight_tests::program::{printed, refused, stderr, succeed, text};
use serde_json::Value;
use std::fs;
use std::process::Command;

/// A search of two methods under two lightings, in two small frames.
fn small() -> Command {
    let mut command = manylight();
    command.args(["tune", "--resolution", "48x32", "--frames", "300..381/80", "--recording", "bistro"]);
    command.args(["--lights", "40", "--lights", "90", "--method", "encl-ortho-2", "--method", "all-lights"]);
    command.args(["--max-runs", "5", "--test", "auto", "--assign", "brute,scatter"]);
    command
}

#[test]
fn what_is_found_is_told_and_can_be_replayed() {
    let out = tempfile::tempdir().unwrap();
    let file = out.path().join("tuned.json");
    let told = printed(small().args(["--json", "--validate", "--write"]).arg(&file));
    let told: Value = serde_json::from_str(&told).unwrap();
    let rows = told["rows"].as_array().unwrap();
    let names: Vec<String> =
        rows.iter().map(|row| format!("{} {}", row["lighting"], row["method"]).replace('"', "")).collect();
    assert_eq!(names, ["40 encl-ortho-2", "40 all-lights", "90 encl-ortho-2", "90 all-lights"]);
    let mut expected = vec![];
    for row in rows {
        let number = |name: &str| row[name].as_f64().unwrap();
        assert!(number("named_ms") > 0.0 && number("total_ms") > 0.0 && number("frames") == 2.0, "{row}");
        assert!((number("total_ms") / number("named_ms") - number("ratio")).abs() < 1e-9, "{row}");
        // Sizes 4 to 0.25, each by two ways, of which any may have been found too slow.
        let tried = if row["method"] == "all-lights" { 1.0 } else { 18.0 };
        assert_eq!(number("tried") + number("left_out"), tried, "{row}");
        expected.push(format!("{} {} {}", row["lighting"], row["tuned"], row["assign"]).replace('"', ""));
    }
    let replay = |more: &[&str]| {
        let mut command = manylight();
        printed(command.args(["replay", "--config"]).arg(&file).args(more))
    };
    let runs = replay(&["--list-runs"]);
    assert_eq!(runs.lines().count(), 4, "{runs}");
    let directory = out.path().join("runs");
    let summary = replay(&["--runs", "1", "--json", "--out", directory.to_str().unwrap()]);
    let summary: Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["rows"].as_array().unwrap().len(), 4, "{summary}");
    let mut replayed: Vec<String> = fs::read_dir(&directory)
        .unwrap()
        .filter_map(|entry| fs::read_to_string(entry.unwrap().path().join("run.json")).ok())
        .map(|text| {
            let run: Value = serde_json::from_str(&text).unwrap();
            let method = run["method"].as_str().unwrap();
            let assign = if method == "all-lights" { "" } else { run["config"]["assign"].as_str().unwrap() };
            format!("{} {method} {assign}", run["lighting"]["count"])
        })
        .collect();
    replayed.sort();
    expected.sort();
    assert_eq!(replayed, expected);
}

#[test]
fn people_get_a_table() {
    let out = tempfile::tempdir().unwrap();
    let file = out.path().join("tuned.json");
    let output = succeed(small().args(["--frames", "300", "--runs", "2", "--write"]).arg(&file));
    let (table, notes) = (text(&output.stdout), stderr(&output));
    for found in ["encl-ortho-2 40: encl-ortho-", "all-lights 90: all-lights of 1 wins"] {
        assert!(notes.contains(found), "each is told as it is found: {notes}");
    }
    let heading = table.lines().nth(1).unwrap();
    assert!(
        ["lights", "method", "tuned", "assign", "test", "ratio"].iter().all(|name| heading.contains(name))
    );
    assert!(table.contains("encl-ortho-2"), "{table}");
}

#[test]
fn what_cannot_be_tuned_is_refused_and_nothing_is_written() {
    let out = tempfile::tempdir().unwrap();
    let file = out.path().join("tuned.json");
    for (flags, word) in [
        (["--runs", "0"], "runs"),
        (["--lights", "40,50"], "40 lights"),
        (["--method", "encl-ortho-0.001"], "encl-ortho-0.001"),
        (["--test", "nearest"], "test"),
        (["--scene", "nowhere.gltf"], "nowhere.gltf"),
    ] {
        let message = refused(small().args(flags).args(["--quiet", "--write"]).arg(&file));
        assert!(message.contains(word), "{flags:?}: {message}");
        assert!(!file.exists());
    }
    assert!(refused(small().arg("--quiet")).contains("--write"));
}
