//! The cone of a spot light (KHR_lights_punctual).

use crate::geometry::SphericalSector;
use glam::DVec3;
use serde::Serialize;
use std::f32::consts::FRAC_PI_2;

/// Smallest half angle of a cone, radians: a tenth of a degree. The cosine of a smaller one is hardly another f32 than 1.
const LEAST_ANGLE: f32 = 0.001_745;

/// Least difference of the cosines of the two half angles that the falloff is spread over (KHR_lights_punctual).
const LEAST_SPREAD: f64 = 1e-3;

/// The cone that a spot light shines into: its light is full up to one half angle and fades to nothing at the other. What it
/// reaches is a spherical sector, as its range ends on a sphere.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spot {
    /// Unit direction of the light, world space.
    pub direction: [f32; 3],
    /// Half angle up to which the light is full, radians, from 0 on.
    pub inner: f32,
    /// Half angle from which on there is no light, radians, from `inner` on up to pi/2.
    pub outer: f32,
}

/// How light fades from a cone's axis to its rim, as a linear function of the cosine of the angle to the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConeFalloff {
    /// What the cosine is multiplied by.
    pub scale: f64,
    /// What is added to that; 0 is reached at the outer half angle.
    pub offset: f64,
}

impl ConeFalloff {
    /// That of a light which shines all around: 1 everywhere.
    pub const NONE: Self = Self { scale: 0.0, offset: 1.0 };

    /// The part of the light that goes in a direction at this cosine from the axis, 0 to 1.
    pub fn at(self, cosine: f64) -> f64 {
        (self.scale * cosine + self.offset).clamp(0.0, 1.0).powi(2)
    }
}

impl Spot {
    /// A cone with half angles in radians around a direction of any length.
    pub fn new(direction: [f32; 3], inner: f32, outer: f32) -> Self {
        let axis = DVec3::from_array(direction.map(f64::from)).normalize_or_zero();
        Self { direction: axis.as_vec3().to_array(), inner, outer }
    }

    /// Unit direction of the light, world space.
    pub fn axis(&self) -> DVec3 {
        DVec3::from_array(self.direction.map(f64::from)).normalize_or_zero()
    }

    /// How the light fades towards the rim (KHR_lights_punctual).
    pub fn falloff(&self) -> ConeFalloff {
        let [inner, outer] = [self.inner, self.outer].map(|angle| libm::cos(angle.into()));
        let scale = 1.0 / (inner - outer).max(LEAST_SPREAD);
        ConeFalloff { scale, offset: -outer * scale }
    }

    /// What a light at `apex` (metres) reaches with this cone, up to `range` metres.
    pub fn sector(&self, apex: DVec3, range: f64) -> SphericalSector {
        SphericalSector { apex, axis: self.axis(), range, half_angle: self.outer.into() }
    }

    /// Finds the first value that no cone can have: its column in a lights file, and what it must be.
    pub(super) fn check(&self) -> Result<(), (&'static str, String)> {
        let length = self.axis().length();
        if !(length > 0.5 && length.is_finite()) {
            return Err(("dx", "0,0,0 is no direction".into()));
        }
        let degrees = |angle: f32| angle.to_degrees();
        if !(LEAST_ANGLE..=1.000_001 * FRAC_PI_2).contains(&self.outer) {
            let message = format!("{} is not a half angle from 0.1 to 90 degrees", degrees(self.outer));
            return Err(("outer", message));
        }
        if !(0.0..=self.outer).contains(&self.inner) {
            let (inner, outer) = (degrees(self.inner), degrees(self.outer));
            return Err((
                "inner",
                format!("{inner} is not a half angle from 0 to the outer one, {outer} degrees"),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(inner: f32, outer: f32) -> Spot {
        Spot::new([0.0, 0.0, -2.0], inner.to_radians(), outer.to_radians())
    }

    #[test]
    fn light_is_full_within_the_inner_cone_and_gone_beyond_the_outer() {
        let falloff = spot(20.0, 40.0).falloff();
        let at = |degrees: f64| falloff.at(degrees.to_radians().cos());
        assert_eq!([at(0.0), at(19.99), at(40.01), at(180.0)], [1.0, 1.0, 0.0, 0.0]);
        let halfway = (0.5 * (20.0_f64.to_radians().cos() + 40.0_f64.to_radians().cos())).acos().to_degrees();
        assert!((at(halfway) - 0.25).abs() < 1e-6 && at(39.9) > 0.0);
        assert_eq!([ConeFalloff::NONE.at(-1.0), ConeFalloff::NONE.at(1.0)], [1.0; 2]);
    }

    #[test]
    fn a_cone_without_a_rim_still_ends_where_it_should() {
        let falloff = spot(30.0, 30.0).falloff();
        assert!(
            falloff.at(29.8_f64.to_radians().cos()) == 1.0
                && falloff.at(30.001_f64.to_radians().cos()) == 0.0
        );
    }

    #[test]
    fn what_no_cone_can_be_is_refused_by_its_column() {
        for (wrong, column) in [
            (Spot { direction: [0.0; 3], ..spot(10.0, 20.0) }, "dx"),
            (Spot { direction: [f32::NAN, 0.0, 1.0], ..spot(10.0, 20.0) }, "dx"),
            (spot(0.0, 0.05), "outer"),
            (spot(0.0, 91.0), "outer"),
            (spot(0.0, f32::NAN), "outer"),
            (spot(21.0, 20.0), "inner"),
            (spot(-1.0, 20.0), "inner"),
        ] {
            assert_eq!(wrong.check().unwrap_err().0, column, "{wrong:?}");
        }
        assert!(spot(0.0, 90.0).check().is_ok() && spot(0.1, 0.1).check().is_ok());
    }
}
