//! How the depth of a perspective grid is divided: the laws, from a depth to its slice and back.
//!
//! Marking, bounds and shading find a slice by [`Slices::coordinate_of`], lights are tested against planes at
//! [`Slices::depth_at`]; `lib/slices.glsl` is the same on the device.

use super::Frustum;
use crate::nearest;
use std::f64::consts::LN_2;
use std::fmt;
use std::str::FromStr;

/// Where the planes between slices lie: plane k of a frustum from n to f metres in front of the eye, of s slices.
///
/// Its name is its identity everywhere: `geometric`, `cubes`, `second-plane-5`, `linear`, `uniform-ndc`, `uniform-view`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SliceLaw {
    /// n (f/n)^(k/s): every slice as many times as deep as the one before (Enhuber section 3.2; Gelderen equation 3.3).
    Geometric,
    /// n (1 + t)^k, where t is the height of a tile in tangents: clusters about as deep as high (Olsson; Tegelaers). The number
    /// of slices follows.
    Cubes,
    /// 0, then m (f/m)^((k-1)/(s-1)): the first slice ends at m metres (Ortegren).
    SecondPlane {
        /// Where the first slice ends, metres in front of the eye.
        metres: f64,
    },
    /// f k/s: even steps from the eye (Ortegren).
    Linear,
    /// Even steps of depth as projected.
    UniformNdc,
    /// n + (f - n) k/s: even steps from the near plane.
    UniformView,
}

impl SliceLaw {
    /// Every law but for what a name gives it, with an example of that.
    pub const EXAMPLES: [Self; 6] = [
        Self::Geometric,
        Self::Cubes,
        Self::SecondPlane { metres: 5.0 },
        Self::Linear,
        Self::UniformNdc,
        Self::UniformView,
    ];
}

const SECOND_PLANE: &str = "second-plane-";

impl fmt::Display for SliceLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Geometric => f.write_str("geometric"),
            Self::Cubes => f.write_str("cubes"),
            Self::SecondPlane { metres } => write!(f, "{SECOND_PLANE}{metres}"),
            Self::Linear => f.write_str("linear"),
            Self::UniformNdc => f.write_str("uniform-ndc"),
            Self::UniformView => f.write_str("uniform-view"),
        }
    }
}

impl FromStr for SliceLaw {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        match text.strip_prefix(SECOND_PLANE) {
            Some(metres) => match metres.parse() {
                Ok(metres) if metres > 0.0 && f64::is_finite(metres) => Ok(Self::SecondPlane { metres }),
                _ => Err(format!("`{text}`: behind `{SECOND_PLANE}` stand metres, a number above 0")),
            },
            None => nearest::named(text, &Self::EXAMPLES, "slice law"),
        }
    }
}

/// The slices of one frustum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slices {
    /// Where their planes lie.
    pub law: SliceLaw,
    /// The depth that others are measured in, metres.
    origin: f64,
    /// From one plane to the next, in what the law divides evenly.
    step: f64,
}

impl Slices {
    /// Slice k from `near`*(1 + `ratio`)^k on, metres.
    pub fn geometric(near: f64, ratio: f64) -> Self {
        Self { law: SliceLaw::Geometric, origin: near, step: ratio.ln_1p() }
    }

    /// So many slices of a frustum. Those of [`SliceLaw::Geometric`] and [`SliceLaw::Cubes`] have a ratio instead.
    pub fn new(law: SliceLaw, frustum: &Frustum, ratio: f64, count: f64) -> Self {
        let (near, far) = (frustum.near(), -frustum.z0);
        let (origin, step) = match law {
            SliceLaw::Geometric | SliceLaw::Cubes => (near, ratio.ln_1p()),
            SliceLaw::SecondPlane { metres } => (metres, (far / metres).ln() / (count - 1.0)),
            SliceLaw::Linear => (far, 1.0 / count),
            SliceLaw::UniformNdc => (near, (far - near) / (far * count)),
            SliceLaw::UniformView => (near, (far - near) / (near * count)),
        };
        Self { law, origin, step }
    }

    /// The depth at a coordinate, metres; of a whole number, that of a plane.
    pub fn depth_at(&self, coordinate: f64) -> f64 {
        let Self { law, origin, step } = *self;
        match law {
            SliceLaw::Geometric | SliceLaw::Cubes => origin * (coordinate * step).exp(),
            SliceLaw::SecondPlane { .. } if coordinate < 1.0 => origin * coordinate,
            SliceLaw::SecondPlane { .. } => origin * ((coordinate - 1.0) * step).exp(),
            SliceLaw::Linear => origin * (coordinate * step),
            SliceLaw::UniformNdc => origin / (1.0 - coordinate * step),
            SliceLaw::UniformView => origin * (1.0 + coordinate * step),
        }
    }

    /// The coordinate of a depth, metres: its floor is the slice.
    pub fn coordinate_of(&self, depth: f64) -> f64 {
        let Self { law, origin, step } = *self;
        let parts = depth / origin;
        match law {
            SliceLaw::Geometric | SliceLaw::Cubes => parts.ln() / step,
            SliceLaw::SecondPlane { .. } if parts < 1.0 => parts,
            SliceLaw::SecondPlane { .. } => 1.0 + parts.ln() / step,
            SliceLaw::Linear => parts / step,
            SliceLaw::UniformNdc => (1.0 - 1.0 / parts) / step,
            SliceLaw::UniformView => (parts - 1.0) / step,
        }
    }

    /// The coordinate of what may lie nearer than anything in the grid, and behind the eye: below 1 there.
    pub fn clamped_coordinate_of(&self, depth: f64) -> f64 {
        let least = match self.law {
            SliceLaw::SecondPlane { .. } | SliceLaw::Linear => 0.0,
            _ => 1e-3,
        };
        self.coordinate_of(depth.max(least * self.origin))
    }

    /// As the device has them: the depth that others are measured in, metres, and the step, of logarithms to base 2.
    pub fn on_device(&self) -> [f64; 2] {
        let Self { law, origin, step } = *self;
        match law {
            SliceLaw::Geometric | SliceLaw::Cubes | SliceLaw::SecondPlane { .. } => [origin, step / LN_2],
            SliceLaw::Linear | SliceLaw::UniformNdc | SliceLaw::UniformView => [origin, step],
        }
    }

    /// The coordinate of one metre by the geometric laws, 0 by the others: with it a slice takes one logarithm, one product
    /// and one sum (Ortiz).
    pub fn bias(&self) -> f64 {
        match self.law {
            SliceLaw::Geometric | SliceLaw::Cubes => self.coordinate_of(1.0),
            SliceLaw::SecondPlane { .. }
            | SliceLaw::Linear
            | SliceLaw::UniformNdc
            | SliceLaw::UniformView => 0.0,
        }
    }

    /// Thickness of the relatively thinnest of `count` slices, over the depth at which it begins: that of the first or last.
    pub fn thinnest(&self, count: f64) -> f64 {
        let thickness = |slice: f64| self.depth_at(slice + 1.0) / self.depth_at(slice) - 1.0;
        thickness(0.0).min(thickness(count - 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn slices(law: SliceLaw, near: f64, far: f64, count: f64) -> Slices {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -0.5, y1: 0.5, z0: -far, z1: -near };
        Slices::new(law, &frustum, (far / near).powf(1.0 / count) - 1.0, count)
    }

    #[test]
    fn names_are_read_and_written_alike() {
        for law in SliceLaw::EXAMPLES.into_iter().chain([SliceLaw::SecondPlane { metres: 0.25 }]) {
            assert_eq!(law.to_string().parse::<SliceLaw>(), Ok(law));
        }
        let refused = |text: &str| text.parse::<SliceLaw>().unwrap_err();
        assert!(refused("lineal").contains("did you mean `linear`?"));
        for text in ["second-plane-", "second-plane-0", "second-plane--3", "second-plane-inf"] {
            assert!(refused(text).contains("a number above 0"), "{text}");
        }
    }

    #[test]
    fn planes_lie_where_the_papers_have_them() {
        let of = |law, plane| slices(law, 2.0, 32.0, 4.0).depth_at(plane);
        let second = SliceLaw::SecondPlane { metres: 4.0 };
        for (law, planes) in [
            (SliceLaw::Geometric, [2.0, 4.0, 8.0, 16.0, 32.0]),
            (second, [0.0, 4.0, 8.0, 16.0, 32.0]),
            (SliceLaw::Linear, [0.0, 8.0, 16.0, 24.0, 32.0]),
            (SliceLaw::UniformView, [2.0, 9.5, 17.0, 24.5, 32.0]),
            // f n/(f - (f - n) k/s).
            (SliceLaw::UniformNdc, [2.0, 64.0 / 24.5, 64.0 / 17.0, 64.0 / 9.5, 32.0]),
        ] {
            for (plane, depth) in planes.into_iter().enumerate() {
                assert!((of(law, plane as f64) - depth).abs() < 1e-12, "{law}, plane {plane}");
            }
        }
    }

    #[test]
    fn the_second_plane_is_where_its_formula_has_it() {
        // slice(z) = log2(z) q + 1 - q log2(m).
        let (near, second, far, count) = (0.1, 5.0, 500.0, 16.0);
        let q = (count - 1.0) / (f64::log2(far) - f64::log2(second));
        let slices = slices(SliceLaw::SecondPlane { metres: second }, near, far, count);
        for depth in [5.0f64, 7.0, 100.0, 499.0] {
            let printed = depth.log2() * q + 1.0 - q * f64::log2(second);
            assert!((slices.coordinate_of(depth) - printed).abs() < 1e-9);
        }
        assert!((0.0..1.0).contains(&slices.coordinate_of(4.99)));
    }

    /// A logarithm in single precision, off by that part of what the Vulkan specification allows.
    fn log2(value: f32, off: f32) -> f32 {
        value.log2() + off * (3.0 * f32::EPSILON * value.log2().abs()).max(2f32.powi(-21))
    }

    /// As `slice_of` of cluster_space.glsl.
    fn slice_of(depth: f32, coordinate: f32, allowed: f32, planes: &[f32]) -> usize {
        let (last, plane) = ((planes.len() - 2) as f32, coordinate.round());
        if (coordinate - plane).abs() < allowed && plane >= 1.0 && plane <= last {
            return plane as usize - usize::from(depth < planes[plane as usize]);
        }
        coordinate.floor().clamp(0.0, last) as usize
    }

    proptest! {
        #[test]
        fn a_plane_divides_its_slices(
            law in 0..6usize, near in 0.05..2.0f64, far in 20.0..2000.0f64, count in 2..200u32,
        ) {
            let law = SliceLaw::EXAMPLES[law];
            let slices = slices(law, near, far, f64::from(count));
            for plane in 1..count {
                let depth = slices.depth_at(f64::from(plane));
                for (aside, slice) in [(1.0 - 1e-9, plane - 1), (1.0 + 1e-9, plane)] {
                    let found = slices.coordinate_of(depth * aside);
                    prop_assert_eq!(found.floor() as u32, slice, "{} at {}", law, depth);
                }
                prop_assert!(depth > slices.depth_at(f64::from(plane - 1)));
            }
            prop_assert!((slices.depth_at(f64::from(count)) / far - 1.0).abs() < 1e-6);
            prop_assert!(slices.coordinate_of(near) > -1e-9);
            let behind_the_eye = slices.clamped_coordinate_of(-3.0);
            prop_assert!(behind_the_eye < 1.0 && !behind_the_eye.is_nan());
        }

        /// The slice is the one whose planes hold the depth, to the bit, by either formula, however far off a device's logarithm is
        /// that keeps to the Vulkan specification.
        #[test]
        fn the_slice_is_that_of_the_planes_by_ratio_and_by_bias(
            near in 0.001..2.0f64, far in 20.0..2000.0f64, count in 1..200u32, part in 0.0..1.0f64, beside in -2..=2i32,
            at_plane: bool, off in -1.0..1.0f32,
        ) {
            let slices = slices(SliceLaw::Geometric, near, far, f64::from(count));
            let planes: Vec<f32> = (0..=count).map(|plane| slices.depth_at(plane.into()) as f32).collect();
            let coordinate = part * f64::from(count);
            let coordinate = if at_plane { coordinate.round() } else { coordinate };
            let depth = (slices.depth_at(coordinate) as f32).to_bits().saturating_add_signed(beside);
            let depth = f32::from_bits(depth).clamp(planes[0], planes[count as usize]);
            let [origin, step] = slices.on_device();
            let (origin, scale, bias) = (origin as f32, (1.0 / step) as f32, slices.bias() as f32);
            let expected = planes.partition_point(|plane| *plane <= depth).clamp(1, count as usize) - 1;
            let by_ratio = log2(depth / origin, off) * scale;
            let allowed = 2e-6 * (by_ratio.abs() + scale);
            prop_assert_eq!(slice_of(depth, by_ratio, allowed, &planes), expected, "by ratio");
            let by_bias = log2(depth, off) * scale + bias;
            let allowed = 2e-6 * (by_bias.abs() + bias.abs() + scale);
            prop_assert_eq!(slice_of(depth, by_bias, allowed, &planes), expected, "by bias");
        }
    }
}
