//! Cameras: a rigid pose and an asymmetric frustum, both f64.

use crate::geometry::Frustum;
use crate::{Error, Result};
use glam::{DMat4, DQuat, DVec3};
use std::ops::Mul;

/// A rigid transform: where a camera (or head) is and how it is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// World position, metres.
    pub position: DVec3,
    /// World-from-local rotation, unit.
    pub rotation: DQuat,
}

impl Pose {
    /// At the origin, looking down -Z.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// Moved by `position` (metres), not turned.
    pub const fn from_position(position: DVec3) -> Self {
        Self { position, rotation: DQuat::IDENTITY }
    }

    /// World from local.
    pub fn to_matrix(&self) -> DMat4 {
        DMat4::from_rotation_translation(self.rotation, self.position)
    }

    /// Local from world.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.conjugate();
        Self { position: -(rotation * self.position), rotation }
    }

    /// A local point in the world.
    pub fn transform_point(&self, local: DVec3) -> DVec3 {
        self.rotation * local + self.position
    }

    /// The same pose in a world whose origin lies at `origin` (metres) of this one.
    pub fn relative_to(&self, origin: DVec3) -> Self {
        Self { position: self.position - origin, rotation: self.rotation }
    }

    /// A world point in this pose's own space.
    pub fn inverse_transform_point(&self, world: DVec3) -> DVec3 {
        self.rotation.conjugate() * (world - self.position)
    }

    /// Checks that position and rotation are numbers and the rotation is a unit quaternion.
    ///
    /// # Errors
    /// Anything else.
    pub fn validate(&self) -> Result<()> {
        let unit = (self.rotation.length_squared() - 1.0).abs() < 1e-6;
        if self.position.is_finite() && unit {
            return Ok(());
        }
        Err(Error::input(format!(
            "pose at {} turned by {}: the position must be finite and the rotation a unit quaternion",
            self.position, self.rotation
        )))
    }
}

/// `a_from_b * b_from_c` is `a_from_c`.
impl Mul for Pose {
    type Output = Self;

    fn mul(self, inner: Self) -> Self {
        Self {
            position: self.transform_point(inner.position),
            rotation: (self.rotation * inner.rotation).normalize(),
        }
    }
}

/// One rendering camera. It looks down its -Z; +Y is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World from view.
    pub pose: Pose,
    /// View-space frustum.
    pub frustum: Frustum,
}

impl View {
    /// World from view.
    pub fn world_from_view(&self) -> DMat4 {
        self.pose.to_matrix()
    }

    /// View from world.
    pub fn view_from_world(&self) -> DMat4 {
        self.pose.inverse().to_matrix()
    }

    /// Clip from view, see [`Frustum::clip_from_view`].
    pub fn clip_from_view(&self) -> DMat4 {
        self.frustum.clip_from_view()
    }

    /// Clip from world.
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_view() * self.view_from_world()
    }

    /// The same view in a world whose origin lies at `origin` (metres) of this one.
    pub fn relative_to(&self, origin: DVec3) -> Self {
        Self { pose: self.pose.relative_to(origin), frustum: self.frustum }
    }

    /// Checks pose and frustum.
    ///
    /// # Errors
    /// What [`Pose::validate`] and [`Frustum::validate`] refuse.
    pub fn validate(&self) -> Result<()> {
        self.pose.validate()?;
        self.frustum.validate()
    }
}

/// The head space of some views: their mean position and orientation, world from head.
///
/// Orientations are averaged as quaternions of one sign (all on the first view's side), which is exact for
/// two and close for the small angles between eyes. No views: the world's own space.
pub fn head_space(views: &[View]) -> Pose {
    let Some(first) = views.first() else { return Pose::IDENTITY };
    let count = views.len() as f64;
    let position = views.iter().map(|view| view.pose.position).sum::<DVec3>() / count;
    // Every term has a part along the first view's quaternion, so that the sum cannot vanish.
    let sum = views.iter().fold(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), |sum, view| {
        let rotation = view.pose.rotation;
        if rotation.dot(first.pose.rotation) < 0.0 { sum - rotation } else { sum + rotation }
    });
    Pose { position, rotation: sum.normalize() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const FRUSTUM: Frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -10.0, z1: -1.0 };

    fn pose(x: f64, yaw: f64) -> Pose {
        Pose { position: DVec3::new(x, 2.0, -3.0), rotation: DQuat::from_rotation_y(yaw) }
    }

    fn view(pose: Pose) -> View {
        View { pose, frustum: FRUSTUM }
    }

    #[test]
    fn poses_compose_and_invert_as_their_matrices() {
        let (a, b) = (pose(1.0, 0.3), pose(-4.0, 2.0));
        let p = DVec3::new(0.5, -0.25, 8.0);
        let product = a.to_matrix() * b.to_matrix();
        assert!((a * b).to_matrix().abs_diff_eq(product, 1e-12));
        assert!((a * a.inverse()).to_matrix().abs_diff_eq(DMat4::IDENTITY, 1e-12));
        assert!((a.transform_point(p) - a.to_matrix().transform_point3(p)).length() < 1e-12);
        assert!((a.inverse_transform_point(a.transform_point(p)) - p).length() < 1e-12);
    }

    #[test]
    fn a_camera_looks_down_its_minus_z() {
        let turned = view(Pose { position: DVec3::X, rotation: DQuat::from_rotation_y(FRAC_PI_2) });
        let ahead = turned.clip_from_world().project_point3(DVec3::new(1.0 - 5.0, 0.0, 0.0));
        assert!(ahead.truncate().length() < 1e-12 && ahead.z > 0.0 && ahead.z < 1.0);
        let above = turned.clip_from_world().project_point3(DVec3::new(-4.0, 1.0, 0.0));
        assert!(above.y > 0.0);
    }

    #[test]
    fn the_head_is_between_the_eyes_whatever_the_sign_of_their_quaternions() {
        let (left, mut right) = (pose(-1.0, 0.2), pose(3.0, -0.4));
        right.rotation = -right.rotation;
        let head = head_space(&[view(left), view(right)]);
        assert!((head.position - DVec3::new(1.0, 2.0, -3.0)).length() < 1e-12);
        assert!(head.rotation.abs_diff_eq(DQuat::from_rotation_y(-0.1), 1e-12));
        assert_eq!(head_space(&[]), Pose::IDENTITY);
    }

    #[test]
    fn a_broken_pose_is_refused() {
        assert!(view(pose(0.0, 1.0)).validate().is_ok());
        assert!(pose(f64::NAN, 0.0).validate().is_err());
        assert!(pose(0.0, f64::NAN).validate().is_err());
        assert!(
            Pose { rotation: DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0), ..Pose::IDENTITY }.validate().is_err()
        );
    }
}
