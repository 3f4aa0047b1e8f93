//! Cells of a grid as the lines on the surface of what they fill together.

use crate::geometry::Grid;
use glam::DVec3;

/// An edge of cells, between two points of the grid's lattice that are neighbours along an axis.
type Edge = ([u32; 3], usize);

/// Cells around an edge inside the grid.
const AROUND: usize = 4;

/// The edges of some cells of a grid (their linear indices, each once) but for those that they surround, each once: ends in
/// clustering space, metres, by ascending place in the lattice.
pub fn outline(grid: &Grid, cells: &[u32]) -> impl Iterator<Item = (DVec3, DVec3)> {
    let point = |[x, y, z]: [u32; 3]| grid.point_at(DVec3::new(x.into(), y.into(), z.into()));
    let edges = surface(cells.iter().map(|&cell| grid.cluster_at(cell)));
    edges.into_iter().map(move |(from, axis)| (point(from), point(moved(from, axis, 1))))
}

/// The edges that are of fewer cells than could be around them.
fn surface(cells: impl Iterator<Item = [u32; 3]>) -> Vec<Edge> {
    let mut edges: Vec<Edge> = cells.flat_map(edges_of).collect();
    edges.sort_unstable();
    let alike = edges.chunk_by(|a, b| a == b);
    alike.filter(|cells| cells.len() < AROUND).map(|cells| cells[0]).collect()
}

/// The twelve edges of a cell: four along each axis.
fn edges_of(cell: [u32; 3]) -> impl Iterator<Item = Edge> {
    (0..3).flat_map(move |axis| {
        let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[a, b]| (moved(moved(cell, one, a), other, b), axis))
    })
}

fn moved(mut point: [u32; 3], axis: usize, by: u32) -> [u32; 3] {
    point[axis] += by;
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ClusterSpace;
    use crate::geometry::views::Pose;

    fn cells(low: [u32; 3], size: u32) -> Vec<[u32; 3]> {
        let axis = move |axis: usize| low[axis]..low[axis] + size;
        axis(0).flat_map(|x| axis(1).flat_map(move |y| axis(2).map(move |z| [x, y, z]))).collect()
    }

    fn edges(cells: &[[u32; 3]]) -> usize {
        surface(cells.iter().copied()).len()
    }

    #[test]
    fn cells_share_edges_and_hide_those_that_they_surround() {
        assert_eq!(edges(&[[3, 1, 4]]), 12);
        assert_eq!(edges(&[[0; 3], [0, 0, 1]]), 20, "side by side they share four");
        assert_eq!(edges(&[[0; 3], [1, 1, 0]]), 23, "across an edge they share it");
        assert_eq!(edges(&[[0; 3], [1; 3]]), 24, "at a corner they share none");
        // Of a cube of 3 cells a side, 4 x 4 edges of 3 parts an axis; of these 2 x 2 lie inside.
        assert_eq!(edges(&cells([5, 0, 2], 3)), 3 * 3 * (4 * 4 - 2 * 2));
        let hollow: Vec<_> = cells([0; 3], 3).into_iter().filter(|cell| *cell != [1; 3]).collect();
        assert_eq!(edges(&hollow), 3 * (3 * 4 * 4 - 2 * 2 * 2), "what lies within is seen through");
    }

    #[test]
    fn edges_lie_along_the_sides_of_their_cells() {
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max: DVec3::new(6.0, 4.0, 10.0) };
        let grid = Grid { pose: Pose::IDENTITY, space, dimensions: [3, 2, 5] };
        let cell = [1, 0, 3];
        let lines: Vec<_> = outline(&grid, &[grid.linear(cell)]).collect();
        let corners = grid.cell_corners(cell);
        assert_eq!(lines.len(), 12);
        for (from, to) in lines {
            assert!(corners.contains(&from) && corners.contains(&to), "{from} {to}");
            assert_eq!((to - from).to_array().iter().filter(|side| **side > 0.0).count(), 1);
        }
    }
}
