//! One frustum around the frusta of any number of views (Gelderen section 4.1, for canted eyes as well).

use super::Frustum;
use crate::geometry::views::{Pose, View};
use crate::{Error, Result};
use glam::{DVec2, DVec3};

/// An enclosing frustum must stay below this angle along both axes, degrees.
const WIDEST_DEGREES: f64 = 170.0;

/// The frustum that encloses some views.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosing {
    /// Position of the apex on the head's Z axis, metres; positive is behind the head.
    pub apex: f64,
    /// The frustum as seen from the apex, turned like the head.
    pub frustum: Frustum,
}

/// Encloses all `views`, at least one, by a frustum whose apex lies on the Z axis of `head` (world from head).
///
/// In the XZ and in the YZ plane, every line through a far and a near corner that leaves all corners on one
/// side is a candidate for a side plane; where the candidates meet the Z axis, the hindmost point is the
/// apex. Views far apart may have no such line, or one that meets the axis amid them: they are seen from a
/// distance. Tangents and depths are those of the corners.
///
/// # Errors
/// A view that spans 170 degrees or more by itself, or views that differ too much in direction: no frustum below 170 degrees
/// holds them.
pub fn enclosing(head: &Pose, views: &[View]) -> Result<Enclosing> {
    let mut angles = views.iter().map(|view| widest_angle(&view.frustum)).enumerate();
    if let Some((view, degrees)) = angles.find(|(_, angle)| *angle >= WIDEST_DEGREES) {
        return Err(Error::input(format!(
            "view {view} spans {degrees:.2} degrees, and no enclosing frustum spans {WIDEST_DEGREES} or more; use a narrower \
             field of view, or Indi (such as indi-persp-64) or an Ortho method (such as encl-ortho-4)"
        )));
    }
    let corners = Corners::new(head, views);
    if !corners.agree_in_direction() {
        return Err(Error::input(format!(
            "the views differ too much in direction: no frustum below {WIDEST_DEGREES} degrees encloses \
             them; use an Ortho method (such as encl-ortho-4), which needs none"
        )));
    }
    let tight = corners.tight_apex().map(|apex| corners.seen_from(apex)).filter(is_narrow_enough);
    Ok(tight.unwrap_or_else(|| corners.seen_from(corners.distant_apex())))
}

/// The angle that a frustum spans along the axis where it is wider, degrees.
fn widest_angle(frustum: &Frustum) -> f64 {
    let Frustum { x0, x1, y0, y1, .. } = frustum;
    (x1.atan() - x0.atan()).max(y1.atan() - y0.atan()).to_degrees()
}

/// The corners of all views, head space.
struct Corners {
    near: Vec<DVec3>,
    far: Vec<DVec3>,
}

impl Corners {
    fn new(head: &Pose, views: &[View]) -> Self {
        let all = |corners: fn(&Frustum) -> [DVec3; 4]| {
            let in_head = |view: &View| {
                let head_from_view = head.inverse() * view.pose;
                corners(&view.frustum).map(|corner| head_from_view.transform_point(corner))
            };
            views.iter().flat_map(in_head).collect()
        };
        Self { near: all(Frustum::near_corners), far: all(Frustum::far_corners) }
    }

    fn iter(&self) -> impl Iterator<Item = DVec3> {
        self.near.iter().chain(&self.far).copied()
    }

    /// Whether the edges of all frusta, near corner to far corner, point forward within the widest angle.
    fn agree_in_direction(&self) -> bool {
        let edges = || self.near.iter().zip(&self.far).map(|(near, far)| *far - *near);
        // Off -Z; beyond a right angle for an edge that points backwards.
        let spread = |sideways: fn(DVec3) -> f64| {
            let angles = || edges().map(|edge| sideways(edge).atan2(-edge.z));
            highest(angles()) + highest(angles().map(|angle| -angle))
        };
        let widest = WIDEST_DEGREES.to_radians();
        spread(|edge| edge.x) < widest && spread(|edge| edge.y) < widest
    }

    /// The hindmost candidate in both planes that has every corner in front of it.
    fn tight_apex(&self) -> Option<f64> {
        let nearest = highest(self.iter().map(|corner| corner.z));
        let in_xz = candidates(self, |corner| DVec2::new(corner.x, corner.z));
        let in_yz = candidates(self, |corner| DVec2::new(corner.y, corner.z));
        in_xz.into_iter().chain(in_yz).filter(|&apex| apex > nearest).reduce(f64::max)
    }

    /// As far behind all corners as they reach sideways: no tangent exceeds 1.
    fn distant_apex(&self) -> f64 {
        let nearest = highest(self.iter().map(|corner| corner.z));
        nearest + highest(self.iter().map(|corner| corner.x.abs().max(corner.y.abs())))
    }

    fn seen_from(&self, apex: f64) -> Enclosing {
        let seen = |corner: DVec3| DVec3::new(corner.x, corner.y, corner.z - apex);
        let projected = |corner: DVec3| (seen(corner) / (apex - corner.z)).with_z(seen(corner).z);
        let (low, high) = self
            .iter()
            .map(projected)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let frustum = Frustum { x0: low.x, x1: high.x, y0: low.y, y1: high.y, z0: low.z, z1: high.z };
        Enclosing { apex, frustum }
    }
}

fn highest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::NEG_INFINITY, f64::max)
}

/// Where the lines that touch all corners from outside meet the Z axis, in the plane that `flat` picks.
fn candidates(corners: &Corners, flat: impl Fn(DVec3) -> DVec2) -> Vec<f64> {
    let all: Vec<DVec2> = corners.iter().map(&flat).collect();
    let mut meetings = Vec::new();
    for near in corners.near.iter().copied().map(&flat) {
        for far in corners.far.iter().copied().map(&flat) {
            let along = far - near;
            let meets_axis = along.x != 0.0;
            if meets_axis && all_on_one_side(&all, near, along) {
                meetings.push(near.y - along.y * near.x / along.x);
            }
        }
    }
    meetings
}

/// Whether no two points lie on different sides of the line; points on it, up to rounding, are on both.
fn all_on_one_side(points: &[DVec2], start: DVec2, along: DVec2) -> bool {
    let slack = 1e-9 * along.length_squared();
    let sides = || points.iter().map(|&point| along.perp_dot(point - start));
    sides().all(|side| side <= slack) || sides().all(|side| side >= -slack)
}

fn is_narrow_enough(enclosing: &Enclosing) -> bool {
    widest_angle(&enclosing.frustum) < WIDEST_DEGREES
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::head_space;
    use glam::DQuat;
    use std::f64::consts::PI;

    const EYE: Frustum = Frustum { x0: -1.2, x1: 0.9, y0: -0.7, y1: 1.1, z0: -100.0, z1: -0.4 };

    fn view(x: f64, yaw: f64) -> View {
        let rotation = DQuat::from_rotation_y(yaw);
        View { pose: Pose { position: DVec3::new(x, 1.0, 2.0), rotation, mirror: None }, frustum: EYE }
    }

    #[test]
    fn one_view_is_enclosed_by_its_own_frustum() {
        let alone = view(3.0, 0.7);
        let Enclosing { apex, frustum } = enclosing(&alone.pose, &[alone]).unwrap();
        assert!(apex.abs() < 1e-9);
        for (found, own) in frustum.corners().into_iter().zip(EYE.corners()) {
            assert!((found - own).length() < 1e-7);
        }
    }

    #[test]
    fn eyes_turned_outwards_need_more_than_eyes_that_agree() {
        let width = |cant: f64| {
            let views = [view(-0.03, cant), view(0.03, -cant)];
            let Frustum { x0, x1, .. } = enclosing(&head_space(&views), &views).unwrap().frustum;
            x1.atan() - x0.atan()
        };
        assert!((width(0.2) - width(0.0) - 0.4).abs() < 0.01, "each side turns by the cant");
    }

    #[test]
    fn views_that_look_apart_are_refused_and_ortho_is_named() {
        for yaw in [PI, 2.0, 1.7] {
            let views = [view(0.0, 0.0), view(0.0, yaw)];
            let message = enclosing(&head_space(&views), &views).unwrap_err().to_string();
            assert!(message.contains("Ortho") && message.contains("170"), "{message}");
        }
    }

    #[test]
    fn a_wide_view_is_not_blamed_on_its_direction() {
        let wide = Frustum { x0: -12.0, x1: 12.0, ..EYE };
        for views in [
            vec![View { frustum: wide, ..view(0.0, 0.3) }],
            vec![view(0.0, 0.0), View { frustum: wide, ..view(0.1, 0.0) }],
        ] {
            let message = enclosing(&head_space(&views), &views).unwrap_err().to_string();
            let number = views.len() - 1;
            assert!(message.starts_with(&format!("view {number} spans 170.47 degrees")), "{message}");
            assert!(!message.contains("direction") && message.contains("ndi"), "{message}");
        }
        let narrow = View { frustum: Frustum { x0: -11.0, x1: 11.0, ..EYE }, ..view(0.0, 0.3) };
        assert!(enclosing(&narrow.pose, &[narrow]).is_ok());
    }

    #[test]
    fn views_whose_sides_converge_are_seen_from_a_distance() {
        let frustum = Frustum { x0: -0.3, x1: 0.3, y0: -0.3, y1: 0.3, z0: -20.0, z1: -5.0 };
        let inwards = |side: f64| {
            let rotation = DQuat::from_rotation_y(0.6 * side) * DQuat::from_rotation_x(-0.6 * side);
            View {
                pose: Pose { position: DVec3::new(20.0, 20.0, 0.0) * side, rotation, mirror: None },
                frustum,
            }
        };
        let Enclosing { apex, frustum } = enclosing(&Pose::IDENTITY, &[inwards(-1.0), inwards(1.0)]).unwrap();
        assert!(apex > 0.0 && frustum.validate().is_ok(), "{apex} {frustum:?}");
        assert!(frustum.x0 >= -1.0 && frustum.x1 <= 1.0 && frustum.y0 >= -1.0 && frustum.y1 <= 1.0);
    }
}
