//! Benchmarks as their users meet them: tables, figures, what measuring costs.

use manylight_tests::manylight;
use manylight_tests::program::{printed, refused};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

#[test]
fn assignment_is_drawn_over_lights_and_over_clusters() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args(["bench", "assign", "--quiet", "--resolution", "64x48", "--frame", "300", "--repeats", "1"]);
    command.args(["--lights", "50,100", "--method", "indi-persp-16", "--method", "indi-persp-32"]);
    printed(command.arg("--out").arg(out.path().join("assign.csv")));
    let read = |name: &str| fs::read_to_string(out.path().join(name)).unwrap();
    let ways = 3;
    let table = read("assign.csv");
    assert_eq!(table.lines().count(), 1 + 2 * 2 * (ways + 1));
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let header = rows.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|column| column == name).unwrap();
    let number = |row: &csv::StringRecord, name: &str| row[place(name)].parse::<f64>().unwrap();
    let mut limit = f64::NAN;
    for row in rows.records().map(Result::unwrap) {
        if &row[place("assign")] == "limit" {
            limit = number(&row, "gpu_ms");
            assert!(limit > 0.0 && number(&row, "over_limit") == 1.0, "{table}");
        } else {
            assert!((number(&row, "over_limit") - number(&row, "gpu_ms") / limit).abs() < 1e-9, "{table}");
        }
    }
    assert_eq!(read("assign.svg").matches("mark-line").count(), 2 * ways);
    assert_eq!(read("assign_clusters.svg").matches("mark-line").count(), 2 * ways);
    let exponents = read("assign_exponents.csv");
    assert_eq!(exponents.lines().count(), 1 + 4 * ways, "{exponents}");
}

#[test]
fn what_cones_cost_and_spare_is_measured_by_every_way() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args(["bench", "assign", "--quiet", "--resolution", "64x48", "--frame", "300", "--repeats", "1"]);
    command.args(["--lights", "300", "--spots", "0.75", "--method", "indi-persp-16"]);
    command.args(["--test", "exact,exact+cone-sat,exact+cone"]);
    printed(command.arg("--out").arg(out.path().join("assign.csv")));
    let mut rows = csv::Reader::from_path(out.path().join("assign.csv")).unwrap();
    let rows: Vec<BTreeMap<String, String>> = rows.deserialize().map(Result::unwrap).collect();
    assert!(rows.len() == 3 * 4 && rows.iter().all(|row| row["spots"] == "225"), "{rows:?}");
    let indices = ["exact", "exact+cone-sat", "exact+cone"].map(|test| {
        let listed: BTreeSet<u64> = rows
            .iter()
            .filter(|row| row["test"] == test)
            .map(|row| row["light_indices"].parse().unwrap())
            .collect();
        assert_eq!(listed.len(), 1, "{test}: {listed:?}");
        listed.first().copied().unwrap()
    });
    let [spheres, axes, cones] = indices;
    assert!(0 < cones && cones <= axes && axes < spheres, "{indices:?}");
    let told = refused(manylight().args(["bench", "assign", "--spots", "1.5"]));
    assert!(told.contains("1.5 is no part of the lights"), "{told}");
}

#[test]
fn methods_that_make_their_lists_in_one_way_are_not_compared() {
    for method in ["raster-24-12-32-e", "hashed-0.5-3", "all-lights"] {
        let told = refused(manylight().args(["bench", "assign", "--method", method]));
        assert!(told.contains(method) && told.contains("one way alone"), "{told}");
    }
}

#[test]
fn measuring_costs_a_ratio_of_each_run() {
    let mut command = manylight();
    command.args([
        "bench",
        "scopes",
        "--json",
        "--resolution",
        "64x48",
        "--frames",
        "300..381/80",
        "--runs",
        "2",
    ]);
    command.args(["--lights", "50", "--method", "indi-persp-64", "--method", "all-lights", "--validate"]);
    let rows: serde_json::Value = serde_json::from_str(&printed(&mut command)).unwrap();
    let rows = rows.as_array().unwrap();
    assert_eq!(
        rows.iter().map(|row| row["run"].as_str().unwrap()).collect::<Vec<_>>(),
        ["indi-persp-64", "all-lights"]
    );
    for row in rows {
        assert_eq!(row["frames"], 2);
        let number = |name: &str| row[name].as_f64().unwrap();
        assert!(number("all_ms") > 0.0 && number("frame_ms") > 0.0 && number("ratio") > 0.0, "{row}");
    }
    for wrong in [["--runs", "0"], ["--scopes", "frame"]] {
        let refused = manylight().args(["bench", "scopes"]).args(wrong).output().unwrap();
        assert_eq!(refused.status.code(), Some(2), "{wrong:?}");
    }
}
