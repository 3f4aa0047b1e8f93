//! The box around a model in its own axes, in world space (Enhuber section 3.5.3: NPT).
//!
//! A matrix of translation, rotation and scale takes the box of an object to a box again, whose sides lie along the
//! matrix's columns. The nearest point of it is found in its own axes, where it is that of a box along them: exact, with
//! the sphere's radius as it is, for what takes it there does not stretch. A negative scale mirrors the box to itself.

use glam::{DMat4, DVec3};

/// Columns of a matrix that is one of translation, rotation and scale are perpendicular up to this, as a cosine: the
/// matrices of files are products of numbers of single precision.
const PERPENDICULAR: f64 = 1e-5;

/// A box along axes of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrientedBox {
    /// Middle of the box, world space, metres.
    pub center: DVec3,
    /// Half the size of the box along each of its axes, metres.
    pub half_extent: DVec3,
    /// Axes of the box, unit and perpendicular.
    pub axes: [DVec3; 3],
}

impl OrientedBox {
    /// The box that `matrix` makes of an object's box from `low` to `high` (metres). `None` where the matrix shears, so that it
    /// makes no box of one.
    pub fn of(matrix: &DMat4, [low, high]: [DVec3; 2]) -> Option<Self> {
        let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| column.truncate());
        let axes = perpendicular(columns)?;
        let half = 0.5 * (high - low);
        // All of the box, also by what little its sides are not perpendicular.
        let extent = |axis: DVec3| (0..3).map(|side| axis.dot(columns[side]).abs() * half[side]).sum();
        let half_extent = DVec3::from_array(axes.map(extent));
        Some(Self { center: matrix.transform_point3(0.5 * (low + high)), half_extent, axes })
    }

    /// A box along the world's axes.
    pub fn along_axes(center: DVec3, half_extent: DVec3) -> Self {
        Self { center, half_extent, axes: DVec3::AXES }
    }

    /// The corners, world space, metres: bit 0, 1 and 2 of the place choose the far side along each axis.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let sides = (0..3).map(|axis| {
                let half = self.axes[axis] * self.half_extent[axis];
                if corner >> axis & 1 == 0 { -half } else { half }
            });
            self.center + sides.sum::<DVec3>()
        })
    }

    /// How far a point of the world lies from the box, metres; 0 inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        let offset = point - self.center;
        let along = DVec3::from_array(self.axes.map(|axis| axis.dot(offset)));
        (along.abs() - self.half_extent).max(DVec3::ZERO).length()
    }
}

/// Unit and perpendicular vectors along columns that are nearly so, whatever is free for those of no length; `None` for others.
fn perpendicular(columns: [DVec3; 3]) -> Option<[DVec3; 3]> {
    let mut axes = columns.map(DVec3::normalize_or_zero);
    let skew = |a: usize, b: usize| axes[a].dot(axes[b]).abs();
    if skew(0, 1).max(skew(1, 2)).max(skew(2, 0)) > PERPENDICULAR {
        return None;
    }
    let first = axes.into_iter().find(|axis| *axis != DVec3::ZERO)?;
    for at in 0..3 {
        if axes[at] == DVec3::ZERO {
            let across = axes[(at + 1) % 3].cross(axes[(at + 2) % 3]);
            axes[at] = across.try_normalize().unwrap_or_else(|| first.any_orthonormal_vector());
        }
    }
    let across = axes[0].cross(axes[1]).normalize();
    Some([axes[0], across.cross(axes[0]), across])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, EulerRot};
    use proptest::prelude::*;

    const BOX: [DVec3; 2] = [DVec3::new(-1.0, 0.5, 2.0), DVec3::new(3.0, 1.0, 7.0)];

    fn matrix(scale: [f64; 3], turn: [f64; 3], place: [f64; 3]) -> DMat4 {
        let rotation = DQuat::from_euler(EulerRot::XYZ, turn[0], turn[1], turn[2]);
        DMat4::from_scale_rotation_translation(DVec3::from_array(scale), rotation, DVec3::from_array(place))
    }

    fn corners() -> impl Iterator<Item = DVec3> {
        (0..8).map(|corner: usize| {
            let pick = |axis: usize| BOX[corner >> axis & 1][axis];
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }

    #[test]
    fn a_box_has_the_corners_that_its_matrix_makes() {
        let matrix = matrix([1.0, 2.0, 0.5], [0.5, 0.7, -0.2], [3.0, 2.0, 1.0]);
        let found = OrientedBox::of(&matrix, BOX).unwrap().corners();
        for (found, expected) in found.into_iter().zip(corners()) {
            assert!(found.distance(matrix.transform_point3(expected)) < 1e-9, "{found}");
        }
    }

    #[test]
    fn what_shears_makes_no_box() {
        let sheared =
            matrix([1.0, 3.0, 1.0], [0.0; 3], [0.0; 3]) * matrix([1.0; 3], [0.5, 0.7, 0.0], [0.0; 3]);
        assert_eq!(OrientedBox::of(&sheared, BOX), None);
        let even = matrix([3.0; 3], [0.0; 3], [0.0; 3]) * matrix([1.0, -2.0, 0.5], [0.5, 0.7, 0.0], [0.0; 3]);
        assert!(OrientedBox::of(&even, BOX).is_some());
    }

    #[test]
    fn what_is_scaled_to_nothing_along_axes_keeps_perpendicular_ones() {
        for scale in [
            [0.0, 2.0, 1.0],
            [1.0, 0.0, 1.0],
            [-1.0, 2.0, 0.0],
            [0.0, 0.0, 3.0],
            [0.0, 2.0, 0.0],
            [1.0, 0.0, 0.0],
        ] {
            let found = OrientedBox::of(&matrix(scale, [0.4, -0.8, 1.1], [5.0, 6.0, 7.0]), BOX).unwrap();
            let [x, y, z] = found.axes;
            assert!((x.cross(y).dot(z).abs() - 1.0).abs() < 1e-12, "{scale:?}");
            for corner in corners() {
                let world = matrix(scale, [0.4, -0.8, 1.1], [5.0, 6.0, 7.0]).transform_point3(corner);
                assert!(found.distance(world) < 1e-12, "{scale:?}");
            }
        }
        assert_eq!(OrientedBox::of(&DMat4::ZERO, BOX), None);
    }

    proptest! {
        /// The distance to the box is that to the nearest point of the object's box, found in its own space.
        #[test]
        fn distances_are_those_to_the_nearest_point(
            scale in [-3.0..3.0f64, -3.0..3.0f64, 0.1..3.0f64],
            turn in [-3.0..3.0f64, -3.0..3.0f64, -3.0..3.0f64],
            place in [-50.0..50.0f64, -50.0..50.0f64, -50.0..50.0f64],
            point in [-60.0..60.0f64, -60.0..60.0f64, -60.0..60.0f64],
        ) {
            prop_assume!(scale.iter().all(|scale| scale.abs() > 0.01));
            let (matrix, point) = (matrix(scale, turn, place), DVec3::from_array(point));
            let found = OrientedBox::of(&matrix, BOX).unwrap();
            let rotation = DQuat::from_euler(EulerRot::XYZ, turn[0], turn[1], turn[2]);
            let local = rotation.inverse() * (point - DVec3::from_array(place));
            let [a, b] = BOX.map(|corner| corner * DVec3::from_array(scale));
            let nearest = local.clamp(a.min(b), a.max(b));
            prop_assert!((found.distance(point) - local.distance(nearest)).abs() < 1e-9);
            for corner in corners() {
                prop_assert!(found.distance(matrix.transform_point3(corner)) < 1e-9);
            }
        }
    }
}
