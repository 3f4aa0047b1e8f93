//! Shells: between which slices the mesh around each light lies, tile by tile (Örtegren and Persson section 4.3).
//!
//! ```text
//! light's mesh, view space ─┬─ eye_is_inside ─────────────────> from slice 0 on
//!                           └─ each triangle: depths_in_tile ─> slices ─(least, greatest)─> SliceRange of (light, tile) ─fill─> lists
//! ```
//!
//! What of a mesh lies in a tile is a convex solid: its depths are extreme at its corners, which are vertices of the mesh in the
//! tile, edges through a side of the tile, triangles through an edge of the tile, and the eye. So every triangle tells its part,
//! in any order, whether it faces the eye or not. Unlike other twins this one is in single precision, step for step as
//! `lib/shell.glsl` has them: the device gets the same bits.

use crate::geometry::{ClusterSpace, Grid, LightMesh};
use crate::gpu_interface::{GridData, MeshFrame};
use glam::{Vec2, Vec3, Vec4};

/// What rounding may cost of a sum or a product, in parts of the coordinates that are in it.
const ROUNDING: f32 = 1e-6;

/// The slices in which a light's mesh lies in one tile, from the first to the last.
///
/// Two halves that only fall where ranges join: the first slice, and how many slices lie behind the last. All ones, which is no
/// slice, says that nothing reaches that far.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SliceRange(u32);

impl SliceRange {
    /// No slices.
    pub const EMPTY: Self = Self(u32::MAX);

    /// Of a mesh around the eye: it begins before whatever else is found.
    const FROM_THE_EYE: Self = Self(u32::MAX << 16);

    /// A half of which nothing is known.
    const NONE: u32 = 0xFFFF;

    const fn new(first: u32, behind: u32) -> Self {
        Self(first | behind << 16)
    }

    /// The slices of both, and those between.
    pub fn joined(self, other: Self) -> Self {
        let (a, b) = (self.halves(), other.halves());
        Self::new(a[0].min(b[0]), a[1].min(b[1]))
    }

    const fn halves(self) -> [u32; 2] {
        [self.0 & Self::NONE, self.0 >> 16]
    }

    /// The first and the last slice of `count`; `None` where there are none.
    pub fn slices(self, count: u32) -> Option<[u32; 2]> {
        let [first, behind] = self.halves();
        (first != Self::NONE && behind != Self::NONE).then(|| [first, count - 1 - behind])
    }

    /// As two channels of eight bits: exact of up to 255 slices.
    pub fn to_bytes(self) -> [u8; 2] {
        self.halves().map(|half| half.min(0xFF) as u8)
    }

    /// Reads what [`SliceRange::to_bytes`] writes.
    pub fn from_bytes(bytes: [u8; 2]) -> Self {
        let [first, behind] = bytes.map(|byte| if byte == 0xFF { Self::NONE } else { byte.into() });
        Self::new(first, behind)
    }

    /// As the device has it: the first slice in the lower half.
    pub const fn to_word(self) -> u32 {
        self.0
    }
}

/// The tiles and slices of a perspective grid, as the device has them.
#[derive(Debug, Clone, Copy)]
pub struct ShellGrid<'a> {
    /// Dimensions and tangents.
    pub grid: &'a GridData,
    /// Depths between slices, metres: one more than there are slices.
    pub planes: &'a [f32],
}

/// Tangents of the sides of a tile.
#[derive(Debug, Clone, Copy)]
struct Tile {
    low: Vec2,
    high: Vec2,
}

impl ShellGrid<'_> {
    /// Number of tiles.
    pub fn tiles(&self) -> u32 {
        self.grid.dimensions[0] * self.grid.dimensions[1]
    }

    /// Number of slices.
    pub fn slices(&self) -> u32 {
        self.grid.dimensions[2]
    }

    fn tile(&self, tile: u32) -> Tile {
        let [x, y] = [tile % self.grid.dimensions[0], tile / self.grid.dimensions[0]];
        let tangents = |x: u32, y: u32| {
            let [origin_x, origin_y, _] = self.grid.origin;
            let [cell_x, cell_y, _] = self.grid.cell;
            Vec2::new(origin_x + cell_x * x as f32, origin_y + cell_y * y as f32)
        };
        Tile { low: tangents(x, y), high: tangents(x + 1, y + 1) }
    }

    /// The slice that holds a depth, or the nearest one: as `slice_of` of `lib/cluster_space.glsl`.
    fn slice_of(&self, depth: f32) -> u32 {
        let inner = &self.planes[1..self.planes.len() - 1];
        inner.partition_point(|&plane| plane <= depth) as u32
    }

    /// The slices between the least and the greatest depth that a triangle has in a tile.
    fn range_of(&self, [least, greatest]: [f32; 2]) -> SliceRange {
        let ends_in_front = greatest >= self.planes[0];
        let begins_before_far = least <= self.planes[self.planes.len() - 1];
        SliceRange::new(
            if begins_before_far { self.slice_of(least) } else { SliceRange::NONE },
            if ends_in_front { self.slices() - 1 - self.slice_of(greatest) } else { SliceRange::NONE },
        )
    }
}

/// Where a frame takes a vertex of its mesh's template, metres: as `placed_vertex` of `lib/light_mesh.glsl`.
pub fn placed(frame: &MeshFrame, vertex: Vec4) -> Vec3 {
    let [origin, x, y, z, tip] = [frame.origin, frame.x, frame.y, frame.z, frame.tip].map(Vec3::from);
    origin + x * vertex.x + y * vertex.y + z * vertex.z + tip * vertex.w
}

/// A light's mesh in the clustering camera's space.
#[derive(Debug, Clone, Copy)]
pub struct ViewMesh<'a> {
    /// Vertices, metres.
    pub vertices: &'a [Vec3],
    /// Vertices of each triangle, anticlockwise as seen from outside.
    pub triangles: &'a [[u16; 3]],
}

impl ViewMesh<'_> {
    fn corners(&self, triangle: &[u16; 3]) -> [Vec3; 3] {
        triangle.map(|vertex| self.vertices[usize::from(vertex)])
    }

    /// Whether the mesh is around the eye, or so near to it that rounding cannot tell.
    fn eye_is_inside(&self) -> bool {
        self.triangles.iter().all(|triangle| eye_is_behind(&self.corners(triangle)))
    }
}

/// A perspective grid as the device has it, as far as shells ask it, and the depths between its slices, metres; `None` of boxes.
pub fn shell_grid(grid: &Grid) -> Option<(GridData, Vec<f32>)> {
    let ClusterSpace::Perspective { frustum, .. } = grid.space else { return None };
    let [columns, rows, _] = grid.dimensions.map(f64::from);
    let mut planes = vec![];
    grid.slice_planes(&mut planes);
    let data = GridData {
        dimensions: grid.dimensions,
        origin: [frustum.x0 as f32, frustum.y0 as f32, 0.0],
        cell: [(frustum.size().x / columns) as f32, (frustum.size().y / rows) as f32, 0.0],
        ..Default::default()
    };
    Some((data, planes))
}

/// The slices of every tile, tile by tile, in which the mesh of a template lies where a frame places it.
pub fn placed_shell(grid: &ShellGrid, mesh: &LightMesh, frame: &MeshFrame) -> Vec<SliceRange> {
    let vertices: Vec<Vec3> = mesh.vertices.iter().map(|vertex| placed(frame, vertex.as_vec4())).collect();
    shell(grid, &ViewMesh { vertices: &vertices, triangles: &mesh.triangles })
}

/// The slices of every tile, tile by tile, in which a light's mesh lies.
pub fn shell(grid: &ShellGrid, mesh: &ViewMesh) -> Vec<SliceRange> {
    let start = start_of_shell(mesh);
    (0..grid.tiles()).map(|tile| in_tile(grid, mesh, start, tile)).collect()
}

/// The slices of one tile in which a light's mesh lies.
pub fn shell_of_tile(grid: &ShellGrid, mesh: &ViewMesh, tile: u32) -> SliceRange {
    in_tile(grid, mesh, start_of_shell(mesh), tile)
}

fn start_of_shell(mesh: &ViewMesh) -> SliceRange {
    if mesh.eye_is_inside() { SliceRange::FROM_THE_EYE } else { SliceRange::EMPTY }
}

fn in_tile(grid: &ShellGrid, mesh: &ViewMesh, start: SliceRange, tile: u32) -> SliceRange {
    let tile = grid.tile(tile);
    let found = mesh.triangles.iter().filter_map(|triangle| depths_in_tile(&mesh.corners(triangle), &tile));
    found.map(|depths| grid.range_of(depths)).fold(start, SliceRange::joined)
}

/// Sum of the coordinates' sizes: no length is greater.
fn size(vector: Vec3) -> f32 {
    vector.x.abs() + vector.y.abs() + vector.z.abs()
}

/// Whether the eye lies on the inner side of a triangle, or as near to its plane as rounding may have it.
fn eye_is_behind([a, b, c]: &[Vec3; 3]) -> bool {
    let (ab, ac) = (*b - *a, *c - *a);
    let slack = ROUNDING * size(ab) * size(ac) * size(*a);
    cross(ab, ac).dot(*a) >= -slack
}

/// As written out, so that it turns its sign, and nothing else, where the two change places.
fn cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y)
}

/// The least and the greatest of some depths, metres.
#[derive(Debug, Clone, Copy)]
struct Depths {
    least: f32,
    greatest: f32,
}

impl Depths {
    fn take(&mut self, depth: f32) {
        self.least = self.least.min(depth);
        self.greatest = self.greatest.max(depth);
    }
}

/// Least and greatest depth of what of a triangle lies in a tile, metres; `None` where nothing does.
///
/// Distances from the tile's sides count as inside by as much as rounding may have taken: what is taken in vain is
/// no farther outside than that. Where an edge of the tile leads through an edge that triangles share, it hits them both.
fn depths_in_tile(corners: &[Vec3; 3], tile: &Tile) -> Option<[f32; 2]> {
    let sides = corners.map(|corner| side_distances(corner, tile));
    let slack = ROUNDING * size_in_tile(corners, tile);
    if (0..4).any(|side| sides.iter().all(|of_corner| of_corner[side] < -slack)) {
        return None;
    }
    let mut found = Depths { least: f32::INFINITY, greatest: f32::NEG_INFINITY };
    for (corner, of_corner) in corners.iter().zip(&sides) {
        if of_corner.iter().all(|distance| *distance >= -slack) {
            found.take(-corner.z);
        }
    }
    for from in 0..3 {
        let to = (from + 1) % 3;
        let depths = [-corners[from].z, -corners[to].z];
        through_sides([&sides[from], &sides[to]], depths, slack, &mut found);
    }
    through_triangle(corners, tile, &mut found);
    (found.least <= found.greatest).then_some([found.least, found.greatest])
}

/// Distances from the sides of a tile, inwards: left, right, bottom, top; each in parts of the length of its normal.
fn side_distances(point: Vec3, tile: &Tile) -> [f32; 4] {
    let depth = -point.z;
    [
        point.x - tile.low.x * depth,
        tile.high.x * depth - point.x,
        point.y - tile.low.y * depth,
        tile.high.y * depth - point.y,
    ]
}

/// A size that no term of the distances exceeds.
fn size_in_tile(corners: &[Vec3; 3], tile: &Tile) -> f32 {
    let widest = tile.low.abs().max(tile.high.abs());
    let stretch = 1.0 + widest.x.max(widest.y);
    let sizes = corners.map(|corner| size(corner) * stretch);
    sizes[0].max(sizes[1]).max(sizes[2])
}

/// Takes the depths at which an edge leads through sides of the tile, between the two other sides.
fn through_sides([from, to]: [&[f32; 4]; 2], depths: [f32; 2], slack: f32, found: &mut Depths) {
    for side in 0..4 {
        if (from[side] < 0.0) == (to[side] < 0.0) {
            continue;
        }
        let along = from[side] / (from[side] - to[side]);
        let at = |ends: [f32; 2]| ends[0] + along * (ends[1] - ends[0]);
        let others = if side < 2 { [2, 3] } else { [0, 1] };
        if others.into_iter().all(|other| at([from[other], to[other]]) >= -slack) {
            found.take(at(depths));
        }
    }
}

/// Takes the depths at which the edges of the tile lead through the triangle.
fn through_triangle(&[a, b, c]: &[Vec3; 3], tile: &Tile, found: &mut Depths) {
    let normals = [cross(b, c), cross(c, a), cross(a, b)];
    for corner in 0..4 {
        let x = if corner & 1 == 0 { tile.low.x } else { tile.high.x };
        let y = if corner & 2 == 0 { tile.low.y } else { tile.high.y };
        // Three times the volume between the edge of the tile and each edge of the triangle: weights of the opposite corners.
        let [of_a, of_b, of_c] = normals.map(|normal| x * normal.x + y * normal.y - normal.z);
        let inside = of_a.min(of_b).min(of_c) >= 0.0 || of_a.max(of_b).max(of_c) <= 0.0;
        let sum = of_a + of_b + of_c;
        let depth = -(of_a * a.z + of_b * b.z + of_c * c.z) / sum;
        if inside && sum != 0.0 && depth > 0.0 {
            found.take(depth);
        }
    }
}

#[cfg(test)]
mod tests;
