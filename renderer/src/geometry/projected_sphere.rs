//! The rectangle of tangents in which a sphere is seen (Mara and McGuire, 2D Polyhedral Bounds of a Clipped, Perspective-Projected
//! 3D Sphere, 2013; Tegelaers section 5.2.3).
//!
//! Along one axis the sphere is a disc, and of all its points from the near plane on those are seen farthest out at which a line
//! through the eye touches it. Where such a point lies before the near plane, or the eye in the sphere, so that there is none, the
//! outermost point is an end of the chord that the near plane cuts off:
//!
//! ```text
//!  near plane │    ___ touches                       │_
//!             │  /     \                         end ┤ \  touches nothing
//!  eye ·──────┼─│   ·   │──────> depth      eye ·  · │  │
//!             │  \ ___ /                             ┤_/
//! ```

use super::Plane;
use glam::{DVec2, DVec3};

/// Tangents between which a sphere is seen, of what it has from the near plane on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedSphere {
    /// Least tangent along x and y.
    pub low: DVec2,
    /// Greatest tangent along x and y.
    pub high: DVec2,
}

impl ProjectedSphere {
    /// Where a sphere is seen that has its `centre` in the space of an eye that looks down -Z, from the plane `near` metres away
    /// on, lengths in metres; `None` where all of it lies before that plane.
    pub fn new(centre: DVec3, radius: f64, near: f64) -> Option<Self> {
        let disc = |across| Disc { across, depth: -centre.z, radius, near };
        let (x, y) = (disc(centre.x), disc(centre.y));
        (x.depth + radius >= near).then(|| Self {
            low: DVec2::new(x.tangent(-1.0), y.tangent(-1.0)),
            high: DVec2::new(x.tangent(1.0), y.tangent(1.0)),
        })
    }
}

/// A sphere as seen along one axis, and where it is cut, metres.
#[derive(Debug, Clone, Copy)]
struct Disc {
    across: f64,
    depth: f64,
    radius: f64,
    near: f64,
}

impl Disc {
    /// The tangent of the outermost point that is seen, on the lower (-1) or the upper side (1).
    fn tangent(&self, side: f64) -> f64 {
        let Self { across, depth, radius, near } = *self;
        let square = across * across + depth * depth;
        let leg = (square - radius * radius).max(0.0).sqrt();
        // The point that is touched lies where the centre does, turned about the eye and drawn nearer; both in parts of what
        // the leg divided by the square of the centre's distance is.
        let touched = leg * depth - side * radius * across;
        if leg > 0.0 && leg * touched >= near * square {
            return (leg * across + side * radius * depth) / touched;
        }
        (across + side * self.half_chord()) / near
    }

    /// Half of what the near plane cuts off; 0 where it does not meet the disc.
    fn half_chord(&self) -> f64 {
        let Self { depth, radius, near, .. } = *self;
        (radius * radius - (near - depth).powi(2)).max(0.0).sqrt()
    }

    /// How far the disc, from the near plane on, reaches in the direction of a unit normal (across, along -depth), and what of
    /// that moving it by a length or changing its radius changes, at most.
    fn reach(&self, normal: DVec2) -> (f64, f64) {
        let Self { across, depth, radius, near } = *self;
        if depth - radius * normal.y >= near {
            return (normal.dot(DVec2::new(across, -depth)) + radius, 1.0);
        }
        let half_chord = self.half_chord();
        let end = DVec2::new(across + half_chord.copysign(normal.x), -near);
        (normal.dot(end), 1.0 + 2.0 * radius / half_chord)
    }

    /// The sign of how far it reaches, with what a move or another radius must come to, at least, to turn it. A move takes the disc
    /// along the near plane too: what it reaches from a plane on that is farther in, or out, stays.
    fn margin(&self, normal: DVec2) -> f64 {
        let (reach, change) = self.reach(normal);
        let sure = |shift: f64| {
            let (left, change) = Self { near: self.near + shift, ..*self }.reach(normal);
            if (left < 0.0) == (reach < 0.0) { (left / change).abs().min(shift.abs()) } else { 0.0 }
        };
        sure(reach).max(sure(reach / 2.0)).min((reach / change).abs()).copysign(reach)
    }
}

/// Margin of what a sphere has from the near plane on to the sides of a piece of a frustum, left, right, bottom and top: at least
/// 0 where its rectangle meets the piece's. Its size is how far the sphere or the sides would have to move for another answer, at
/// least, metres.
pub(super) fn rectangle_margin(sides: &[Plane], near: f64, centre: DVec3, radius: f64) -> f64 {
    let disc = |across| Disc { across, depth: -centre.z, radius, near };
    let discs = [disc(centre.x), disc(centre.y)];
    let margin = |(place, side): (usize, &Plane)| {
        let axis = place / 2;
        discs[axis].margin(DVec2::new(side.normal[axis], side.normal.z))
    };
    sides.iter().take(4).enumerate().map(margin).fold(radius - centre.z - near, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn seen(centre: [f64; 3], radius: f64, near: f64) -> ProjectedSphere {
        ProjectedSphere::new(DVec3::from(centre), radius, near).expect("some of it is seen")
    }

    #[test]
    fn a_sphere_ahead_is_seen_between_its_silhouettes() {
        let ahead = seen([0.0, 0.0, -10.0], 1.0, 0.4);
        assert!((ahead.high - DVec2::splat(1.0 / 99f64.sqrt())).length() < 1e-12);
        assert_eq!(ahead.low, -ahead.high);
        // A disc that touches the lines of 0 and 2 along x: its centre lies on their bisector.
        let bisector = (2f64.atan() / 2.0).tan();
        let aside = seen([bisector * 5.0, 0.0, -5.0], bisector * 5.0, 0.4);
        assert!(aside.low.x.abs() < 1e-12 && (aside.high.x - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_sphere_that_meets_the_near_plane_is_seen_from_there_on() {
        let around = seen([0.0, 0.5, 0.0], 2.0, 1.0);
        let half_chord = 3f64.sqrt();
        assert!((around.high - DVec2::new(half_chord, 0.5 + half_chord)).length() < 1e-12);
        assert!((around.low - DVec2::new(-half_chord, 0.5 - half_chord)).length() < 1e-12);
        // Beside the eye: the lower line touches ahead, the upper one behind.
        let beside = seen([10.0, 0.0, 1.0], 2.0, 0.5);
        let angle = |point: f64| point.atan().to_degrees();
        assert!((90.0 - angle(beside.low.x) - 5.766).abs() < 1e-2);
        assert!((beside.high.x - (10.0 + (4.0 - 1.5f64 * 1.5).sqrt()) / 0.5).abs() < 1e-12);
        assert_eq!(ProjectedSphere::new(DVec3::new(1.0, 0.0, 1.7), 2.0, 0.4), None);
        assert!(ProjectedSphere::new(DVec3::new(1.0, 0.0, 1.5), 2.0, 0.4).is_some());
    }

    /// Points of the sphere from the near plane on: inside, and all over its surface.
    fn points(centre: DVec3, radius: f64, near: f64) -> impl Iterator<Item = DVec3> {
        let golden = 2.399_963_229_728_653;
        (0..4000).filter_map(move |step| {
            let height = 1.0 - 2.0 * (f64::from(step % 2000) + 0.5) / 2000.0;
            let across = (1.0 - height * height).sqrt();
            let turn = golden * f64::from(step);
            let part = if step < 2000 { 1.0 } else { f64::from(step - 2000) / 2000.0 };
            let point = centre + radius * part * DVec3::new(across * turn.cos(), across * turn.sin(), height);
            (-point.z >= near).then_some(point)
        })
    }

    /// Spheres that lie all about an eye, small and large, many of which meet the near plane.
    fn spheres() -> impl Strategy<Value = (DVec3, f64, f64)> {
        let centre = [-20.0..20.0, -20.0..20.0, -30.0..5.0f64].prop_map(DVec3::from);
        (centre, (-2.0..1.6f64).prop_map(|power| 10f64.powf(power)), 0.05..2.0f64)
    }

    proptest! {
        #[test]
        fn every_point_is_seen_in_the_rectangle((centre, radius, near) in spheres()) {
            let rectangle = ProjectedSphere::new(centre, radius, near);
            for point in points(centre, radius, near) {
                let Some(ProjectedSphere { low, high }) = rectangle else {
                    return Err(TestCaseError::fail(format!("{point} is seen")));
                };
                let tangents = point.truncate() / -point.z;
                let room = 1e-9 * (1.0 + tangents.abs());
                let within = tangents.cmpge(low - room) & tangents.cmple(high + room);
                prop_assert!(within.all(), "{tangents} is not between {low} and {high}");
            }
        }

        /// Each side of the rectangle has a point of the sphere that is seen there.
        #[test]
        fn the_rectangle_is_tight((centre, radius, near) in spheres()) {
            let Some(ProjectedSphere { low, high }) = ProjectedSphere::new(centre, radius, near) else {
                return Ok(());
            };
            for axis in 0..2 {
                for tangent in [low[axis], high[axis]] {
                    // Along the line through the eye, the depth from the near plane on that is nearest to the centre.
                    let along = (centre[axis] * tangent - centre.z) / (1.0 + tangent * tangent);
                    let depth = along.max(near);
                    let off = (centre[axis] - tangent * depth).hypot(centre.z + depth);
                    prop_assert!((off / radius - 1.0).abs() < 1e-6, "{off} of {radius}");
                }
            }
        }

        /// The margin is at least 0 where the rectangles meet, and what moves the sphere by less does not change that.
        #[test]
        fn margins_say_whether_rectangles_meet(
            (centre, radius, near) in spheres(), low in -2.0..1.0f64, wide in 0.01..1.5f64, turn in 0..5usize,
        ) {
            let sides = Plane::through_apex([low, low + wide], [-0.3, 0.4]);
            let meets = |centre, radius| {
                ProjectedSphere::new(centre, radius, near).is_some_and(|seen| {
                    (seen.low.x <= low + wide && seen.high.x >= low) && (seen.low.y <= 0.4 && seen.high.y >= -0.3)
                })
            };
            let margin = rectangle_margin(&sides, near, centre, radius);
            if margin.abs() < 1e-9 {
                return Ok(());
            }
            prop_assert_eq!(margin >= 0.0, meets(centre, radius), "{}", margin);
            let part = 0.99 * margin.abs();
            let moved = [DVec3::X, -DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z][turn] * part;
            prop_assert_eq!(margin >= 0.0, meets(centre + moved, radius), "{} moved", margin);
            let less = (radius - part).max(1e-12);
            let other = if margin >= 0.0 { less } else { radius + part };
            prop_assert_eq!(margin >= 0.0, meets(centre, other), "{} by radius", margin);
        }
    }
}
