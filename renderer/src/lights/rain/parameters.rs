//! What rain is like, as recordings tell it.

use crate::Result;
use crate::json::{Check, Problem};
use serde::{Deserialize, Serialize};

/// What the rain is like. The default is the rain of Gelderen's chapter 6, in the box of both its scenes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RainParameters {
    /// Seed of all random choices: the same seed gives the same lights on every machine.
    pub seed: u64,
    /// Lowest corner of the box, metres.
    pub box_min: [f32; 3],
    /// Highest corner of the box, metres.
    pub box_max: [f32; 3],
    /// Lowest velocity of a new drop, m/s.
    pub velocity_min: [f32; 3],
    /// Highest velocity of a new drop, m/s.
    pub velocity_max: [f32; 3],
    /// Lowest and highest value of a tint's channels.
    pub tint: [f32; 2],
    /// What is added to the velocity in every step, m/s.
    pub gravity_step: [f32; 3],
    /// Multiplies the velocity in every step, after gravity.
    pub damping: f32,
    /// Height of the slab at the box's top where drops respawn, as a fraction of the box's height.
    pub respawn_slab: f32,
}

impl Default for RainParameters {
    fn default() -> Self {
        Self {
            seed: 1,
            box_min: [-60.0, -20.0, -60.0],
            box_max: [80.0, 60.0, 60.0],
            velocity_min: [0.2, -20.0, 1.0],
            velocity_max: [1.2, -14.0, 2.3],
            tint: [0.5, 1.0],
            gravity_step: [0.0, -0.04, 0.0],
            damping: 0.99,
            respawn_slab: 0.01,
        }
    }
}

impl Check for RainParameters {
    fn check(&self) -> Result<(), Problem> {
        let sane = |values: &[f32]| values.iter().all(|value| value.abs() <= 1e6);
        let ordered = |low: &[f32], high: &[f32]| {
            sane(low) && sane(high) && low.iter().zip(high).all(|(low, high)| low <= high)
        };
        let filled = self.box_min.iter().zip(self.box_max).all(|(low, high)| *low < high);
        let fault = |field: &'static str, message: &str| Err(Problem::new(message).under(field));
        if !(ordered(&self.box_min, &self.box_max) && filled) {
            return fault("box_max", "must lie above box_min on every axis, and both within +-1e6 m");
        }
        if !ordered(&self.velocity_min, &self.velocity_max) {
            return fault("velocity_max", "must not lie below velocity_min, and both within +-1e6 m/s");
        }
        if !(ordered(&self.tint[..1], &self.tint[1..]) && self.tint[0] >= 0.0) {
            return fault("tint", "must be a lowest and a highest value, 0 or above, in this order");
        }
        if !sane(&self.gravity_step) {
            return fault("gravity_step", "must lie within +-1e6 m/s");
        }
        if !(0.0..=1.0).contains(&self.damping) {
            return fault("damping", "must lie within 0..1");
        }
        if !(self.respawn_slab > 0.0 && self.respawn_slab <= 1.0) {
            return fault("respawn_slab", "must lie above 0 and not above 1");
        }
        Ok(())
    }
}

/// How flat a box of rain may be: its shortest side over its longest.
const FLATTEST: f32 = 0.1;

impl RainParameters {
    /// The default rain in the box from `low` to `high` (metres). Speeds and gravity are scaled with its sides, so that a
    /// drop falls through it in the same time. A side too short for rain is stretched, upwards or to both sides.
    pub fn within(low: [f32; 3], high: [f32; 3]) -> Self {
        let usual = Self::default();
        let side = |axis: usize| high[axis] - low[axis];
        let least = (FLATTEST * side(0).max(side(1)).max(side(2))).max(1e-3);
        let [box_min, box_max] = [-1.0, 1.0].map(|sign: f32| {
            std::array::from_fn(|axis| {
                let missing = (least - side(axis)).max(0.0);
                match (axis, sign < 0.0) {
                    (1, true) => low[1],
                    (1, false) => high[1] + missing,
                    (_, true) => low[axis] - 0.5 * missing,
                    (_, false) => high[axis] + 0.5 * missing,
                }
            })
        });
        let scaled = |values: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|axis| {
                let usual_side = usual.box_max[axis] - usual.box_min[axis];
                values[axis] * ((box_max[axis] - box_min[axis]) / usual_side)
            })
        };
        Self {
            velocity_min: scaled(usual.velocity_min),
            velocity_max: scaled(usual.velocity_max),
            gravity_step: scaled(usual.gravity_step),
            box_min,
            box_max,
            ..usual
        }
    }
}
