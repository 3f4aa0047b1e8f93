//! Which lights may meet a visible cluster, and in which cells: the candidates of hierarchy and scatter.

use super::Visible;
use crate::assign::block_size;
use crate::geometry::{ClusterSpace, Grid, LightVolume, Plane, SphereTest};
use crate::gpu_interface::BLOCK_COLUMNS;
use glam::DVec3;
use std::collections::BTreeSet;

/// Cells from `low` to `high`, both included; empty where `low` is beyond `high` on some axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellRange {
    /// Lowest index on each axis.
    pub low: [u32; 3],
    /// Highest cell of the range, on each axis.
    pub high: [u32; 3],
}

impl CellRange {
    /// The least range that holds all `cells`.
    pub fn around(cells: impl Iterator<Item = [u32; 3]>) -> Self {
        cells.fold(Self { low: [u32::MAX; 3], high: [0; 3] }, |Self { low, high }, cell| Self {
            low: std::array::from_fn(|axis| low[axis].min(cell[axis])),
            high: std::array::from_fn(|axis| high[axis].max(cell[axis])),
        })
    }

    /// Whether the two share a cell.
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    fn is_empty(&self) -> bool {
        (0..3).any(|axis| self.low[axis] > self.high[axis])
    }
}

/// A light that may meet a visible cluster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Candidate {
    /// Index of the light in the frame.
    pub light: u32,
    /// The cells that it may meet.
    pub cells: CellRange,
}

/// Lights that are left once those that reach nothing visible are dropped.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CulledLights {
    /// Lights that may meet a visible cluster, ascending.
    pub candidates: Vec<Candidate>,
    /// Lights, ascending, of which f32 may decide otherwise: whether they are candidates, or of which cells.
    pub borderline: Vec<u32>,
}

/// Blocks of clusters that hold something visible.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Blocks {
    size: [u32; 3],
    occupied: BTreeSet<[u32; 3]>,
    visible: CellRange,
}

/// Which blocks of `grid` hold `visible` clusters (linear indices).
pub fn mark_blocks(grid: &Grid, visible: &[u32]) -> Blocks {
    let size = block_size(grid.dimensions);
    let cells = || visible.iter().map(|&cluster| grid.cluster_at(cluster));
    let occupied = cells().map(|cell| block_of(cell, size)).collect();
    Blocks { size, occupied, visible: CellRange::around(cells()) }
}

fn block_of(cell: [u32; 3], size: [u32; 3]) -> [u32; 3] {
    std::array::from_fn(|axis| cell[axis] / size[axis])
}

impl Blocks {
    /// The device's words: a word a column with a bit a block along z, for all columns, then for columns joined two by
    /// two, and so on down to one; then the highest visible cell, and the lowest with all bits turned.
    pub fn words(&self) -> Vec<u32> {
        let mut words = vec![];
        for level in 0..=BLOCK_COLUMNS.ilog2() {
            let side = BLOCK_COLUMNS >> level;
            let first = words.len();
            words.resize(first + (side * side) as usize, 0u32);
            for &[x, y, z] in &self.occupied {
                words[first + ((x >> level) + side * (y >> level)) as usize] |= 1 << z;
            }
        }
        words.extend(self.visible.high);
        words.extend(self.visible.low.map(|index| !index));
        words
    }

    /// Whether something visible lies in the blocks of `cells`, or in those joined with them at the level where the cells
    /// take at most two columns each way.
    fn may_hold_visible(&self, cells: &CellRange) -> bool {
        let (low, high) = (block_of(cells.low, self.size), block_of(cells.high, self.size));
        let span = (high[0] - low[0]).max(high[1] - low[1]);
        let level = (0..).find(|level| span <= 1 << level).unwrap_or(0);
        self.occupied.iter().any(|block| {
            (0..2).all(|axis| (low[axis] >> level..=high[axis] >> level).contains(&(block[axis] >> level)))
                && (low[2]..=high[2]).contains(&block[2])
        })
    }
}

/// Culls lights by their `volumes`, slack included, as the device has them.
///
/// `epsilon` is how small a margin makes a light borderline, in metres and in cells.
pub fn cull_lights(
    visible: &Visible,
    volumes: &[LightVolume],
    test: SphereTest,
    epsilon: f64,
) -> CulledLights {
    let blocks = mark_blocks(visible.grid, visible.clusters);
    let bounds = RangeTest::new(visible.grid, &blocks.visible, test);
    let (mut candidates, mut borderline) = (vec![], vec![]);
    for (light, volume) in (0u32..).zip(volumes) {
        let margin = bounds.margin(volume);
        let Near { cells, close } = cells_near(visible.grid, volume, test, epsilon);
        if margin >= 0.0 && !cells.is_empty() && blocks.may_hold_visible(&cells) {
            candidates.push(Candidate { light, cells });
        }
        if margin.abs() < epsilon || close {
            borderline.push(light);
        }
    }
    CulledLights { candidates, borderline }
}

/// All visible clusters together, as one body with planes: most lights lie outside of it.
struct RangeTest {
    planes: [Plane; 6],
    /// Whether the side planes meet in the apex.
    perspective: bool,
    bounded: bool,
}

/// How much the device grows radii before it asks for a whole range, in parts of the coordinates.
const RANGE_ROUNDING: f64 = 4e-6;

/// Spheres nearer to the apex than this, in radii, are not cut by planes through it.
const APEX_RADII: f64 = 1.05;

impl RangeTest {
    fn new(grid: &Grid, range: &CellRange, test: SphereTest) -> Self {
        let perspective = matches!(grid.space, ClusterSpace::Perspective { .. });
        let bounded = test.is_bounded(!perspective);
        let empty = CellRange { low: [0; 3], high: [0; 3] };
        let CellRange { low, high } = if range.is_empty() { empty } else { *range };
        if is_boxed(grid, test) {
            return Self { planes: box_planes(grid.range_bounds(low, high)), perspective: false, bounded };
        }
        let (first, last) = (grid.cell_planes(low), grid.cell_planes(high));
        let outer = |plane: usize| {
            if first[plane].offset > last[plane].offset { first[plane] } else { last[plane] }
        };
        let planes = [first[0], last[1], first[2], last[3], outer(4), outer(5)];
        Self { planes, perspective, bounded }
    }

    /// Margin in metres: below 0 where no cell of the range can be met.
    fn margin(&self, &LightVolume { centre, radius, .. }: &LightVolume) -> f64 {
        if !self.bounded {
            return f64::INFINITY;
        }
        let at_apex = self.perspective && -centre.z < APEX_RADII * radius;
        let asked = if at_apex { &self.planes[4..] } else { &self.planes[..] };
        let grown = radius + RANGE_ROUNDING * (centre.abs().element_sum() + radius);
        asked.iter().map(|plane| plane.distance(centre) + grown).fold(f64::INFINITY, f64::min)
    }
}

/// Whether boxes around the pieces of a frustum are tested.
fn is_boxed(grid: &Grid, test: SphereTest) -> bool {
    matches!(grid.space, ClusterSpace::Perspective { .. }) && test == SphereTest::Box
}

/// The sides of a box from one corner to the opposite one.
fn box_planes((low, high): (DVec3, DVec3)) -> [Plane; 6] {
    let side =
        |axis: usize, sign: f64, at: f64| Plane { normal: sign * DVec3::AXES[axis], offset: -sign * at };
    std::array::from_fn(|place| match place % 2 {
        0 => side(place / 2, 1.0, low[place / 2]),
        _ => side(place / 2, -1.0, high[place / 2]),
    })
}

/// Cells near a light.
struct Near {
    cells: CellRange,
    /// Whether an end of them is so close to where a cell begins that f32 may round to another.
    close: bool,
}

/// The device widens ranges by this at both ends, in cells.
const MARGIN: f64 = 0.02;

/// The cells whose planes, moved out by the radius of the bounding sphere, hold its centre, widened as on the device.
fn cells_near(grid: &Grid, volume: &LightVolume, test: SphereTest, epsilon: f64) -> Near {
    let &LightVolume { centre, radius, .. } = volume;
    let perspective = matches!(grid.space, ClusterSpace::Perspective { .. });
    let mut near = Near {
        cells: CellRange { low: [0; 3], high: grid.dimensions.map(|count| count - 1) },
        // Around this depth side planes begin to cut.
        close: perspective && !is_boxed(grid, test) && (-centre.z - APEX_RADII * radius).abs() < epsilon,
    };
    if !test.is_bounded(!perspective) {
        near.close = false;
        return near;
    }
    // How far boxes reach across depends on the depths between which they lie.
    for axis in [2, 0, 1] {
        let ends = match grid.space {
            ClusterSpace::Perspective { slices, .. } if axis == 2 => {
                let slice = |depth: f64| slices.clamped_coordinate_of(depth);
                let [_, step] = slices.on_device();
                let error = 1e-4 / step;
                Some([slice(-centre.z - radius) - error, slice(-centre.z + radius) + error])
            }
            ClusterSpace::Perspective { frustum, .. } => {
                let first = if axis == 0 { frustum.x0 } else { frustum.y0 };
                let scale = f64::from(grid.dimensions[axis]) / frustum.size()[axis];
                let tangents = match is_boxed(grid, test) {
                    true => box_tangents(centre[axis], radius, near.depths(grid)),
                    false => silhouette(centre[axis], -centre.z, radius),
                };
                tangents.map(|tangents| {
                    let error = 1e-4 * scale * (1.0 + tangents[0].abs().max(tangents[1].abs()));
                    [(tangents[0] - first) * scale - error, (tangents[1] - first) * scale + error]
                })
            }
            ClusterSpace::Orthographic { min, max } => {
                let count = f64::from(grid.dimensions[axis]);
                let scale = count / (max - min)[axis];
                let error = 1e-5 * (min[axis].abs() * scale + count);
                let at = |place: f64| (place - min[axis]) * scale;
                Some([at(centre[axis] - radius) - error, at(centre[axis] + radius) + error])
            }
        };
        let Some([low, high]) = ends else { continue };
        near.cut(axis, low - MARGIN, high + MARGIN, epsilon);
    }
    near
}

/// The tangents, across one axis, of the two lines through the apex that touch a sphere; `None` where it is too near to
/// the apex.
fn silhouette(across: f64, depth: f64, radius: f64) -> Option<[f64; 2]> {
    (depth >= APEX_RADII * radius).then(|| {
        let square = depth * depth - radius * radius;
        let reach = radius * (across * across + square).sqrt();
        [across * depth - reach, across * depth + reach].map(|tangent| tangent / square)
    })
}

/// The tangents, across one axis, between which cells have boxes that a sphere reaches somewhere between two depths; `None` where
/// these begin at the eye.
fn box_tangents(across: f64, radius: f64, [nearest, farthest]: [f64; 2]) -> Option<[f64; 2]> {
    let (low, high) = (across - radius, across + radius);
    (nearest > 0.0).then(|| {
        [low / if low < 0.0 { nearest } else { farthest }, high / if high < 0.0 { farthest } else { nearest }]
    })
}

impl Near {
    /// The depths between which the cells of a perspective grid lie.
    fn depths(&self, grid: &Grid) -> [f64; 2] {
        let mut planes = vec![];
        grid.slice_planes(&mut planes);
        let plane = |number: u32| f64::from(planes[number.min(grid.dimensions[2]) as usize]);
        [plane(self.cells.low[2]), plane(self.cells.high[2] + 1)]
    }

    /// Cuts one axis to what lies between two continuous cell coordinates.
    fn cut(&mut self, axis: usize, low: f64, high: f64, epsilon: f64) {
        let count = f64::from(self.cells.high[axis] + 1);
        // What lies outside the grid altogether leaves an empty range.
        self.cells.low[axis] = low.floor().clamp(0.0, count + 1.0) as u32;
        if high < 0.0 {
            (self.cells.low[axis], self.cells.high[axis]) = (1, 0);
        } else {
            self.cells.high[axis] = high.floor().min(count - 1.0) as u32;
        }
        self.close |= [low, high]
            .into_iter()
            .any(|end| (-epsilon..count + epsilon).contains(&end) && (end - end.round()).abs() < epsilon);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::tests::{frustum_grid, row};
    use crate::geometry::CellTest;

    #[test]
    fn words_have_a_bit_for_every_block_on_every_level() {
        let blocks = mark_blocks(&row(16), &[3, 9]);
        let words = blocks.words();
        assert_eq!(words.len() as u32, crate::gpu_interface::BLOCK_WORDS);
        let set: Vec<usize> = (0..341).filter(|&word| words[word] != 0).collect();
        assert_eq!(set, [3, 9, 256 + 1, 256 + 4, 320, 320 + 2, 336, 336 + 1, 340]);
        assert_eq!(words[341..], [9, 0, 0, !3, !0, !0]);
    }

    #[test]
    fn lights_near_nothing_visible_are_dropped() {
        let grid = row(16);
        let visible = Visible { grid: &grid, clusters: &[3, 9] };
        let at = |x: f64, radius: f64| LightVolume::sphere(DVec3::new(x, 0.5, 0.5), radius);
        let volumes = [at(3.5, 0.1), at(6.5, 0.2), at(12.5, 1.0), at(11.0, 1.5), at(6.5, 2.6), at(-5.0, 1.0)];
        let culled = cull_lights(&visible, &volumes, SphereTest::Box, 1e-4);
        let lights: Vec<u32> = culled.candidates.iter().map(|candidate| candidate.light).collect();
        assert_eq!(lights, [0, 3, 4]);
        assert_eq!(culled.candidates[1].cells, CellRange { low: [9, 0, 0], high: [12, 0, 0] });
    }

    #[test]
    fn a_light_that_meets_a_cluster_has_it_among_its_cells() {
        let grid = frustum_grid();
        let clusters: Vec<u32> = (0..grid.cluster_count() as u32).collect();
        let visible = Visible { grid: &grid, clusters: &clusters };
        for step in 0..200u32 {
            let turn = f64::from(step);
            let centre = DVec3::new(9.0 * turn.sin(), 6.0 * (1.7 * turn).cos(), 2.0 - 0.4 * turn);
            let radius = 0.2 + 3.0 * (0.9 * turn).sin().abs();
            let volume = LightVolume::sphere(centre, radius);
            for test in [SphereTest::HALF_SPACES, SphereTest::Box] {
                let culled = cull_lights(&visible, &[volume], test, 1e-4);
                for &cluster in &clusters {
                    let cell = grid.cluster_at(cluster);
                    if CellTest::new(test, &grid, cell).margin(&volume) >= 0.0 {
                        let cells = culled.candidates.first().expect("it is a candidate").cells;
                        assert!(
                            cells.overlaps(&CellRange { low: cell, high: cell }),
                            "{cell:?} of {cells:?}"
                        );
                    }
                }
            }
        }
    }
}
