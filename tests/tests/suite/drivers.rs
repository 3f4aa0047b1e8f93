//! Drivers as the Vulkan loader hands them out.

use manylight_tests::manylight;
use serde_json::{Value, json};
use std::fs;
use std::path::PathBuf;
use std::process::Output;

/// Manifests of installed drivers.
fn installed() -> Vec<Value> {
    let directories = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];
    let mut files: Vec<PathBuf> = directories
        .iter()
        .filter_map(|directory| fs::read_dir(directory).ok())
        .flat_map(|entries| entries.map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .collect();
    files.sort();
    files.iter().map(|path| serde_json::from_slice(&fs::read(path).unwrap()).unwrap()).collect()
}

#[test]
fn drivers_of_the_portability_subset_are_found() {
    let dir = tempfile::tempdir().unwrap();
    let manifest = dir.path().join("driver.json");
    // Of the drivers here some have no device.
    let devices = |driver: &Value| -> Output {
        fs::write(&manifest, driver.to_string()).unwrap();
        // The loader's name for it, and the one before version 1.3.207.
        let names = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];
        manylight().args(["devices", "--json"]).envs(names.map(|name| (name, &manifest))).output().unwrap()
    };
    let mut driver =
        installed().into_iter().find(|driver| devices(driver).status.success()).expect("a driver");
    driver["ICD"]["is_portability_driver"] = json!(true);
    let output = devices(&driver);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let listed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(listed[0]["name"].is_string(), "{listed}");
}
