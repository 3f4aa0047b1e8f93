//! Configurations: from text to values and back.

use super::*;
use crate::lights::{GammaRadii, GammaRecipe, Generator, GeneratorKind, LightBox, LightMotion, VolumeRecipe};
use crate::methods::Method;
use std::path::PathBuf;

/// The message for a configuration file with this text, without the file's name, which it must begin with.
fn refusal(text: &str) -> String {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("my.json");
    std::fs::write(&path, text).unwrap();
    let error = Config::resolve(Some(&path), Layer::default()).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    let message = error.to_string();
    assert!(!message.contains('\n'), "{message}");
    message.strip_prefix(&format!("{}: ", path.display())).expect("names the file").to_owned()
}

fn layer(text: &str) -> Layer {
    file::parse(text).unwrap()
}

fn resolved(layers: &[&str]) -> Result<Config> {
    let mut config = Config::default();
    for text in layers {
        config.apply(layer(text)).map_err(Error::Input)?;
    }
    config.check()?;
    Ok(config)
}

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(path)
}

mod bundled;
mod layers;
mod mistakes;
mod written;
