//! Writes `embedded_shaders.rs`: the table of all files of `shaders-glsl/`, sorted by path.

use std::path::{Path, PathBuf};
use std::{env, fs};

const EXTENSIONS: [&str; 4] = ["vert", "frag", "comp", "glsl"];

/// Generates the table in `OUT_DIR`, again whenever a file there comes, goes or changes.
pub fn run() {
    let manifest = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let root = manifest.parent().expect("the crate lies in the workspace").join("shaders-glsl");
    let mut files = Vec::new();
    collect(&root, "", &mut files);
    files.sort();
    let rows: String = files
        .iter()
        .map(|(name, path)| format!("    ({name:?}, include_str!({:?})),\n", path.display().to_string()))
        .collect();
    let table = format!("/// Every file of `shaders-glsl/`.\nconst EMBEDDED: Embedded = &[\n{rows}];\n");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it")).join("embedded_shaders.rs");
    fs::write(&out, table).unwrap_or_else(|error| panic!("{}: {error}", out.display()));
}

/// Adds (path below the root with slashes, path) of all sources in `folder`; cargo watches the folder.
fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, PathBuf)>) {
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries {
        let path = entry.unwrap_or_else(|error| panic!("{}: {error}", folder.display())).path();
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
            panic!("{}: the name must be UTF-8", path.display());
        };
        let name = format!("{prefix}{name}");
        if path.is_dir() {
            collect(&path, &format!("{name}/"), files);
        } else if path.extension().is_some_and(|e| EXTENSIONS.iter().any(|known| e == *known)) {
            files.push((name, path));
        }
    }
}
