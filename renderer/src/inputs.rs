//! What a replay reads: scene, recording, lights.

use crate::config::Config;
use crate::extent::Extent;
use crate::lights::rain::RainParameters;
use crate::lights::{
    self, Corners, Generated, GeneratorKind, Light, LightSource, LightTally, Lighting, LightsFile,
    LightsFrom, StaticLights, Surroundings,
};
use crate::methods::{Method, model};
use crate::recording::{self, Recording};
use crate::scene::{self, Scene, procedural};
use crate::{Error, Result};
use std::path::Path;

/// Scene, recording and lights of a replay.
pub struct Inputs {
    /// The scene that is drawn.
    pub scene: Scene,
    /// Cameras and rain of each frame.
    pub recording: Recording,
    /// Hexadecimal SHA-256 of the file of static lights, where they come from one.
    pub lights_sha256: Option<String>,
    /// Lights of a file or of the scene; `None` where they are made.
    static_lights: Option<Vec<Light>>,
    /// Whether it rains.
    rains: bool,
}

impl Inputs {
    /// Loads or generates what the config names.
    ///
    /// # Errors
    /// A missing or broken file; a scene without lights where they were asked for; a recording without rain whose
    /// box was.
    pub fn load(config: &Config) -> Result<Self> {
        Self::load_with(config, recording::load(&config.recording)?, None)
    }

    /// Loads as [`Self::load`] does, with the recording at hand and maybe the scene.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn load_with(config: &Config, recording: Recording, scene: Option<Scene>) -> Result<Self> {
        let static_file = config.lights_file.as_deref().map(lights::load_csv).transpose()?;
        let scene = scene.map_or_else(|| load_scene(&config.scene, config.strict), Ok)?;
        let (static_lights, lights_sha256) = match static_file {
            Some(LightsFile { lights, sha256 }) => (Some(lights), Some(sha256)),
            None if config.scene_lights => (Some(scene_lights(&scene)?), None),
            None => (None, None),
        };
        let generator = config.generator();
        if static_lights.is_none() && generator.asks_for_rain_box() && recording.rain().is_none() {
            return Err(Error::input(format!(
                "light_box: recording {} brings no rain that has a box: give `scene` or corners",
                recording.name()
            )));
        }
        let rains = static_lights.is_none() && generator.kind() == GeneratorKind::Rain;
        Ok(Self { scene, recording, lights_sha256, static_lights, rains })
    }

    /// Lights for one run over the frames, at its first frame or before.
    ///
    /// # Errors
    /// Lights that do not fit into memory; rain whose parameters are out of range.
    pub fn light_source(&self, lights: &LightsFrom) -> Result<Box<dyn LightSource>> {
        match (lights, &self.static_lights) {
            (LightsFrom::Generated(generator, lighting, spots), _) => {
                generator.lights(lighting, *spots, &self.surroundings())
            }
            (_, Some(lights)) => Ok(Box::new(StaticLights(lights.clone()))),
            (_, None) => Err(Error::Internal("static lights were not loaded".into())),
        }
    }

    /// How large what is seen is.
    pub fn extent(&self) -> Extent {
        Extent::of(&self.scene, &self.recording)
    }

    /// What is told of lights that are made; `None` of others.
    ///
    /// # Errors
    /// A number of lights that cannot be made.
    pub fn generated(&self, lights: &LightsFrom) -> Result<Option<Generated>> {
        match lights {
            LightsFrom::Generated(generator, lighting, spots) => {
                generator.generated(lighting, *spots, &self.surroundings()).map(Some)
            }
            LightsFrom::File(_) | LightsFrom::Scene => Ok(None),
        }
    }

    /// Where and in what time lights are made; without anything to draw, the scene's box is that of the default rain.
    fn surroundings(&self) -> Surroundings {
        let rain = self.rain();
        let scene =
            self.scene.bounds().map(|corners| <[_; 2]>::from(corners).map(|at| at.as_vec3().to_array()));
        let [min, max] = scene.unwrap_or([rain.box_min, rain.box_max]);
        Surroundings { rain, scene: Corners { min, max }, dt_s: self.recording.file().dt_s }
    }

    /// The rain of the recording; where it brings none, rain in the box around the scene.
    fn rain(&self) -> RainParameters {
        self.recording.rain().copied().unwrap_or_else(|| match self.scene.bounds() {
            Some((low, high)) => RainParameters::within(low.as_vec3().to_array(), high.as_vec3().to_array()),
            None => RainParameters::default(),
        })
    }

    /// Says where it rains, where the recording does not.
    fn rain_note(&self) -> Option<String> {
        (self.rains && self.recording.rain().is_none()).then(|| {
            let RainParameters { box_min, box_max, .. } = self.rain();
            format!(
                "recording {} brings no rain: it rains in the scene's box, from {box_min:.1?} to {box_max:.1?}",
                self.recording.name()
            )
        })
    }

    /// What is good to know before methods are run: where it rains, and what of the scene they do not serve as it is.
    pub fn notes(&self, methods: &[Method]) -> impl Iterator<Item = String> {
        let sheared = methods.contains(&Method::Models).then(|| model::sheared_note(&self.scene)).flatten();
        self.rain_note().into_iter().chain(sheared)
    }

    /// How many lights a source of lights has, and whether it has spots.
    ///
    /// # Errors
    /// The lights were not loaded.
    pub fn light_tally(&self, lights: &LightsFrom) -> Result<LightTally> {
        match (lights, &self.static_lights) {
            (LightsFrom::Generated(_, lighting, spots), _) => {
                Ok(LightTally { count: lighting.count, spots: spots.is_any() })
            }
            (_, Some(lights)) => Ok(LightTally::of(lights)),
            (_, None) => Err(Error::Internal("static lights were not loaded".into())),
        }
    }
}

/// A built-in scene by its name, or a scene file, of which `strict` refuses odd lines.
///
/// # Errors
/// As [`scene::load`].
pub fn load_scene(name_or_path: &str, strict: bool) -> Result<Scene> {
    match procedural::by_name(name_or_path) {
        Some(scene) => Ok(scene),
        None if strict => scene::load_strictly(Path::new(name_or_path)),
        None => scene::load(Path::new(name_or_path)),
    }
}

/// The scene's lights with the cut-off and near radius that rain has by default.
fn scene_lights(scene: &Scene) -> Result<Vec<Light>> {
    let Lighting { cutoff, r0, .. } = Lighting::with_count(1);
    lights::from_scene(&scene.lights, cutoff, r0)
}
