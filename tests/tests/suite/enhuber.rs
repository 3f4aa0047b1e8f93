//! `configs/enhuber-ci.json` holds what every figure, table and claim of Enhuber's evaluation needs: its runs in one scene, with fewer
//! pixels and frames, are replayed and reported.

use manylight_tests::manylight;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The configuration in the street alone, in pictures of a few hundred pixels.
fn configuration(out: &Path) -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../configs/enhuber-ci.json");
    let mut config: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    config["scenes"] = json!([{ "scene": "street", "recording": "bistro", "frames": "160..441/140" }]);
    config["resolution"] = json!([32, 18]);
    config["runs"] = json!(2);
    config["out"] = json!(out.join("results"));
    let path = out.join("config.json");
    fs::write(&path, config.to_string()).unwrap();
    path
}

#[test]
fn every_figure_table_and_claim_has_data() {
    let out = tempfile::tempdir().unwrap();
    let mut replay = manylight();
    replay.args(["replay", "--quiet", "--report", "--config"]).arg(configuration(out.path()));
    let made = replay.output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));

    let report = out.path().join("results/report");
    let claims: Vec<Value> =
        serde_json::from_str(&fs::read_to_string(report.join("claims.json")).unwrap()).unwrap();
    let ids: Vec<&str> = claims.iter().map(|claim| claim["id"].as_str().unwrap()).collect();
    assert_eq!(ids, (1..=13).map(|number| format!("E{number}")).collect::<Vec<_>>());
    for claim in &claims {
        assert_eq!(
            (&claim["missing"], claim["evidence"].as_array().unwrap().is_empty()),
            (&json!([]), false),
            "{claim}"
        );
        assert_ne!(claim["verdict"], "not enough data", "{claim}");
    }
    // Lists of G and M do not depend on the view, whatever the machine.
    assert_eq!(claims[10]["verdict"], "holds", "{}", claims[10]);

    let files: BTreeSet<String> = fs::read_dir(report.join("figures"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    for figure in (1..=13).map(|number| format!("E4.{number}.svg")).chain(["E4.13-fit.svg".into()]) {
        assert!(files.contains(&figure), "{figure} is not drawn: {files:?}");
    }
    let tables = ["scenes", "sizes", "variability", "4.4", "4.5", "4.6", "ratios", "printed"];
    for table in tables.map(|table| format!("enhuber-{table}.csv")) {
        let text = fs::read_to_string(report.join(&table)).unwrap_or_else(|error| panic!("{table}: {error}"));
        assert!(text.lines().count() > 1, "{table} has rows");
    }
    let mut scenes = csv::Reader::from_path(report.join("enhuber-scenes.csv")).unwrap();
    let scene: BTreeMap<String, String> = scenes.deserialize().next().unwrap().unwrap();
    assert_eq!((scene["scene_triangles"].as_str(), scene["frames"].as_str()), ("47262", "670"));
    for axis in ["x", "y", "z"] {
        let [scene, lights] =
            ["scene's", "lights'"].map(|whose| scene[&format!("{whose}_box_{axis}")].parse::<f64>().unwrap());
        assert!(
            (scene - lights).abs() < 1e-3 * scene,
            "lights fill the scene's box: {scene} and {lights} m along {axis}"
        );
    }
    let page = fs::read_to_string(report.join("index.html")).unwrap();
    assert!(
        page.contains("id=\"enhuber\"") && !page.contains("id=\"chapter-6\""),
        "the page is of what was run"
    );
}
