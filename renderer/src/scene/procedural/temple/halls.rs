//! The nave and the sanctuary.

use glam::Vec3;

use super::super::architecture::{Arch, entablature};
use super::super::maths::{Place, mix, sin_cos};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::architecture::vault_bay;
use super::{BAY, COLUMN, FLOOR, HIGH_FLOOR, ROW, Site, WALL, floor, stairs, things};

/// Bays of each hall.
const BAYS: u32 = 8;
/// Height of a hall's walls over its floor.
const WALL_HEIGHT: f32 = 9.2;
/// The nave's gate, to the north.
const GATE: f32 = 50.0;
/// Between nave and sanctuary.
const CHANCEL: f32 = GATE - BAY * BAYS as f32;
/// The sanctuary's far end.
const END: f32 = -18.0;
/// Half the thickness of the cross walls.
const CROSS_WALL: f32 = 0.5;

impl Site<'_> {
    /// Builds from the gate to the stairs of the sanctuary.
    pub(super) fn nave(&mut self) {
        let detail = self.detail;
        for tile in floor([-WALL, CHANCEL], [WALL, GATE], FLOOR, Surface::Flags, detail) {
            self.add(tile);
        }
        self.arcades(GATE, FLOOR, aisle_ceiling);
        let vault = self.builder.model(vault_bay(ROW, 5.0, detail));
        for k in 0..BAYS {
            let place = Place::at(0.0, FLOOR + WALL_HEIGHT, GATE - BAY * k as f32);
            self.builder.place(&vault, &place);
        }
        self.nave_roof();
        self.cross_wall(GATE, FLOOR, Arch { half: 3.4, spring: 4.6, band: 0.5 });
        self.cross_wall(CHANCEL, FLOOR, Arch { half: 4.4, spring: 4.2, band: 0.5 });
        self.add(stairs([-5.0, 5.0], [HIGH_FLOOR, 16.8], [FLOOR, 20.2], detail));
        self.add(things::pool([-1.7, 26.0], [1.7, 40.0], FLOOR, detail));
        for z in [25.0, 41.0] {
            self.builder.put(&self.models.brazier, [-2.9, FLOOR, z], 0.1);
        }
        for k in 0..BAYS {
            let z = GATE - BAY * (k as f32 + 0.5);
            for side in [-1.0_f32, 1.0] {
                let turns = f64::from(side) * -0.25;
                self.builder.put(&self.models.banner, [side * (ROW + 0.3), FLOOR + 7.6, z], turns);
                if k % 2 == 1 {
                    self.builder.put(&self.models.brazier, [side * 10.4, FLOOR, z], 0.0);
                }
            }
        }
    }

    /// Columns, their beams, side walls and aisles of a hall that starts at `z0`; `cover` makes what lies over
    /// an aisle's bay, given its side, z and height.
    fn arcades(&mut self, z0: f32, y: f32, cover: fn(f32, f32, f32) -> Chunk) {
        let detail = self.detail;
        let beam = self.builder.model(entablature(BAY, 0.62, WALL_HEIGHT - COLUMN, detail));
        for k in 0..BAYS {
            let z = z0 - BAY * k as f32;
            for side in [-1.0_f32, 1.0] {
                if k > 0 {
                    self.builder.put(&self.models.tall, [side * ROW, y, z], 0.0);
                }
                let along = Place::along(Vec3::new(side * ROW, y + COLUMN, z), [0.0, -1.0]);
                self.builder.place(&beam, &along);
                let (start, along) = if side < 0.0 { (z, [0.0, -1.0]) } else { (z - BAY, [0.0, 1.0]) };
                let place = Place::along(Vec3::new(side * WALL, y, start), along);
                self.builder.place(&self.models.window_bay, &place);
                self.add(cover(side, z, y + WALL_HEIGHT));
            }
        }
        let length = BAY * BAYS as f32;
        for side in [-1.0_f32, 1.0] {
            let middle = Vec3::new(side * (WALL + 0.3), y, z0 - length / 2.0);
            self.add(self.retaining_wall(middle, length, -side));
        }
    }

    /// A wall across a hall at `z`, up to the roof's gable.
    fn cross_wall(&mut self, z: f32, y: f32, arch: Arch) {
        let (half, base) = (WALL + 0.3, y + WALL_HEIGHT);
        let wall = arch.wall([half, WALL_HEIGHT], 2.0 * CROSS_WALL, Surface::TempleWall, self.detail);
        self.builder.add(wall, &Place::at(0.0, y, z));
        let ridge = Vec3::new(0.0, base + 6.8, CROSS_WALL);
        let right = Vec3::new(half, base, CROSS_WALL);
        let back = Vec3::Z * (-2.0 * CROSS_WALL);
        let mut side = Mesh::default();
        side.polygon(&[Vec3::new(-half, base, CROSS_WALL), right, ridge], [Vec3::X, Vec3::Y]);
        side.rect(right, [back, ridge - right], [1, 1], [z, 0.0]);
        side.rect(right - Vec3::Y * (base + 0.6), [back, Vec3::Y * (base + 0.6)], [1, 1], [z, -0.6]);
        let low = Vec3::new(-half, -0.6, CROSS_WALL);
        side.rect(low, [Vec3::X * (2.0 * half), Vec3::Y * (y + 0.6)], [1, 1], [-half, -0.6]);
        let mut chunk = Chunk::default();
        for turns in [0.0, 0.5] {
            chunk.on(Surface::TempleWall).append(&side, &Place::at(0.0, 0.0, z).turned(turns));
        }
        let disc = Place::at(0.0, base + 2.6, z + CROSS_WALL).tilted(0.25);
        let mut sun = Mesh::default();
        let segments = self.detail.around(1.0, 16);
        sun.lathe(&[[1.3, 0.0], [1.3, 0.12], [1.0, 0.2], [0.9, 0.12], [0.0, 0.16]], segments, false);
        chunk.on(Surface::Gold).append(&sun, &disc);
        self.add(chunk);
    }

    /// Tiled slopes over the nave, in pieces.
    fn nave_roof(&mut self) {
        const PIECES: u32 = 4;
        let length = (GATE - CHANCEL + 2.0) / PIECES as f32;
        let (eaves, ridge) = (FLOOR + WALL_HEIGHT - 0.1, FLOOR + WALL_HEIGHT + 7.2);
        for k in 0..PIECES {
            let z = GATE + 1.0 - length * k as f32;
            for side in [-1.0_f32, 1.0] {
                let corner = Vec3::new(side * (WALL + 1.0), eaves, if side > 0.0 { z } else { z - length });
                let up = Vec3::new(-side * (WALL + 1.0), ridge - eaves, 0.0);
                let axes = [Vec3::Z * (-side * length), up];
                let cells = [self.detail.cells(length * 0.6), self.detail.cells(9.0)];
                let mut chunk = Chunk::default();
                chunk.on(Surface::RoofTiles).relief(corner, axes, cells, [corner.z, 0.0], |[u, _]| {
                    let wave = u * 2.5 - (u * 2.5).floor() - 0.5;
                    0.08 * (0.25 - wave * wave)
                });
                self.add(chunk);
            }
        }
    }

    /// Builds from the top of the stairs to the arch of the cloister, under a dome.
    pub(super) fn sanctuary(&mut self) {
        let detail = self.detail;
        for tile in floor([-WALL, END - CROSS_WALL], [WALL, 16.8], HIGH_FLOOR, Surface::Mosaic, detail) {
            self.add(tile);
        }
        self.arcades(CHANCEL - 0.4, HIGH_FLOOR, aisle_terrace);
        self.cross_wall(END, HIGH_FLOOR, Arch { half: 4.0, spring: 4.6, band: 0.5 });
        self.dome(Vec3::new(0.0, HIGH_FLOOR + WALL_HEIGHT, -1.0));
        let mut plinth = Chunk::default();
        let steps = [
            [1.5, 0.0],
            [1.5, 0.3],
            [1.2, 0.3],
            [1.2, 0.6],
            [0.95, 0.7],
            [0.95, 1.3],
            [1.05, 1.4],
            [0.0, 1.4],
        ];
        plinth.on(Surface::Marble).lathe(&steps, detail.around(1.2, 16), false);
        self.builder.add(plinth, &Place::at(0.0, HIGH_FLOOR, -2.5));
        self.builder.put(&self.models.statue, [0.0, HIGH_FLOOR + 1.4, -2.5], 0.0);
        for (x, z) in [(-3.6, 2.0), (-3.6, -7.0), (-10.2, 8.0), (10.2, 8.0), (-10.2, -9.0), (10.2, -9.0)] {
            self.builder.put(&self.models.brazier, [x, HIGH_FLOOR, z], 0.0);
        }
        for k in (0..BAYS).step_by(2) {
            let z = CHANCEL - 0.4 - BAY * (k as f32 + 0.5);
            self.builder.put(&self.models.banner, [-ROW - 0.3, HIGH_FLOOR + 7.6, z], 0.25);
            self.builder.put(&self.models.banner, [ROW + 0.3, HIGH_FLOOR + 7.6, z], -0.25);
            self.builder.put(&self.models.vines, [11.6, HIGH_FLOOR + 9.0, z - 2.1], -0.25);
        }
    }

    /// Ceiling with a round hole, drum with windows, dome inside and out; `centre` at the ceiling.
    fn dome(&mut self, centre: Vec3) {
        let detail = self.detail;
        let segments = detail.around(3.2, 24);
        let (radius, near, far) = (6.6, CHANCEL - centre.z, centre.z - END);
        let mut chunk = Chunk::default();
        // From the hole to the rectangle of the hall: seen from below, and again as the terrace above.
        let corners = [[ROW, -far], [-ROW, -far], [-ROW, near], [ROW, near], [ROW, -far]];
        for ends in corners.windows(2) {
            for (surface, y, below) in [(Surface::TempleWall, 0.0, true), (Surface::Flags, 1.0, false)] {
                chunk.on(surface).surface([segments / 2, detail.cells(3.0)], |u, v| {
                    let edge = Vec3::new(mix(ends[0][0], ends[1][0], u), y, mix(ends[0][1], ends[1][1], u));
                    let hole = (edge - Vec3::Y * y).normalize() * radius + Vec3::Y * y;
                    let p = hole + (edge - hole) * if below { v } else { 1.0 - v };
                    (p, [p.x, p.z])
                });
            }
        }
        chunk.on(Surface::Screen).lathe(&[[radius + 0.15, 1.0], [radius + 0.15, 2.4]], segments, true);
        let ring = [
            [radius - 0.2, 0.0],
            [radius + 0.4, 0.0],
            [radius + 0.5, 1.2],
            [radius + 0.1, 1.2],
            [radius - 0.2, 0.9],
            [radius - 0.2, 0.0],
        ];
        chunk.on(Surface::Marble).lathe(&ring, segments, false);
        let cap = 2.4;
        let shell = |r: f32, from: f64| -> Vec<[f32; 2]> {
            let rows = detail.around(0.6, 6);
            (0..=rows)
                .map(|k| {
                    let (sin, cos) = sin_cos((from + (1.0 - from) * f64::from(k) / f64::from(rows)) * 0.25);
                    [r * cos, cap + r * sin]
                })
                .map(|[r, y]| [if r < 1e-3 { 0.0 } else { r }, y])
                .collect()
        };
        chunk.on(Surface::RoofTiles).lathe(&shell(radius + 0.6, 0.0), segments, true);
        let mut inner = shell(radius, 0.0);
        inner.reverse();
        chunk.on(Surface::Gold).lathe(&inner, segments, true);
        let rim = [
            [radius, cap - 0.02],
            [radius + 0.75, cap - 0.02],
            [radius + 0.75, cap + 0.3],
            [radius + 0.5, cap + 0.4],
        ];
        chunk.on(Surface::Marble).lathe(&rim, segments, false);
        let finial = [[0.9, 0.0], [0.8, 0.5], [0.3, 0.7], [0.3, 1.2], [0.5, 1.5], [0.3, 1.9], [0.0, 2.6]];
        let top = cap + radius + 0.5;
        chunk.on(Surface::Gold).lathe(&finial.map(|[r, y]| [r, top + y]), detail.around(0.6, 8), true);
        self.builder.add(chunk, &Place::at(centre.x, centre.y, centre.z));
    }
}

/// The x between which an aisle lies.
fn aisle(side: f32) -> [f32; 2] {
    let (inner, outer) = (side * ROW, side * (WALL + 0.3));
    [inner.min(outer), inner.max(outer)]
}

/// Ceiling of an aisle's bay that starts at `z`, with its beams.
fn aisle_ceiling(side: f32, z: f32, y: f32) -> Chunk {
    let mut chunk = Chunk::default();
    let [low, high] = aisle(side);
    let axes = [Vec3::X * (high - low), Vec3::Z * BAY];
    chunk.on(Surface::TempleWall).rect(Vec3::new(low, y, z - BAY), axes, [1, 1], [low, z]);
    for x in [ROW + 1.4, WALL - 1.4] {
        let half = Vec3::new(0.15, 0.0, BAY / 2.0);
        let middle = Vec3::new(side * x, y, z - BAY / 2.0);
        chunk.on(Surface::Wood).block(middle - half - Vec3::Y * 0.25, middle + half, true);
    }
    chunk
}

/// [`aisle_ceiling`] with a flat roof and its fascia over it.
fn aisle_terrace(side: f32, z: f32, y: f32) -> Chunk {
    let mut chunk = aisle_ceiling(side, z, y);
    let [low, high] = aisle(side);
    let axes = [Vec3::X * (high - low), Vec3::Z * -BAY];
    chunk.on(Surface::Flags).rect(Vec3::new(low, y + 1.0, z), axes, [1, 1], [low, z]);
    let end = Vec3::new(high, y, z - BAY);
    chunk.on(Surface::Marble).rect(end, [Vec3::X * (low - high), Vec3::Y], [1, 1], [low, y]);
    let outer = side * (WALL + 0.3);
    let start = Vec3::new(outer, y, if side > 0.0 { z } else { z - BAY });
    chunk.on(Surface::Marble).rect(start, [Vec3::Z * (-side * BAY), Vec3::Y], [1, 1], [z, y]);
    chunk
}
