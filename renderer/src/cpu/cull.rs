//! Which instances some views may see, from their boxes.

use crate::culling::{ViewPlanes, WorldBox};
use crate::geometry::views::View;

/// What at least one of the views may see.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seen {
    /// Whether each box may be seen.
    pub visible: Vec<bool>,
    /// Whether each box touches a plane so closely that f32 may decide otherwise.
    pub borderline: Vec<bool>,
}

/// Tests every box against the planes of every view; `epsilon`, in metres, is how close to a plane a box is borderline.
pub fn cull(boxes: &[WorldBox], views: &[View], epsilon: f64) -> Seen {
    let planes: Vec<ViewPlanes> = views.iter().map(ViewPlanes::new).collect();
    let depth = |bounds: &WorldBox| planes.iter().map(|p| p.depth(bounds)).fold(f64::NEG_INFINITY, f64::max);
    let depths: Vec<f64> = boxes.iter().map(depth).collect();
    Seen {
        visible: depths.iter().map(|&depth| depth >= 0.0).collect(),
        borderline: depths.iter().map(|depth| depth.abs() < epsilon).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frustum;
    use crate::geometry::views::Pose;
    use glam::DVec3;

    #[test]
    fn what_any_view_sees_is_visible_and_what_touches_a_plane_borderline() {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -10.0, z1: -1.0 };
        let eye = |x: f64| View { pose: Pose::from_position(DVec3::new(x, 0.0, 0.0)), frustum };
        let at = |x: f64, z: f64| WorldBox { center: DVec3::new(x, 0.0, z), half_extent: DVec3::splat(0.5) };
        let boxes = [at(0.0, -5.0), at(20.0, -5.0), at(40.0, -5.0), at(0.0, -0.5), at(0.0, -0.499)];
        let one = cull(&boxes, &[eye(0.0)], 0.01);
        assert_eq!(one.visible, [true, false, false, true, false]);
        assert_eq!(one.borderline, [false, false, false, true, true]);
        let both = cull(&boxes, &[eye(0.0), eye(20.0)], 0.01);
        assert_eq!(both.visible, [true, true, false, true, false]);
    }
}
