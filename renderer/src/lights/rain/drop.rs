//! One drop of rain: how it starts, falls and respawns, from random numbers of its own.

use super::RainParameters;
use rand_core::Rng;
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

/// The generator of one life of one light: its own stream, and a state that no other seed or life is near to.
fn generator(seed: u64, light: u32, life: u32) -> Pcg32 {
    let key = u64::from(light) << 32 | u64::from(life);
    Pcg32::new(scramble(seed ^ scramble(key)), key)
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014; constants of Vigna's version).
fn scramble(value: u64) -> u64 {
    let value = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ (value >> 31)
}

/// Uniform in low..=high on each axis, in steps of 2^-24 of the range.
pub(super) fn uniform_vector(random: &mut Pcg32, low: [f32; 3], high: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let fraction = (random.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0);
        (low[axis] + fraction * (high[axis] - low[axis])).min(high[axis])
    })
}
