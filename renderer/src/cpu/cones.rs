//! Which way the fragments of each cluster face, from a depth image and the normals there.

use super::DepthImage;
use super::mark::possible_cells;
use crate::geometry::views::View;
use crate::geometry::{Grid, NormalCones};
use glam::DVec3;

/// The cones of the fragments of every cluster of a grid, a bit each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClusterCones {
    /// Of the fragments that surely lie in each cluster and face one cone alone.
    pub least: Vec<u64>,
    /// With all that f32 may make of others: a device's cones hold `least` and are among these.
    pub most: Vec<u64>,
}

impl ClusterCones {
    /// No fragment yet in any cluster of `grid`.
    pub fn none(grid: &Grid) -> Self {
        let empty = || vec![0; grid.cluster_count() as usize];
        Self { least: empty(), most: empty() }
    }

    /// Lets the cones of every cluster of `grid` hold the fragments that `view` sees in it, on top of what they hold. `normal` tells
    /// the unit shading normal at a position, both in clustering space.
    ///
    /// `epsilon`, in clusters and in parts of a normal, is how close to a side a fragment is too close to call.
    ///
    /// # Panics
    /// Where the image does not hold one depth for every sample.
    pub fn include(
        &mut self,
        (image, view): (DepthImage<'_>, &View),
        grid: &Grid,
        (divided, epsilon): (NormalCones, f64),
        normal: impl Fn(DVec3) -> DVec3,
    ) {
        for local in image.fragments(view, grid) {
            let Some(at) = grid.coordinates(local) else { continue };
            let (cells, faced) =
                (possible_cells(grid, at, epsilon), possible_cones(divided, normal(local), epsilon));
            for cell in &cells {
                self.most[grid.linear(*cell) as usize] |= faced;
            }
            if let ([cell], 1) = (&cells[..], faced.count_ones()) {
                self.least[grid.linear(*cell) as usize] |= faced;
            }
        }
    }
}

/// The cones within `epsilon` of a direction.
fn possible_cones(divided: NormalCones, direction: DVec3, epsilon: f64) -> u64 {
    let side = |corner: u32, axis: u32| if corner >> axis & 1 == 1 { epsilon } else { -epsilon };
    let corners = (0..8).map(|corner| DVec3::new(side(corner, 0), side(corner, 1), side(corner, 2)));
    corners.fold(0, |cones, shift| cones | 1 << divided.cone_of(direction + shift))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{ClusterSpace, Frustum};

    #[test]
    fn a_wall_faces_one_way_and_an_edge_two() {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -0.5, y1: 0.5, z0: -16.0, z1: -1.0 };
        let view = View { pose: Pose::IDENTITY, frustum };
        let grid =
            Grid { pose: view.pose, space: ClusterSpace::geometric(frustum, 3.0), dimensions: [2, 1, 2] };
        let depth = ((16.0 - 2.0) / (2.0 * 15.0)) as f32;
        let depths = [depth; 4];
        let image = DepthImage { resolution: [4, 1], sample_positions: &[[0.5, 0.5]], depths: &depths };
        let divided: NormalCones = "1".parse().unwrap();
        let mut cones = ClusterCones::none(&grid);
        let roof = |at: DVec3| if at.x < 0.0 { DVec3::Z } else { DVec3::new(0.8, 0.0, 0.6) };
        cones.include((image, &view), &grid, (divided, 1e-3), roof);
        assert_eq!((cones.least, cones.most), (vec![1 << 4, 1 << 0, 0, 0], vec![1 << 4, 1 << 0, 0, 0]));
        let edge = possible_cones(divided, DVec3::new(1.0, 0.0, 1.0).normalize(), 1e-3);
        assert_eq!(edge, 1 << 0 | 1 << 4);
    }
}
