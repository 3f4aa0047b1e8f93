//! Run configuration: typed, defaulted, unknown fields refused.

use crate::lights::Attenuation;
use crate::methods::MethodSpec;
use std::path::PathBuf;

/// N lights of one intensity, cut-off and near radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lighting {
    /// How many.
    pub count: u32,
    /// Intensity I.
    pub intensity: f32,
    /// Cut-off I0.
    pub cutoff: f32,
    /// Near radius R0, metres.
    pub r0: f32,
}

/// Where the visible clusters of opaque and masked geometry are marked from (METHODS section 3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marking {
    /// From the depth buffer, per sample; with MSAA, shading runs per sample too.
    Depth,
    /// From a second geometry pass with early depth tests, per fragment.
    Geometry,
}

/// Which frustum sizes the clusters of Displ (METHODS section 2.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DisplacedVolume {
    /// The average cluster volume of Persp on the undisplaced frustum.
    View,
    /// The displaced frustum's own volume over Persp's cluster count.
    Own,
}

/// Frames first..last by step; `last` excluded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameRange {
    /// First frame.
    pub first: u32,
    /// One past the last frame; `None` for the recording's end.
    pub end: Option<u32>,
    /// Every how many frames, at least 1.
    pub step: u32,
}

/// Which frames' images are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ExrFrames {
    /// These.
    List(Vec<u32>),
    /// Every rendered one.
    All,
}

/// Which scopes get timestamps in temporal runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scopes {
    /// Every stage.
    All,
    /// The frame alone: what measuring itself costs is the difference.
    Frame,
}

/// One fully resolved run configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// Built-in name or path of a scene.
    pub scene: String,
    /// Bundled name or path of a recording.
    pub recording: String,
    /// Methods, each a run.
    pub methods: Vec<MethodSpec>,
    /// Lightings, each a run of every method.
    pub lights: Vec<Lighting>,
    /// Static lights from a CSV instead of the rain.
    pub lights_file: Option<PathBuf>,
    /// The scene's own point lights instead of the rain.
    pub scene_lights: bool,
    /// Width and height of each view, pixels.
    pub resolution: [u32; 2],
    /// Samples per pixel, 1 or 4.
    pub msaa: u32,
    /// Frames to render.
    pub frames: FrameRange,
    /// Temporal runs.
    pub runs: u32,
    /// Frames whose EXR and PNG images are written.
    pub exr: ExrFrames,
    /// Attenuation function.
    pub attenuation: Attenuation,
    /// Marking strategy.
    pub marking: Marking,
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
