//! Run configuration: typed, defaulted, unknown fields refused.
//!
//! Three layers, each over the one before: the built-in defaults, a JSON file, the flags. A setting is one entry of
//! `settings!`, in `settings.rs`: the flag, the file's format and its schema, the default and the check at once.

mod axes;
mod cases;
mod declare;
mod exclude;
mod file;
mod frames;
mod layer;
mod lights;
mod runs;
mod scenes;
mod schema;
mod settings;
mod values;

#[cfg(test)]
mod tests;

pub use axes::{AXES, Axis, Labels, Role, resolution_name, run_name};
pub use cases::{Choice, Own, Test};
pub use declare::{Bearing, Setting};
pub use exclude::Exclude;
pub use runs::Runs;
pub use schema::json_schema;
pub use settings::{Config, Layer};
pub use values::resolution as parse_resolution;

use crate::assign::Assigner;
use crate::lights::{LatticeBox, Lighting, LightsFrom};
use crate::measure::Capacities;
use crate::{Error, Result};
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// How the light lists are built; every way gives the same ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Assign {
    /// Every visible cluster against every light.
    Brute,
    /// Every visible cluster down a hierarchy of the lights, built anew each frame.
    Hierarchy,
    /// Every light to the groups of visible clusters that its cells meet.
    Scatter,
    /// Every light to the visible clusters of the tiles in which it is seen; with the test `mm` alone.
    Rectangles,
    /// What is likely fastest, by counts taken before the run.
    Auto,
}

impl Assign {
    /// What builds them; `None` where counts decide.
    pub fn fixed(self) -> Option<Assigner> {
        match self {
            Self::Brute => Some(Assigner::Brute),
            Self::Hierarchy => Some(Assigner::Hierarchy),
            Self::Scatter => Some(Assigner::Scatter),
            Self::Rectangles => Some(Assigner::Rectangles),
            Self::Auto => None,
        }
    }
}

impl From<Assigner> for Assign {
    fn from(assigner: Assigner) -> Self {
        match assigner {
            // Rasterisation is its methods' own, whatever way is named.
            Assigner::Brute | Assigner::Raster | Assigner::RasterCount => Self::Brute,
            Assigner::Hierarchy => Self::Hierarchy,
            Assigner::Scatter => Self::Scatter,
            Assigner::Rectangles => Self::Rectangles,
        }
    }
}

/// Frames first..last by step; `last` excluded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct FrameRange {
    /// First frame.
    pub first: u32,
    /// One past the last frame; `None` for the recording's end.
    pub end: Option<u32>,
    /// Every how many frames, at least 1.
    pub step: u32,
}

/// Frames of which something is written: images, a trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExrFrames {
    /// These, ascending.
    List(Vec<u32>),
    /// Every rendered one.
    All,
    /// The one of least and the one of most depth discontinuity, which counting finds.
    Discontinuity,
}

/// How an EXR image holds several views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ExrLayout {
    /// A part a view.
    Multipart,
    /// One part, whose `multiView` attribute lists the views and whose channels are named by view.
    Multiview,
}

/// Which scopes get timestamps in temporal runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Scopes {
    /// Every stage.
    All,
    /// The frame alone: what measuring itself costs is the difference.
    Frame,
    /// Every stage, and every compute pass as a stage of its own: where the time of a stage goes.
    Passes,
}

/// One scene of the scene axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "scenes::RawSceneEntry")]
pub struct SceneEntry {
    /// Built-in name or path of a scene.
    pub scene: String,
    /// Bundled name or path of a recording.
    pub recording: String,
    /// Width and height of each view, pixels; [`Config::resolution`] where `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<[u32; 2]>,
    /// Frames to render; [`Config::frames`] where `None`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<FrameRange>,
    /// Lights that are made; [`Config::lights`] where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<Lighting>,
    /// Volumes that lights are laid out in; [`Config::light_volumes`] where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub light_volumes: Vec<LatticeBox>,
}

impl SceneEntry {
    /// A scene with a recording, and nothing else of its own.
    fn new(scene: impl Into<String>, recording: impl Into<String>) -> Self {
        let (scene, recording) = (scene.into(), recording.into());
        Self { scene, recording, resolution: None, frames: None, lights: vec![], light_volumes: vec![] }
    }
}

impl Config {
    /// The defaults, under the file if one is given, under the flags.
    ///
    /// # Errors
    /// The file cannot be read or holds something wrong (said with line and column), or the result is not a
    /// configuration that can be run.
    pub fn resolve(file: Option<&Path>, flags: Layer) -> Result<Self> {
        Self::default().under(file, flags)
    }

    /// As [`Self::resolve`], with this in place of the defaults.
    ///
    /// # Errors
    /// As there.
    pub fn under(self, file: Option<&Path>, flags: Layer) -> Result<Self> {
        let mut config = self;
        if let Some(path) = file {
            config.apply(file::read(path)?).map_err(|message| Error::file(path, message))?;
            config.check().map_err(|error| Error::file(path, error))?;
            config.check_excludes().map_err(|error| Error::file(path, error))?;
        }
        let own_rules = flags.exclude.is_some();
        config.apply(flags).map_err(Error::Input)?;
        config.check()?;
        // Flags may narrow an axis that the file has rules for: those may then match nothing.
        if own_rules {
            config.check_excludes()?;
        }
        Ok(config)
    }

    /// Refuses values out of range, whoever put them there.
    ///
    /// # Errors
    /// Names the first field at fault.
    pub fn check(&self) -> Result<()> {
        self.check_values().map_err(Error::Input)?;
        self.check_lights()?;
        self.check_runs().map_err(Error::Input)?;
        if self.runs.is_none() && !self.trace.is_empty() {
            return Err(Error::input("trace: there is no temporal run to trace: set runs to 1 or more"));
        }
        Ok(())
    }

    /// Refuses rules that leave nothing out: most are misspelt.
    fn check_excludes(&self) -> Result<()> {
        let runs: Vec<Self> = self.by_scene().iter().flat_map(Self::cases).collect();
        let matched = |rule: &Exclude| runs.iter().any(|run| rule.matches(run));
        match self.exclude.iter().find(|rule| !matched(rule)) {
            Some(rule) => Err(Error::Input(format!(
                "exclude: the rule {rule} matches no run: mend its names, or leave it out"
            ))),
            None => Ok(()),
        }
    }

    /// What a clustering's buffers hold at first.
    pub fn capacities(&self) -> Capacities {
        Capacities {
            visible_clusters: self.visible_cluster_capacity,
            light_indices: self.light_index_capacity,
            ..Capacities::default()
        }
    }

    /// The scene axis: `scenes`, or the one that `scene` and `recording` name.
    pub fn scene_entries(&self) -> Vec<SceneEntry> {
        if !self.scenes.is_empty() {
            return self.scenes.clone();
        }
        vec![SceneEntry::new(&self.scene, &self.recording)]
    }

    /// The frames to render of a recording with `available` frames, ascending.
    ///
    /// # Errors
    /// The range reaches beyond the recording, or leaves out a frame whose images or trace are asked for.
    pub fn frame_numbers(&self, available: u32) -> Result<Vec<u32>> {
        let frames = self.frames.frames(available)?;
        self.exr.check_rendered("exr", &frames)?;
        self.trace.check_rendered("trace", &frames)?;
        Ok(frames)
    }
}
