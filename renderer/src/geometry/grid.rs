//! A grid of clusters: from points to clusters and from clusters to their shapes.

use super::{Frustum, Slices, SphereTest};
use crate::geometry::views::Pose;
use glam::DVec3;

/// How far outside the grid, relative to its dimensions, a point still counts as on its rim.
const RIM: f64 = 1e-9;

/// What the cells of a grid look like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellShape {
    /// Cells are pieces of a frustum.
    Frustum,
    /// Cells are pieces of a frustum, which can be tested as the boxes around them along the axes of their view.
    BoxedFrustum,
    /// Cells are boxes along the axes.
    Box,
    /// Groups are models, in boxes along their own axes.
    Model,
}

impl CellShape {
    /// Whether `test` asks boxes around the cells, which are kept for it.
    pub fn keeps_boxes(self, test: SphereTest) -> bool {
        self == Self::BoxedFrustum && test == SphereTest::Box
    }
}

/// The shape of a grid, in clustering space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ClusterSpace {
    /// Clusters divide the frustum evenly in tangents, and by a law in depth.
    Perspective {
        /// From the apex at the origin of clustering space.
        frustum: Frustum,
        /// Where the planes between slices lie; the last one is at `z0`, or beyond it.
        slices: Slices,
    },
    /// Clusters divide an axis-aligned box evenly.
    Orthographic {
        /// Lowest corner of the grid, metres.
        min: DVec3,
        /// Highest corner of the grid, metres.
        max: DVec3,
    },
}

impl ClusterSpace {
    /// A frustum whose slice k spans depths z1*(1+`ratio`)^k..z1*(1+`ratio`)^(k+1) (Gelderen equation 3.3).
    pub fn geometric(frustum: Frustum, ratio: f64) -> Self {
        Self::Perspective { frustum, slices: Slices::geometric(frustum.near(), ratio) }
    }
}

/// A clustering's grid. Linear index ix + Dx*(iy + Dy*iz).
///
/// ix grows to the right and iy upwards; iz grows away from the camera in perspective grids, and with z,
/// towards the camera, in orthographic ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Pose that takes clustering to world space.
    pub pose: Pose,
    /// Shape in clustering space.
    pub space: ClusterSpace,
    /// Dx, Dy, Dz; their product fits a u32.
    pub dimensions: [u32; 3],
}

/// The cell with a linear index in a grid of so many cells a side: the inverse of [`Grid::linear`].
pub fn cell_at(linear: u32, [dx, dy, _]: [u32; 3]) -> [u32; 3] {
    [linear % dx, linear / dx % dy, linear / dx / dy]
}

impl Grid {
    /// This grid in a world whose origin lies at `origin` (metres) of the world it is in.
    pub fn relative_to(&self, origin: DVec3) -> Self {
        Self { pose: self.pose.relative_to(origin), ..*self }
    }

    /// Number of clusters: Dx*Dy*Dz.
    pub fn cluster_count(&self) -> u64 {
        self.dimensions.into_iter().map(u64::from).product()
    }

    /// The linear index of a cluster.
    pub fn linear(&self, [ix, iy, iz]: [u32; 3]) -> u32 {
        let [dx, dy, _] = self.dimensions;
        ix + dx * (iy + dy * iz)
    }

    /// The cluster with a linear index: the inverse of [`Grid::linear`].
    pub fn cluster_at(&self, linear: u32) -> [u32; 3] {
        cell_at(linear, self.dimensions)
    }

    /// The cluster that a world point lies in, `None` outside the grid.
    pub fn cluster_of(&self, world: DVec3) -> Option<[u32; 3]> {
        self.cluster_of_local(self.pose.inverse_transform_point(world))
    }

    /// The cluster that a point of clustering space lies in, `None` outside the grid.
    ///
    /// The rim of the grid belongs to it, and so does what rounding errors put just outside.
    pub fn cluster_of_local(&self, point: DVec3) -> Option<[u32; 3]> {
        let at = self.coordinates(point)?;
        let dimensions = self.dimensions_f64();
        let inside = (at.cmpge(-RIM * dimensions) & at.cmple((1.0 + RIM) * dimensions)).all();
        inside.then(|| self.clamped(at))
    }

    /// The cluster that a point of clustering space lies in, or the nearest one along each cluster axis;
    /// `None` only behind the apex of a perspective grid. This is what a shader computes for a fragment.
    pub fn nearest_cluster(&self, point: DVec3) -> Option<[u32; 3]> {
        self.coordinates(point).map(|at| self.clamped(at))
    }

    /// Fractional cluster coordinates of a point of clustering space: their floors are the cluster index.
    ///
    /// `None` where they are not defined: at or behind the apex of a perspective grid.
    pub fn coordinates(&self, point: DVec3) -> Option<DVec3> {
        let dimensions = self.dimensions_f64();
        match self.space {
            ClusterSpace::Perspective { frustum: f, slices } => (point.z < 0.0).then(|| {
                let size = f.size();
                DVec3::new(
                    dimensions.x * (point.x / -point.z - f.x0) / size.x,
                    dimensions.y * (point.y / -point.z - f.y0) / size.y,
                    slices.coordinate_of(-point.z),
                )
            }),
            ClusterSpace::Orthographic { min, max } => Some(dimensions * (point - min) / (max - min)),
        }
    }

    /// The corners of a cluster in clustering space: bit 0, 1 and 2 of the position choose the upper x, y
    /// and z index.
    pub fn cell_corners(&self, cell: [u32; 3]) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let upper = |axis: usize| f64::from(cell[axis]) + f64::from(corner as u32 >> axis & 1);
            self.point_at(DVec3::new(upper(0), upper(1), upper(2)))
        })
    }

    /// The axis-aligned bounds of a cluster in clustering space, (lowest, highest): exact for orthographic
    /// grids.
    pub fn cell_bounds(&self, cell: [u32; 3]) -> (DVec3, DVec3) {
        self.cell_corners(cell)
            .into_iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), corner| {
                (low.min(corner), high.max(corner))
            })
    }

    /// Lowest and highest corner of the whole grid in clustering space.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.range_bounds([0; 3], self.dimensions.map(|count| count - 1))
    }

    /// Lowest and highest corner, in clustering space, of the cells from one to another.
    pub fn range_bounds(&self, first: [u32; 3], last: [u32; 3]) -> (DVec3, DVec3) {
        let corner = |corner: usize| -> [u32; 3] {
            std::array::from_fn(|axis| if corner >> axis & 1 == 1 { last[axis] } else { first[axis] })
        };
        (0..8)
            .map(|i| self.cell_bounds(corner(i)))
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), (cell_low, cell_high)| {
                (low.min(cell_low), high.max(cell_high))
            })
    }

    /// The point of clustering space with the given fractional cluster coordinates: the inverse of
    /// [`Grid::coordinates`].
    pub fn point_at(&self, coordinates: DVec3) -> DVec3 {
        let part = coordinates / self.dimensions_f64();
        match self.space {
            ClusterSpace::Perspective { frustum: f, slices } => {
                let size = f.size();
                let distance = slices.depth_at(coordinates.z);
                DVec3::new(f.x0 + size.x * part.x, f.y0 + size.y * part.y, -1.0) * distance
            }
            ClusterSpace::Orthographic { min, max } => min + (max - min) * part,
        }
    }

    /// Replaces `planes` by the depths between the slices of a perspective grid, metres: of the first one's near side, Dz - 1
    /// between, of the last one's far side. Empty for orthographic grids.
    ///
    /// Slice k holds what is not nearer than plane k and nearer than plane k + 1, compared in f32 on the device. They
    /// ascend strictly, see [`crate::methods::Method::plan`].
    pub fn slice_planes(&self, planes: &mut Vec<f32>) {
        planes.clear();
        if let ClusterSpace::Perspective { slices, .. } = self.space {
            planes.extend((0..=self.dimensions[2]).map(|slice| slices.depth_at(slice.into()) as f32));
        }
    }

    fn dimensions_f64(&self) -> DVec3 {
        DVec3::from_array(self.dimensions.map(f64::from))
    }

    fn clamped(&self, coordinates: DVec3) -> [u32; 3] {
        let last = self.dimensions_f64() - DVec3::ONE;
        // Within 0..=last, the conversion is exact.
        coordinates.floor().clamp(DVec3::ZERO, last).to_array().map(|index| index as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn perspective() -> Grid {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -0.5, y1: 0.5, z0: -16.0, z1: -1.0 };
        let space = ClusterSpace::geometric(frustum, 1.0);
        Grid { pose: Pose::from_position(DVec3::new(0.0, 0.0, 3.0)), space, dimensions: [4, 2, 4] }
    }

    fn orthographic() -> Grid {
        let space = ClusterSpace::Orthographic { min: DVec3::splat(-2.0), max: DVec3::new(2.0, 4.0, 6.0) };
        Grid { pose: Pose::IDENTITY, space, dimensions: [4, 3, 2] }
    }

    #[test]
    fn slices_double_and_slice_0_is_at_the_near_plane() {
        let grid = perspective();
        for (distance, slice) in [(1.0, 0), (1.9, 0), (2.1, 1), (7.9, 2), (8.1, 3), (16.0, 3)] {
            assert_eq!(grid.cluster_of_local(DVec3::new(0.0, 0.0, -distance)), Some([2, 1, slice]));
        }
        assert_eq!(grid.cluster_of(DVec3::new(0.0, 0.0, 2.0)), Some([2, 1, 0]), "the pose counts");
    }

    #[test]
    fn outside_is_nowhere_and_the_rim_is_inside() {
        let grid = perspective();
        for outside in [
            DVec3::new(0.0, 0.0, 1.0),
            DVec3::ZERO,
            DVec3::new(0.0, 0.0, -0.99),
            DVec3::new(0.0, 0.0, -16.01),
            DVec3::new(2.001, 0.0, -2.0),
            DVec3::NAN,
        ] {
            assert_eq!(grid.cluster_of_local(outside), None, "{outside}");
        }
        assert_eq!(grid.nearest_cluster(DVec3::new(9.0, -9.0, -99.0)), Some([2, 0, 3]));
        assert_eq!(grid.nearest_cluster(DVec3::new(900.0, -900.0, -0.5)), Some([3, 0, 0]));
        assert_eq!(grid.cluster_of_local(DVec3::new(16.0, 8.0, -16.0)), Some([3, 1, 3]));
        assert_eq!(orthographic().cluster_of_local(DVec3::new(2.0, 4.0, 6.0)), Some([3, 2, 1]));
        assert_eq!(orthographic().cluster_of_local(DVec3::new(2.0, 4.0, 6.1)), None);
    }

    #[test]
    fn a_cell_has_the_corners_its_index_says() {
        let corners = orthographic().cell_corners([1, 0, 1]);
        assert_eq!(corners[0], DVec3::new(-1.0, -2.0, 2.0));
        assert_eq!(corners[1], DVec3::new(0.0, -2.0, 2.0));
        assert_eq!(corners[6], DVec3::new(-1.0, 0.0, 6.0));
        let (low, high) = perspective().cell_bounds([3, 1, 1]);
        assert!((low - DVec3::new(1.0, 0.0, -4.0)).length() < 1e-12, "{low}");
        assert!((high - DVec3::new(4.0, 2.0, -2.0)).length() < 1e-12, "{high}");
    }
}
