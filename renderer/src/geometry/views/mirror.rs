//! Planes that reflect.

use super::Pose;
use crate::{Error, Result};
use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};

/// A plane in the world that reflects: its points, with normal·p = offset, stay where they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mirror {
    /// Unit normal of the mirror's plane, towards the side that is seen in it.
    pub normal: DVec3,
    /// Distance of the plane from the origin along the normal, metres.
    pub offset: f64,
}

impl Mirror {
    /// Where a point is seen.
    pub fn reflect_point(&self, point: DVec3) -> DVec3 {
        point - 2.0 * (self.normal.dot(point) - self.offset) * self.normal
    }

    /// How a direction is seen.
    pub fn reflect_vector(&self, vector: DVec3) -> DVec3 {
        vector - 2.0 * self.normal.dot(vector) * self.normal
    }

    /// The reflection as a matrix.
    pub fn to_matrix(&self) -> DMat4 {
        let columns = DVec3::AXES.map(|axis| self.reflect_vector(axis).extend(0.0));
        let origin = self.reflect_point(DVec3::ZERO).extend(1.0);
        DMat4::from_cols(columns[0], columns[1], columns[2], origin)
    }

    /// This mirror once it is moved with a rigid `pose`.
    pub fn moved(&self, pose: &Pose) -> Self {
        let normal = pose.rotation * self.normal;
        Self { normal, offset: self.offset + normal.dot(pose.position) }
    }

    /// The plane's equation: (n, o) with n·p + o above 0 on the side that is seen, metres.
    pub fn plane(&self) -> DVec4 {
        self.normal.extend(-self.offset)
    }

    /// What reflecting at `self` and then at `next` amounts to: a rigid motion.
    pub fn then(&self, next: &Self) -> Pose {
        let columns = DVec3::AXES.map(|axis| next.reflect_vector(self.reflect_vector(axis)));
        Pose {
            position: next.reflect_point(self.reflect_point(DVec3::ZERO)),
            rotation: DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2])).normalize(),
            mirror: None,
        }
    }

    /// Checks that this is a plane.
    ///
    /// # Errors
    /// A normal that is not a unit vector, an offset that is no number.
    pub fn validate(&self) -> Result<()> {
        if self.offset.is_finite() && (self.normal.length() - 1.0).abs() < 1e-6 {
            return Ok(());
        }
        let Self { normal, offset } = self;
        Err(Error::input(format!(
            "mirror {normal}, {offset}: the normal must be a unit vector, the offset finite"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIRROR: Mirror = Mirror { normal: DVec3::new(0.6, 0.0, -0.8), offset: -3.0 };

    #[test]
    fn points_change_sides_and_the_plane_stays() {
        let p = DVec3::new(4.0, 1.0, 2.0);
        let seen = MIRROR.reflect_point(p);
        let side = |point: DVec3| MIRROR.plane().dot(point.extend(1.0));
        assert!((side(seen) + side(p)).abs() < 1e-12 && side(p).abs() > 1.0);
        assert!((MIRROR.reflect_point(seen) - p).length() < 1e-12);
        let on_it = (p + seen) / 2.0;
        assert!((MIRROR.reflect_point(on_it) - on_it).length() < 1e-12);
        assert!((MIRROR.to_matrix().transform_point3(p) - seen).length() < 1e-12);
        assert!((MIRROR.to_matrix().determinant() + 1.0).abs() < 1e-12);
    }

    #[test]
    fn two_reflections_are_a_rigid_motion() {
        let next = Mirror { normal: DVec3::new(0.0, 0.28, 0.96), offset: 2.0 };
        let p = DVec3::new(-2.0, 5.0, 1.0);
        let moved = MIRROR.then(&next).transform_point(p);
        assert!((moved - next.reflect_point(MIRROR.reflect_point(p))).length() < 1e-12);
        assert!((MIRROR.then(&MIRROR).transform_point(p) - p).length() < 1e-12);
    }

    #[test]
    fn what_is_no_plane_is_refused() {
        assert!(MIRROR.validate().is_ok());
        assert!(Mirror { normal: DVec3::ONE, ..MIRROR }.validate().is_err());
        assert!(Mirror { offset: f64::NAN, ..MIRROR }.validate().is_err());
    }
}
