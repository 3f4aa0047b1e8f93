//! `run.json`: how a run came to be.

use super::strict::{refuse, shown};
use crate::config::Config;
use crate::extent::Extent;
use crate::lights::{Generated, GeneratorKind, Lighting};
use crate::machine::{Conditions, Machine};
use crate::measure::{Capacities, Extremes, GrowthEvent, Timing};
use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// By this file a run directory is known.
pub const MANIFEST: &str = "run.json";

/// Format and version of `run.json`.
pub const RUN_FORMAT: &str = "manylight.run/1";

/// The git revision that the program was built from, or `unknown`.
pub fn git_revision() -> &'static str {
    env!("MANYLIGHT_GIT_REVISION")
}

/// Everything that made a run what it is. What earlier versions left out may be missing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// [`RUN_FORMAT`].
    pub format: String,
    /// Version of the program.
    pub version: String,
    /// [`git_revision`].
    pub git_revision: String,
    /// Hexadecimal SHA-256 over all that the run's results depend on; a run with the same is not made again.
    #[serde(default)]
    pub fingerprint: String,
    /// The method's name.
    pub method: String,
    /// Number and strength of lights that were made; `None` where lights come from a file or the scene.
    pub lighting: Option<Lighting>,
    /// The fully resolved configuration of this run alone; it can be replayed as it is.
    pub config: Config,
    /// How the light lists were built: `brute`, `hierarchy` or `scatter`.
    #[serde(default)]
    pub assigned_by: String,
    /// The scene drawn.
    pub scene: Source,
    /// The recording replayed.
    pub recording: Source,
    /// How large scene, models and the camera's way are; `None` of earlier versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extent: Option<Extent>,
    /// The file of static lights, where they come from one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lights_file: Option<Source>,
    /// What made the lights, where they come from neither a file nor the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub generated: Option<Generated>,
    /// Rows of `frames.csv`.
    pub frame_count: Option<usize>,
    /// The device that rendered.
    pub device: DeviceInfo,
    /// The machine it ran on.
    #[serde(default)]
    pub machine: Machine,
    /// How the machine fared in the temporal runs.
    #[serde(default)]
    pub conditions: Conditions,
    /// Why times are doubtful, a sentence each; see [`crate::machine`].
    #[serde(default)]
    pub doubts: Vec<String>,
    /// How its temporal runs were made; `None` where there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<Timing>,
    /// Buffer capacities at the end of the run.
    #[serde(default)]
    pub capacities: Capacities,
    /// What all structures of `memory.csv` were allocated, bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory_bytes: Option<u64>,
    /// Each time that buffers grew.
    #[serde(default)]
    pub growth: Vec<GrowthEvent>,
    /// The frames of least and of most depth discontinuity, where they were found for pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub discontinuity: Option<Extremes>,
    /// When the run started, RFC 3339, UTC.
    #[serde(default)]
    pub started: String,
    /// How long it took, seconds.
    #[serde(default)]
    pub duration_s: f64,
}

/// A named input.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Source {
    /// Its name.
    pub name: String,
    /// Hexadecimal SHA-256 of it.
    pub sha256: String,
}

/// The device that rendered, as far as runs are known by it: another of the same name does not make them anew.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DeviceInfo {
    /// Its name.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Version of the Vulkan API it offers.
    #[serde(default)]
    pub api: String,
}

impl Manifest {
    /// Intensity of all lights that were made; `None` where each has one of its own, or they were not made.
    pub fn intensity(&self) -> Option<f32> {
        let lighting = self.lighting.filter(|_| self.config.light_source != GeneratorKind::Gamma)?;
        Some(lighting.intensity)
    }

    /// How many temporal runs there are; earlier versions made as many as they were told.
    pub fn temporal_runs(&self) -> u32 {
        self.timing.as_ref().map(|timing| timing.runs).or(self.config.runs.fixed()).unwrap_or(0)
    }

    /// Reads the manifest of the run in `directory`, by this version of the program or an earlier one.
    ///
    /// # Errors
    /// It is missing, damaged, of another format, or was not written by a replay.
    pub fn read(directory: &Path) -> Result<Self> {
        let path = &directory.join(MANIFEST);
        let bytes = fs::read(path).map_err(|error| Error::file(path, format!("cannot be read: {error}")))?;
        check_format(&bytes).map_err(|problem| Error::file(path, problem))?;
        serde_path_to_error::deserialize(&mut serde_json::Deserializer::from_slice(&bytes)).map_err(|error| {
            let field = match error.path().to_string().as_str() {
                "." => String::new(),
                field => format!("{field}: "),
            };
            let problem = format!("{field}{}", error.inner()).replace('\n', " ");
            refuse(path, format!("is no manifest of a run: {problem}"))
        })
    }
}

/// Says what is wrong with what is no manifest of this version's format.
fn check_format(bytes: &[u8]) -> Result<(), String> {
    let manifest: serde_json::Value =
        serde_json::from_slice(bytes).map_err(|error| format!("is no JSON: {error}: measure it again"))?;
    match manifest.get("format").and_then(serde_json::Value::as_str) {
        Some(RUN_FORMAT) => Ok(()),
        Some(other) if other.starts_with("manylight.run/") => {
            Err(format!("has format {}, this version reads {RUN_FORMAT}: measure it again", shown(other)))
        }
        _ => Err(format!("was not written by a replay (its format is not {RUN_FORMAT}): leave it out")),
    }
}

/// A moment as RFC 3339 in UTC to the second: `2026-11-05T09:03:07Z`. Moments before 1970 count as its start.
pub fn rfc3339_utc(time: SystemTime) -> String {
    humantime::format_rfc3339_seconds(time.max(UNIX_EPOCH)).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::testing::manifest;
    use std::time::Duration;

    #[test]
    fn times_are_rfc_3339() {
        let at = UNIX_EPOCH + Duration::from_secs(951_868_799);
        assert_eq!(rfc3339_utc(at), "2000-02-29T23:59:59Z");
        assert_eq!(rfc3339_utc(UNIX_EPOCH - Duration::from_secs(1)), "1970-01-01T00:00:00Z");
    }

    /// What is read of `value`, written as a manifest.
    fn read(value: &serde_json::Value) -> Result<Manifest> {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join(MANIFEST), value.to_string()).unwrap();
        Manifest::read(directory.path())
    }

    #[test]
    fn a_manifest_survives_being_written() {
        let manifest = manifest();
        assert_eq!(read(&serde_json::to_value(&manifest).unwrap()).unwrap(), manifest);
    }

    #[test]
    fn what_earlier_versions_left_out_is_not_missed() {
        let mut value = serde_json::to_value(manifest()).unwrap();
        for field in
            "fingerprint assigned_by frame_count capacities growth duration_s machine conditions doubts"
                .split(' ')
        {
            value.as_object_mut().unwrap().remove(field).unwrap();
        }
        for field in ["assign", "test", "culling", "multiview", "trace"] {
            value["config"].as_object_mut().unwrap().remove(field).unwrap();
        }
        let read = read(&value).unwrap();
        assert_eq!((read.frame_count, read.config), (None, Config::default()));
        assert_eq!((read.machine, read.doubts), (Machine::default(), vec![]));
    }

    #[test]
    fn a_field_that_no_run_has_is_named() {
        let mut value = serde_json::to_value(manifest()).unwrap();
        value["config"]["msaa"] = 3.into();
        let message = read(&value).unwrap_err().to_string();
        assert!(message.contains("run.json: is no manifest of a run: config.msaa: 3 samples"), "{message}");
        value["format"] = "manylight.run/2".into();
        let message = read(&value).unwrap_err().to_string();
        assert!(
            message.contains("has format manylight.run/2, this version reads manylight.run/1"),
            "{message}"
        );
    }

    #[test]
    fn the_revision_is_a_hash_or_unknown() {
        let revision = git_revision();
        assert!(
            revision == "unknown" || revision.len() >= 40 && revision.bytes().all(|b| b.is_ascii_hexdigit())
        );
    }
}
