//! The hall: a nave under a vault with openings to the sky, between aisles and two storeys of galleries.
//!
//! It is 37.2 m long (x), 22.9 m wide (z) and 15.6 m high, the size of Sponza's atrium, in which papers on many lights
//! measure; its middle lies over the origin, its floor at y = 0.
//!
//! ```text
//!   y 15.4        .---  ---.         crown of the coffered vault; every other bay is open
//!     12.4  _____/          \_____   beams
//!      9.2  |___|            |___|   second gallery: slender columns, railings of wrought iron
//!      5.2  |___|            |___|   first gallery: arches, balusters, drapes
//!      0    |___|____________|___|   aisles under groin vaults behind an arcade
//!   z    -10.75 -5.25      5.25 10.75
//! ```
//!
//! Arcades, aisles and galleries run around the nave: what stands there is placed by [`Side`].

mod ceiling;
mod storeys;
mod things;

use glam::Vec3;

use super::builder::Builder;
use super::maths::Place;
use super::mesh::Chunk;
use super::palette::Surface;
use super::{Detail, props};

/// Distance between columns.
const BAY: f32 = 3.5;
/// Floor of the first gallery.
const FIRST: f32 = 5.2;
/// Floor of the second gallery.
const SECOND: f32 = 9.2;
/// Foot of the vault, ceiling of the second gallery.
const EAVES: f32 = 12.4;
/// Half the nave's length and width, to the middle of its columns.
const NAVE: [f32; 2] = [14.0, 5.25];
/// Depth of the aisles along the nave and at its ends, to their walls.
const AISLE: [f32; 2] = [5.5, 3.9];
/// Thickness of walls.
const THICK: f32 = 0.7;
/// How far floors reach into the openings of the outer walls.
const SILL: f32 = 0.6;

/// Detail of what is large or near.
const FINE: Detail = Detail { step: 2.0, round: 60, leaves: 320, level: 1 };
/// Detail of what there is much of.
const MEDIUM: Detail = Detail { step: 2.0, round: 27, leaves: 140, level: 1 };
/// Detail of arches and their mouldings, of which there is most.
const LIGHT: Detail = Detail { step: 4.0, round: 13, leaves: 0, level: 1 };
/// Detail of what is seen from afar.
const COARSE: Detail = Detail { step: 4.0, round: 14, leaves: 60, level: 0 };

/// One of the four sides of the nave, in whose frame x runs along its columns, from the first one's middle on, and z points
/// into the nave.
struct Side {
    /// Middle of the first column, (x, z).
    start: [f32; 2],
    /// Direction of x in the world, (x, z).
    along: [f32; 2],
    /// How many bays there are.
    bays: u32,
    /// Depth of the aisle behind the columns.
    depth: f32,
}

const SIDES: [Side; 4] = [
    Side { start: [-NAVE[0], -NAVE[1]], along: [1.0, 0.0], bays: 8, depth: AISLE[0] },
    Side { start: [NAVE[0], -NAVE[1]], along: [0.0, 1.0], bays: 3, depth: AISLE[1] },
    Side { start: [NAVE[0], NAVE[1]], along: [-1.0, 0.0], bays: 8, depth: AISLE[0] },
    Side { start: [-NAVE[0], NAVE[1]], along: [0.0, -1.0], bays: 3, depth: AISLE[1] },
];

impl Side {
    /// The place at a point of the side's frame, with the frame's axes.
    fn place(&self, x: f32, y: f32, z: f32) -> Place {
        let [ax, az] = self.along;
        let origin = Vec3::new(self.start[0] + ax * x - az * z, y, self.start[1] + az * x + ax * z);
        Place::along(origin, self.along)
    }

    /// The x at which each bay begins.
    fn bays(&self) -> impl Iterator<Item = f32> + use<> {
        (0..self.bays).map(|k| k as f32 * BAY)
    }

    /// The aisle cut into pieces of whole bays: start and length along x. Those along the nave have the corners too.
    fn pieces(&self) -> Vec<[f32; 2]> {
        let length = self.bays as f32 * BAY;
        if self.bays < 4 {
            return vec![[0.0, length]];
        }
        let inner = (0..2).map(|k| [k as f32 * length / 2.0, length / 2.0]);
        self.corners().into_iter().chain(inner).collect()
    }

    /// The corners beside the bays, which belong to the long sides: start and length along x.
    fn corners(&self) -> Vec<[f32; 2]> {
        if self.bays < 4 {
            return vec![];
        }
        vec![[-AISLE[1], AISLE[1]], [self.bays as f32 * BAY, AISLE[1]]]
    }
}

/// The whole hall, ready to be finished.
pub(super) fn build() -> Builder {
    let mut hall = Hall::default();
    hall.floor();
    hall.arcades();
    hall.galleries();
    hall.walls();
    hall.vault();
    hall.furnish();
    hall.builder
}

/// The hall under construction.
#[derive(Default)]
struct Hall {
    builder: Builder,
}

impl Hall {
    /// Adds geometry given in world space.
    fn add(&mut self, chunk: Chunk) {
        self.builder.add(chunk, &Place::at(0.0, 0.0, 0.0));
    }

    /// Tiles in the nave, in two pieces, and slabs in the aisles.
    fn floor(&mut self) {
        let [half, wide] = NAVE;
        for x in [-half, 0.0] {
            let mut chunk = Chunk::default();
            let axes = [Vec3::X * half, Vec3::Z * (-2.0 * wide)];
            chunk.on(Surface::Chequers).rect(Vec3::new(x, 0.0, wide), axes, [8, 6], [x, -wide]);
            self.add(chunk);
        }
        for side in &SIDES {
            for [x, length] in side.pieces() {
                let mut chunk = Chunk::default();
                let axes = [Vec3::X * length, Vec3::Z * -(side.depth + SILL)];
                let cells = [FINE.cells(length), FINE.cells(side.depth)];
                chunk.on(Surface::Flags).rect(Vec3::new(x, 0.0, 0.0), axes, cells, [x, 0.0]);
                self.builder.add(chunk, &side.place(0.0, 0.0, 0.0));
            }
        }
    }

    /// What stands and hangs in the hall.
    fn furnish(&mut self) {
        self.drapes();
        self.lanterns();
        self.builder.add(things::fountain(&FINE), &Place::at(0.0, 0.0, 0.0));
        for (k, x) in [-8.75, 8.75].into_iter().enumerate() {
            let tree = self.builder.model(props::tree(&Detail { leaves: 500, ..MEDIUM }, 51 + k as u64));
            self.builder.place(&tree, &Place::at(x, 0.3, 0.0).scaled(1.25));
            self.add_bed(x);
        }
        let planters = [61, 62].map(|seed| self.builder.model(props::planter(&MEDIUM, seed)));
        let vase = self.builder.model(things::vase(&MEDIUM));
        for (k, x) in [-12.25, -5.25, 1.75, 8.75].into_iter().enumerate() {
            for side in [-1.0_f32, 1.0] {
                let place = Place::at(side * x, 0.0, side * 4.1).turned(0.13 * k as f64).scaled(1.35);
                self.builder.place(&planters[k % 2], &place);
                let place = Place::at(side * (x + 1.75), 0.0, side * 9.9).turned(0.3 * k as f64);
                self.builder.place(&vase, &place);
            }
        }
    }

    /// The stone kerb in which the tree at `x` stands.
    fn add_bed(&mut self, x: f32) {
        let mut chunk = Chunk::default();
        let kerb =
            [[1.5, 0.0], [1.5, 0.36], [1.56, 0.4], [1.56, 0.48], [1.2, 0.48], [1.2, 0.34], [0.0, 0.36]];
        chunk.on(Surface::Marble).lathe(&kerb, 8, false);
        self.builder.add(chunk, &Place::at(x, 0.0, 0.0).turned(1.0 / 16.0));
    }
}

/// A chunk that is all of one surface, and so one model.
fn dressed(chunk: Chunk, surface: Surface) -> Chunk {
    let mut all = Chunk::default();
    for (_, mesh) in chunk.into_parts() {
        all.on(surface).append(&mesh, &Place::at(0.0, 0.0, 0.0));
    }
    all
}
