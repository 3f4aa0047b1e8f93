//! `run.json`, as far as a report needs it.

use crate::methods::MethodSpec;
use crate::output::RUN_FORMAT;
use crate::report::format::grouped;
use crate::report::results::{LightingName, Setting};
use crate::report::way::Way;
use crate::{Error, Result};
use serde::Deserialize;
use std::fs;
use std::path::Path;

/// A manifest; fields that a report does not use are left where they are.
#[derive(Debug, Clone, Deserialize)]
pub struct RunFile {
    pub version: String,
    pub git_revision: String,
    method: String,
    lighting: Option<Lighting>,
    pub config: RunConfig,
    scene: Source,
    recording: Source,
    lights_file: Option<Source>,
    device: Device,
    pub started: String,
    pub duration_s: f64,
}

#[derive(Debug, Clone, Deserialize)]
struct Lighting {
    count: u32,
    intensity: f64,
    cutoff: f64,
    r0: f64,
}

#[derive(Debug, Clone, Deserialize)]
pub struct RunConfig {
    resolution: [u32; 2],
    #[serde(default = "one")]
    msaa: u32,
    #[serde(default)]
    pub runs: u32,
    attenuation: Option<String>,
    marking: Option<String>,
    displaced_volume: Option<String>,
    lights_file: Option<String>,
    assign: Option<OneOrSeveral>,
    test: Option<OneOrSeveral>,
}

/// An axis of a sweep; a run's own configuration has one value on it.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum OneOrSeveral {
    One(String),
    Several(Vec<String>),
}

impl OneOrSeveral {
    fn name(&self) -> String {
        match self {
            Self::One(name) => name.clone(),
            Self::Several(names) => names.join(" or "),
        }
    }
}

fn one() -> u32 {
    1
}

#[derive(Debug, Clone, Deserialize)]
struct Source {
    name: String,
    sha256: String,
}

#[derive(Debug, Clone, Deserialize)]
struct Device {
    name: String,
    driver: String,
    api: String,
}

/// Reads a manifest of this program's format.
pub fn read(path: &Path) -> Result<RunFile> {
    let text =
        fs::read_to_string(path).map_err(|error| Error::file(path, format!("cannot be read: {error}")))?;
    let value: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| Error::file(path, format!("is not JSON: {error}")))?;
    match value.get("format").and_then(serde_json::Value::as_str) {
        Some(RUN_FORMAT) => {}
        Some(other) if other.starts_with("manylight.run/") => {
            let problem = format!("has format {other}, and this version reads {RUN_FORMAT}: measure anew");
            return Err(Error::file(path, problem));
        }
        _ => {
            let problem =
                format!("was not written by a replay (its format is not {RUN_FORMAT}): leave it out");
            return Err(Error::file(path, problem));
        }
    }
    serde_path_to_error::deserialize(value).map_err(|error| {
        let field = match error.path().to_string().as_str() {
            "." => String::new(),
            field => format!("{field}: "),
        };
        Error::file(path, format!("{field}{}: measure anew", error.into_inner()))
    })
}

impl RunFile {
    /// Version and revision of the program that measured.
    pub fn built(&self) -> String {
        format!("manylight {} ({})", self.version, self.git_revision)
    }

    pub fn method(&self, path: &Path) -> Result<MethodSpec> {
        self.method.parse().map_err(|error| Error::file(path, format!("method: {error}")))
    }

    pub fn setting(&self, views: u32, method: MethodSpec) -> Setting {
        // What is as in the thesis goes without saying.
        let unusual = [
            (&self.config.attenuation, "phy_red_2", "attenuation"),
            (&self.config.marking, "depth", "marking from"),
            (&self.config.displaced_volume, "view", "displaced volume"),
        ];
        let options = unusual.into_iter().filter_map(|(value, usual, what)| {
            let value = value.as_ref().filter(|value| *value != usual)?;
            Some(format!("{what} {value}"))
        });
        Setting {
            scene: self.scene.name.clone(),
            recording: self.recording.name.clone(),
            views,
            resolution: self.config.resolution,
            msaa: self.config.msaa,
            options: options.collect(),
            hashes: [self.scene.sha256.clone(), self.recording.sha256.clone()],
            way: self.way(method),
        }
    }

    fn way(&self, method: MethodSpec) -> Way {
        let [assign, test] =
            [&self.config.assign, &self.config.test].map(|axis| axis.as_ref().map(OneOrSeveral::name));
        Way::new(assign, test, method)
    }

    pub fn lighting(&self) -> LightingName {
        if let Some(Lighting { count, intensity, cutoff, r0 }) = self.lighting {
            let mut label = format!("{} lights", grouped(u64::from(count)));
            // The thesis's intensity of each count goes without saying.
            if !matches!((count, intensity), (1000, 100.0) | (10_000, 20.0) | (100_000, 1.0)) {
                label += &format!(", I {intensity}");
            }
            for (name, value, usual) in [("I₀", cutoff, 0.5), ("R₀", r0, 0.1)] {
                if value != usual {
                    label += &format!(", {name} {value}");
                }
            }
            return LightingName { count: Some(count), label, sha256: None };
        }
        match &self.lights_file {
            Some(Source { name, sha256 }) => {
                let label = format!("{name} ({sha256:.8})");
                LightingName { count: None, label, sha256: Some(sha256.clone()) }
            }
            None => {
                let label = self.config.lights_file.clone().unwrap_or_else(|| "the scene's lights".into());
                LightingName { count: None, label, sha256: None }
            }
        }
    }

    /// What tells its lights from those of others.
    pub fn lights_key(&self) -> String {
        let LightingName { label, sha256, .. } = self.lighting();
        sha256.unwrap_or(label)
    }

    pub fn device(&self) -> [String; 3] {
        let Device { name, driver, api } = &self.device;
        [name.clone(), driver.clone(), api.clone()]
    }
}
