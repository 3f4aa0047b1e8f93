//! Cameras: a pose, maybe seen in a mirror, and an asymmetric frustum, both f64.

mod mirror;

pub use mirror::Mirror;

use crate::geometry::Frustum;
use crate::{Error, Result};
use glam::{DMat4, DQuat, DVec3};
use std::ops::Mul;

/// Where a camera (or head) is and how it is turned; with a mirror, a camera that sees the world in it.
///
/// Without a mirror this is a rigid transform. With one, a local point is turned and moved, then reflected, and left and
/// right change places: a camera at the pose sees, of the point where that ends, the mirror image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// World position, metres; of the camera itself, not of its mirror image.
    pub position: DVec3,
    /// World-from-local rotation, unit; of the camera itself, not of its mirror image.
    pub rotation: DQuat,
    /// What the world is reflected at.
    pub mirror: Option<Mirror>,
}

impl Pose {
    /// The pose at the origin, looking down -Z.
    pub const IDENTITY: Self = Self::from_position(DVec3::ZERO);

    /// Moved by `position` (metres), not turned.
    pub const fn from_position(position: DVec3) -> Self {
        Self { position, rotation: DQuat::IDENTITY, mirror: None }
    }

    /// Matrix that takes local to world space.
    pub fn to_matrix(&self) -> DMat4 {
        let rigid = DMat4::from_rotation_translation(self.rotation, self.position);
        self.mirror.map_or(rigid, |mirror| mirror.to_matrix() * rigid)
    }

    /// The pose that takes world to local space.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.conjugate();
        let rigid = Self { position: -(rotation * self.position), rotation, mirror: None };
        Self { mirror: self.mirror.map(|mirror| mirror.moved(&rigid)), ..rigid }
    }

    /// A local point in the world.
    pub fn transform_point(&self, local: DVec3) -> DVec3 {
        let point = self.rotation * local + self.position;
        self.mirror.map_or(point, |mirror| mirror.reflect_point(point))
    }

    /// A local direction in the world.
    pub fn transform_vector(&self, local: DVec3) -> DVec3 {
        let vector = self.rotation * local;
        self.mirror.map_or(vector, |mirror| mirror.reflect_vector(vector))
    }

    /// This pose in a world whose origin lies at `origin` (metres) of the world it is in.
    pub fn relative_to(&self, origin: DVec3) -> Self {
        let moved = Self::from_position(-origin);
        Self {
            position: self.position - origin,
            rotation: self.rotation,
            mirror: self.mirror.map(|mirror| mirror.moved(&moved)),
        }
    }

    /// A world point in this pose's own space.
    pub fn inverse_transform_point(&self, world: DVec3) -> DVec3 {
        let point = self.mirror.map_or(world, |mirror| mirror.reflect_point(world));
        self.rotation.conjugate() * (point - self.position)
    }

    /// Checks that position and rotation are numbers, the rotation is a unit quaternion and a mirror is a plane.
    ///
    /// # Errors
    /// Anything else.
    pub fn validate(&self) -> Result<()> {
        let unit = (self.rotation.length_squared() - 1.0).abs() < 1e-6;
        if self.position.is_finite() && unit {
            return self.mirror.as_ref().map_or(Ok(()), Mirror::validate);
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
        let outer = Self { mirror: None, ..self };
        let rigid = Self {
            position: outer.transform_point(inner.position),
            rotation: (self.rotation * inner.rotation).normalize(),
            mirror: None,
        };
        match (inner.mirror.map(|mirror| mirror.moved(&outer)), self.mirror) {
            (Some(first), Some(second)) => first.then(&second) * rigid,
            (first, second) => Self { mirror: first.or(second), ..rigid },
        }
    }
}

/// One rendering camera. It looks down its -Z; +Y is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World from view. With a mirror, what lies behind that is not seen.
    pub pose: Pose,
    /// Frustum of the view in view space.
    pub frustum: Frustum,
}

impl View {
    /// Place that the view sees from: its own, or where a mirror shows that; world space, metres.
    pub fn eye(&self) -> DVec3 {
        self.pose.transform_point(DVec3::ZERO)
    }

    /// Matrix that takes view to world space.
    pub fn world_from_view(&self) -> DMat4 {
        self.pose.to_matrix()
    }

    /// Matrix that takes world to view space.
    pub fn view_from_world(&self) -> DMat4 {
        self.pose.inverse().to_matrix()
    }

    /// Width over height of what a pixel of `resolution` shows, in the plane ahead; 1 for square pixels.
    pub fn pixel_aspect(&self, [width, height]: [u32; 2]) -> f64 {
        let size = self.frustum.size();
        (size.x / f64::from(width)) / (size.y / f64::from(height))
    }

    /// Clip from view, see [`Frustum::clip_from_view`].
    pub fn clip_from_view(&self) -> DMat4 {
        self.frustum.clip_from_view()
    }

    /// Matrix that takes world to clip space, with reversed depth.
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_view() * self.view_from_world()
    }

    /// This view in a world whose origin lies at `origin` (metres) of the world it is in.
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

/// What is known of a recording's views before any frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ViewSet {
    /// How many views there are.
    pub count: usize,
    /// Whether some see the world in a mirror.
    pub mirrors: bool,
}

/// The head space of some views: their mean position and orientation, world from head.
///
/// Orientations are averaged as quaternions of one sign (all on the first view's side), which is exact for
/// two and close for the small angles between eyes. No views: the world's own space. Of views in mirrors the cameras
/// themselves count; where all see the same mirror, so does the head.
pub fn head_space(views: &[View]) -> Pose {
    let Some(first) = views.first() else { return Pose::IDENTITY };
    let count = views.len() as f64;
    let position = views.iter().map(|view| view.pose.position).sum::<DVec3>() / count;
    // Every term has a part along the first view's quaternion, so that the sum cannot vanish.
    let sum = views.iter().fold(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), |sum, view| {
        let rotation = view.pose.rotation;
        if rotation.dot(first.pose.rotation) < 0.0 { sum - rotation } else { sum + rotation }
    });
    Pose { position, rotation: sum.normalize(), mirror: common_mirror(views).flatten() }
}

/// The mirror that all views see, or that they see none; `None` where they differ, or there are no views.
pub fn common_mirror(views: &[View]) -> Option<Option<Mirror>> {
    let first = views.first()?.pose.mirror;
    views.iter().all(|view| view.pose.mirror == first).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const FRUSTUM: Frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -10.0, z1: -1.0 };

    fn pose(x: f64, yaw: f64) -> Pose {
        Pose { rotation: DQuat::from_rotation_y(yaw), ..Pose::from_position(DVec3::new(x, 2.0, -3.0)) }
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
    fn poses_with_mirrors_compose_and_invert_as_their_matrices() {
        let mirror = |x: f64, offset: f64| Mirror { normal: DVec3::new(x, 0.6, 0.8).normalize(), offset };
        let seen = |pose: Pose, x: f64, offset: f64| Pose { mirror: Some(mirror(x, offset)), ..pose };
        let plain = [pose(1.0, 0.3), pose(-4.0, 2.0)];
        let poses = [plain[0], plain[1], seen(plain[0], 0.2, 3.0), seen(plain[1], -0.7, -1.0)];
        let p = DVec3::new(0.5, -0.25, 8.0);
        for a in poses {
            a.validate().unwrap();
            assert!((a.transform_point(p) - a.to_matrix().transform_point3(p)).length() < 1e-12);
            assert!((a.transform_vector(p) - a.to_matrix().transform_vector3(p)).length() < 1e-12);
            assert!((a.inverse_transform_point(a.transform_point(p)) - p).length() < 1e-12);
            assert!((a.inverse().transform_point(a.transform_point(p)) - p).length() < 1e-12);
            for b in poses {
                let product = a.to_matrix() * b.to_matrix();
                assert!((a * b).to_matrix().abs_diff_eq(product, 1e-12));
            }
        }
    }

    #[test]
    fn a_mirror_shows_what_is_behind_the_camera_with_left_and_right_exchanged() {
        // A wall three metres ahead, at z = -6; the camera looks at it from z = -3.
        let mirror = Mirror { normal: DVec3::Z, offset: -6.0 };
        let camera = view(Pose { mirror: Some(mirror), ..Pose::from_position(DVec3::new(0.0, 0.0, -3.0)) });
        assert_eq!(camera.eye(), DVec3::new(0.0, 0.0, -9.0));
        let behind = camera.clip_from_world().project_point3(DVec3::new(0.5, 0.25, 0.0));
        assert!(behind.x > 0.0 && behind.y > 0.0 && (0.0..1.0).contains(&behind.z), "{behind}");
        let plane = mirror.plane();
        assert!(plane.dot(DVec3::ZERO.extend(1.0)) > 0.0 && plane.dot(DVec3::NEG_Z.extend(0.1)) < 0.0);
    }

    #[test]
    fn the_head_of_views_in_one_mirror_is_in_it_too() {
        let seen = |pose: Pose, offset: f64| {
            view(Pose { mirror: Some(Mirror { normal: DVec3::Z, offset }), ..pose })
        };
        let (left, right) = (pose(-1.0, 0.2), pose(3.0, 0.2));
        let head = |views: &[View]| head_space(views).mirror;
        assert_eq!(head(&[seen(left, -9.0), seen(right, -9.0)]), seen(left, -9.0).pose.mirror);
        assert_eq!(head(&[view(left), seen(right, -9.0)]), None);
        assert_eq!(head(&[seen(left, -8.0), seen(right, -9.0)]), None);
        assert_eq!(common_mirror(&[view(left), view(right)]), Some(None));
        assert_eq!(common_mirror(&[view(left), seen(left, 1.0)]), None);
    }

    #[test]
    fn a_camera_looks_down_its_minus_z() {
        let turned =
            view(Pose { rotation: DQuat::from_rotation_y(FRAC_PI_2), ..Pose::from_position(DVec3::X) });
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
