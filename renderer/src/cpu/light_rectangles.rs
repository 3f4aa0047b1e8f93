//! Assignment by rectangles: the cells in which each light is seen, and the lists that follow.

use super::Visible;
use super::cull_lights::{Candidate, CellRange, CulledLights};
use crate::geometry::{ClusterSpace, Grid, LightVolume, ProjectedSphere};
use glam::DVec2;

/// The cells of a perspective grid in which each light is seen, by its rectangle of tiles and by its depths; lights without any are
/// left out. The `volumes` have their slack, as the device has them.
///
/// `epsilon` is how small a margin makes a light borderline: in cells across, in metres along the view.
pub fn light_rectangles(grid: &Grid, volumes: &[LightVolume], epsilon: f64) -> CulledLights {
    let seen = volumes.iter().map(|volume| rectangle(grid, volume, epsilon));
    let (mut candidates, mut borderline) = (vec![], vec![]);
    for (light, (cells, close)) in (0..).zip(seen) {
        candidates.extend(cells.map(|cells| Candidate { light, cells }));
        borderline.extend(close.then_some(light));
    }
    CulledLights { candidates, borderline }
}

/// The lights of each visible cluster, ascending: those whose cells it is among.
pub fn rectangles(visible: &Visible, seen: &[Candidate]) -> Vec<Vec<u32>> {
    let of_cell = |cell: [u32; 3]| {
        let cell = CellRange { low: cell, high: cell };
        seen.iter().filter(|light| light.cells.overlaps(&cell)).map(|light| light.light).collect()
    };
    visible.clusters.iter().map(|&cluster| of_cell(visible.grid.cluster_at(cluster))).collect()
}

/// The cells in which a light is seen, and whether that is too close to call.
fn rectangle(grid: &Grid, volume: &LightVolume, epsilon: f64) -> (Option<CellRange>, bool) {
    let ClusterSpace::Perspective { frustum, .. } = grid.space else { return (None, false) };
    let &LightVolume { centre, radius, .. } = volume;
    let depths = [-centre.z - radius, -centre.z + radius];
    let at_near = (depths[1] - frustum.near()).abs() < epsilon;
    let Some(seen) = ProjectedSphere::new(centre, radius, frustum.near()) else { return (None, at_near) };
    let tiles = DVec2::new(f64::from(grid.dimensions[0]), f64::from(grid.dimensions[1]));
    let place = |tangents: DVec2| (tangents - DVec2::new(frustum.x0, frustum.y0)) * tiles / frustum.size();
    let (low, high) = (place(seen.low), place(seen.high));
    let [x, y] = [0, 1].map(|axis| ends(low[axis], high[axis], grid.dimensions[axis], epsilon));
    let ranges = [x, y, slices(grid, depths, epsilon)];
    let is_there = ranges.iter().all(|(range, _)| range[0] <= range[1]);
    let end = |end: usize| ranges.map(|(range, _)| range[end] as u32);
    (is_there.then(|| CellRange { low: end(0), high: end(1) }), at_near || ranges.iter().any(|range| range.1))
}

/// Cells of an axis between two coordinates, and whether an end is close to where a cell begins.
fn ends(low: f64, high: f64, count: u32, epsilon: f64) -> ([i64; 2], bool) {
    let close = |end: f64| {
        let room = epsilon * (1.0 + end.abs());
        (end - end.round()).abs() < room && (-room..f64::from(count) + room).contains(&end)
    };
    let range = [(low.ceil() as i64 - 1).max(0), (high.floor() as i64).min(i64::from(count) - 1)];
    (range, close(low) || close(high))
}

/// Slices that have some of what lies between two depths.
fn slices(grid: &Grid, [nearest, farthest]: [f64; 2], epsilon: f64) -> ([i64; 2], bool) {
    let mut planes = vec![];
    grid.slice_planes(&mut planes);
    let planes: Vec<f64> = planes.into_iter().map(f64::from).collect();
    let first = planes[1..].partition_point(|&plane| plane < nearest);
    let behind = planes[..planes.len() - 1].partition_point(|&plane| plane <= farthest);
    let close = |plane: &f64| (plane - nearest).abs() < epsilon || (plane - farthest).abs() < epsilon;
    ([first as i64, behind as i64 - 1], planes.iter().any(close))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::tests::{frustum_grid, volumes};
    use crate::geometry::{CellTest, SphereTest};

    /// The lights of every cell are those whose test against it passes, cell by cell.
    #[test]
    fn rectangles_hold_what_the_test_lets_pass() {
        let (grid, volumes) = (frustum_grid(), volumes(300));
        let clusters: Vec<u32> = (0..grid.cluster_count() as u32).collect();
        let CulledLights { candidates, borderline } = light_rectangles(&grid, &volumes, 1e-6);
        assert_eq!(borderline, [0; 0]);
        let lists = rectangles(&Visible { grid: &grid, clusters: &clusters }, &candidates);
        for (cluster, list) in clusters.iter().zip(&lists) {
            let test = CellTest::new(SphereTest::Projected, &grid, grid.cluster_at(*cluster));
            let passing: Vec<u32> = (0..)
                .zip(&volumes)
                .filter(|(_, volume)| test.margin(volume) >= 0.0)
                .map(|(l, _)| l)
                .collect();
            assert_eq!(list, &passing, "cluster {cluster}");
        }
        assert!(lists.concat().len() > 1000);
    }

    #[test]
    fn what_lies_outside_has_no_cells() {
        let grid = frustum_grid();
        let beside = |x: f64, z: f64| LightVolume::sphere(glam::DVec3::new(x, 0.0, z), 1.0);
        let seen =
            light_rectangles(&grid, &[beside(30.0, -10.0), beside(0.0, 2.0), beside(0.0, -65.0)], 1e-6);
        assert_eq!((seen.candidates, seen.borderline), (vec![], vec![]));
    }
}
