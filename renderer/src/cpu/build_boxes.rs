//! The boxes around the cells of a perspective grid, along the axes of its view.

use crate::geometry::Grid;
use glam::DVec3;

/// Lowest and highest corner of the box around each cell of `grid`, clustering space, in the order of linear indices (Ortiz,
/// step 1): two opposite corners of the tile, at the depths where the slice begins and where it ends.
pub fn build_boxes(grid: &Grid) -> Vec<[DVec3; 2]> {
    let box_of = |cluster: u32| {
        let cell = DVec3::from_array(grid.cluster_at(cluster).map(f64::from));
        let corners = [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::Z, DVec3::ONE];
        let points = corners.map(|corner| grid.point_at(cell + corner));
        [points.into_iter().fold(points[0], DVec3::min), points.into_iter().fold(points[0], DVec3::max)]
    };
    (0..grid.cluster_count() as u32).map(box_of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{CellTest, ClusterSpace, Frustum, LightVolume, SliceLaw, Slices, SphereTest};
    use proptest::prelude::*;

    fn grid(law: SliceLaw, sides: [f64; 4], [near, far]: [f64; 2], dimensions: [u32; 3]) -> Grid {
        let [left, right, bottom, top] = sides;
        // Beside the axis too.
        let frustum =
            Frustum { x0: left, x1: left + right, y0: bottom, y1: bottom + top, z0: -far, z1: -near };
        let count = f64::from(dimensions[2]);
        let slices = Slices::new(law, &frustum, (far / near).powf(1.0 / count) - 1.0, count);
        Grid { pose: Pose::IDENTITY, space: ClusterSpace::Perspective { frustum, slices }, dimensions }
    }

    proptest! {
        #[test]
        fn boxes_are_the_least_that_hold_their_cells(
            law in 0..6usize, sides in [-1.5..1.0f64, 0.1..2.0f64, -1.5..1.0f64, 0.1..2.0f64],
            near in 0.05..2.0f64, far in 20.0..500.0f64, dimensions in [1..9u32, 1..9u32, 2..9u32],
            parts in [0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64],
        ) {
            let grid = grid(SliceLaw::EXAMPLES[law], sides, [near, far], dimensions);
            for (cluster, [low, high]) in (0u32..).zip(build_boxes(&grid)) {
                let cell = grid.cluster_at(cluster);
                let (lowest, highest) = grid.cell_bounds(cell);
                prop_assert!((low - lowest).abs().max_element() < 1e-9 && (high - highest).abs().max_element() < 1e-9);
                let inside = DVec3::from_array(cell.map(f64::from)) + DVec3::from_array(parts);
                let point = grid.point_at(inside);
                prop_assert!((low - point).max(point - high).max_element() < 1e-9, "{point} of {cell:?}");
            }
        }

        #[test]
        fn boxes_lose_no_light_that_meets_their_cell(
            sides in [-1.5..1.0f64, 0.1..2.0f64, -1.5..1.0f64, 0.1..2.0f64],
            centre in [-30.0..30.0f64, -30.0..30.0f64, -40.0..5.0f64], radius in 0.01..20.0f64,
        ) {
            let grid = grid(SliceLaw::Geometric, sides, [0.3, 100.0], [4, 3, 6]);
            let volume = LightVolume::sphere(DVec3::from_array(centre), radius);
            for cluster in 0..grid.cluster_count() as u32 {
                let margin = |test| CellTest::new(test, &grid, grid.cluster_at(cluster)).margin(&volume);
                prop_assert!(margin(SphereTest::Box) >= margin(SphereTest::Exact) - 1e-9);
            }
        }
    }
}
