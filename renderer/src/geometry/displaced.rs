//! The displaced frustum: the apex moved back so that clusters near the eye grow (Gelderen section 4.3).

use super::Frustum;
use clap::ValueEnum;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which frustum sizes the clusters of Displ (Gelderen section 4.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DisplacedVolume {
    /// The average cluster volume of Persp on the undisplaced frustum.
    View,
    /// The displaced frustum's own volume over Persp's cluster count.
    Own,
}

/// Moves the apex of `frustum` back by `displacement` metres along its central axis; the far plane's
/// rectangle stays, so that the displaced frustum contains the original.
///
/// Returns the new apex in the space of `frustum`, and the frustum seen from it.
pub fn displaced(frustum: &Frustum, displacement: f64) -> (DVec3, Frustum) {
    let Frustum { x0, x1, y0, y1, z0, z1 } = *frustum;
    let apex = DVec3::new(-(x0 + x1) / 2.0, -(y0 + y1) / 2.0, 1.0) * displacement;
    let x = |tangent: f64| (z0 * tangent + apex.x) / (z0 - displacement);
    let y = |tangent: f64| (z0 * tangent + apex.y) / (z0 - displacement);
    let seen =
        Frustum { x0: x(x0), x1: x(x1), y0: y(y0), y1: y(y1), z0: z0 - displacement, z1: z1 - displacement };
    (apex, seen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_far_plane_stays_and_the_near_corners_are_inside() {
        let eye = Frustum { x0: -1.2, x1: 0.4, y0: -0.7, y1: 1.1, z0: -80.0, z1: -0.3 };
        let (apex, seen) = displaced(&eye, 20.0);
        for (old, new) in eye.far_corners().into_iter().zip(seen.far_corners()) {
            assert!((new + apex - old).length() < 1e-9);
        }
        for near in eye.near_corners() {
            assert!(seen.contains((near - apex) * (1.0 + 1e-12)));
        }
    }
}
