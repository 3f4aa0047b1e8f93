//! One house: what its parts agree on, and the walls that face no street.

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Dice, Place};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::{facade, roof};

/// Height of the ground floor, metres.
pub(super) const GROUND_FLOOR: f32 = 4.0;
/// Height of each storey above it.
pub(super) const STOREY: f32 = 3.15;
/// Most bays that share one chunk, so that parts of a long front can be culled.
const BAYS_PER_CHUNK: u32 = 6;

/// What a house looks like.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    /// Material of the front.
    pub(super) wall: Surface,
    /// Tint of the front.
    pub(super) tint: [u8; 3],
    /// Whether the ground floor is shops.
    pub(super) shops: bool,
    /// Whether windows have shutters.
    pub(super) shutters: bool,
    /// Tint of the awnings.
    pub(super) cloth: [u8; 3],
}

impl Style {
    /// A random style.
    pub(super) fn throw(dice: &mut Dice) -> Self {
        const TINTS: [[u8; 3]; 6] =
            [[255; 3], [250, 240, 222], [236, 214, 190], [226, 222, 214], [240, 205, 178], [214, 222, 224]];
        const CLOTHS: [[u8; 3]; 4] = [[190, 40, 36], [40, 92, 60], [46, 66, 120], [200, 140, 40]];
        let plastered = dice.chance(0.4);
        Self {
            wall: if plastered { Surface::Plaster } else { Surface::Limestone },
            tint: TINTS[dice.below(if plastered { 6 } else { 3 }) as usize],
            shops: dice.chance(0.7),
            shutters: plastered,
            cloth: CLOTHS[dice.below(4) as usize],
        }
    }
}

/// A house in its own space: x along its front from its left end, y up, z towards the street.
pub(super) struct House {
    /// Place of the left end of the house's front.
    pub(super) place: Place,
    /// Length of its front, metres.
    pub(super) width: f32,
    /// How far it reaches back.
    pub(super) depth: f32,
    /// How its left and right ends move along x for each metre of z (corners of a row).
    pub(super) mitre: [f32; 2],
    /// Storeys above the ground floor.
    pub(super) storeys: u32,
    /// Looks of the house.
    pub(super) style: Style,
    /// Seed of the house's own random choices.
    pub(super) seed: u64,
}

impl House {
    /// Height of the eaves.
    pub(super) fn height(&self) -> f32 {
        GROUND_FLOOR + STOREY * self.storeys as f32
    }

    /// Number of bays of its front.
    pub(super) fn bays(&self) -> u32 {
        (self.width / 2.7).round() as u32
    }

    /// The left (0) or right (1) end at depth `z`.
    pub(super) fn end(&self, side: usize, z: f32) -> f32 {
        self.width * side as f32 + self.mitre[side] * z
    }

    /// All its chunks, in its own space.
    pub(super) fn build(&self, detail: &Detail) -> Vec<Chunk> {
        let bays = self.bays();
        let count = bays.div_ceil(BAYS_PER_CHUNK);
        let mut chunks: Vec<Chunk> = (0..count)
            .map(|k| {
                let bays = bays * k / count..bays * (k + 1) / count;
                let mut chunk = facade::build(self, bays.clone(), detail);
                roof::front(self, bays, detail, &mut chunk);
                chunk
            })
            .collect();
        chunks.push(self.shell(detail));
        chunks
    }

    fn shell(&self, detail: &Detail) -> Chunk {
        let mut chunk = Chunk::default();
        roof::top(self, detail, &mut chunk);
        for side in [0, 1] {
            self.party_wall(side, chunk.on(Surface::Brick));
        }
        self.back(detail, &mut chunk);
        chunk
    }

    /// An end wall, up to the roof's outline.
    fn party_wall(&self, side: usize, mesh: &mut Mesh) {
        let top = self.height();
        let d = self.depth;
        let outline = [
            [-d, 0.0],
            [0.0, 0.0],
            [0.0, top],
            [-roof::SLOPE, top + roof::RISE],
            [-d / 2.0, top + roof::RIDGE],
            [roof::SLOPE - d, top + roof::RISE],
            [-d, top],
        ];
        let mut points: Vec<Vec3> =
            outline.iter().map(|[z, y]| Vec3::new(self.end(side, *z), *y, *z)).collect();
        let mut along = Vec3::Z;
        if side == 1 {
            points.reverse();
            along = -Vec3::Z;
        }
        mesh.polygon(&points, [along, Vec3::Y]);
    }

    /// The plain wall at the back, with rows of windows.
    fn back(&self, detail: &Detail, chunk: &mut Chunk) {
        let z = -self.depth;
        let (left, right) = (self.end(0, z), self.end(1, z));
        let width = right - left;
        let (u, v) = (-Vec3::X * width, Vec3::Y * self.height());
        let wall = chunk.on(Surface::Plaster);
        let first = wall.vertices.len();
        wall.rect(
            Vec3::new(right, 0.0, z),
            [u, v],
            [detail.cells(width / 2.0), detail.cells(v.y / 2.0)],
            [0.0; 2],
        );
        for vertex in &mut wall.vertices[first..] {
            let [r, g, b] = self.style.tint;
            vertex.color = [r, g, b, 255];
        }
        let mut dice = Dice::new(self.seed ^ 0xbac);
        let columns = (width / 3.2) as u32;
        for row in 0..=self.storeys {
            for column in 0..columns {
                let x = right - width * (column as f32 + 0.5) / columns as f32 + 0.5;
                let y = 1.0 + row as f32 * STOREY + if row > 0 { GROUND_FLOOR - STOREY } else { 0.0 };
                self.back_window(Vec3::new(x, y, z), dice.chance(0.3), detail, chunk);
            }
        }
    }

    fn back_window(&self, corner: Vec3, lit: bool, detail: &Detail, chunk: &mut Chunk) {
        let axes = [-Vec3::X, Vec3::Y * 1.7];
        let room = if lit { Surface::LitRoom } else { Surface::Room };
        chunk.on(room).panel(corner - Vec3::Z * 0.01, axes);
        chunk.on(Surface::Casement).panel(corner - Vec3::Z * 0.03, axes);
        if detail.level > 0 {
            let trim = chunk.on(Surface::Trim);
            let low = corner - Vec3::new(1.1, 0.12, 0.14);
            trim.block(low, low + Vec3::new(1.2, 0.12, 0.14), true);
            trim.block(low + Vec3::Y * 1.82, low + Vec3::new(1.2, 1.97, 0.14), true);
        }
    }
}
