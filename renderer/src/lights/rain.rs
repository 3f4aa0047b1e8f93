//! Falling lights: point lights that fall through a box and start anew at its top (Gelderen chapter 6).
//!
//! The state of frame f is f steps after the spawn, one step a frame, each of the recording's time step:
//! v += g; v *= damping; p += v * dt. A drop that has left the box respawns in the slab at its top with a new
//! position and velocity; its tint stays. Each of a light's lives draws from a generator of its own, seeded from
//! (seed, light, life), and the step uses single-precision `+`, `-` and `*` alone: light k of frame f has the
//! same bits on every machine, however frames are skipped, batched or threaded, and however many lights there are.

mod drop;
mod parameters;
#[cfg(test)]
mod tests;

pub use parameters::RainParameters;

use crate::json::Check;
use crate::lights::random::uniform_vector;
use crate::lights::{Light, Lighting, reserve};
use crate::{Error, Result};
use drop::Motion;
use rayon::prelude::*;

/// Lights that one task steps at least; fewer are not worth handing to another thread.
const LIGHTS_PER_TASK: usize = 1024;

/// N falling lights at one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Rain {
    parameters: RainParameters,
    /// What all lights have in common.
    template: Light,
    dt: f32,
    frame: u32,
    lights: Vec<Light>,
    motions: Vec<Motion>,
}

impl Rain {
    /// The rain of `lighting` at `frame`, stepped by `dt_s` seconds a frame (the recording's time step).
    ///
    /// # Errors
    /// [`Error::Input`] where parameters, lighting or time step are out of range, or the lights do not fit into
    /// memory.
    pub fn new(parameters: &RainParameters, lighting: &Lighting, dt_s: f64, frame: u32) -> Result<Self> {
        parameters.check().map_err(|problem| Error::input(format!("rain: {problem}")))?;
        let dt = dt_s as f32;
        if !(dt.is_finite() && dt > 0.0) {
            return Err(Error::input(format!("rain: a time step of {dt_s} s is not above 0")));
        }
        let template = lighting.light();
        template.check().map_err(|(field, message)| Error::input(format!("lights: {field}: {message}")))?;
        let mut rain = Self {
            parameters: *parameters,
            template,
            dt,
            frame: 0,
            lights: reserve(lighting.count)?,
            motions: reserve(lighting.count)?,
        };
        rain.spawn(lighting.count);
        rain.advance_to(frame);
        Ok(rain)
    }

    /// Goes to `frame`, forwards by stepping, backwards by falling anew from frame 0.
    pub fn advance_to(&mut self, frame: u32) {
        if frame < self.frame {
            self.spawn(self.lights.len() as u32);
        }
        let (steps, dt, parameters) = (frame - self.frame, self.dt, self.parameters);
        let pairs = self.lights.par_iter_mut().zip(&mut self.motions).enumerate();
        pairs.with_min_len(LIGHTS_PER_TASK).for_each(|(light, (point, motion))| {
            for _ in 0..steps {
                parameters.step(dt, light as u32, &mut point.position, motion);
            }
        });
        self.frame = frame;
    }

    /// The lights, in the order of their indices.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// The frame that [`Rain::lights`] belongs to.
    pub fn frame(&self) -> u32 {
        self.frame
    }

    fn spawn(&mut self, count: u32) {
        let (parameters, template) = (self.parameters, self.template);
        let [low, high] = parameters.tint;
        let start = |light| {
            let (position, motion, mut random) = parameters.start(light, 0);
            let tint = uniform_vector(&mut random, [low; 3], [high; 3]);
            (Light { position, tint, ..template }, motion)
        };
        let lights = (0..count).into_par_iter().with_min_len(LIGHTS_PER_TASK);
        lights.map(start).unzip_into_vecs(&mut self.lights, &mut self.motions);
        self.frame = 0;
    }
}
