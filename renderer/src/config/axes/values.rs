//! Values along axes: the configurations that have one each, and their names.

use crate::config::{Choice, Config, Lighting, LightsFrom, Own, SceneEntry};
use std::path::Path;

pub(super) fn of_scene(config: &Config, entry: &SceneEntry, several: bool) -> Config {
    let frames = entry.frames.unwrap_or(config.frames);
    Config {
        scene: entry.scene.clone(),
        recording: entry.recording.clone(),
        scenes: Vec::new(),
        exclude: Vec::new(),
        resolution: entry.resolution.unwrap_or(config.resolution),
        resolutions: if entry.resolution.is_some() { vec![] } else { config.resolutions.clone() },
        frames,
        lights: own(&entry.lights, &config.lights),
        light_volumes: own(&entry.light_volumes, &config.light_volumes),
        exr: if several { config.exr.within(&frames) } else { config.exr.clone() },
        ..config.clone()
    }
}

/// What a scene has of its own, or else what all have.
fn own<T: Clone>(own: &[T], all: &[T]) -> Vec<T> {
    if own.is_empty() { all.to_vec() } else { own.to_vec() }
}

pub(super) fn each<T: Copy>(values: &[T], with: impl Fn(T) -> Config) -> Vec<Config> {
    values.iter().map(|&value| with(value)).collect()
}

/// What they are for the method of a run; those of all methods as they are.
pub(super) fn choices<T: Own>(run: &Config, values: &[Choice<T>]) -> Vec<Choice<T>> {
    match run.methods.as_slice() {
        [method] => values.iter().map(|choice| choice.resolved(method)).collect(),
        _ => values.to_vec(),
    }
}

pub(super) fn names<T: ToString>(values: &[T]) -> String {
    values.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
}

pub(super) fn name_and_stem(name: &str) -> Vec<String> {
    let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    [name.to_owned()].into_iter().chain(stem).collect()
}

/// What tells a lighting from the others.
pub(super) fn lighting_name(lights: &LightsFrom, all: &[LightsFrom]) -> String {
    let count = |lights: &LightsFrom| lights.lighting().map(|lighting| lighting.count);
    match lights.lighting() {
        Some(Lighting { count: n, intensity, cutoff, r0 })
            if all.iter().filter(|other| count(other) == Some(n)).count() > 1 =>
        {
            format!("{n}-{intensity}-{cutoff}-{r0}")
        }
        _ => lights.to_string(),
    }
}
