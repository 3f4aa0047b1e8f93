//! Where a still is seen from.

use crate::geometry::Frustum;
use crate::geometry::views::{Pose, View, head_space};
use crate::recording::MAX_COORDINATE;
use crate::{Error, Result};
use glam::{DMat3, DQuat, DVec3};

/// The name of the camera that looks from above.
pub const BIRDSEYE: &str = "birdseye";

/// The name of a camera that was placed by hand.
const EYE: &str = "eye";

/// What a still is asked to be seen from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viewpoint<'a> {
    /// A camera by its name; `None` is the recording's first view.
    Named(Option<&'a str>),
    /// A camera at any place.
    Placed(Placed),
}

/// A camera placed by hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Place of the camera, world space, metres.
    pub eye: DVec3,
    /// Place that the camera looks at, world space, metres.
    pub target: DVec3,
    /// Field of view along the longer side, radians.
    pub fov: f64,
}

impl Placed {
    /// A camera at `eye` that looks at `target`; without a `fov`, with the bird's eye's field of view.
    ///
    /// # Errors
    /// A place that is no number or too far from the origin, a target where the eye is, no field of view.
    pub fn new(eye: [f64; 3], target: [f64; 3], fov: Option<f64>) -> Result<Self> {
        let fov = fov.unwrap_or(FOV);
        let [eye, target] = [("eye", eye), ("target", target)].map(|(name, place)| {
            let within = place.iter().all(|value| value.abs() <= MAX_COORDINATE);
            let [x, y, z] = place;
            within.then_some(DVec3::from_array(place)).ok_or_else(|| {
                Error::input(format!("{name}: {x},{y},{z} is not within +-{MAX_COORDINATE} m of the origin"))
            })
        });
        let (eye, target) = (eye?, target?);
        let least = LEAST_DISTANCE * eye.abs().max(target.abs()).max_element().max(1.0);
        if eye.distance(target) < least {
            return Err(Error::input(
                "target: it is where the eye is, so that the camera has no direction: move one of them",
            ));
        }
        if !(fov > 0.0 && fov < std::f64::consts::PI) {
            return Err(Error::input(format!(
                "fov: {fov} is no field of view: give radians above 0 and below pi, such as 1.2 for 69 degrees"
            )));
        }
        Ok(Self { eye, target, fov })
    }

    /// The camera over an image of `resolution`. Like the `views` it begins to see at their near distance; it sees as
    /// far as they do, and at least to `farthest`, the end of the scene, metres.
    ///
    /// # Errors
    /// A resolution of zero.
    pub fn view(&self, views: &[View], resolution: [u32; 2], farthest: f64) -> Result<View> {
        let near = views.iter().map(|view| view.frustum.near()).fold(f64::INFINITY, f64::min);
        let far = views.iter().map(|view| view.frustum.far()).fold(farthest, f64::max);
        let frustum = Frustum::from_fov(self.fov, resolution, near, far)?;
        Ok(View { pose: looking_at(self.eye, self.target), frustum })
    }
}

/// Eye and target are apart by at least this part of their largest coordinate, so that single precision can tell them
/// apart too.
const LEAST_DISTANCE: f64 = 1e-6;

/// The camera of a still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Camera {
    /// One of the recording's views, by its position.
    View(usize),
    /// A camera of its own, which takes no part in the clustering: see [`birdseye`].
    BirdsEye,
    /// Another such, wherever it is wanted.
    Placed(Placed),
}

impl Camera {
    /// The camera at `viewpoint`, given the names of the recording's `views`.
    ///
    /// # Errors
    /// A name that is neither one of `views` nor [`BIRDSEYE`].
    pub fn new(viewpoint: Viewpoint, views: &[&str]) -> Result<Self> {
        let name = match viewpoint {
            Viewpoint::Named(Some(name)) => name,
            Viewpoint::Named(None) => return Ok(Self::View(0)),
            Viewpoint::Placed(placed) => return Ok(Self::Placed(placed)),
        };
        if let Some(view) = views.iter().position(|known| *known == name) {
            return Ok(Self::View(view));
        }
        if name == BIRDSEYE {
            return Ok(Self::BirdsEye);
        }
        Err(Error::input(format!(
            "view: this recording has no view `{name}`: it has {}, and {BIRDSEYE} looks from above; --eye and \
             --target place a camera anywhere",
            views.join(", ")
        )))
    }

    /// Name of the camera, given those of the views.
    pub fn name(self, views: &[String]) -> String {
        match self {
            Self::View(view) => views[view].clone(),
            Self::BirdsEye => BIRDSEYE.to_owned(),
            Self::Placed(_) => EYE.to_owned(),
        }
    }
}

/// The bird's eye stands this far beside, above and behind the head, in reaches.
const PLACE: DVec3 = DVec3::new(0.35, 0.8, 0.5);
/// The camera from above looks at the point this far ahead of the head, in reaches.
const TARGET: f64 = 0.35;
/// Field of view of the camera from above along the longer side, radians.
const FOV: f64 = 1.2;

/// A camera behind and above the head of `views`, level with the horizon, that sees what lies up to `reach` metres
/// ahead of it.
///
/// # Errors
/// A resolution of zero.
pub fn birdseye(views: &[View], resolution: [u32; 2], reach: f64) -> Result<View> {
    let head = head_space(views);
    let far = views.iter().map(|view| view.frustum.far()).fold(reach, f64::max);
    let ahead = level(head.transform_vector(DVec3::NEG_Z));
    let right = ahead.cross(DVec3::Y);
    let head = head.transform_point(DVec3::ZERO);
    let position = head + reach * (PLACE.x * right + PLACE.y * DVec3::Y - PLACE.z * ahead);
    let target = head + reach * TARGET * ahead;
    let frustum = Frustum::from_fov(FOV, resolution, 0.01 * reach, 4.0 * far)?;
    Ok(View { pose: looking_at(position, target), frustum })
}

/// Sine of the angle to the vertical below which a camera looks straight up or down.
const UPRIGHT: f64 = 1e-9;

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

/// At `position`, looking at `target`, upright; where that is straight above or below, the top of the image is north (-Z)
/// from above and south from below.
fn looking_at(position: DVec3, target: DVec3) -> Pose {
    let back = (position - target).normalize();
    let right = DVec3::Y.cross(back);
    let right = if right.length() > UPRIGHT { right.normalize() } else { DVec3::X };
    // Exactly at right angles, where the fallback's right was not.
    let right = back.cross(right).normalize().cross(back);
    let rotation = DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back));
    Pose { position, rotation: rotation.normalize(), mirror: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(yaw: f64, pitch: f64) -> View {
        View {
            pose: Pose {
                position: DVec3::new(3.0, 1.7, -20.0),
                rotation: DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch),
                mirror: None,
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
        let find = |name| Camera::new(Viewpoint::Named(name), &["left", "right"]);
        assert_eq!(find(Some("right")).unwrap(), Camera::View(1));
        assert_eq!(find(None).unwrap().name(&["left".into(), "right".into()]), "left");
        assert_eq!(find(Some("birdseye")).unwrap(), Camera::BirdsEye);
        assert!(find(Some("mono")).unwrap_err().to_string().contains("left, right"));
    }

    #[test]
    fn a_placed_camera_has_its_target_in_the_middle_and_is_upright() {
        let eye = [3.0, 10.0, -4.0];
        let straight = [[3.0, 0.0, -4.0], [3.0, 90.0, -4.0]];
        for target in [[0.0, 1.0, -20.0], [40.0, 10.0, -4.0], [3.0, 9.0, -3.9]].into_iter().chain(straight) {
            let view =
                Placed::new(eye, target, None).unwrap().view(&[head(0.0, 0.0)], [90, 60], 80.0).unwrap();
            view.validate().unwrap();
            let ndc = view.clip_from_world().project_point3(target.into());
            assert!(ndc.truncate().length() < 1e-12, "{ndc}");
            assert!((view.pose.rotation * DVec3::X).y.abs() < 1e-12);
            let up = view.pose.rotation * DVec3::Y;
            assert!(up.y > 0.0 || straight.contains(&target) && up.y > -1e-12, "{up}");
        }
        let north = looking_at(DVec3::Y, DVec3::ZERO).rotation * DVec3::Y;
        assert!((north - DVec3::NEG_Z).length() < 1e-12, "{north}");
    }

    #[test]
    fn a_placed_camera_sees_to_the_end_of_the_scene() {
        let placed = Placed::new([0.0, 0.0, 300.0], [0.0; 3], Some(0.5)).unwrap();
        let frustum = placed.view(&[head(0.0, 0.0)], [90, 60], 380.0).unwrap().frustum;
        assert_eq!((frustum.near(), frustum.far()), (0.4, 380.0));
        assert!((frustum.x1 - 0.25f64.tan()).abs() < 1e-12);
        let near = Placed::new([0.0; 3], [1.0, 0.0, 0.0], None).unwrap();
        assert_eq!(near.view(&[head(0.0, 0.0)], [90, 60], 80.0).unwrap().frustum.far(), 100.0);
    }

    #[test]
    fn a_camera_without_place_direction_or_field_of_view_is_refused() {
        let refused = |eye, target, fov| Placed::new(eye, target, fov).unwrap_err().to_string();
        assert!(refused([1.0; 3], [1.0; 3], None).starts_with("target: it is where the eye is"));
        assert!(refused([1e6; 3], [1e6 - 0.1; 3], None).starts_with("target: it is where the eye is"));
        for bad in [f64::NAN, f64::INFINITY, 1.1e6] {
            assert!(refused([0.0, bad, 0.0], [1.0; 3], None).starts_with("eye: "));
            assert!(refused([0.0; 3], [bad, 1.0, 1.0], None).starts_with("target: "));
        }
        for bad in [0.0, -1.0, f64::NAN, 60.0, std::f64::consts::PI] {
            assert!(refused([0.0; 3], [1.0; 3], Some(bad)).contains("radians"));
        }
    }
}
