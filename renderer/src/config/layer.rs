//! One layer of a configuration: what a file or the flags say, every field optional.

use super::values::{self, de};
use super::{
    Assign, Clusters, Config, Culling, DisplacedVolume, Exclude, ExrFrames, ExrLayout, FrameRange, Lighting,
    Marking, SceneEntry, Scopes, Test, scenes, schema,
};
use crate::lights::Attenuation;
use crate::methods::{KINDS, Method};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// Every kind of method, a line each.
fn methods_help() -> String {
    let lines = KINDS.iter().map(|kind| format!("  {}: {}", kind.pattern(), kind.about));
    let head = "Methods, each a run; the flag is repeated for several. Sizes are numbers above 0:".to_owned();
    [head].into_iter().chain(lines).collect::<Vec<_>>().join("\n")
}

/// What one source says of a [`Config`]. The same declaration is the JSON file, its schema and the flags,
/// so that every field is a flag.
#[derive(Debug, Clone, Default, PartialEq, clap::Args, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(
    title = "manylight configuration",
    description = "What to replay and measure. Every field may be left out."
)]
pub struct Layer {
    /// Where editors find the schema of this file; otherwise without meaning.
    #[arg(skip)]
    #[serde(rename = "$schema")]
    pub schema: Option<String>,

    /// Scene: `street`, `temple`, or the path of a .gltf, .glb or .obj file.
    #[arg(long, value_name = "NAME|PATH")]
    #[serde(default, deserialize_with = "de::text")]
    #[schemars(length(min = 1))]
    pub scene: Option<String>,

    /// Refuse an OBJ scene, or an MTL file of its, for the first line that would else be a warning.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub strict: Option<bool>,

    /// Recording: `bistro`, `suntem`, `bistro-vive`, `bistro-mirror`, `suntem-vive`, or the path of a JSON file.
    #[arg(long, value_name = "NAME|PATH")]
    #[serde(default, deserialize_with = "de::text")]
    #[schemars(length(min = 1))]
    pub recording: Option<String>,

    /// Several scenes, each with its recording and maybe a resolution and frames of its own, instead of `scene`
    /// and `recording`; the flag is repeated for several.
    #[arg(long, value_name = "SCENE=RECORDING[,WxH][,FRAMES]")]
    #[serde(default, deserialize_with = "de::scenes")]
    #[schemars(with = "Option<Vec<scenes::RawSceneEntry>>", length(min = 1))]
    pub scenes: Option<Vec<SceneEntry>>,

    /// What to leave out of the product of scenes, lightings, methods, ways of assignment and tests, such as
    /// `recording=*-vive,lights=1000|10000,method=indi-persp-16`; the flag is repeated for several rules.
    #[arg(long, value_name = "AXIS=NAME[|NAME],..")]
    pub exclude: Option<Vec<Exclude>>,

    /// Methods, each a run, by names with sizes.
    #[arg(long = "method", value_name = "METHOD", value_parser = values::method, help = methods_help())]
    #[serde(default, deserialize_with = "de::methods")]
    #[schemars(schema_with = "schema::methods")]
    pub methods: Option<Vec<Method>>,

    /// Falling lights: how many, intensity I (100), cut-off I0 (0.5), near radius R0 (0.1 m). Each lighting is
    /// a run of every method; the flag is repeated for several.
    #[arg(long, value_name = "N[,I,I0,R0]")]
    #[serde(default, deserialize_with = "de::lights")]
    #[schemars(with = "Option<Vec<Lighting>>")]
    pub lights: Option<Vec<Lighting>>,

    /// Static lights from a CSV file (columns `x,y,z,r,g,b,i,i0,r0` and maybe `r1`) instead of falling ones.
    #[arg(long, value_name = "FILE.csv")]
    pub lights_file: Option<PathBuf>,

    /// The scene's own point lights (KHR_lights_punctual) instead of falling ones.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub scene_lights: Option<bool>,

    /// Width and height of each view, pixels.
    #[arg(long, value_name = "WxH", value_parser = values::resolution)]
    #[serde(default, deserialize_with = "de::resolution")]
    #[schemars(schema_with = "schema::resolution")]
    pub resolution: Option<[u32; 2]>,

    /// Samples a pixel, 1 or 4.
    #[arg(long, value_name = "1|4", value_parser = values::msaa)]
    #[serde(default, deserialize_with = "de::msaa")]
    #[schemars(schema_with = "schema::msaa")]
    pub msaa: Option<u32>,

    /// Where instances outside the views are left out; what is seen is the same.
    #[arg(long, value_enum)]
    pub culling: Option<Culling>,

    /// Draw all views in one pass: the prepass, and opaque and masked shading where the views share a clustering. What
    /// is seen is the same.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub multiview: Option<bool>,

    /// Frames to render: A..B/STEP leaves B out; also A.., ..B, /STEP, or one number.
    #[arg(long, value_name = "A..B/STEP")]
    #[serde(default)]
    #[schemars(schema_with = "schema::frames")]
    pub frames: Option<FrameRange>,

    /// Temporal runs, in which stages are timed; 0 leaves the counting run alone.
    #[arg(long, value_name = "N")]
    pub runs: Option<u32>,

    /// Frames whose EXR and PNG images are written: numbers with commas between, `all` or `none`.
    #[arg(long, value_name = "LIST|all|none")]
    #[serde(default)]
    #[schemars(schema_with = "schema::exr")]
    pub exr: Option<ExrFrames>,

    /// How an EXR image holds several views: as parts, or in one part with channels named by view (`right.R`).
    #[arg(long, value_enum)]
    pub exr_layout: Option<ExrLayout>,

    /// Frames of the temporal runs whose CPU and GPU stages go to `trace.json`, for Perfetto or chrome://tracing:
    /// numbers with commas between, `all` (the flag alone) or `none`.
    #[arg(long, value_name = "LIST|all|none", num_args = 0..=1, default_missing_value = "all")]
    #[serde(default)]
    #[schemars(schema_with = "schema::exr")]
    pub trace: Option<ExrFrames>,

    /// How a light fades with distance: phy, red, smo, phy_red_1, phy_red_2, phy_smo_1, phy_smo_2, lin or stp.
    #[arg(long, value_name = "NAME")]
    #[serde(default, deserialize_with = "de::attenuation")]
    #[schemars(schema_with = "schema::attenuation")]
    pub attenuation: Option<Attenuation>,

    /// What the visible clusters of opaque and masked geometry are marked from.
    #[arg(long, value_enum)]
    pub marking: Option<Marking>,

    /// Which clusters get light lists: `visible` (those that hold a fragment, which marking finds) or `all` of the grid, with
    /// nothing marked. Of several, with commas between, each is a run of every method.
    #[arg(long, value_enum, value_name = "LIST", value_delimiter = ',')]
    #[serde(default, deserialize_with = "de::ways")]
    #[schemars(schema_with = "schema::clusters")]
    pub clusters: Option<Vec<Clusters>>,

    /// How the light lists are built; every way gives the same ones. Of several, with commas between, each is a run of
    /// every method.
    #[arg(long, value_enum, value_name = "LIST", value_delimiter = ',')]
    #[serde(default, deserialize_with = "de::ways")]
    #[schemars(schema_with = "schema::assign")]
    pub assign: Option<Vec<Assign>>,

    /// What decides whether a light meets a cluster: `hs` (half spaces), `sat-` with letters (no separating axis among
    /// e: edges, n: to the nearest vertex, p: normals, v: to all vertices), `hs+sat-n` and the like, `exact`, `box`
    /// (orthographic clusters only), or `auto`: hs in perspective grids, box in orthographic ones. Of several, with
    /// commas between, each is a run of every method.
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::test)]
    #[serde(default, deserialize_with = "de::ways")]
    #[schemars(schema_with = "schema::test")]
    pub test: Option<Vec<Test>>,

    /// Which frustum sizes the clusters of Displ.
    #[arg(long, value_enum)]
    pub displaced_volume: Option<DisplacedVolume>,

    /// Output directory.
    #[arg(long, value_name = "DIR")]
    #[schemars(length(min = 1))]
    pub out: Option<PathBuf>,

    /// Visible clusters that a clustering's buffers hold at first; they grow where a frame needs more.
    #[arg(long, value_name = "N", value_parser = values::capacity)]
    #[serde(default, deserialize_with = "de::capacity")]
    #[schemars(range(min = 1))]
    pub visible_cluster_capacity: Option<u32>,

    /// Light indices that a clustering's buffers hold at first; they grow where a frame needs more.
    #[arg(long, value_name = "N", value_parser = values::capacity)]
    #[serde(default, deserialize_with = "de::capacity")]
    #[schemars(range(min = 1))]
    pub light_index_capacity: Option<u32>,

    /// Device, by a part of its name or by its index in `manylight devices`.
    #[arg(long, value_name = "NAME|INDEX")]
    #[serde(default, deserialize_with = "de::text")]
    #[schemars(length(min = 1))]
    pub device: Option<String>,

    /// Turn the validation layers on, with synchronization validation; any message fails the run.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub validate: Option<bool>,

    /// Read the shader sources from this directory instead of from the program.
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,

    /// Which stages are timed: all, or the frame as a whole, which shows what timing itself costs.
    #[arg(long, value_enum)]
    pub scopes: Option<Scopes>,
}

impl Config {
    /// Lays a layer over this configuration: what it gives replaces what was there. The three fields that say
    /// where lights come from count as one, and so do those that name scenes.
    pub(super) fn apply(&mut self, layer: Layer) -> Result<(), String> {
        self.apply_lights(&layer)?;
        self.apply_scenes(&layer)?;
        set(&mut self.exclude, layer.exclude);
        set(&mut self.scene, layer.scene);
        set(&mut self.strict, layer.strict);
        set(&mut self.recording, layer.recording);
        set(&mut self.methods, layer.methods);
        set(&mut self.resolution, layer.resolution);
        set(&mut self.msaa, layer.msaa);
        set(&mut self.culling, layer.culling);
        set(&mut self.multiview, layer.multiview);
        set(&mut self.frames, layer.frames);
        set(&mut self.runs, layer.runs);
        set(&mut self.exr, layer.exr);
        set(&mut self.exr_layout, layer.exr_layout);
        set(&mut self.trace, layer.trace);
        set(&mut self.attenuation, layer.attenuation);
        set(&mut self.marking, layer.marking);
        set(&mut self.clusters, layer.clusters);
        set(&mut self.assign, layer.assign);
        set(&mut self.test, layer.test);
        set(&mut self.displaced_volume, layer.displaced_volume);
        set(&mut self.out, layer.out);
        set(&mut self.visible_cluster_capacity, layer.visible_cluster_capacity);
        set(&mut self.light_index_capacity, layer.light_index_capacity);
        set(&mut self.device, layer.device.map(Some));
        set(&mut self.validate, layer.validate);
        set(&mut self.shaders, layer.shaders.map(Some));
        set(&mut self.scopes, layer.scopes);
        Ok(())
    }

    /// Whether a scene or recording is given that is not the default: beside several scenes, a resolved configuration
    /// names the default one.
    fn names_another_scene(layer: &Layer) -> bool {
        let default = Self::default();
        let other =
            |given: &Option<String>, default: &str| given.as_deref().is_some_and(|name| name != default);
        other(&layer.scene, &default.scene) || other(&layer.recording, &default.recording)
    }

    /// One scene and several replace each other. A resolution or frames that the layer gives hold for the scenes of
    /// layers below, whatever those said.
    fn apply_scenes(&mut self, layer: &Layer) -> Result<(), String> {
        let one = layer.scene.is_some() || layer.recording.is_some();
        match &layer.scenes {
            Some(_) if Self::names_another_scene(layer) => {
                return Err("scenes excludes scene and recording: give one or the other".into());
            }
            Some(scenes) => self.scenes = scenes.clone(),
            None if one => self.scenes.clear(),
            None => {
                for entry in &mut self.scenes {
                    entry.resolution = entry.resolution.filter(|_| layer.resolution.is_none());
                    entry.frames = entry.frames.filter(|_| layer.frames.is_none());
                }
            }
        }
        Ok(())
    }

    fn apply_lights(&mut self, layer: &Layer) -> Result<(), String> {
        let lights = layer.lights.clone().filter(|lights| !lights.is_empty());
        let scene = layer.scene_lights == Some(true);
        match (lights, layer.lights_file.clone(), scene) {
            (Some(lights), None, false) => self.set_lights(lights, None, false),
            (None, Some(file), false) => self.set_lights(Vec::new(), Some(file), false),
            (None, None, true) => self.set_lights(Vec::new(), None, true),
            (None, None, false) if layer.lights.is_some() => self.set_lights(Vec::new(), None, false),
            (None, None, false) if layer.scene_lights == Some(false) && self.scene_lights => {
                self.set_lights(Self::default().lights, None, false);
            }
            (None, None, false) => {}
            _ => {
                return Err(
                    "lights, lights_file and scene_lights exclude each other: give one of them".into()
                );
            }
        }
        Ok(())
    }

    fn set_lights(&mut self, lights: Vec<Lighting>, file: Option<PathBuf>, scene: bool) {
        (self.lights, self.lights_file, self.scene_lights) = (lights, file, scene);
    }
}

impl TryFrom<Layer> for Config {
    type Error = String;

    /// The layer over the defaults.
    fn try_from(layer: Layer) -> Result<Self, String> {
        let mut config = Self::default();
        config.apply(layer).map(|()| config)
    }
}

fn set<T>(field: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *field = value;
    }
}
