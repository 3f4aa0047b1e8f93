//! The forecourt, the cloister and the garden.

use glam::Vec3;

use super::super::architecture::{courses, entablature};
use super::super::maths::{Dice, Place};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::{COLUMN, FLOOR, HIGH_FLOOR, Site, floor, stairs, things};

/// Height of the small columns of courts.
const LOW_COLUMN: f32 = 4.2;

impl Site<'_> {
    /// Between two rows of tall columns, from the stairs to the gate.
    pub(super) fn forecourt(&mut self) {
        let detail = self.detail;
        for tile in floor([-10.0, 50.0], [10.0, 76.0], FLOOR, Surface::Flags, detail) {
            self.add(tile);
        }
        self.add(stairs([-10.0, 10.0], [FLOOR, 76.0], [-0.05, 78.6], detail));
        for side in [-1.0_f32, 1.0] {
            self.add(self.retaining_wall(Vec3::new(side * 10.0, FLOOR, 63.0), 26.0, -side));
            let beam = self.builder.model(entablature(4.8, 0.62, 1.0, detail));
            for k in 0..6 {
                let z = 74.5 - 4.8 * k as f32;
                self.builder.put(&self.models.tall, [side * 6.0, FLOOR, z], 0.0);
                if k < 5 {
                    let place = Place::along(Vec3::new(side * 6.0, FLOOR + COLUMN, z), [0.0, -1.0]);
                    self.builder.place(&beam, &place);
                    let turns = f64::from(side) * -0.25;
                    self.builder.put(&self.models.banner, [side * 6.0, FLOOR + 7.4, z - 2.4], turns);
                    self.builder.put(&self.models.brazier, [side * 4.4, FLOOR, z - 2.4], 0.0);
                }
                self.builder.put(&self.models.cypress[k % 2], [side * 14.0, -0.2, z - 1.0], 0.1 * k as f64);
            }
        }
    }

    /// The outer face of a terrace, `length` long, whose upper edge's middle is given. It faces +x where
    /// `along` is -1, else -x.
    pub(super) fn retaining_wall(&self, middle: Vec3, length: f32, along: f32) -> Chunk {
        let mut chunk = Chunk::default();
        let height = middle.y + 0.6;
        let start = middle - Vec3::new(0.0, height, along * length / 2.0);
        let axes = [Vec3::Z * (along * length), Vec3::Y * height];
        let cells = [self.detail.cells(length), self.detail.cells(height)];
        chunk.on(Surface::TempleWall).relief(start, axes, cells, [0.0, 0.0], courses);
        chunk
    }

    /// A court open to the sky behind the sanctuary, with a walk on three sides.
    pub(super) fn cloister(&mut self) {
        const HALF: f32 = 9.0;
        const BACK: f32 = -42.0;
        let detail = self.detail;
        for tile in floor([-13.0, -46.0], [13.0, -18.0], FLOOR, Surface::Flags, detail) {
            self.add(tile);
        }
        self.add(stairs([-4.4, 4.4], [HIGH_FLOOR, -18.5], [FLOOR, -22.0], detail));
        self.builder.add(things::fountain(detail), &Place::at(0.0, FLOOR, -33.0));
        let beam = self.builder.model(entablature(3.0, 0.36, 0.7, detail));
        let walk = self.builder.model(self.walk_bay(3.0));
        for k in 0..8 {
            let z = -18.6 - 3.0 * k as f32;
            for (x, start, along) in [(-HALF, z, [0.0, -1.0]), (HALF, z - 3.0, [0.0, 1.0])] {
                self.builder.put(&self.models.low, [x, FLOOR, z - 3.0], 0.0);
                self.walk([x, start], along, [&beam, &walk]);
            }
        }
        for k in 0..6 {
            let x = -HALF + 3.0 * k as f32;
            self.builder.put(&self.models.low, [x, FLOOR, BACK - 0.6], 0.0);
            self.walk([x, BACK - 0.6], [1.0, 0.0], [&beam, &walk]);
        }
        self.builder.put(&self.models.low, [HALF, FLOOR, BACK - 0.6], 0.0);
        for (k, (x, z)) in [(-5.5, -27.0), (5.5, -27.0), (-5.5, -39.0), (5.5, -39.0)].into_iter().enumerate()
        {
            self.builder.put(&self.models.cypress[k % 2], [x, FLOOR, z], 0.2 * k as f64);
        }
        for x in [-6.5, -4.8, 4.8, 6.5] {
            self.builder.put(&self.models.planter, [x, FLOOR, -23.5], 0.0);
            self.builder.put(&self.models.planter, [x, FLOOR, -41.4], 0.3);
        }
        for (x, y) in [(-10.6, 7.6), (-8.2, 8.4), (-5.9, 8.9), (6.1, 8.8), (8.4, 8.1), (10.7, 7.4)] {
            self.builder.put(&self.models.vines, [x, FLOOR + y, -18.6], 0.5);
        }
    }

    /// A beam on columns with the walk behind it, at (x, z); the court to the right of `along`.
    fn walk(&mut self, [x, z]: [f32; 2], along: [f32; 2], models: [&super::super::builder::Model; 2]) {
        let place = Place::along(Vec3::new(x, FLOOR + LOW_COLUMN, z), along);
        for model in models {
            self.builder.place(model, &place);
        }
    }

    /// A bay of a covered walk: outer wall with a screen, ceiling and tiled roof, 4 m deep behind z = 0;
    /// y = 0 at the top of its columns.
    fn walk_bay(&self, length: f32) -> Chunk {
        let mut chunk = Chunk::default();
        let x = Vec3::X * length;
        let cells = [self.detail.cells(length), self.detail.cells(5.0)];
        let foot = -LOW_COLUMN;
        for (z, x0, across) in [(-3.7, 0.0, x), (-4.3, length, -x)] {
            let start = Vec3::new(x0, foot - 1.2, z);
            let axes = [across, Vec3::Y * (1.9 + 1.2 - foot)];
            chunk.on(Surface::TempleWall).relief(start, axes, cells, [0.0, 0.0], courses);
        }
        chunk.on(Surface::Wood).rect(Vec3::new(0.0, 0.7, -3.7), [x, Vec3::Z * 4.1], [1, 1], [0.0, 0.0]);
        let slope = Vec3::new(0.0, 1.6, -5.0);
        let cells = [self.detail.cells(length * 0.5), self.detail.cells(5.0)];
        chunk.on(Surface::RoofTiles).relief(
            Vec3::new(0.0, 0.6, 0.6),
            [x, slope],
            cells,
            [0.0, 0.0],
            |[u, _]| {
                let wave = u * 3.0 - (u * 3.0).floor() - 0.5;
                0.06 * (0.25 - wave * wave)
            },
        );
        chunk.on(Surface::Marble).rect(Vec3::new(length, 0.0, -4.4), [-x, Vec3::Y * 2.2], [1, 1], [0.0, 0.0]);
        chunk
            .on(Surface::Screen)
            .panel(Vec3::new(0.4, foot + 1.6, -3.66), [Vec3::X * (length - 0.8), Vec3::Y * 2.2]);
        chunk
    }

    /// A walled garden west of the nave: pool, pergola, trees.
    pub(super) fn garden(&mut self) {
        let detail = self.detail;
        for tile in floor([-34.0, -6.0], [-13.0, 34.0], 0.5, Surface::Flags, detail) {
            self.add(tile);
        }
        self.builder.add(things::pool([-24.0, 15.0], [-18.0, 29.0], 0.5, detail), &Place::at(0.0, 0.0, 0.0));
        self.builder.add(things::fountain(detail), &Place::at(-22.0, 0.5, 2.0));
        let beam = self.builder.model(entablature(3.0, 0.36, 0.7, detail));
        for k in 0..7 {
            let z = 32.0 - 3.0 * k as f32;
            for x in [-33.0, -29.0] {
                self.builder.put(&self.models.low, [x, 0.5, z], 0.0);
                if k < 6 {
                    let place = Place::along(Vec3::new(x, 0.5 + LOW_COLUMN, z), [0.0, -1.0]);
                    self.builder.place(&beam, &place);
                    self.builder.put(&self.models.vines, [x + 0.05, 0.5 + LOW_COLUMN, z - 1.5], 0.25);
                }
            }
            self.add(rafter([-33.6, -28.4], 5.4, z));
        }
        self.garden_wall();
        self.garden_plants();
    }

    /// The wall with screens at the garden's ends.
    fn garden_wall(&mut self) {
        for (z, turned) in [(34.0, true), (-6.0, false)] {
            for k in 0..7 {
                let mut chunk = Chunk::default();
                let wall = chunk.on(Surface::TempleWall);
                wall.block(Vec3::new(0.0, -0.4, -0.25), Vec3::new(3.0, 1.4, 0.25), false);
                wall.block(Vec3::new(0.0, 1.4, -0.3), Vec3::new(0.5, 3.6, 0.3), false);
                let screen = chunk.on(Surface::Screen);
                screen.panel(Vec3::new(0.5, 1.4, 0.0), [Vec3::X * 2.5, Vec3::Y * 1.9]);
                chunk.on(Surface::Marble).block(Vec3::new(0.0, 3.3, -0.32), Vec3::new(3.0, 3.6, 0.32), true);
                let x = -34.0 + 3.0 * k as f32;
                let place = Place::at(if turned { x + 3.0 } else { x }, 0.3, z);
                self.builder.add(chunk, &if turned { place.turned(0.5) } else { place });
            }
        }
    }

    fn garden_plants(&mut self) {
        let mut dice = Dice::new(77);
        for k in 0..9 {
            let z = 32.0 - 4.0 * k as f32;
            let turns = f64::from(dice.unit());
            self.builder.put(&self.models.cypress[k % 2], [-14.8, 0.3, z], turns);
            self.builder.put(&self.models.cypress[(k + 1) % 2], [-37.0, -0.3, z - 1.0], turns);
            self.builder.put(&self.models.cypress[k % 2], [17.0, -0.2, z + 4.0], turns);
        }
        for (x, z) in
            [(-25.4, 13.6), (-16.6, 13.6), (-25.4, 30.4), (-16.6, 30.4), (-18.0, 2.0), (-26.0, -2.0)]
        {
            self.builder.put(&self.models.planter, [x, 0.5, z], 0.0);
        }
        for (x, z, turns) in [(-21.0, 31.8, 0.5), (-21.0, -4.4, 0.0)] {
            self.builder.put(&self.models.statue, [x, 0.5, z], turns);
        }
        for (x, z) in [(-26.6, 22.0), (-15.9, 22.0), (-27.0, 6.0), (-17.0, 8.0)] {
            self.builder.put(&self.models.brazier, [x, 0.5, z], 0.0);
        }
    }
}

/// A wooden beam across a pergola.
fn rafter([x0, x1]: [f32; 2], y: f32, z: f32) -> Chunk {
    let mut beam = Mesh::default();
    for k in 0..3 {
        let z = z - 1.0 * k as f32;
        beam.block(Vec3::new(x0, y, z - 0.08), Vec3::new(x1, y + 0.22, z + 0.08), true);
    }
    let mut chunk = Chunk::default();
    chunk.on(Surface::Wood).append(&beam, &Place::at(0.0, 0.0, 0.0));
    chunk
}
