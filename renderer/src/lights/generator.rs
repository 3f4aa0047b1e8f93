//! What makes lights of a number that is asked for: rain, gamma, volumes.
//!
//! ```text
//! Generator (which, with what) ──┐
//! Lighting (how many, I, I0, R0) ┼─> LightSource ─> FrameLights of every frame
//! Surroundings (boxes, time) ────┘        └─> Generated: what run.json tells
//! ```

use super::gamma::{GammaLights, GammaRadii, GammaRecipe};
use super::motion::LightMotion;
use super::place::{Corners, LightBox};
use super::rain::{Rain, RainParameters};
use super::spotted::{SpotShare, Spotted};
use super::volume::{LatticeBox, PlacedVolume, VolumeRecipe};
use super::{LightSource, Lighting, StaticLights};
use crate::{Error, Result};
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Kinds of generators.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum GeneratorKind {
    /// Lights that fall through a box (Gelderen chapter 6).
    #[default]
    Rain,
    /// Lights at random in a box, with gamma-distributed radii (Enhuber section 4.2).
    Gamma,
    /// Lights on lattices in boxes (Tegelaers section 3.3).
    Volume,
}

impl fmt::Display for GeneratorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rain => "rain",
            Self::Gamma => "gamma",
            Self::Volume => "volume",
        })
    }
}

/// A generator with what it needs besides a lighting.
#[derive(Debug, Clone, PartialEq)]
pub enum Generator {
    /// The rain of the recording.
    Rain,
    /// Gamma-distributed radii in a box.
    Gamma(LightBox, GammaRecipe),
    /// Lattices in volumes, of which those without a box of their own fill this one.
    Volume(LightBox, VolumeRecipe),
}

/// Where and in what time lights are made.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings {
    /// The rain that falls, with its box.
    pub rain: RainParameters,
    /// The box around the scene.
    pub scene: Corners,
    /// Seconds from a frame to the next.
    pub dt_s: f64,
}

/// Lights that were made, as `run.json` tells of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Generated {
    /// What made them.
    pub source: GeneratorKind,
    /// The seed of all random choices.
    pub seed: u64,
    /// How they move: `fall`, `static` or `bounce`, behind which stands the part that does where it is not all.
    pub motion: String,
    /// The boxes that they are in.
    pub boxes: Vec<GeneratedBox>,
    /// The distribution of their radii, where they differ by chance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radii: Option<GammaRadii>,
    /// Which part of them are spots, where any are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spots: Option<SpotShare>,
}

/// A box of lights that were made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GeneratedBox {
    /// Its corners before it is turned.
    #[serde(flatten)]
    pub corners: Corners,
    /// How it is turned about its middle: a quaternion x, y, z, w.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<[f32; 4]>,
    /// Lights along its axes, where they stand on a lattice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lattice: Option<[u32; 3]>,
}

impl fmt::Display for GeneratedBox {
    /// Writes `X0,Y0,Z0,X1,Y1,Z1`, behind it lattice and turn as flags spell them.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        LightBox::Corners(self.corners).fmt(f)?;
        if let Some([nx, ny, nz]) = self.lattice {
            write!(f, ":{nx}x{ny}x{nz}")?;
        }
        match self.turn {
            Some([x, y, z, w]) => write!(f, ":{x},{y},{z},{w}"),
            None => Ok(()),
        }
    }
}

impl Surroundings {
    fn corners(&self, place: LightBox) -> Corners {
        match place {
            LightBox::Scene => self.scene,
            LightBox::Rain => Corners { min: self.rain.box_min, max: self.rain.box_max },
            LightBox::Corners(corners) => corners,
        }
    }

    fn volumes(&self, place: LightBox, recipe: &VolumeRecipe, count: u32) -> Result<Vec<PlacedVolume>> {
        let of = |volume: Option<&LatticeBox>| {
            self.corners(volume.and_then(|volume| volume.place).unwrap_or(place))
        };
        recipe.placed(count, of).map_err(|message| Error::input(format!("lights: {message}")))
    }
}

impl Generator {
    /// Which it is.
    pub fn kind(&self) -> GeneratorKind {
        match self {
            Self::Rain => GeneratorKind::Rain,
            Self::Gamma(..) => GeneratorKind::Gamma,
            Self::Volume(..) => GeneratorKind::Volume,
        }
    }

    /// Refuses lightings that it cannot make lights of.
    ///
    /// # Errors
    /// Says why, and which it can.
    pub(crate) fn check(&self, lighting: &Lighting) -> Result<(), String> {
        match self {
            Self::Rain => Ok(()),
            Self::Gamma(_, recipe) => {
                recipe.radii.check()?;
                if lighting.intensity == Lighting::with_count(1).intensity {
                    return Ok(());
                }
                Err(format!(
                    "{lighting}: each light's intensity is I0*R1^2 by its radius: leave I out, or at {}",
                    Lighting::with_count(1).intensity
                ))
            }
            Self::Volume(_, recipe) => recipe.check(lighting.count),
        }
    }

    /// Whether it makes lights in the box of the recording's rain because that was asked for.
    pub fn asks_for_rain_box(&self) -> bool {
        match self {
            Self::Rain => false,
            Self::Gamma(place, _) => *place == LightBox::Rain,
            Self::Volume(place, VolumeRecipe { volumes, .. }) => {
                let places = volumes.iter().map(|volume| volume.place.unwrap_or(*place));
                places.chain(volumes.is_empty().then_some(*place)).any(|place| place == LightBox::Rain)
            }
        }
    }

    /// The lights of `lighting`, at the first frame or before, of which `spots` get cones.
    ///
    /// # Errors
    /// [`Error::Input`] where they do not fit into memory, or rain's parameters are out of range.
    pub fn lights(
        &self,
        lighting: &Lighting,
        spots: SpotShare,
        around: &Surroundings,
    ) -> Result<Box<dyn LightSource>> {
        let points = self.points(lighting, around)?;
        let cones = (spots, self.seed(around));
        Ok(if spots.is_any() { Box::new(Spotted::new(points, cones, lighting.count)) } else { points })
    }

    /// The seed of all random choices.
    fn seed(&self, around: &Surroundings) -> u64 {
        match self {
            Self::Rain => around.rain.seed,
            Self::Gamma(_, recipe) => recipe.seed,
            Self::Volume(_, recipe) => recipe.seed,
        }
    }

    fn points(&self, lighting: &Lighting, around: &Surroundings) -> Result<Box<dyn LightSource>> {
        match self {
            Self::Rain => Ok(Box::new(Rain::new(&around.rain, lighting, around.dt_s, 0)?)),
            Self::Gamma(place, recipe) => {
                Ok(Box::new(GammaLights::new(recipe, lighting, around.corners(*place), around.dt_s)?))
            }
            Self::Volume(place, recipe) => {
                let volumes = around.volumes(*place, recipe, lighting.count)?;
                Ok(Box::new(StaticLights(recipe.lights(&volumes, lighting)?)))
            }
        }
    }

    /// What is told of the lights of `lighting`, of which `spots` have cones.
    ///
    /// # Errors
    /// [`Error::Input`] for a number of lights that no lattice has.
    pub fn generated(
        &self,
        lighting: &Lighting,
        spots: SpotShare,
        around: &Surroundings,
    ) -> Result<Generated> {
        let of = |motion: &str, boxes| Generated {
            source: self.kind(),
            seed: self.seed(around),
            motion: motion.into(),
            boxes,
            radii: None,
            spots: spots.is_any().then_some(spots),
        };
        let plain = |corners| vec![GeneratedBox { corners, turn: None, lattice: None }];
        match self {
            Self::Rain => Ok(of("fall", plain(around.corners(LightBox::Rain)))),
            Self::Gamma(place, GammaRecipe { radii, motion, moving, .. }) => {
                let motion = match motion {
                    LightMotion::Static => "static".to_owned(),
                    LightMotion::Bounce if *moving < 1.0 => format!("bounce {moving}"),
                    LightMotion::Bounce => "bounce".to_owned(),
                };
                Ok(Generated { radii: Some(*radii), ..of(&motion, plain(around.corners(*place))) })
            }
            Self::Volume(place, recipe) => {
                let boxes = around.volumes(*place, recipe, lighting.count)?.into_iter().map(|volume| {
                    let PlacedVolume { within, turn, lattice, .. } = volume;
                    GeneratedBox { corners: within, turn, lattice: Some(lattice) }
                });
                Ok(of("static", boxes.collect()))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gamma(place: LightBox) -> Generator {
        let (radii, motion) = (GammaRadii::default(), LightMotion::Static);
        Generator::Gamma(place, GammaRecipe { seed: 4, radii, motion, moving: 1.0 })
    }

    fn volume(place: LightBox, volumes: &[&str]) -> Generator {
        let volumes = volumes.iter().map(|text| text.parse().unwrap()).collect();
        Generator::Volume(place, VolumeRecipe { seed: 4, volumes, set: None })
    }

    fn around() -> Surroundings {
        let scene = Corners { min: [0.0; 3], max: [4.0, 2.0, 4.0] };
        Surroundings { rain: RainParameters::default(), scene, dt_s: 0.01 }
    }

    #[test]
    fn the_box_of_the_rain_is_asked_for_where_lights_are_made_in_it() {
        let (scene, rain) = (LightBox::Scene, LightBox::Rain);
        for (generator, asks) in [
            (Generator::Rain, false),
            (gamma(scene), false),
            (gamma(rain), true),
            (volume(rain, &[]), true),
            (volume(scene, &[]), false),
            (volume(scene, &["1x1x1", "rain:1x1x1"]), true),
            (volume(rain, &["scene:1x1x1", "0,0,0,1,1,1:1x1x1"]), false),
            (volume(rain, &["scene:1x1x1", "1x1x1"]), true),
        ] {
            assert_eq!(generator.asks_for_rain_box(), asks, "{generator:?}");
        }
    }

    #[test]
    fn lights_lie_in_the_boxes_that_are_told_and_their_motion_is_what_is_told() {
        let lighting = Lighting::with_count(32);
        let made =
            [Generator::Rain, gamma(LightBox::Rain), gamma(LightBox::Scene), volume(LightBox::Scene, &[])];
        for generator in made {
            let told = generator.generated(&lighting, SpotShare::default(), &around()).unwrap();
            let mut source = generator.lights(&lighting, SpotShare::default(), &around()).unwrap();
            let first = source.at_frame(0).list.to_vec();
            let [GeneratedBox { corners, .. }] = told.boxes[..] else { panic!("{told:?}") };
            assert!(first.len() == 32 && first.iter().all(|light| inside(&corners, light.position)));
            let moved = source.at_frame(5).list.iter().zip(&first).any(|(a, b)| a.position != b.position);
            assert_eq!(moved, told.motion != "static", "{told:?}");
            assert_eq!(told.source, generator.kind());
        }
        let none = SpotShare::default();
        let few =
            GammaRecipe { seed: 4, radii: GammaRadii::default(), motion: LightMotion::Bounce, moving: 0.25 };
        let told = Generator::Gamma(LightBox::Scene, few).generated(&lighting, none, &around()).unwrap();
        assert_eq!(told.motion, "bounce 0.25");
        let told = volume(LightBox::Scene, &[]).generated(&lighting, none, &around()).unwrap();
        assert_eq!(told.boxes[0].to_string(), "0,0,0,4,2,4:4x2x4");
    }

    fn inside(corners: &Corners, at: [f32; 3]) -> bool {
        (0..3).all(|axis| (corners.min[axis]..=corners.max[axis]).contains(&at[axis]))
    }
}
