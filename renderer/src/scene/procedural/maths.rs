//! Arithmetic that gives the same bits on every machine: only + - * / and sqrt, in a fixed order.

use glam::{Mat4, Vec3};
use rand_core::Rng;
use rand_pcg::Pcg32;

/// Sine and cosine of an angle given in whole turns, by Taylor series on an eighth of a turn.
pub(super) fn sin_cos(turns: f64) -> (f32, f32) {
    let quarter = (turns * 4.0).round();
    let angle = (turns - quarter / 4.0) * std::f64::consts::TAU;
    let square = angle * angle;
    let series = |first: f64, start: f64| {
        let mut term = first;
        let mut sum = first;
        for k in 0..8 {
            let n = start + 2.0 * f64::from(k);
            term *= -square / (n * (n + 1.0));
            sum += term;
        }
        sum
    };
    let (sin, cos) = (series(angle, 2.0) as f32, series(1.0, 1.0) as f32);
    match (quarter as i64).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// 0 at and below `low`, 1 at and above `high`, smooth between.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Linear interpolation.
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// A pseudo-random number in 0..1 for a lattice point (an integer avalanche hash).
pub(super) fn hash(x: i32, y: i32, seed: u32) -> f32 {
    let mut h = (x as u32)
        .wrapping_mul(0x9e37_79b1)
        .wrapping_add((y as u32).wrapping_mul(0x85eb_ca77))
        .wrapping_add(seed.wrapping_mul(0xc2b2_ae3d));
    h ^= h >> 15;
    h = h.wrapping_mul(0x2c1b_3c6d);
    h ^= h >> 12;
    h = h.wrapping_mul(0x297a_2d39);
    h ^= h >> 15;
    (h >> 8) as f32 / 16_777_216.0
}

/// Smooth value noise in 0..1 that repeats after `period` lattice points in both directions.
pub(super) fn noise(x: f32, y: f32, period: i32, seed: u32) -> f32 {
    let (x0, y0) = (x.floor(), y.floor());
    let (sx, sy) = (smoothstep(0.0, 1.0, x - x0), smoothstep(0.0, 1.0, y - y0));
    let corner = |dx: i32, dy: i32| {
        hash((x0 as i32 + dx).rem_euclid(period), (y0 as i32 + dy).rem_euclid(period), seed)
    };
    mix(mix(corner(0, 0), corner(1, 0), sx), mix(corner(0, 1), corner(1, 1), sx), sy)
}

/// Octaves of [`noise`] over the unit square, each twice as fine and half as strong; 0..1, tiles.
pub(super) fn fractal(u: f32, v: f32, period: i32, octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut weight, mut total) = (0.0, 1.0, 0.0);
    for octave in 0..octaves {
        let cells = period << octave;
        sum += weight * noise(u * cells as f32, v * cells as f32, cells, seed + octave);
        total += weight;
        weight *= 0.5;
    }
    sum / total
}

/// Seeded random numbers, converted to floats by raw integers.
pub(super) struct Dice(Pcg32);

impl Dice {
    /// The sequence of `seed`.
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg32::new(seed, 0x5eed))
    }

    /// A number uniform in 0..1.
    pub(super) fn unit(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as f32 / 16_777_216.0
    }

    /// Uniform between `low` and `high`.
    pub(super) fn range(&mut self, low: f32, high: f32) -> f32 {
        mix(low, high, self.unit())
    }

    /// A whole number uniform in 0..`count`.
    pub(super) fn below(&mut self, count: u32) -> u32 {
        ((u64::from(self.0.next_u32()) * u64::from(count)) >> 32) as u32
    }

    /// True with probability `share`.
    pub(super) fn chance(&mut self, share: f32) -> bool {
        self.unit() < share
    }

    /// A direction, uniform on the sphere.
    pub(super) fn direction(&mut self) -> Vec3 {
        let y = self.range(-1.0, 1.0);
        let (sin, cos) = sin_cos(f64::from(self.unit()));
        let radius = (1.0 - y * y).max(0.0).sqrt();
        Vec3::new(radius * cos, y, radius * sin)
    }
}

/// A rigid placement with uniform scale: object axes and origin in the parent space.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    axes: [Vec3; 3],
    origin: Vec3,
}

impl Place {
    /// The place at `(x, y, z)`, unturned.
    pub(super) fn at(x: f32, y: f32, z: f32) -> Self {
        Self { axes: [Vec3::X, Vec3::Y, Vec3::Z], origin: Vec3::new(x, y, z) }
    }

    /// The place at `origin`, with the object's x axis along the horizontal unit vector `(x, z)`.
    pub(super) fn along(origin: Vec3, [x, z]: [f32; 2]) -> Self {
        Self { axes: [Vec3::new(x, 0.0, z), Vec3::Y, Vec3::new(-z, 0.0, x)], origin }
    }

    /// The place at `origin`, with the object's y axis along the unit vector `up`.
    pub(super) fn upright(origin: Vec3, up: Vec3) -> Self {
        let helper = if up.x * up.x < 0.5 { Vec3::X } else { Vec3::Z };
        let back = helper.cross(up).normalize();
        Self { axes: [up.cross(back), up, back], origin }
    }

    /// First turned about the object's own y axis, counter-clockwise seen from above.
    pub(super) fn turned(self, turns: f64) -> Self {
        let (sin, cos) = sin_cos(turns);
        let [x, y, z] = self.axes;
        Self { axes: [x * cos - z * sin, y, x * sin + z * cos], ..self }
    }

    /// First turned about the object's own x axis.
    pub(super) fn tilted(self, turns: f64) -> Self {
        let (sin, cos) = sin_cos(turns);
        let [x, y, z] = self.axes;
        Self { axes: [x, y * cos + z * sin, z * cos - y * sin], ..self }
    }

    /// First scaled about the object's origin.
    pub(super) fn scaled(self, factor: f32) -> Self {
        Self { axes: self.axes.map(|axis| axis * factor), ..self }
    }

    /// The placement of `child`, given in this object's space, in the parent's.
    pub(super) fn then(&self, child: &Self) -> Self {
        Self { axes: child.axes.map(|axis| self.vector(axis)), origin: self.point(child.origin) }
    }

    /// A point of the object in the parent space.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        self.origin + self.vector(p)
    }

    /// A direction of the object in the parent space, scale included.
    pub(super) fn vector(&self, v: Vec3) -> Vec3 {
        self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z
    }

    /// The place as a matrix.
    pub(super) fn matrix(&self) -> Mat4 {
        let [x, y, z] = self.axes.map(|axis| axis.extend(0.0));
        Mat4::from_cols(x, y, z, self.origin.extend(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_agree_with_the_library() {
        for step in -500..500 {
            let turns = f64::from(step) / 97.0;
            let (sin, cos) = sin_cos(turns);
            let (s, c) = (turns * std::f64::consts::TAU).sin_cos();
            assert!((f64::from(sin) - s).abs() < 1e-6 && (f64::from(cos) - c).abs() < 1e-6, "{turns}");
        }
    }

    #[test]
    fn placements_stay_right_handed() {
        for place in [
            Place::along(Vec3::ONE, [0.6, -0.8]),
            Place::upright(Vec3::ZERO, Vec3::new(0.48, 0.6, 0.64)),
            Place::at(1.0, 2.0, 3.0).turned(0.3).tilted(0.1).scaled(2.0),
        ] {
            assert!(place.matrix().determinant() > 0.5);
        }
    }

    #[test]
    fn noise_tiles() {
        for k in 0..20 {
            let v = k as f32 / 20.0;
            assert!((fractal(0.0, v, 4, 3, 1) - fractal(1.0, v, 4, 3, 1)).abs() < 1e-5);
        }
    }
}
