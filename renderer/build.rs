//! Generates what the crate includes from `OUT_DIR`, and tells it which revision it is built from.

#[path = "build/embed_shaders.rs"]
mod embed_shaders;
#[path = "build/git_revision.rs"]
mod git_revision;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build/embed_shaders.rs");
    println!("cargo::rerun-if-changed=build/git_revision.rs");
    embed_shaders::run();
    git_revision::run();
}
