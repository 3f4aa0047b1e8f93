//! Where the lights of a configuration come from, and what its settings mean to what makes them.

use super::{Config, LightsFrom};
use crate::lights::{GammaRadii, GammaRecipe, Generator, GeneratorKind, LightMotion, VolumeRecipe};
use crate::{Error, Result};

impl Config {
    /// Where lights come from: every lighting of the generator, or the file, or the scene.
    pub fn lights_from(&self) -> Vec<LightsFrom> {
        if let Some(path) = &self.lights_file {
            return vec![LightsFrom::File(path.clone())];
        }
        if self.scene_lights {
            return vec![LightsFrom::Scene];
        }
        let made = |lighting| LightsFrom::Generated(self.generator(), lighting, self.spots);
        self.lights.iter().copied().map(made).collect()
    }

    /// What makes the lights, where they come from neither a file nor the scene.
    pub fn generator(&self) -> Generator {
        let (seed, place) = (self.light_seed.unwrap_or(1), self.light_box.unwrap_or_default());
        match self.light_source {
            GeneratorKind::Rain => Generator::Rain,
            GeneratorKind::Gamma => {
                let usual = GammaRadii::default();
                let radii = GammaRadii {
                    mode: self.light_radius_mode.unwrap_or(usual.mode),
                    mean: self.light_radius_mean.unwrap_or(usual.mean),
                };
                let motion = self.light_motion.unwrap_or_default();
                let moving = self.light_moving.unwrap_or(1.0);
                Generator::Gamma(place, GammaRecipe { seed, radii, motion, moving })
            }
            GeneratorKind::Volume => {
                let (volumes, set) = (self.light_volumes.clone(), self.light_set);
                Generator::Volume(place, VolumeRecipe { seed, volumes, set })
            }
        }
    }

    /// Refuses for any scene lights from nowhere, lightings that the generator cannot make lights of, and settings that it does
    /// not know.
    pub(super) fn check_lights(&self) -> Result<()> {
        self.by_scene().iter().try_for_each(Self::check_lights_of_scene)
    }

    fn check_lights_of_scene(&self) -> Result<()> {
        if self.lights_from().is_empty() {
            return Err(Error::input("lights: no lighting: give at least one, such as 1000"));
        }
        if let Some((name, takers)) = self.idle_light_setting() {
            let takers: Vec<String> = takers.iter().map(ToString::to_string).collect();
            let source = self.light_source;
            return Err(Error::Input(format!(
                "{name}: lights by {source} have none: leave it out, or set light_source to {}",
                takers.join(" or ")
            )));
        }
        self.check_moving()?;
        let generator = self.generator();
        let checked = self.lights.iter().try_for_each(|lighting| generator.check(lighting));
        checked.map_err(|message| Error::Input(format!("lights: {message}")))
    }

    /// Refuses a part that is none, and one of lights that do not move.
    fn check_moving(&self) -> Result<()> {
        match (self.light_moving, self.light_motion.unwrap_or_default()) {
            (Some(part), _) if !(0.0..=1.0).contains(&part) => {
                Err(Error::Input(format!("light_moving: {part} is no part of the lights: give 0 to 1")))
            }
            (Some(_), LightMotion::Static) => Err(Error::input(
                "light_moving: static lights do not move: leave it out, or set light_motion to bounce",
            )),
            _ => Ok(()),
        }
    }

    /// The first setting given that means nothing to what makes the lights, and the generators that know it.
    fn idle_light_setting(&self) -> Option<(&'static str, &'static [GeneratorKind])> {
        use GeneratorKind::{Gamma, Volume};
        let all: [(_, _, &'static [GeneratorKind]); 8] = [
            ("light_seed", self.light_seed.is_some(), &[Gamma, Volume]),
            ("light_box", self.light_box.is_some(), &[Gamma, Volume]),
            ("light_motion", self.light_motion.is_some(), &[Gamma]),
            ("light_moving", self.light_moving.is_some(), &[Gamma]),
            ("light_radius_mode", self.light_radius_mode.is_some(), &[Gamma]),
            ("light_radius_mean", self.light_radius_mean.is_some(), &[Gamma]),
            ("light_volumes", !self.light_volumes.is_empty(), &[Volume]),
            ("light_set", self.light_set.is_some(), &[Volume]),
        ];
        let idle = all.into_iter().find(|(_, given, takers)| *given && !takers.contains(&self.light_source));
        idle.map(|(name, _, takers)| (name, takers))
    }

    /// Leaves the choice of a generator, and with it what was said to it, to the defaults.
    pub(super) fn forget_generator(&mut self) {
        let usual = Self::default();
        self.light_source = usual.light_source;
        self.light_seed = usual.light_seed;
        self.light_box = usual.light_box;
        self.light_motion = usual.light_motion;
        self.light_moving = usual.light_moving;
        self.light_radius_mode = usual.light_radius_mode;
        self.light_radius_mean = usual.light_radius_mean;
        self.light_volumes = usual.light_volumes;
        self.scenes.iter_mut().for_each(|entry| entry.light_volumes.clear());
        self.light_set = usual.light_set;
        self.spots = usual.spots;
    }
}
