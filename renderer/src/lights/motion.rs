//! How lights move that do not fall.

use super::place::Corners;
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the lights of a generator move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LightMotion {
    /// They stay where they are.
    #[default]
    Static,
    /// Each has its velocity, of up to 1 m/s along each axis, and bounces off the faces of its box.
    Bounce,
}

/// Greatest speed of a bouncing light along each axis, m/s.
pub(super) const BOUNCE_SPEED: f32 = 1.0;

/// Whether light `light` is one of those that move where this part of them does: they are spread evenly among the others.
pub(super) fn moves(light: u32, part: f64) -> bool {
    let among = |count: f64| (count * part).floor();
    among(f64::from(light) + 1.0) > among(f64::from(light))
}

/// A light that bounces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounce {
    /// Where it starts, metres, within the box.
    pub start: [f32; 3],
    /// Velocity at the start, m/s.
    pub velocity: [f32; 3],
}

impl Bounce {
    /// Where it is after so many seconds, metres.
    pub fn at(&self, seconds: f64, within: &Corners) -> [f32; 3] {
        let sides = within.sides();
        std::array::from_fn(|axis| {
            let (low, high) = (within.min[axis], within.max[axis]);
            let way = f64::from(self.start[axis]) - f64::from(low) + f64::from(self.velocity[axis]) * seconds;
            ((f64::from(low) + folded(way, sides[axis])) as f32).clamp(low, high)
        })
    }
}

/// How far up a side of this length a point is that has gone `way` along it, up and down in turn.
fn folded(way: f64, side: f64) -> f64 {
    if side <= 0.0 {
        return 0.0;
    }
    let way = way.rem_euclid(2.0 * side);
    if way > side { 2.0 * side - way } else { way }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ROOM: Corners = Corners { min: [-1.0, 0.0, 5.0], max: [3.0, 0.0, 6.0] };

    #[test]
    fn a_light_goes_straight_and_turns_at_the_faces() {
        let bounce = Bounce { start: [0.0, 0.0, 5.5], velocity: [1.0, 1.0, -0.5] };
        assert_eq!(bounce.at(0.0, &ROOM), [0.0, 0.0, 5.5]);
        assert_eq!(bounce.at(1.0, &ROOM), [1.0, 0.0, 5.0]);
        assert_eq!(bounce.at(3.0, &ROOM), [3.0, 0.0, 6.0]);
        assert_eq!(bounce.at(4.0, &ROOM), [2.0, 0.0, 5.5]);
        assert_eq!(bounce.at(8.0, &ROOM), [0.0, 0.0, 5.5]);
    }

    #[test]
    fn a_part_of_the_lights_moves_spread_evenly() {
        for (part, moving) in [(1.0, 100), (0.25, 25), (0.01, 1), (0.0, 0)] {
            assert_eq!((0..100).filter(|light| moves(*light, part)).count(), moving, "{part}");
        }
        assert!((0..100).filter(|light| moves(*light, 0.25)).eq((3..100).step_by(4)));
    }

    proptest! {
        #[test]
        fn no_light_leaves_its_box_or_leaps(
            start in [-1.0_f32..=3.0, 0.0..=0.0, 5.0..=6.0], velocity in [-1.0_f32..=1.0, -1.0..=1.0, -1.0..=1.0],
            seconds in 0.0_f64..1e5,
        ) {
            let bounce = Bounce { start, velocity };
            let (here, next) = (bounce.at(seconds, &ROOM), bounce.at(seconds + 0.01, &ROOM));
            for axis in 0..3 {
                prop_assert!((ROOM.min[axis]..=ROOM.max[axis]).contains(&here[axis]));
                prop_assert!((next[axis] - here[axis]).abs() <= 0.01 * BOUNCE_SPEED + 1e-5);
            }
        }
    }
}
