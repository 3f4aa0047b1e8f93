//! One drop of rain: how it starts, falls and respawns, from random numbers of its own.

use super::RainParameters;
use crate::lights::random::{generator, uniform_vector};
use rand_pcg::Pcg32;

/// What a light needs to go on falling, more than its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    /// Velocity of the drop, m/s.
    pub velocity: [f32; 3],
    /// How often the drop has respawned.
    pub life: u32,
}

impl RainParameters {
    /// A drop at the start of life `life` (0: the spawn) of light `light`.
    pub(super) fn start(&self, light: u32, life: u32) -> ([f32; 3], Motion, Pcg32) {
        let mut random = generator(self.seed, light, life);
        let mut lowest = self.box_min;
        if life > 0 {
            lowest[1] = self.box_max[1] - self.respawn_slab * (self.box_max[1] - self.box_min[1]);
        }
        let position = uniform_vector(&mut random, lowest, self.box_max);
        let velocity = uniform_vector(&mut random, self.velocity_min, self.velocity_max);
        (position, Motion { velocity, life }, random)
    }

    /// Whether a position lies in the box. No short cut: six comparisons cost less than a branch guessed wrong.
    pub(super) fn holds(&self, [x, y, z]: [f32; 3]) -> bool {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.box_min, self.box_max);
        (x >= x0) & (x <= x1) & (y >= y0) & (y <= y1) & (z >= z0) & (z <= z1)
    }

    /// One step of `dt` seconds for light `light`.
    pub(super) fn step(&self, dt: f32, light: u32, position: &mut [f32; 3], motion: &mut Motion) {
        let ([x, y, z], [u, v, w], [gx, gy, gz]) = (*position, motion.velocity, self.gravity_step);
        let [u, v, w] = [(u + gx) * self.damping, (v + gy) * self.damping, (w + gz) * self.damping];
        motion.velocity = [u, v, w];
        *position = [x + u * dt, y + v * dt, z + w * dt];
        if !self.holds(*position) {
            (*position, *motion, _) = self.start(light, motion.life.wrapping_add(1));
        }
    }
}
