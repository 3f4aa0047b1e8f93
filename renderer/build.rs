//! Generates what the crate includes from `OUT_DIR`.

#[path = "build/embed_shaders.rs"]
mod embed_shaders;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build/embed_shaders.rs");
    embed_shaders::run();
}
