//! Layers over a configuration: what a layer gives replaces what was there.

use super::{Config, Layer};
use crate::lights::GeneratorKind;

impl Config {
    /// Lays a layer over this configuration: what it gives replaces what was there. The fields that say where lights
    /// come from count as one, and so do those that name scenes, and resolutions.
    pub(super) fn apply(&mut self, layer: Layer) -> Result<(), String> {
        self.make_room_for_lights(&layer)?;
        self.make_room_for_generator(&layer)?;
        self.make_room_for_scenes(&layer)?;
        self.make_room_for_resolutions(&layer)?;
        self.replace(layer);
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

    /// One scene and several replace each other. Resolutions, frames, lights or volumes that the layer gives hold for the scenes
    /// of layers below, whatever those said.
    fn make_room_for_scenes(&mut self, layer: &Layer) -> Result<(), String> {
        if layer.scenes.is_some() && Self::names_another_scene(layer) {
            return Err("scenes excludes scene and recording: give one or the other".into());
        }
        if layer.scene.is_some() || layer.recording.is_some() {
            self.scenes.clear();
        }
        for entry in &mut self.scenes {
            entry.resolution =
                entry.resolution.filter(|_| layer.resolution.is_none() && layer.resolutions.is_none());
            entry.frames = entry.frames.filter(|_| layer.frames.is_none());
            if layer.lights.is_some() || layer.lights_file.is_some() || layer.scene_lights == Some(true) {
                entry.lights.clear();
            }
            if layer.light_volumes.is_some() {
                entry.light_volumes.clear();
            }
        }
        Ok(())
    }

    /// One resolution and several replace each other. Beside several, a resolved configuration has the default one.
    fn make_room_for_resolutions(&mut self, layer: &Layer) -> Result<(), String> {
        let other = layer.resolution.is_some_and(|resolution| resolution != Self::default().resolution);
        if layer.resolutions.is_some() && other {
            return Err("resolutions excludes resolution: give one or the other".into());
        }
        if layer.resolution.is_some() {
            self.resolutions.clear();
        }
        if layer.resolutions.is_some() {
            self.resolution = Self::default().resolution;
        }
        Ok(())
    }

    /// Lights that are made, of a file and of the scene replace each other; without those of the scene, which were asked
    /// for below, there are as many as by default.
    fn make_room_for_lights(&mut self, layer: &Layer) -> Result<(), String> {
        let made = layer.lights.as_ref().is_some_and(|lights| !lights.is_empty());
        let scene = layer.scene_lights == Some(true);
        let sources = [made, layer.lights_file.is_some(), scene].into_iter().filter(|given| *given).count();
        if sources > 1 {
            return Err("lights, lights_file and scene_lights exclude each other: give one of them".into());
        }
        if sources == 1 || layer.lights.is_some() {
            (self.lights, self.lights_file, self.scene_lights) = (Vec::new(), None, false);
        } else if layer.scene_lights == Some(false) && self.scene_lights {
            self.lights = Self::default().lights;
        }
        Ok(())
    }

    /// Another generator, a file and the scene each replace the generator below with all that was said to it; a generator
    /// replaces a file and the scene.
    fn make_room_for_generator(&mut self, layer: &Layer) -> Result<(), String> {
        let elsewhere = layer.lights_file.is_some() || layer.scene_lights == Some(true);
        if elsewhere && layer.light_source.is_some_and(|source| source != GeneratorKind::Rain) {
            return Err("light_source excludes lights_file and scene_lights: give one of them".into());
        }
        if elsewhere || layer.light_source.is_some_and(|source| source != self.light_source) {
            self.forget_generator();
        }
        if layer.light_source.is_some() && !elsewhere && (self.lights_file.is_some() || self.scene_lights) {
            (self.lights, self.lights_file, self.scene_lights) = (Self::default().lights, None, false);
        }
        Ok(())
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
