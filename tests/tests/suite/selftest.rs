//! The self-test as its users meet it: fine on the device at hand, and naming what is wrong where shaders were spoilt.

use manylight_tests::{copy_shaders, manylight};
use serde_json::Value;
use std::fs;
use std::process::Output;

/// Runs some checks with a text of a shader replaced.
fn with_fault((file, good, bad): (&str, &str, &str), checks: &[&str]) -> Output {
    let directory = tempfile::tempdir().unwrap();
    let shaders = directory.path().join("shaders");
    copy_shaders(&shaders);
    let path = shaders.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(good), "{file} no longer says {good}");
    fs::write(&path, text.replace(good, bad)).unwrap();
    let mut command = manylight();
    command.args(["selftest", "--json"]).arg("--shaders").arg(&shaders);
    command.args(checks.iter().flat_map(|check| ["--check", check])).output().unwrap()
}

/// The checks that found something wrong, with what they found.
fn faults(output: &Output) -> Vec<(String, String)> {
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let checks = found["checks"].as_array().unwrap().iter();
    let text = |check: &Value, key: &str| check[key].as_str().unwrap().to_owned();
    checks
        .filter(|check| check["verdict"] == "wrong")
        .map(|check| (text(check, "check"), text(check, "found")))
        .collect()
}

#[test]
fn a_device_on_which_all_is_well_is_fit_and_every_check_says_what_it_measured() {
    let empty = tempfile::tempdir().unwrap();
    let output = manylight().arg("selftest").current_dir(empty.path()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert_eq!(
        text.lines().filter(|line| line.starts_with("ok ") || line.starts_with("note ")).count(),
        14,
        "{text}"
    );
    assert!(text.contains("found nothing wrong, 14 checks in "), "{text}");
}

#[test]
fn a_slack_of_nothing_loses_lights_that_touch() {
    let fault = ("lib/light_volume.glsl", "+ max(grid.slack, grid.slack_per_radius * reach)", "");
    let found = faults(&with_fault(fault, &["lists", "touching"]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].0 == "touching" && found[0].1.contains("are not on its list"), "{found:?}");
}

#[test]
fn a_list_that_is_cut_is_not_that_of_the_twin() {
    let end = "uint entry = entries.x, end = entries.y;";
    let cut = end.replace("entries.y", "max(1u, entries.y) - 1u");
    let found = faults(&with_fault(("assign/read_masks.comp", end, &cut), &["scan", "lists"]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].0 == "lists" && found[0].1.starts_with("brute force of "), "{found:?}");
}

#[test]
fn triangles_that_are_not_grown_miss_tiles() {
    let fault = ("raster/shell.vert", "GROWTH = 0.5 + 1.0 / 16.0", "GROWTH = 0.25");
    let found = faults(&with_fault(fault, &["lists", "shells"]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].0 == "shells" && found[0].1.starts_with("software: "), "{found:?}");
}

#[test]
fn a_sample_position_that_is_not_the_rasterisers_is_told_with_its_distance() {
    let fault = ("lib/sample_positions.glsl", "vec2(0.875, 0.375)", "vec2(0.625, 0.375)");
    let found = faults(&with_fault(fault, &["log2", "samples"]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0], ("samples".to_owned(), "a sample lies 0.250 pixels from its place".to_owned()));
}

#[test]
fn a_check_that_is_none_is_a_mistake_of_the_user() {
    let output = manylight().args(["selftest", "--check", "touchin"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("did you mean `touching`?"), "{said}");
}
