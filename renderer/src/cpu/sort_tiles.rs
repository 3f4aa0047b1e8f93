//! Compaction by tiles: the visible clusters tile by tile, each tile's by ascending slice.

use super::scan;
use crate::geometry::Grid;

/// Visible clusters in the order of their tiles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TileClusters {
    /// Where the clusters of each tile begin in `clusters`, and last their number.
    pub offsets: Vec<u32>,
    /// Linear indices of the visible clusters.
    pub clusters: Vec<u32>,
}

/// Sorts the visible clusters of `grid`, by ascending index, by their tiles.
pub fn sort_tiles(grid: &Grid, visible: &[u32]) -> TileClusters {
    let tiles = grid.dimensions[0] * grid.dimensions[1];
    let mut clusters = visible.to_vec();
    clusters.sort_by_key(|cluster| (cluster % tiles, cluster / tiles));
    let counts: Vec<u32> = (0..tiles)
        .map(|tile| clusters.iter().filter(|&cluster| cluster % tiles == tile).count() as u32)
        .collect();
    TileClusters { offsets: scan(&counts), clusters }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::tests::frustum_grid;

    #[test]
    fn tiles_follow_each_other_with_ascending_slices() {
        let grid = frustum_grid();
        let at = |x, y, z| grid.linear([x, y, z]);
        let visible = [at(3, 0, 0), at(0, 0, 2), at(3, 0, 2), at(0, 1, 4), at(0, 0, 8)];
        let sorted = sort_tiles(&grid, &visible);
        assert_eq!(sorted.clusters, [at(0, 0, 2), at(0, 0, 8), at(3, 0, 0), at(3, 0, 2), at(0, 1, 4)]);
        assert_eq!((sorted.offsets.len(), sorted.offsets[35]), (36, 5));
        assert_eq!(sorted.offsets[..9], [0, 2, 2, 2, 4, 4, 4, 4, 5]);
    }
}
