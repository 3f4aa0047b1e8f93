//! What the fragments of each cluster take of its cell, from a depth image.

use super::DepthImage;
use super::mark::possible_cells;
use crate::geometry::views::View;
use crate::geometry::{Grid, MeasuredBounds};

/// Bounds of the fragments of every cluster of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct ClusterBounds {
    /// Of the fragments that surely lie in each cluster.
    pub least: Vec<MeasuredBounds>,
    /// With those so close to one of its sides that f32 may count them in it or in a neighbour: a device's bounds hold `least`
    /// and lie within these.
    pub most: Vec<MeasuredBounds>,
}

impl ClusterBounds {
    /// No fragment yet in any cluster of `grid`.
    pub fn none(grid: &Grid) -> Self {
        let empty = || vec![MeasuredBounds::EMPTY; grid.cluster_count() as usize];
        Self { least: empty(), most: empty() }
    }

    /// Lets the bounds of every cluster of `grid` hold the fragments that `view` sees in it, on top of what they hold.
    ///
    /// `epsilon`, in clusters, is how close to a side a fragment is too close to call.
    ///
    /// # Panics
    /// Where the image does not hold one depth for every sample.
    pub fn include(&mut self, image: DepthImage<'_>, view: &View, grid: &Grid, epsilon: f64) {
        for local in image.fragments(view, grid) {
            let Some(at) = grid.coordinates(local) else { continue };
            let possible = possible_cells(grid, at, epsilon);
            for cell in &possible {
                self.most[grid.linear(*cell) as usize].include(grid, local);
            }
            if let [cell] = possible[..] {
                self.least[grid.linear(cell) as usize].include(grid, local);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{ClusterSpace, Frustum};
    use glam::{DVec2, DVec3};

    /// A row of two columns and two slices in front of a camera that sees four pixels.
    fn scene() -> (View, Grid) {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -0.5, y1: 0.5, z0: -16.0, z1: -1.0 };
        let view = View { pose: Pose::from_position(DVec3::new(1.0, 2.0, 3.0)), frustum };
        let space = ClusterSpace::geometric(frustum, 3.0);
        (view, Grid { pose: view.pose, space, dimensions: [2, 1, 2] })
    }

    #[test]
    fn bounds_hold_the_samples_of_their_cluster_and_no_more() {
        let (view, grid) = scene();
        let depth = |distance: f64| (1.0 * (16.0 - distance) / (distance * 15.0)) as f32;
        let depths = [depth(2.0), depth(3.0), 0.0, depth(8.0)];
        let image = DepthImage { resolution: [4, 1], sample_positions: &[[0.5, 0.5]], depths: &depths };
        let mut bounds = ClusterBounds::none(&grid);
        bounds.include(image, &view, &grid, 1e-4);
        assert_eq!(bounds.least, bounds.most, "nothing is close to a side");
        let expected = [
            Some([DVec2::new(-0.75, 0.0).extend(2.0), DVec2::new(-0.25, 0.0).extend(3.0)]),
            None,
            None,
            Some([DVec2::new(0.75, 0.0).extend(8.0); 2]),
        ];
        for (found, expected) in bounds.least.iter().zip(expected) {
            assert_eq!(found.is_empty(), expected.is_none());
            if let Some([low, high]) = expected {
                assert!((found.low - low).length() < 1e-5 && (found.high - high).length() < 1e-5);
            }
        }
    }

    #[test]
    fn what_is_close_to_a_side_may_belong_to_either_cell() {
        let (view, grid) = scene();
        // The slices meet at 4 metres.
        let depths = [0.0, ((16.0 - 4.0) / (4.0 * 15.0)) as f32, 0.0, 0.0];
        let image = DepthImage { resolution: [4, 1], sample_positions: &[[0.5, 0.5]], depths: &depths };
        let mut bounds = ClusterBounds::none(&grid);
        bounds.include(image, &view, &grid, 1e-4);
        let held = |all: &[MeasuredBounds]| all.iter().map(|bounds| !bounds.is_empty()).collect::<Vec<_>>();
        assert_eq!(held(&bounds.least), [false; 4]);
        assert_eq!(held(&bounds.most), [true, false, true, false]);
    }
}
