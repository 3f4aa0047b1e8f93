//! What a spot light reaches: the part of a ball that lies within a cone from its centre.
//!
//! ```text
//!            ___
//!         .-'   │       range R, half angle a
//!   apex <──────┤ axis  bounding sphere: through the apex and the rim where a <= 45 degrees,
//!         '-.___│       else around the rim
//! ```

use glam::DVec3;
use std::f64::consts::FRAC_PI_4;

/// The points up to `range` metres from an apex whose direction is within `half_angle` of an axis. Convex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalSector {
    /// Where the light is, metres.
    pub apex: DVec3,
    /// Unit vector along which the light shines.
    pub axis: DVec3,
    /// How far it reaches, metres, above 0.
    pub range: f64,
    /// Angle between the axis and the side, radians, above 0 and at most a right angle.
    pub half_angle: f64,
}

impl SphericalSector {
    /// Centre (metres) and radius (metres) of the least sphere that holds all of it.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        let Self { apex, axis, range, half_angle } = *self;
        if half_angle <= FRAC_PI_4 {
            let radius = range / (2.0 * half_angle.cos());
            (apex + axis * radius, radius)
        } else {
            (apex + axis * (range * half_angle.cos()), range * half_angle.sin())
        }
    }

    /// The unit direction within the cone that is nearest to a direction of any length but 0.
    pub fn nearest_direction(&self, direction: DVec3) -> DVec3 {
        let (sine, cosine) = self.half_angle.sin_cos();
        let along = self.axis.dot(direction);
        let across = direction.reject_from_normalized(self.axis);
        if across.length() * cosine <= along * sine {
            return direction.normalize();
        }
        self.axis * cosine + self.sideways(direction) * sine
    }

    /// The unit direction across the axis that is nearest to a direction; any where that is along the axis.
    fn sideways(&self, direction: DVec3) -> DVec3 {
        let across = direction.reject_from_normalized(self.axis);
        if across.length() <= 1e-12 * direction.length() {
            return self.axis.any_orthonormal_vector();
        }
        // Again, for what little is left along the axis is all the more of it, the less there is across.
        across.normalize().reject_from_normalized(self.axis).normalize()
    }

    /// The farthest that it reaches along a direction: the most that `direction` . x is for its points x, metres times the
    /// direction's length.
    pub fn support(&self, direction: DVec3) -> f64 {
        self.apex.dot(direction) + self.reach(direction)
    }

    /// The farthest that it reaches along a direction from its apex.
    pub(super) fn reach(&self, direction: DVec3) -> f64 {
        if direction == DVec3::ZERO {
            return 0.0;
        }
        (self.range * direction.dot(self.nearest_direction(direction))).max(0.0)
    }

    /// Whether it holds a point.
    pub fn contains(&self, point: DVec3) -> bool {
        self.distance(point) == 0.0
    }

    /// How far a point lies outside, metres; 0 inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        let (sine, cosine) = self.half_angle.sin_cos();
        let (along, across) = self.along_and_across(point);
        if across * cosine <= along * sine {
            return (along.hypot(across) - self.range).max(0.0);
        }
        // Beside the cone, the nearest point lies on the side, which in the plane of axis and point is a line.
        let up_the_side = (along * cosine + across * sine).clamp(0.0, self.range);
        (along - up_the_side * cosine).hypot(across - up_the_side * sine)
    }

    /// How far in front of the apex a point lies, and how far from the axis, metres.
    fn along_and_across(&self, point: DVec3) -> (f64, f64) {
        let offset = point - self.apex;
        let along = self.axis.dot(offset);
        (along, (offset - self.axis * along).length())
    }

    /// A sector of the same axis and angle that holds every point up to `by` metres from this one; or, by less than 0, one of
    /// whose points all others up to so many metres away lie in this one: `None` where there is no such point.
    pub fn grown(&self, by: f64) -> Option<Self> {
        let back = by / self.half_angle.sin();
        let range = self.range + by + back;
        (range > 0.0).then(|| Self { apex: self.apex - self.axis * back, range, ..*self })
    }
}

#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use proptest::prelude::*;

    /// Any direction; the poles are as likely as others.
    pub fn direction() -> impl Strategy<Value = DVec3> {
        (-1.0..=1.0f64, 0.0..std::f64::consts::TAU).prop_map(|(z, turn)| {
            let across = (1.0 - z * z).sqrt();
            DVec3::new(across * turn.cos(), across * turn.sin(), z)
        })
    }

    /// Half angles from half a degree to a right angle, narrow ones as likely as wide ones.
    pub fn half_angle() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-1.0..1.0f64).prop_map(|part| (90.0 * 180f64.powf((part - 1.0) / 2.0)).to_radians()),
            Just(90f64.to_radians()),
            (0.5..90f64).prop_map(f64::to_radians),
        ]
    }

    /// Sectors that reach half a metre to 40 m, their apices around the origin.
    pub fn sector() -> impl Strategy<Value = SphericalSector> {
        let apex = prop::array::uniform3(-20.0..20.0f64).prop_map(DVec3::from_array);
        (apex, direction(), 0.5..40.0f64, half_angle())
            .prop_map(|(apex, axis, range, half_angle)| SphericalSector { apex, axis, range, half_angle })
    }

    /// The point of a sector at parts of its range, of its half angle and around its axis.
    pub fn point_of(sector: &SphericalSector, [far, wide, around]: [f64; 3]) -> DVec3 {
        let first = sector.axis.any_orthonormal_vector();
        let sideways = first * (around * std::f64::consts::TAU).cos()
            + sector.axis.cross(first) * (around * std::f64::consts::TAU).sin();
        let (sine, cosine) = (wide * sector.half_angle).sin_cos();
        sector.apex + (sector.axis * cosine + sideways * sine) * (far * sector.range)
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{direction, point_of, sector};
    use super::*;
    use proptest::prelude::*;

    fn of(half_angle: f64) -> SphericalSector {
        let apex = DVec3::new(1.0, 2.0, 3.0);
        SphericalSector { apex, axis: -DVec3::Z, range: 2.0, half_angle: half_angle.to_radians() }
    }

    #[test]
    fn distances_are_those_to_side_cap_and_apex() {
        let sector = of(45.0);
        let distance = |x: f64, z: f64| sector.distance(sector.apex + DVec3::new(x, 0.0, -z));
        for (x, z, expected) in [
            (0.0, 1.0, 0.0),
            (0.0, 2.5, 0.5),
            (0.0, -1.0, 1.0),
            (2.0, 0.0, 2f64.sqrt()),
            (3.0, 3.0, 18f64.sqrt() - 2.0),
            // Past the rim.
            (3.0, 0.0, (13.0 - 12.0 * 0.5f64.sqrt()).sqrt()),
        ] {
            assert!((distance(x, z) - expected).abs() < 1e-12, "({x}, {z})");
        }
        assert_eq!(of(90.0).distance(DVec3::new(1.0, 2.0, 4.0)), 1.0);
        assert!((of(90.0).distance(DVec3::new(5.0, 2.0, 3.5)) - 2f64.hypot(0.5)).abs() < 1e-12);
    }

    #[test]
    fn narrow_ones_are_bounded_through_their_apex_and_wide_ones_around_their_rim() {
        let (centre, radius) = of(30.0).bounding_sphere();
        assert!((radius - 2.0 / 3f64.sqrt()).abs() < 1e-12);
        assert!((centre.distance(of(30.0).apex) - radius).abs() < 1e-12);
        let (centre, radius) = of(60.0).bounding_sphere();
        assert!((radius - 3f64.sqrt()).abs() < 1e-12 && (centre.z - 2.0).abs() < 1e-12);
        assert_eq!(of(90.0).bounding_sphere().1, 2.0);
    }

    proptest! {
        #[test]
        fn what_a_sector_holds_is_bounded_and_supported(
            sector in sector(), parts in prop::array::uniform3(0.0..=1.0f64), towards in direction(),
        ) {
            let point = point_of(&sector, parts);
            prop_assert!(sector.distance(point) < 1e-9);
            let (centre, radius) = sector.bounding_sphere();
            prop_assert!(centre.distance(point) <= radius + 1e-9);
            prop_assert!(towards.dot(point) <= sector.support(towards) + 1e-9);
            // The direction within the cone that is nearest takes part in it, also of what is along the axis, and none is nearer.
            let nearest = sector.nearest_direction(towards);
            for direction in [towards, -sector.axis, -7.3 * sector.axis, towards * 1e-14 - sector.axis] {
                let angle = sector.nearest_direction(direction).angle_between(sector.axis);
                prop_assert!(angle <= sector.half_angle + 1e-7, "{}", direction);
            }
            let direction = (point - sector.apex).normalize_or(sector.axis);
            prop_assert!(towards.dot(direction) <= towards.dot(nearest) + 1e-9);
        }

        /// A point is as far away as the plane that parts it best from the sector.
        #[test]
        fn the_distance_of_a_point_is_that_of_the_plane_that_parts_it_best(
            sector in sector(), point in prop::array::uniform3(-60.0..60.0f64), towards in direction(),
        ) {
            let point = DVec3::from_array(point);
            let distance = sector.distance(point);
            prop_assert!(towards.dot(point) - sector.support(towards) <= distance + 1e-9);
            if distance > 1e-2 {
                // By how the distance grows along each axis; it is convex, so that this is the way out.
                let step = 1e-6;
                let slope = DVec3::AXES.map(|axis| (sector.distance(point + axis * step) - distance) / step);
                let out = DVec3::from_array(slope).normalize();
                prop_assert!(out.dot(point) - sector.support(out) > distance - 1e-3 * (1.0 + distance));
            }
        }

        #[test]
        fn a_grown_sector_holds_all_around_and_a_shrunk_one_is_held(
            sector in sector(), parts in prop::array::uniform3(0.0..=1.0f64), by in 0.0..0.5f64, towards in direction(),
        ) {
            let grown = sector.grown(by).unwrap();
            prop_assert!(grown.distance(point_of(&sector, parts) + towards * by) < 1e-9);
            if let Some(shrunk) = sector.grown(-by) {
                prop_assert!(sector.distance(point_of(&shrunk, parts) + towards * by) < 1e-9);
            }
        }
    }
}
