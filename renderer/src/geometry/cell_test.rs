//! Which light volumes meet a cluster: conservative and exact tests.
//!
//! Tests answer with a signed margin in metres: at least 0 means that they meet, and its size tells how close
//! the answer was, so that a comparison with f32 results can leave borderline pairs out.

use super::piece::FrustumPiece;
use super::projected_sphere::rectangle_margin;
use super::{
    ClusterSpace, Frustum, Grid, Hexahedron, LightVolume, MeasuredBounds, OrientedBox, Separators,
    SphereTest, SphericalSector, VolumeTest,
};
use glam::DVec3;

/// A plane by its unit normal, which points inwards, and its offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal of the plane, inwards.
    pub normal: DVec3,
    /// Signed distance of the origin, metres.
    pub offset: f64,
}

impl Plane {
    /// Signed distance of `point`, metres; positive inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }

    /// The sides between two tangents along x and two along y: x >= t*(-z) for the left plane with tangent t, and so on.
    pub(super) fn through_apex([left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> [Self; 4] {
        [
            DVec3::new(1.0, 0.0, left),
            -DVec3::new(1.0, 0.0, right),
            DVec3::new(0.0, 1.0, bottom),
            -DVec3::new(0.0, 1.0, top),
        ]
        .map(|normal| Self { normal: normal.normalize(), offset: 0.0 })
    }
}

impl Grid {
    /// The planes of a cluster in clustering space: lower and upper x, lower and upper y, lowest and highest
    /// z (in perspective grids that is far, near).
    pub fn cell_planes(&self, cell: [u32; 3]) -> [Plane; 6] {
        let (low, high) = self.cell_bounds(cell);
        let axis = |normal: DVec3, through: DVec3| Plane { normal, offset: -normal.dot(through) };
        let [left, right, bottom, top] = match self.space {
            ClusterSpace::Perspective { frustum, .. } => self.side_planes(&frustum, cell),
            ClusterSpace::Orthographic { .. } => {
                [axis(DVec3::X, low), axis(-DVec3::X, high), axis(DVec3::Y, low), axis(-DVec3::Y, high)]
            }
        };
        [left, right, bottom, top, axis(DVec3::Z, low), axis(-DVec3::Z, high)]
    }

    fn side_planes(&self, frustum: &Frustum, cell: [u32; 3]) -> [Plane; 4] {
        let step = [0, 1].map(|axis| frustum.size()[axis] / f64::from(self.dimensions[axis]));
        let x = |index: u32| frustum.x0 + step[0] * f64::from(index);
        let y = |index: u32| frustum.y0 + step[1] * f64::from(index);
        let [ix, iy, _] = cell;
        Plane::through_apex([x(ix), x(ix + 1)], [y(iy), y(iy + 1)])
    }
}

/// A cluster made ready to be tested against many light volumes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellTest {
    test: VolumeTest,
    cell: Hexahedron,
    /// Where a part of a cell is tested, those of the cell: of two planes through the apex the outer one is not always nearer to
    /// what lies behind both.
    outer: Option<[Plane; 6]>,
    /// Directions of the edges; as many as differ.
    edges: [DVec3; 6],
    /// In perspective grids.
    piece: Option<FrustumPiece>,
    /// Before what depth nothing is seen, metres; of boxes there is none.
    near: f64,
}

impl CellTest {
    /// Prepares the cluster `cell` of `grid`.
    pub fn new(test: impl Into<VolumeTest>, grid: &Grid, cell: [u32; 3]) -> Self {
        let cell = Hexahedron::of_cell(grid, cell);
        let piece = match grid.space {
            ClusterSpace::Perspective { .. } => Some(FrustumPiece::new(&cell.corners)),
            ClusterSpace::Orthographic { .. } => None,
        };
        let edges = edges(piece.as_ref());
        Self { test: test.into(), cell, outer: None, edges, piece, near: near(grid) }
    }

    /// Prepares what was measured in the cluster `cell` of `grid`; it holds something.
    pub fn measured(
        test: impl Into<VolumeTest>,
        grid: &Grid,
        cell: [u32; 3],
        bounds: &MeasuredBounds,
    ) -> Self {
        let part = Hexahedron { corners: bounds.corners(grid), planes: bounds.planes(grid) };
        let piece = match grid.space {
            ClusterSpace::Perspective { .. } => Some(FrustumPiece::new(&part.corners)),
            ClusterSpace::Orthographic { .. } => None,
        };
        let edges = edges(piece.as_ref());
        let outer = piece.map(|_| grid.cell_planes(cell));
        Self { test: test.into(), cell: part, outer, edges, piece, near: near(grid) }
    }

    /// Signed margin in metres: at least 0 where the volume meets the cluster, by this test. Its size is how far the
    /// volume or the corners would have to move for another answer, at least.
    pub fn margin(&self, volume: &LightVolume) -> f64 {
        let of_sphere = self.sphere_margin(volume.centre, volume.radius);
        volume.sector.iter().map(|sector| self.sector_margin(sector)).fold(of_sphere, f64::min)
    }

    fn sector_margin(&self, sector: &SphericalSector) -> f64 {
        self.test.cone.margin(&self.asked_of_cones(), sector)
    }

    /// The cell, or the box around it where that is what spheres are tested against.
    fn asked_of_cones(&self) -> Hexahedron {
        if self.test.sphere != SphereTest::Box {
            return self.cell;
        }
        let [low, high] = self.bounds();
        Hexahedron::of_box(&OrientedBox::along_axes(0.5 * (low + high), 0.5 * (high - low)))
    }

    /// Lowest and highest corner of the box around the cell.
    fn bounds(&self) -> [DVec3; 2] {
        let corners = self.cell.corners.into_iter();
        let low = corners.clone().fold(DVec3::INFINITY, DVec3::min);
        [low, corners.fold(DVec3::NEG_INFINITY, DVec3::max)]
    }

    fn sphere_margin(&self, center: DVec3, radius: f64) -> f64 {
        match (self.test.sphere, &self.piece) {
            (SphereTest::Separating(separators), _) => self.unseparated(separators, center, radius),
            (SphereTest::Projected, _) => self.projection_margin(center, radius),
            (SphereTest::Exact, Some(piece)) => radius - piece.distance(center),
            (SphereTest::Exact, None) | (SphereTest::Box, _) => {
                let [low, high] = self.bounds();
                radius - center.distance(center.clamp(low, high))
            }
        }
    }

    /// Least margin of the sides to what is seen of the sphere, and of the ends to its depths.
    fn projection_margin(&self, center: DVec3, radius: f64) -> f64 {
        let ends = self.cell.planes[4..].iter().map(|plane| plane.distance(center) + radius);
        ends.fold(rectangle_margin(&self.cell.planes, self.near, center, radius), f64::min)
    }

    /// Least margin of all that might separate.
    fn unseparated(&self, separators: Separators, center: DVec3, radius: f64) -> f64 {
        let mut least = f64::INFINITY;
        if separators.contain(Separators::HALF_SPACES) {
            least = self.within_planes(center, radius);
        }
        if separators.contain(Separators::NORMALS) {
            least = least.min(self.within_planes(center, radius));
            let normals = self.cell.planes.iter().map(|plane| radius - self.gap(plane.normal, center));
            least = normals.fold(least, f64::min);
        }
        if separators.contain(Separators::EDGES) {
            let edges = self.edges.iter().map(|&edge| radius - self.gap(edge, center));
            least = edges.fold(least, f64::min);
        }
        if separators.contain(Separators::VERTICES) {
            let vertices = self.cell.corners.iter().map(|&corner| self.vertex_margin(corner, center, radius));
            least = vertices.fold(least, f64::min);
        }
        if separators.contain(Separators::NEAREST_VERTEX) {
            least = least.min(self.nearest_vertex_margin(center, radius));
        }
        least
    }

    /// Least distance of the centre from the planes, moved out by the radius.
    fn within_planes(&self, center: DVec3, radius: f64) -> f64 {
        let asked = self.cell.planes.iter().chain(self.outer.iter().flatten());
        asked.map(|plane| plane.distance(center) + radius).fold(f64::INFINITY, f64::min)
    }

    /// How far the corners' projections to a unit axis lie apart from the centre's, metres; below 0 where they enclose it.
    fn gap(&self, axis: DVec3, center: DVec3) -> f64 {
        let projected = self.cell.corners.map(|corner| axis.dot(corner - center));
        let low = projected.into_iter().fold(f64::INFINITY, f64::min);
        let high = projected.into_iter().fold(f64::NEG_INFINITY, f64::max);
        low.max(-high)
    }

    /// Margin of the axis from the centre to a corner. The nearer the corner, the more does the axis turn when it moves.
    fn vertex_margin(&self, corner: DVec3, center: DVec3, radius: f64) -> f64 {
        let Some(axis) = (corner - center).try_normalize() else { return radius };
        let farthest = self.cell.corners.iter().map(|other| other.distance(center)).fold(0.0, f64::max);
        (radius - self.gap(axis, center)) / (1.0 + farthest / corner.distance(center))
    }

    /// Margin of the axis to the nearest corner; corners about as near take its place when they move.
    fn nearest_vertex_margin(&self, center: DVec3, radius: f64) -> f64 {
        let mut corners: Vec<(f64, f64)> = self
            .cell
            .corners
            .iter()
            .map(|&corner| (corner.distance(center), self.vertex_margin(corner, center, radius)))
            .collect();
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (nearest, margin) = corners[0];
        let others = corners.iter().filter(|(_, other)| (*other < 0.0) != (margin < 0.0));
        let turn = others.map(|(distance, _)| (distance - nearest) / 2.0).fold(f64::INFINITY, f64::min);
        margin.abs().min(turn).copysign(margin)
    }
}

/// Before what depth nothing is seen in a grid, metres.
fn near(grid: &Grid) -> f64 {
    match grid.space {
        ClusterSpace::Perspective { frustum, .. } => frustum.near(),
        ClusterSpace::Orthographic { .. } => f64::NEG_INFINITY,
    }
}

/// Unit directions of the edges of a piece of a frustum, or of a box, also where these have no length: x, y, and the four that
/// meet in the apex, or z.
fn edges(piece: Option<&FrustumPiece>) -> [DVec3; 6] {
    let [a, b, c, d] = piece.map_or([DVec3::Z; 4], FrustumPiece::sides);
    [DVec3::X, DVec3::Y, a, b, c, d]
}

/// Margin of [`SphereTest::HALF_SPACES`] between a cluster and a sphere in clustering space, metres.
pub fn half_space(grid: &Grid, cell: [u32; 3], center: DVec3, radius: f64) -> f64 {
    CellTest::new(SphereTest::HALF_SPACES, grid, cell).sphere_margin(center, radius)
}

/// Margin of [`SphereTest::Box`] between a cluster and a sphere in clustering space, metres.
pub fn axis_box(grid: &Grid, cell: [u32; 3], center: DVec3, radius: f64) -> f64 {
    CellTest::new(SphereTest::Box, grid, cell).sphere_margin(center, radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;

    fn orthographic() -> Grid {
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max: DVec3::splat(4.0) };
        Grid { pose: Pose::IDENTITY, space, dimensions: [2, 2, 2] }
    }

    #[test]
    fn the_box_test_is_exact_where_half_spaces_are_not() {
        let (cell, beyond_corner) = ([0, 0, 0], DVec3::splat(2.8));
        assert!(half_space(&orthographic(), cell, beyond_corner, 1.0) > 0.0);
        assert!(axis_box(&orthographic(), cell, beyond_corner, 1.0) < 0.0);
        assert!((axis_box(&orthographic(), cell, DVec3::new(1.0, 5.0, 1.0), 3.5) - 0.5).abs() < 1e-12);
        assert_eq!(axis_box(&orthographic(), cell, DVec3::ONE, 1.5), 1.5);
    }

    #[test]
    fn cones_are_asked_where_the_test_says_so() {
        // Beside the first cell, shining along its face, or into it.
        let apex = DVec3::new(2.5, 1.0, -1.0);
        let spot = |x: f64| {
            let axis = DVec3::new(x, 0.0, 1.0).normalize();
            LightVolume::sector(SphericalSector { apex, axis, range: 3.0, half_angle: 0.1 })
        };
        let meets = |name: &str, x: f64| {
            let test: VolumeTest = name.parse().unwrap();
            CellTest::new(test, &orthographic(), [0; 3]).margin(&spot(x)) >= 0.0
        };
        for sphere in ["exact", "box", "hs", "sat-n"] {
            assert!(meets(sphere, 0.0) && meets(sphere, -1.0), "{sphere}");
            for cone in ["+cone", "+cone-sat"] {
                assert!(!meets(&format!("{sphere}{cone}"), 0.0), "{sphere}{cone}");
                assert!(meets(&format!("{sphere}{cone}"), -1.0), "{sphere}{cone}");
            }
        }
    }

    #[test]
    fn half_spaces_answer_with_the_distance_to_the_moved_out_planes() {
        let cell = [1, 0, 0];
        for (center, margin) in [
            (DVec3::new(1.0, 1.0, 1.0), 0.5),
            (DVec3::new(5.0, 1.0, 1.0), 0.5),
            (DVec3::new(3.0, 4.0, 1.0), -0.5),
            (DVec3::new(3.0, 1.0, -1.5), 0.0),
            (DVec3::new(3.0, 1.0, 1.0), 2.5),
        ] {
            assert!((half_space(&orthographic(), cell, center, 1.5) - margin).abs() < 1e-12);
        }
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -16.0, z1: -1.0 };
        let space = ClusterSpace::geometric(frustum, 3.0);
        let perspective = Grid { pose: Pose::IDENTITY, space, dimensions: [2, 2, 2] };
        let beside = DVec3::new(2.0 + 2f64.sqrt(), 0.5, -2.0);
        assert!((half_space(&perspective, [1, 1, 0], beside, 1.25) - 0.25).abs() < 1e-12, "45 degrees");
        assert!((half_space(&perspective, [1, 1, 1], DVec3::new(1.0, 1.0, -3.0), 1.25) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn planes_touch_their_cells_corners_and_point_inwards() {
        let frustum = Frustum { x0: -1.2, x1: 0.9, y0: -0.7, y1: 1.1, z0: -80.0, z1: -0.3 };
        let space = ClusterSpace::geometric(frustum, 0.5);
        let perspective = Grid { pose: Pose::IDENTITY, space, dimensions: [5, 3, 14] };
        for (grid, cell) in [(perspective, [0, 2, 7]), (perspective, [4, 1, 0]), (orthographic(), [1, 0, 1])]
        {
            for plane in grid.cell_planes(cell) {
                let distances = grid.cell_corners(cell).map(|corner| plane.distance(corner));
                assert_eq!(distances.iter().filter(|d| d.abs() < 1e-9).count(), 4);
                assert_eq!(distances.iter().filter(|d| **d > 1e-6).count(), 4);
            }
        }
    }
}
