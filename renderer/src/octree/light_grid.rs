//! The grid of deepest cells around one light (Tegelaers section 7.1.2): which of them its ball fills.
//!
//! All cells begin filled. From the eight corners on, those that the ball does not meet are emptied, neighbour after
//! neighbour: half of them, for a ball fills 52 % of its cube. What lies farther out than an empty cell is empty, so that
//! the corners reach all of them.
//!
//! The thesis prints the low corner as its index times the radius (it is times the cell's edge), and the test of a cell
//! with the arguments of its clamp exchanged and the comparison turned around.

use super::ball::Ball;
use glam::UVec3;

/// A cube of deepest cells, a bit each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct LightGrid {
    /// Its lowest cell.
    low: UVec3,
    /// Cells along an axis.
    side: u32,
    filled: Vec<u64>,
}

impl LightGrid {
    /// Cells of the grid around a ball, filled or not.
    pub fn size(ball: &Ball) -> u64 {
        let (low, high) = ball.grid();
        u64::from((high - low).max_element() + 1).saturating_pow(3)
    }

    /// The grid around a ball, with the cells that it meets filled.
    pub fn new(ball: &Ball) -> Self {
        let (low, high) = ball.grid();
        let side = (high - low).max_element() + 1;
        let words = (side as usize).pow(3).div_ceil(64);
        let mut grid = Self { low, side, filled: vec![u64::MAX; words] };
        let last = side - 1;
        let corner = |corner: u32| UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2) * last;
        let mut open: Vec<UVec3> = (0..8).map(corner).collect();
        while let Some(cell) = open.pop() {
            if grid.is_filled(cell) && !ball.meets(low + cell) {
                grid.empty(cell);
                open.extend(neighbours(cell, last));
            }
        }
        grid
    }

    /// The filled cells, in the octree's coordinates.
    pub fn cells(&self) -> impl Iterator<Item = UVec3> {
        let side = self.side;
        let rows = (0..side).flat_map(move |z| (0..side).map(move |y| (y, z)));
        let cells = rows.flat_map(move |(y, z)| (0..side).map(move |x| UVec3::new(x, y, z)));
        cells.filter(|cell| self.is_filled(*cell)).map(|cell| self.low + cell)
    }

    fn is_filled(&self, cell: UVec3) -> bool {
        let (word, bit) = self.bit(cell);
        self.filled[word] & bit != 0
    }

    fn empty(&mut self, cell: UVec3) {
        let (word, bit) = self.bit(cell);
        self.filled[word] &= !bit;
    }

    fn bit(&self, cell: UVec3) -> (usize, u64) {
        let side = self.side as usize;
        let at = cell.x as usize + side * (cell.y as usize + side * cell.z as usize);
        (at / 64, 1 << (at % 64))
    }
}

/// The cells that share a face with one, in a cube of cells up to `last`.
fn neighbours(cell: UVec3, last: u32) -> impl Iterator<Item = UVec3> {
    UVec3::AXES.into_iter().flat_map(move |axis| {
        let below = (cell.dot(axis) > 0).then(|| cell - axis);
        let above = (cell.dot(axis) < last).then(|| cell + axis);
        below.into_iter().chain(above)
    })
}
