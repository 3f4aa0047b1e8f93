//! The frame's origin: what positions on the device are relative to, so that single precision holds them wherever in the
//! world a frame is. Pure.
//!
//! The host knows positions in f64 and takes the origin off before it rounds: lights each frame, instances when the origin
//! moves. Everything the device calls world space has its origin here, whatever the method.

use crate::geometry::views::{View, head_space};
use glam::DVec3;

/// While the head stays within this part of the views' far distance from the world's origin, that is the frame's as well.
pub const AT_HOME: f64 = 0.75;

/// How many of the steps in which the origin follows the head elsewhere go into the far distance, at least.
const STEPS: f64 = 4.0;

/// The origin of a frame with these views, metres: the world's where the head is near it, else a point near the head, on a
/// lattice so coarse that instances rarely have to be placed anew. The head is at most [`AT_HOME`] of the far distance
/// away from it.
///
/// A function of the views alone, so that any frame can be rendered by itself and all methods agree.
pub fn of_views(views: &[View]) -> DVec3 {
    let head = head_space(views).position;
    let far = views.iter().map(|view| view.frustum.far()).fold(f64::INFINITY, f64::min);
    if head.length() <= AT_HOME * far {
        return DVec3::ZERO;
    }
    let step = power_of_two_below(far / STEPS);
    (head / step).round() * step
}

/// The largest power of two that is not above a positive number.
fn power_of_two_below(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(number.to_bits() & EXPONENT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frustum;
    use crate::geometry::views::Pose;
    use crate::recording::{bundled_names, load};
    use proptest::prelude::*;

    fn view(position: DVec3, far: f64) -> View {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -far, z1: -0.1 };
        View { pose: Pose::from_position(position), frustum }
    }

    #[test]
    fn bundled_recordings_are_at_home() {
        for name in bundled_names() {
            let recording = load(name).unwrap();
            for frame in 0..recording.frame_count() {
                assert_eq!(
                    of_views(&recording.views(frame, [64, 32]).unwrap()),
                    DVec3::ZERO,
                    "{name} {frame}"
                );
            }
        }
        assert_eq!(of_views(&[]), DVec3::ZERO);
    }

    #[test]
    fn the_origin_stays_while_the_head_moves_little() {
        let at = |x: f64| of_views(&[view(DVec3::new(1e5 + x, 0.0, -3.0), 100.0)]);
        assert_eq!(at(0.0), DVec3::new(1e5, 0.0, 0.0));
        assert_eq!(at(7.9), at(-7.9));
        assert_eq!(at(9.0), DVec3::new(1e5 + 16.0, 0.0, 0.0));
    }

    proptest! {
        #[test]
        fn the_head_is_near_the_origin(position in [-1e6..1e6f64, -1e6..1e6f64, -1e6..1e6f64], far in 0.01..1e6f64) {
            let head = DVec3::from_array(position);
            let origin = of_views(&[view(head, far)]);
            prop_assert!((head - origin).length() <= AT_HOME * far);
        }
    }
}
