//! Run configuration: typed, defaulted, unknown fields refused.
//!
//! Three layers, each over the one before: the built-in defaults, a JSON file, the flags. One declaration,
//! [`Layer`], is the file's format, its schema and the flags at once.

mod axes;
mod cases;
mod exclude;
mod file;
mod frames;
mod layer;
mod scenes;
mod schema;
mod values;

#[cfg(test)]
mod tests;

pub use axes::{AXES, Axis, Labels, Role, run_name};
pub use cases::Test;
pub use exclude::Exclude;
pub use layer::Layer;
pub use schema::json_schema;
pub use values::resolution as parse_resolution;

use crate::assign::{Assigner, Clusters, Marking};
use crate::culling::Culling;
use crate::geometry::DisplacedVolume;
use crate::lights::{Attenuation, Lighting, LightsFrom};
use crate::measure::Capacities;
use crate::methods::{Method, Sharing, Space};
use crate::{Error, Result};
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// How the light lists are built; every way gives the same ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Assign {
    /// Every visible cluster against every light.
    Brute,
    /// Every visible cluster down a hierarchy of the lights, built anew each frame.
    Hierarchy,
    /// Every light to the groups of visible clusters that its cells meet.
    Scatter,
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
            Self::Auto => None,
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
}

/// One fully resolved run configuration. Serialized, it is a configuration file again; read back, what is left out has
/// its default.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Layer")]
pub struct Config {
    /// Built-in name or path of a scene.
    pub scene: String,
    /// Odd lines of OBJ and MTL files are errors instead of warnings.
    pub strict: bool,
    /// Bundled name or path of a recording.
    pub recording: String,
    /// Several scenes, each with its recording, instead of `scene` and `recording`; empty for that one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<SceneEntry>,
    /// What is left out of the product of scenes, lightings, methods, ways of assignment and tests.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub exclude: Vec<Exclude>,
    /// Methods, each a run.
    #[serde(serialize_with = "values::ser::methods")]
    pub methods: Vec<Method>,
    /// Lightings of the rain, each a run of every method; empty where lights come from a file or the scene.
    pub lights: Vec<Lighting>,
    /// Static lights from a CSV instead of the rain.
    pub lights_file: Option<PathBuf>,
    /// The scene's own point lights instead of the rain.
    pub scene_lights: bool,
    /// Width and height of each view, pixels.
    pub resolution: [u32; 2],
    /// Samples per pixel, 1 or 4.
    pub msaa: u32,
    /// Where instances are culled.
    pub culling: Culling,
    /// Prepass and shading draw all views at once.
    pub multiview: bool,
    /// Frames to render.
    pub frames: FrameRange,
    /// Temporal runs.
    pub runs: u32,
    /// Frames whose EXR and PNG images are written.
    pub exr: ExrFrames,
    /// How an EXR image holds several views.
    pub exr_layout: ExrLayout,
    /// Frames of the temporal runs that the trace shows.
    pub trace: ExrFrames,
    /// Attenuation function.
    #[serde(serialize_with = "values::ser::attenuation")]
    pub attenuation: Attenuation,
    /// Marking strategy.
    pub marking: Marking,
    /// Which clusters get lists, each a run of every method.
    #[serde(serialize_with = "values::ser::one_or_several")]
    pub clusters: Vec<Clusters>,
    /// How the light lists are built, each a run of every method.
    #[serde(serialize_with = "values::ser::one_or_several")]
    pub assign: Vec<Assign>,
    /// What decides who is on them, each a run of every method.
    #[serde(serialize_with = "values::ser::one_or_several")]
    pub test: Vec<Test>,
    /// Volume that sizes Displ.
    pub displaced_volume: DisplacedVolume,
    /// Output directory.
    pub out: PathBuf,
    /// Visible clusters a clustering's buffers hold at first; they grow.
    pub visible_cluster_capacity: u32,
    /// Light indices a clustering's buffers hold at first; they grow.
    pub light_index_capacity: u32,
    /// Device by name part or index.
    pub device: Option<String>,
    /// Validation layers on; any message fails the run.
    pub validate: bool,
    /// Shader sources from here instead of from the binary.
    pub shaders: Option<PathBuf>,
    /// Which scopes get timestamps.
    pub scopes: Scopes,
}

impl Default for Config {
    /// The default replay: the street in HTC Vive stereo under 1000 lights, by the thesis's six tuned methods.
    fn default() -> Self {
        Self {
            scene: "street".into(),
            strict: false,
            recording: "bistro-vive".into(),
            scenes: Vec::new(),
            exclude: Vec::new(),
            methods: tuned_methods(),
            lights: vec![Lighting::with_count(1000)],
            lights_file: None,
            scene_lights: false,
            resolution: [320, 180],
            msaa: 1,
            culling: Culling::Gpu,
            multiview: false,
            frames: FrameRange { first: 0, end: None, step: 40 },
            runs: 2,
            exr: ExrFrames::List(Vec::new()),
            exr_layout: ExrLayout::Multipart,
            trace: ExrFrames::List(Vec::new()),
            attenuation: Attenuation::PhyRed2,
            marking: Marking::Depth,
            clusters: vec![Clusters::Visible],
            assign: vec![Assign::Brute],
            test: vec![Test::Auto],
            displaced_volume: DisplacedVolume::View,
            out: "out".into(),
            visible_cluster_capacity: 1 << 14,
            light_index_capacity: 1 << 20,
            device: None,
            validate: false,
            shaders: None,
            scopes: Scopes::All,
        }
    }
}

/// Persp 64, Ortho 4 and Displ 64 32, each Indi and Encl (Gelderen chapter 6).
fn tuned_methods() -> Vec<Method> {
    let spaces = [
        Space::Persp { pixels: 64.0 },
        Space::Ortho { metres: 4.0 },
        Space::Displ { pixels: 64.0, displacement: 32.0 },
    ];
    let both = [Sharing::Indi, Sharing::Encl];
    spaces.iter().flat_map(|&space| both.map(|sharing| Method::grid(sharing, space))).collect()
}

impl Config {
    /// The defaults, under the file if one is given, under the flags.
    ///
    /// # Errors
    /// The file cannot be read or holds something wrong (said with line and column), or the result is not a
    /// configuration that can be run.
    pub fn resolve(file: Option<&Path>, flags: Layer) -> Result<Self> {
        let mut config = Self::default();
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
        let at = |field: &'static str| move |message: String| Error::Input(format!("{field}: {message}"));
        values::check_text(self.scene.clone()).map_err(at("scene"))?;
        values::check_text(self.recording.clone()).map_err(at("recording"))?;
        for entry in &self.scenes {
            entry.clone().check().map_err(at("scenes"))?;
        }
        for rule in &self.exclude {
            rule.check().map_err(at("exclude"))?;
        }
        values::check_methods(self.methods.clone()).map_err(at("methods"))?;
        values::check_ways(self.clusters.clone()).map_err(at("clusters"))?;
        values::check_ways(self.assign.clone()).map_err(at("assign"))?;
        values::check_ways(self.test.clone()).map_err(at("test"))?;
        values::check_lights(self.lights.clone()).map_err(at("lights"))?;
        for lighting in &self.lights {
            lighting.check().map_err(at("lights"))?;
        }
        if self.lights_from().is_empty() {
            return Err(at("lights")("no lighting: give at least one, such as 1000".into()));
        }
        values::check_resolution(self.resolution).map_err(at("resolution"))?;
        values::check_msaa(self.msaa).map_err(at("msaa"))?;
        self.frames.check().map_err(at("frames"))?;
        if self.runs == 0 && !self.trace.is_empty() {
            return Err(at("trace")("there is no temporal run to trace: set runs to 1 or more".into()));
        }
        values::check_path(&self.out).map_err(at("out"))?;
        values::check_capacity(self.visible_cluster_capacity).map_err(at("visible_cluster_capacity"))?;
        values::check_capacity(self.light_index_capacity).map_err(at("light_index_capacity"))?;
        for (field, path) in [("lights_file", &self.lights_file), ("shaders", &self.shaders)] {
            path.as_deref().map_or(Ok(()), values::check_path).map_err(at(field))?;
        }
        self.device.clone().map_or(Ok(String::new()), values::check_text).map_err(at("device"))?;
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
        }
    }

    /// The scene axis: `scenes`, or the one that `scene` and `recording` name.
    pub fn scene_entries(&self) -> Vec<SceneEntry> {
        if !self.scenes.is_empty() {
            return self.scenes.clone();
        }
        let (scene, recording) = (self.scene.clone(), self.recording.clone());
        vec![SceneEntry { scene, recording, resolution: None, frames: None }]
    }

    /// Where lights come from: every lighting of the rain, or the file, or the scene.
    pub fn lights_from(&self) -> Vec<LightsFrom> {
        if let Some(path) = &self.lights_file {
            return vec![LightsFrom::File(path.clone())];
        }
        if self.scene_lights {
            return vec![LightsFrom::Scene];
        }
        self.lights.iter().copied().map(LightsFrom::Rain).collect()
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
