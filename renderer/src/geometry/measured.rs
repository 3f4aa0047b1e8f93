//! What points take of a cell: the bounds that are tested instead of it (Enhuber section 3.2).

use super::{ClusterSpace, Grid, Plane};
use glam::DVec3;

/// The least box that holds some points: of tangents and depth (metres) in perspective grids, which is a piece of a frustum,
/// else of metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredBounds {
    /// Lowest values of all points.
    pub low: DVec3,
    /// Highest values of all points.
    pub high: DVec3,
}

impl MeasuredBounds {
    /// Bounds of nothing.
    pub const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// Whether they hold nothing.
    pub fn is_empty(&self) -> bool {
        self.low.cmpgt(self.high).any()
    }

    /// Lets them hold a point of the clustering space of `grid`.
    pub fn include(&mut self, grid: &Grid, point: DVec3) {
        let place = place(grid, point);
        self.low = self.low.min(place);
        self.high = self.high.max(place);
    }

    /// How far others reach beyond these, in metres where `grid` is orthographic, else in tangents or parts of the depth.
    pub fn missing(&self, grid: &Grid, others: &Self) -> f64 {
        let unit = match grid.space {
            ClusterSpace::Perspective { .. } => DVec3::new(1.0, 1.0, others.high.z),
            ClusterSpace::Orthographic { .. } => DVec3::ONE,
        };
        ((self.low - others.low).max(others.high - self.high) / unit).max_element()
    }

    /// Corners in clustering space, in the order of [`Grid::cell_corners`] along x and y; along z, of perspective grids the near
    /// ones come first.
    pub(super) fn corners(&self, grid: &Grid) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let side = |axis: usize| if corner >> axis & 1 == 1 { self.high[axis] } else { self.low[axis] };
            let [x, y, z] = [0, 1, 2].map(side);
            match grid.space {
                ClusterSpace::Perspective { .. } => DVec3::new(x * z, y * z, -z),
                ClusterSpace::Orthographic { .. } => DVec3::new(x, y, z),
            }
        })
    }

    /// A ball that holds them in clustering space, around the middle of the least box along its axes: centre, radius (metres).
    pub fn ball(&self, grid: &Grid) -> (DVec3, f64) {
        let corners = self.corners(grid);
        let (low, high) = (
            corners.into_iter().fold(DVec3::INFINITY, DVec3::min),
            corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max),
        );
        (0.5 * (low + high), 0.5 * (high - low).length())
    }

    /// Planes in clustering space, in the order of [`Grid::cell_planes`].
    pub fn planes(&self, grid: &Grid) -> [Plane; 6] {
        let Self { low, high } = *self;
        let axis = |normal: DVec3, place: f64| Plane { normal, offset: -place };
        match grid.space {
            ClusterSpace::Perspective { .. } => {
                let [left, right, bottom, top] = Plane::through_apex([low.x, high.x], [low.y, high.y]);
                [left, right, bottom, top, axis(DVec3::Z, -high.z), axis(-DVec3::Z, low.z)]
            }
            ClusterSpace::Orthographic { .. } => [
                axis(DVec3::X, low.x),
                axis(-DVec3::X, -high.x),
                axis(DVec3::Y, low.y),
                axis(-DVec3::Y, -high.y),
                axis(DVec3::Z, low.z),
                axis(-DVec3::Z, -high.z),
            ],
        }
    }
}

/// Where a point of clustering space lies: tangents and depth, or metres.
fn place(grid: &Grid, point: DVec3) -> DVec3 {
    match grid.space {
        ClusterSpace::Perspective { .. } => (point.truncate() / -point.z).extend(-point.z),
        ClusterSpace::Orthographic { .. } => point,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{CellTest, Frustum, LightVolume, SphereTest};

    fn grids() -> [Grid; 2] {
        let frustum = Frustum { x0: -1.2, x1: 0.9, y0: -0.7, y1: 1.1, z0: -80.0, z1: -0.3 };
        let max = DVec3::splat(40.0);
        let spaces = [ClusterSpace::geometric(frustum, 0.5), ClusterSpace::Orthographic { min: -max, max }];
        spaces.map(|space| Grid { pose: Pose::IDENTITY, space, dimensions: [5, 3, 14] })
    }

    fn tests() -> impl Iterator<Item = SphereTest> {
        let names = ["hs", "sat-e", "sat-n", "sat-p", "sat-v", "hs+sat-enpv", "exact"];
        names.into_iter().map(|name| name.parse().unwrap())
    }

    #[test]
    fn the_bounds_of_a_cells_corners_are_the_cell() {
        for grid in grids() {
            let cell = [3, 1, 4];
            let mut bounds = MeasuredBounds::EMPTY;
            assert!(bounds.is_empty());
            grid.cell_corners(cell).into_iter().for_each(|corner| bounds.include(&grid, corner));
            assert!(!bounds.is_empty());
            for (own, of_cell) in bounds.planes(&grid).into_iter().zip(grid.cell_planes(cell)) {
                assert!((own.normal - of_cell.normal).length() < 1e-12);
                assert!((own.offset - of_cell.offset).abs() < 1e-9);
            }
            for corner in bounds.corners(&grid) {
                assert!(grid.cell_corners(cell).iter().any(|of_cell| of_cell.distance(corner) < 1e-9));
            }
        }
    }

    #[test]
    fn the_ball_holds_all_corners_and_touches_some() {
        for grid in grids() {
            let mut bounds = MeasuredBounds::EMPTY;
            grid.cell_corners([1, 2, 6]).into_iter().for_each(|corner| bounds.include(&grid, corner));
            let (centre, radius) = bounds.ball(&grid);
            let farthest =
                bounds.corners(&grid).map(|corner| corner.distance(centre)).into_iter().fold(0.0, f64::max);
            assert!((farthest - radius).abs() < 1e-9, "{farthest} {radius}");
        }
    }

    #[test]
    fn a_single_point_meets_what_reaches_it_by_every_test() {
        let (point, away) = (DVec3::new(1.5, -0.5, -6.0), DVec3::new(0.6, -0.3, 0.7).normalize());
        for grid in grids() {
            let mut bounds = MeasuredBounds::EMPTY;
            bounds.include(&grid, point);
            for test in tests() {
                let at = grid.cluster_of(point).unwrap();
                let cell = CellTest::measured(test, &grid, at, &bounds);
                let margin = |radius: f64| cell.margin(&LightVolume::sphere(point + 2.0 * away, radius));
                assert!(margin(2.0 + 1e-9) >= 0.0, "{test} loses the point");
                let vertices =
                    ["sat-n", "sat-v", "hs+sat-enpv", "exact"].contains(&test.to_string().as_str());
                assert!(!vertices || margin(2.0 - 1e-6) < 0.0, "{test} takes what ends before the point");
            }
        }
    }
}
