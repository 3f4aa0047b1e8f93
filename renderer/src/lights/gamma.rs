//! Lights at random in a box with gamma-distributed radii (Enhuber section 4.2).
//!
//! Positions are uniform in the box, radii follow Gamma(alpha, beta) with shape alpha = mean/(mean - mode) and scale
//! beta = mean - mode: many small lights, few large ones, none cut off. Enhuber says nothing of colours: tints are
//! uniform in 0.5..1, as those of rain. He assumes that lights may move at will, but states no motion of those he
//! measures, and the lists of his world grid are the same at two times of a recording: so they stand still, or
//! bounce in the box, all of them or every so many-th, which is this program's own motion.
//!
//! A radius R is where the light's influence ends: R1 = R. The cut-off I0 is that of the lighting, and the intensity
//! I = I0 R^2 is what falls to it at R, so that all lights look alike at the same part of their radius. Light k
//! depends on the seed alone, and has the same bits on every machine.

use super::motion::{BOUNCE_SPEED, Bounce, LightMotion, moves};
use super::place::Corners;
use super::random::{generator, normal, uniform, uniform_vector};
use super::{FrameLights, Light, LightSource, Lighting, reserve};
use crate::Result;
use rand_pcg::Pcg32;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Lowest and highest value of a tint's channels.
const TINT: [f32; 2] = [0.5, 1.0];

/// Lights that one task moves at least; fewer are not worth handing to another thread.
const LIGHTS_PER_TASK: usize = 1024;

/// The gamma distribution of radii, by what one can see of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GammaRadii {
    /// The most frequent radius, metres.
    pub mode: f64,
    /// The mean radius, metres.
    pub mean: f64,
}

impl Default for GammaRadii {
    /// Those of Enhuber's evaluation: shape 4/3, scale 0.75 m, standard deviation 0.866 m.
    fn default() -> Self {
        Self { mode: 0.25, mean: 1.0 }
    }
}

impl GammaRadii {
    /// Shape alpha of the distribution (Enhuber equation 4.3), 1 or above.
    pub fn shape(&self) -> f64 {
        self.mean / (self.mean - self.mode)
    }

    /// Scale beta of the distribution, metres.
    pub fn scale(&self) -> f64 {
        self.mean - self.mode
    }

    /// Refuses what no gamma distribution of radii has.
    pub(crate) fn check(&self) -> Result<(), String> {
        let Self { mode, mean } = *self;
        if !(1e-3..=1e6).contains(&mean) {
            return Err(format!("a mean radius of {mean} m: it lies within 0.001..1000000"));
        }
        if !(mode >= 0.0 && self.scale() >= 1e-6 * mean) {
            return Err(format!(
                "a most frequent radius of {mode} m: it is at least 0 and below the mean radius, {mean} m"
            ));
        }
        Ok(())
    }

    /// One radius, metres, above 0: squeeze and rejection (Marsaglia and Tsang 2000), which serves any shape from 1 on.
    fn sample(&self, random: &mut Pcg32) -> f64 {
        let d = self.shape() - 1.0 / 3.0;
        let c = 1.0 / (9.0 * d).sqrt();
        loop {
            let x = normal(random);
            let root = 1.0 + c * x;
            if root <= 0.0 {
                continue;
            }
            let (v, u, square) = (root * root * root, uniform(random), x * x);
            let surely = u < 1.0 - 0.0331 * square * square;
            if surely || libm::log(u) < 0.5 * square + d * (1.0 - v + libm::log(v)) {
                return d * v * self.scale();
            }
        }
    }
}

/// How lights with gamma-distributed radii are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GammaRecipe {
    /// Seed of all random choices.
    pub seed: u64,
    /// Distribution of the radii.
    pub radii: GammaRadii,
    /// How the lights move.
    pub motion: LightMotion,
    /// Which part of them does, from 0 to 1.
    pub moving: f64,
}

/// N lights with gamma-distributed radii.
#[derive(Debug, Clone, PartialEq)]
pub struct GammaLights {
    motion: LightMotion,
    within: Corners,
    dt_s: f64,
    starts: Vec<Bounce>,
    lights: Vec<Light>,
}

impl GammaLights {
    /// The lights of `lighting`, of which the intensity is not used, in a box, at frame 0; a frame takes `dt_s` seconds.
    ///
    /// # Errors
    /// [`crate::Error::Input`] where the lights do not fit into memory.
    pub fn new(recipe: &GammaRecipe, lighting: &Lighting, within: Corners, dt_s: f64) -> Result<Self> {
        let (mut starts, mut lights) = (reserve(lighting.count)?, reserve(lighting.count)?);
        let made = (0..lighting.count).into_par_iter().with_min_len(LIGHTS_PER_TASK);
        made.map(|light| make(recipe, lighting, &within, light)).unzip_into_vecs(&mut starts, &mut lights);
        Ok(Self { motion: recipe.motion, within, dt_s, starts, lights })
    }
}

/// Light `light` at frame 0 and how it goes on. The radius comes last, for it takes as many numbers as it takes.
fn make(recipe: &GammaRecipe, lighting: &Lighting, within: &Corners, light: u32) -> (Bounce, Light) {
    let mut random = generator(recipe.seed, light, 0);
    let start = uniform_vector(&mut random, within.min, within.max);
    let tint = uniform_vector(&mut random, [TINT[0]; 3], [TINT[1]; 3]);
    let velocity = uniform_vector(&mut random, [-BOUNCE_SPEED; 3], [BOUNCE_SPEED; 3]);
    let r1 = recipe.radii.sample(&mut random);
    let velocity = if moves(light, recipe.moving) { velocity } else { [0.0; 3] };
    (Bounce { start, velocity }, lighting.light_of_radius(start, tint, r1 as f32))
}

impl LightSource for GammaLights {
    fn at_frame(&mut self, frame: u32) -> FrameLights<'_> {
        if self.motion == LightMotion::Static {
            return FrameLights { list: &self.lights, revision: 0 };
        }
        let (seconds, within) = (f64::from(frame) * self.dt_s, self.within);
        let lights = self.lights.par_iter_mut().zip(&self.starts).with_min_len(LIGHTS_PER_TASK);
        lights.for_each(|(light, bounce)| light.position = bounce.at(seconds, &within));
        FrameLights { list: &self.lights, revision: frame.into() }
    }
}

#[cfg(test)]
mod tests;
