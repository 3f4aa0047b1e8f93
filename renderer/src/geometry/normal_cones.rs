//! Normal cones (Tegelaers section 4.3, after Olsson et al. 2012): which ways the surfaces of a group face, as a set of cones, and
//! whether a light lies behind all of them.
//!
//! ```text
//! shading normals ──cone_of──> the cones they fall into, a bit each ─┐
//! samples ──> a ball around them ────────────────────────────────────┴─ facing ─> how surely some sample faces a light
//! ```
//!
//! Each face of a cube around the origin is divided into N x N squares; the directions through a square lie in a cone around
//! the one through its centre. Normals and lights are in the clustering camera's space.

use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;
use std::fmt;
use std::str::FromStr;

/// How finely normals are told apart: into how many squares, along either side, each face of the cube is divided; 0 where they
/// are not asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NormalCones(u32);

/// The most that a face is divided into along a side: 54 cones, in two words a group.
pub const MOST_DIVISIONS: u32 = 3;

/// How much wider a cone is than its square, radians. What two shaders make of one normal, and what a G-buffer of 16-bit
/// octahedral normals rounds (6e-5 at most), together stay well below.
const WIDENED: f64 = 1e-3;

impl NormalCones {
    /// Lights are tested against where samples lie alone.
    pub const OFF: Self = Self(0);

    /// Whether normals are asked at all.
    pub fn are_on(self) -> bool {
        self != Self::OFF
    }

    /// Squares along a side of a face.
    pub fn divisions(self) -> u32 {
        self.0
    }

    /// How many cones there are.
    pub fn count(self) -> u32 {
        6 * self.0 * self.0
    }

    /// Words of a bit for each cone.
    pub fn words(self) -> u32 {
        self.count().div_ceil(u32::BITS)
    }

    /// The cone that a direction lies in, of any length but 0: face by face (+x, -x, +y, ..), of each row by row.
    pub fn cone_of(self, direction: DVec3) -> u32 {
        let extent = direction.abs();
        let axis = match extent {
            _ if extent.x >= extent.y && extent.x >= extent.z => 0,
            _ if extent.y >= extent.z => 1,
            _ => 2,
        };
        let place = DVec2::new(direction[(axis + 1) % 3], direction[(axis + 2) % 3]) / extent[axis];
        let sides = f64::from(self.0);
        let [u, v] = ((place + 1.0) * (0.5 * sides)).to_array().map(|side| (side as u32).min(self.0 - 1));
        let face = 2 * axis as u32 + u32::from(direction[axis] < 0.0);
        (face * self.0 + v) * self.0 + u
    }

    /// The direction in the middle of a cone, of unit length.
    pub fn axis(self, cone: u32) -> DVec3 {
        let [face, v, u] = self.place(cone);
        self.through(face, DVec2::new(f64::from(u) + 0.5, f64::from(v) + 0.5))
    }

    /// Largest angle of a cone's directions from its axis, radians, widened by what normals are rounded.
    pub fn half_angle(self, cone: u32) -> f64 {
        let ([face, v, u], axis) = (self.place(cone), self.axis(cone));
        let corner = |i: u32| DVec2::new((u + (i & 1)).into(), (v + (i >> 1)).into());
        (0..4).map(|i| axis.angle_between(self.through(face, corner(i)))).fold(0.0, f64::max) + WIDENED
    }

    /// Face, row and column of a cone.
    fn place(self, cone: u32) -> [u32; 3] {
        [cone / (self.0 * self.0), cone / self.0 % self.0, cone % self.0]
    }

    /// The direction through a place on a face, in squares from its lowest corner.
    fn through(self, face: u32, place: DVec2) -> DVec3 {
        let axis = face as usize / 2;
        let across = place * (2.0 / f64::from(self.0)) - 1.0;
        let mut direction = DVec3::ZERO;
        direction[axis] = if face & 1 == 0 { 1.0 } else { -1.0 };
        direction[(axis + 1) % 3] = across.x;
        direction[(axis + 2) % 3] = across.y;
        direction.normalize()
    }

    /// How far, in metres, a light is from lying behind every surface with a normal in one of these cones (a bit each), somewhere
    /// in a ball: below 0 it lies behind all of them. In the ball it is infinitely far from that, and out of it, with no cone at all,
    /// infinitely far behind.
    ///
    /// With d the distance of the light from the centre of the ball, of radius r, all normals within a of an axis face away from the
    /// light, wherever in the ball their surface lies, where the light is more than pi/2 + a + asin(r/d) off the axis.
    pub fn facing(self, cones: u64, (centre, radius): (DVec3, f64), light: DVec3) -> f64 {
        let towards = light - centre;
        let distance = towards.length();
        if distance <= radius {
            return f64::INFINITY;
        }
        let ball = (radius / distance).asin();
        let of_cone = |cone: u32| {
            let widest = (FRAC_PI_2 + self.half_angle(cone) + ball).min(std::f64::consts::PI);
            self.axis(cone).dot(towards) - distance * widest.cos()
        };
        (0..self.count())
            .filter(|&cone| cones >> cone & 1 == 1)
            .map(of_cone)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Sine and cosine of the half angle of each cone of a face, as arguments of an array in GLSL: they are the same on all faces.
    pub fn glsl_spreads(self) -> String {
        let of_cone = |cone: u32| {
            let (sine, cosine) = self.half_angle(cone).sin_cos();
            format!("vec2({sine:.9}, {cosine:.9})")
        };
        (0..self.0 * self.0).map(of_cone).collect::<Vec<_>>().join(", ")
    }
}

impl fmt::Display for NormalCones {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for NormalCones {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse() {
            Ok(divisions) if divisions <= MOST_DIVISIONS => Ok(Self(divisions)),
            _ => Err(format!(
                "`{text}` is no division of a cube's faces: valid are 0 (no cones) to {MOST_DIVISIONS}"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all() -> impl Iterator<Item = NormalCones> {
        (1..=MOST_DIVISIONS).map(NormalCones)
    }

    #[test]
    fn cones_are_named_by_their_divisions() {
        for divisions in 0..=MOST_DIVISIONS {
            assert_eq!(divisions.to_string().parse(), Ok(NormalCones(divisions)));
        }
        for wrong in ["4", "-1", "", "two"] {
            assert!(wrong.parse::<NormalCones>().unwrap_err().contains("0 (no cones) to 3"), "{wrong}");
        }
        let words: Vec<u32> = (0..=MOST_DIVISIONS).map(|divisions| NormalCones(divisions).words()).collect();
        assert_eq!(words, [0, 1, 1, 2]);
    }

    #[test]
    fn a_face_is_a_cone_up_to_the_corners_of_the_cube() {
        let cones = NormalCones(1);
        assert_eq!(cones.cone_of(DVec3::new(0.1, -3.0, 0.2)), 3);
        assert_eq!(cones.axis(3), -DVec3::Y);
        assert!((cones.half_angle(3) - (1.0 / 3f64.sqrt()).acos() - WIDENED).abs() < 1e-12);
        assert!((0..24).all(|cone| NormalCones(2).half_angle(cone) < 0.63));
    }

    #[test]
    fn every_axis_lies_in_its_cone_and_faces_are_alike() {
        for cones in all() {
            for cone in 0..cones.count() {
                assert_eq!(cones.cone_of(cones.axis(cone)), cone, "{cones}");
                let on_first = cone % (cones.divisions() * cones.divisions());
                assert!(
                    (cones.half_angle(cone) - cones.half_angle(on_first)).abs() < 1e-12,
                    "{cones} {cone}"
                );
            }
        }
    }

    #[test]
    fn a_light_behind_a_wall_faces_none_of_it_and_one_before_it_does() {
        let cones = NormalCones(3);
        let wall = 1 << cones.cone_of(DVec3::Z);
        let ball = (DVec3::new(5.0, 0.0, 0.0), 0.5);
        let facing = |light: DVec3| cones.facing(wall, ball, light);
        assert!(facing(DVec3::new(5.0, 0.0, -3.0)) < -1.0);
        assert!(facing(DVec3::new(5.0, 0.0, 3.0)) > 1.0);
        assert!(facing(DVec3::new(8.0, 0.0, -0.1)) > 0.0, "beside the wall, in the plane of its cone");
        assert_eq!(facing(DVec3::new(5.0, 0.0, -0.4)), f64::INFINITY, "among the samples");
        assert_eq!(cones.facing(0, ball, DVec3::ZERO), f64::NEG_INFINITY);
    }

    fn direction() -> impl Strategy<Value = DVec3> {
        let axis = -1.0..1.0f64;
        [axis.clone(), axis.clone(), axis]
            .prop_map(DVec3::from_array)
            .prop_filter("has a length", |d| d.length() > 0.05)
            .prop_map(DVec3::normalize)
    }

    proptest! {
        #[test]
        fn directions_lie_in_their_cones(direction in direction(), divisions in 1..=MOST_DIVISIONS) {
            let cones = NormalCones(divisions);
            let cone = cones.cone_of(direction);
            prop_assert!(cone < cones.count());
            prop_assert!(cones.axis(cone).angle_between(direction) <= cones.half_angle(cone) - WIDENED + 1e-9);
        }

        #[test]
        fn no_light_is_left_out_that_a_sample_faces(
            samples in prop::collection::vec((direction(), direction(), 0.0..1.0f64), 1..6),
            (towards, distance) in (direction(), 0.0..8.0f64),
            divisions in 1..=MOST_DIVISIONS,
        ) {
            let (cones, light) = (NormalCones(divisions), towards * distance);
            let ball = (DVec3::ZERO, 1.0);
            let set = samples.iter().fold(0, |set, (normal, ..)| set | 1 << cones.cone_of(*normal));
            let faced = samples.iter().any(|(normal, place, r)| normal.dot(light - *place * *r) > 0.0);
            prop_assert!(!faced || cones.facing(set, ball, light) > 0.0);
        }
    }
}
