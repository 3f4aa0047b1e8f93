//! Where a still is seen from.

use crate::geometry::Frustum;
use crate::views::{Pose, View, head_space};
use crate::{Error, Result};
use glam::{DMat3, DQuat, DVec3};

/// The name of the second camera.
pub const BIRDSEYE: &str = "birdseye";

/// The camera of a still.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Camera {
    /// One of the recording's views, by its position.
    View(usize),
    /// A camera of its own, which takes no part in the clustering: see [`birdseye`].
    BirdsEye,
}

impl Camera {
    /// The camera called `name`: one of `views`, or [`BIRDSEYE`]. `None` is the first view.
    ///
    /// # Errors
    /// Another name.
    pub fn by_name(name: Option<&str>, views: &[&str]) -> Result<Self> {
        let Some(name) = name else { return Ok(Self::View(0)) };
        if let Some(view) = views.iter().position(|known| *known == name) {
            return Ok(Self::View(view));
        }
        if name == BIRDSEYE {
            return Ok(Self::BirdsEye);
        }
        Err(Error::input(format!(
            "view: this recording has no view `{name}`: it has {}, and {BIRDSEYE} looks from above",
            views.join(", ")
        )))
    }

    /// Its name, given those of the views.
    pub fn name(self, views: &[String]) -> String {
        match self {
            Self::View(view) => views[view].clone(),
            Self::BirdsEye => BIRDSEYE.to_owned(),
        }
    }
}

/// The bird's eye stands this far beside, above and behind the head, in reaches.
const PLACE: DVec3 = DVec3::new(0.35, 0.8, 0.5);
/// It looks at the point this far ahead of the head, in reaches.
const TARGET: f64 = 0.35;
/// Its field of view along the longer side, radians.
const FOV: f64 = 1.2;

/// A camera behind and above the head of `views`, level with the horizon, that sees what lies up to `reach` metres
/// ahead of it.
///
/// # Errors
/// A resolution of zero.
pub fn birdseye(views: &[View], resolution: [u32; 2], reach: f64) -> Result<View> {
    let head = head_space(views);
    let far = views.iter().map(|view| view.frustum.far()).fold(reach, f64::max);
    let ahead = level(head.rotation * DVec3::NEG_Z);
    let right = ahead.cross(DVec3::Y);
    let position = head.position + reach * (PLACE.x * right + PLACE.y * DVec3::Y - PLACE.z * ahead);
    let target = head.position + reach * TARGET * ahead;
    let frustum = Frustum::from_fov(FOV, resolution, 0.01 * reach, 4.0 * far)?;
    Ok(View { pose: looking_at(position, target), frustum })
}

/// A reach is at least this part of the far distance.
const LEAST_REACH: f64 = 0.2;

/// How far ahead views that end at `far` see something: twice the distance that 19 of 20 pixels stay below. Pixels
/// that nothing was hit in (infinity) do not count.
pub fn reach(far: f64, distances: impl Iterator<Item = f32>) -> f64 {
    let mut hit: Vec<f32> = distances.filter(|distance| distance.is_finite()).collect();
    hit.sort_unstable_by(f32::total_cmp);
    let seen = hit.get(hit.len() * 19 / 20).map_or(far, |&distance| f64::from(distance));
    (2.0 * seen).clamp(LEAST_REACH * far, far)
}

/// A direction without its height; north for one that has nothing else.
fn level(direction: DVec3) -> DVec3 {
    DVec3::new(direction.x, 0.0, direction.z).try_normalize().unwrap_or(DVec3::NEG_Z)
}

fn looking_at(position: DVec3, target: DVec3) -> Pose {
    let back = (position - target).normalize();
    let right = DVec3::Y.cross(back).normalize();
    let rotation = DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back));
    Pose { position, rotation: rotation.normalize() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(yaw: f64, pitch: f64) -> View {
        View {
            pose: Pose {
                position: DVec3::new(3.0, 1.7, -20.0),
                rotation: DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch),
            },
            frustum: Frustum { x0: -1.0, x1: 1.0, y0: -0.6, y1: 0.6, z0: -100.0, z1: -0.4 },
        }
    }

    #[test]
    fn the_bird_sees_the_head_and_what_it_sees_upright() {
        for (yaw, pitch) in [(0.0, 0.0), (2.0, 0.3), (-1.0, -0.4), (0.5, std::f64::consts::FRAC_PI_2)] {
            let view = head(yaw, pitch);
            let bird = birdseye(&[view], [160, 90], 50.0).unwrap();
            bird.validate().unwrap();
            let ahead = view.pose.position + level(view.pose.rotation * DVec3::NEG_Z) * 50.0;
            for point in [view.pose.position, ahead] {
                let ndc = bird.clip_from_world().project_point3(point);
                assert!(ndc.truncate().abs().max_element() < 1.0, "{ndc} at yaw {yaw}, pitch {pitch}");
            }
            let right = bird.pose.rotation * DVec3::X;
            assert!(right.y.abs() < 1e-12 && (bird.pose.rotation * DVec3::Y).y > 0.0);
        }
    }

    #[test]
    fn the_reach_follows_what_is_seen_within_bounds() {
        let walls = |distance: f32| [f32::INFINITY; 50].into_iter().chain([distance; 100]);
        assert_eq!(reach(100.0, walls(30.0)), 60.0);
        assert_eq!(reach(100.0, walls(0.5)), 20.0);
        assert_eq!(reach(100.0, walls(90.0)), 100.0);
        assert_eq!(reach(100.0, std::iter::empty()), 100.0);
    }

    #[test]
    fn cameras_are_found_by_name() {
        let find = |name| Camera::by_name(name, &["left", "right"]);
        assert_eq!(find(Some("right")).unwrap(), Camera::View(1));
        assert_eq!(find(None).unwrap().name(&["left".into(), "right".into()]), "left");
        assert_eq!(find(Some("birdseye")).unwrap(), Camera::BirdsEye);
        assert!(find(Some("mono")).unwrap_err().to_string().contains("left, right"));
    }
}
