//! Cells of a grid as the lines on the surface of what they fill together, where it faces an eye.

use crate::geometry::Grid;
use glam::DVec3;

/// An edge of cells, between two points of the grid's lattice that are neighbours along an axis.
type Edge = ([u32; 3], usize);

/// A side is seen edge-on, and not shown, where the sine of the angle to it is no more than this.
const EDGE_ON: f64 = 1e-9;

/// Some cells of a grid: linear indices that ascend.
#[derive(Debug, Clone, Copy)]
pub struct Cells<'a> {
    /// Where they lie.
    pub grid: &'a Grid,
    /// Which they are.
    pub indices: &'a [u32],
}

/// A side of a cell: the point of the lattice that it has least coordinates at, and the axis that it lies across.
#[derive(Debug, Clone, Copy)]
struct Side {
    low: [u32; 3],
    across: usize,
}

impl Cells<'_> {
    /// The edges of those sides between the cells and others that face an eye (world space, metres), each once: ends in clustering
    /// space, metres, by ascending place in the lattice.
    pub fn outline(self, eye: DVec3) -> impl Iterator<Item = (DVec3, DVec3)> {
        let eye = self.grid.pose.inverse_transform_point(eye);
        let cells = self.indices.iter().map(|&index| self.grid.cluster_at(index));
        let facing = |&(cell, side): &([u32; 3], Side)| self.faces(cell, side, eye);
        let sides = cells.flat_map(|cell| self.free_sides(cell).map(move |side| (cell, side)));
        let mut edges: Vec<Edge> = sides.filter(facing).flat_map(|(_, side)| side.edges()).collect();
        edges.sort_unstable();
        edges.dedup();
        edges.into_iter().map(move |(from, axis)| (self.point(from), self.point(moved(from, axis))))
    }

    fn point(&self, lattice: [u32; 3]) -> DVec3 {
        self.grid.point_at(DVec3::from_array(lattice.map(f64::from)))
    }

    /// The sides of a cell that it shares with none of the others.
    fn free_sides(&self, cell: [u32; 3]) -> impl Iterator<Item = Side> {
        (0..3).flat_map(move |across| {
            let [mut before, behind] = [cell, moved(cell, across)];
            before[across] = before[across].wrapping_sub(1);
            let sides = [(before, cell), (behind, behind)];
            sides.into_iter().filter(|(next, _)| !self.has(*next)).map(move |(_, low)| Side { low, across })
        })
    }

    fn has(&self, cell: [u32; 3]) -> bool {
        let inside = cell.iter().zip(self.grid.dimensions).all(|(at, count)| *at < count);
        inside && self.indices.binary_search(&self.grid.linear(cell)).is_ok()
    }

    /// Whether the outer face of a cell's side is seen.
    fn faces(&self, cell: [u32; 3], side: Side, eye: DVec3) -> bool {
        let [a, b, c, d] = side.corners().map(|corner| self.point(corner));
        let middle = self.grid.point_at(DVec3::from_array(cell.map(f64::from)) + 0.5);
        let normal = (d - a).cross(c - b);
        let outwards = normal * normal.dot(a - middle).signum();
        let towards = eye - a;
        outwards.dot(towards) > EDGE_ON * outwards.length() * towards.length()
    }
}

impl Side {
    /// The axes along which it lies.
    fn along(self) -> [usize; 2] {
        [(self.across + 1) % 3, (self.across + 2) % 3]
    }

    /// The second and the third are neighbours of the first, and of the last.
    fn corners(self) -> [[u32; 3]; 4] {
        let [one, other] = self.along();
        [self.low, moved(self.low, one), moved(self.low, other), moved(moved(self.low, one), other)]
    }

    fn edges(self) -> [Edge; 4] {
        let [one, other] = self.along();
        let [a, b, c, _] = self.corners();
        [(a, one), (a, other), (b, other), (c, one)]
    }
}

fn moved(mut point: [u32; 3], axis: usize) -> [u32; 3] {
    point[axis] += 1;
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{ClusterSpace, Frustum};
    use glam::DQuat;

    const BEYOND: DVec3 = DVec3::splat(100.0);

    /// Cubes of a metre.
    fn cubes() -> Grid {
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max: DVec3::splat(4.0) };
        Grid { pose: Pose::IDENTITY, space, dimensions: [4; 3] }
    }

    /// Each tile 1 wide and high in tangents, slices from 1, 2, 4 and 8 m on; somewhere in the world.
    fn tiles() -> Grid {
        let frustum = Frustum { x0: -2.0, x1: 2.0, y0: -2.0, y1: 2.0, z0: -16.0, z1: -1.0 };
        let pose = Pose {
            rotation: DQuat::from_rotation_y(2.0),
            ..Pose::from_position(DVec3::new(70.0, -9.0, 4.0))
        };
        Grid { pose, space: ClusterSpace::geometric(frustum, 1.0), dimensions: [4; 3] }
    }

    /// What is seen from a place in clustering space.
    fn edges(grid: &Grid, cells: &[[u32; 3]], eye: DVec3) -> Vec<(DVec3, DVec3)> {
        let mut indices: Vec<u32> = cells.iter().map(|cell| grid.linear(*cell)).collect();
        indices.sort_unstable();
        Cells { grid, indices: &indices }.outline(grid.pose.transform_point(eye)).collect()
    }

    fn count(cells: &[[u32; 3]], eye: DVec3) -> usize {
        edges(&cubes(), cells, eye).len()
    }

    #[test]
    fn cells_share_edges_and_hide_the_sides_between_them() {
        assert_eq!(count(&[[3, 1, 2]], BEYOND), 9, "three sides of a cube");
        assert_eq!(count(&[[3, 1, 2]], -BEYOND), 9);
        assert_eq!(count(&[[0; 3], [0, 0, 1]], BEYOND), 14);
        assert_eq!(count(&[[0; 3], [2; 3]], BEYOND), 18, "apart they share none");
        let all: Vec<_> = (0..64).map(|index| cubes().cluster_at(index)).collect();
        assert_eq!(count(&all, BEYOND), 3 * (5 + 4) * 4, "three sides of 4 x 4 squares");
        assert_eq!(count(&all, DVec3::new(2.0, 2.0, 100.0)), 40, "one side, seen straight on");
        assert_eq!(count(&all, DVec3::splat(2.0)), 0, "nothing faces who is inside");
        let hollow: Vec<_> = all.into_iter().filter(|cell| *cell != [1; 3]).collect();
        assert_eq!(count(&hollow, DVec3::splat(1.5)), 12, "but for what is hollow");
    }

    #[test]
    fn edges_lie_along_the_sides_that_are_seen() {
        for (grid, eye) in [(cubes(), BEYOND), (tiles(), DVec3::new(50.0, 60.0, 0.0))] {
            let (corners, lines) = (grid.cell_corners([1, 0, 2]), edges(&grid, &[[1, 0, 2]], eye));
            for (from, to) in &lines {
                assert!(corners.contains(from) && corners.contains(to), "{from} {to}");
            }
            let seen = |corner: &DVec3| lines.iter().any(|(from, to)| from == corner || to == corner);
            let unseen: Vec<_> = corners.into_iter().filter(|corner| !seen(corner)).collect();
            assert_eq!((lines.len(), unseen.len()), (9, 1), "{unseen:?}");
            assert_eq!(
                unseen[0],
                corners.into_iter().max_by(|a, b| a.distance(eye).total_cmp(&b.distance(eye))).unwrap()
            );
        }
    }

    #[test]
    fn the_eye_of_a_grid_sees_the_near_sides_alone() {
        let lines = edges(&tiles(), &[[2, 1, 1], [2, 1, 2], [3, 3, 3]], DVec3::ZERO);
        let depths: Vec<_> = lines.iter().flat_map(|(from, to)| [-from.z, -to.z]).collect();
        assert_eq!(lines.len(), 8);
        assert!(
            depths.iter().all(|depth| (depth - 2.0).abs() < 1e-9 || (depth - 8.0).abs() < 1e-9),
            "{depths:?}"
        );
    }
}
