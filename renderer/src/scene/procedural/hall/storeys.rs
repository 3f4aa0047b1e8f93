//! Arcades, galleries and outer walls.

use glam::Vec3;

use super::super::Detail;
use super::super::architecture::{Arch, column, entablature};
use super::super::maths::Place;
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::ceiling::{groin_vault, soffit};
use super::{
    AISLE, BAY, COARSE, EAVES, FINE, FIRST, Hall, LIGHT, MEDIUM, SECOND, SIDES, SILL, THICK, dressed,
};

/// Height of the ground floor's columns.
const COLUMN: f32 = 3.2;
/// Height of the first gallery's columns.
const UPPER_COLUMN: f32 = 2.25;
/// Height of the beam over the second gallery's columns.
const BEAM: f32 = 0.5;
/// Height of the cornice that each storey ends with.
const CORNICE: f32 = 0.22;
/// Height of the galleries' railings.
const RAIL: f32 = 1.0;

impl Hall {
    /// Columns with what they bear, storey by storey around the nave.
    pub(super) fn arcades(&mut self) {
        let columns = [
            (0.0, dressed(column(&FINE, COLUMN, 0.42), Surface::Marble)),
            (FIRST, dressed(column(&MEDIUM, UPPER_COLUMN, 0.25), Surface::Porphyry)),
            (SECOND, slender_column(EAVES - SECOND - BEAM)),
        ];
        let beam = dressed(entablature(BAY, 0.28, BEAM, &COARSE), Surface::Limestone);
        let bays = [
            (COLUMN, arcade(Arch { half: 1.22, spring: 0.14, band: 0.36 }, FIRST - COLUMN, &LIGHT)),
            (FIRST, balustrade()),
            (
                FIRST + UPPER_COLUMN,
                arcade(Arch { half: 1.3, spring: 0.1, band: 0.22 }, SECOND - FIRST - UPPER_COLUMN, &LIGHT),
            ),
            (SECOND, railing()),
            (EAVES - BEAM, beam),
        ];
        for (y, chunk) in columns.into_iter().chain(bays) {
            let model = self.builder.model(chunk);
            for side in &SIDES {
                for x in side.bays() {
                    self.builder.place(&model, &side.place(x, y, 0.0));
                }
            }
        }
    }

    /// Vaults over the aisles, floors and ceilings of the galleries.
    pub(super) fn galleries(&mut self) {
        let vaults = [
            self.builder.model(groin_vault([BAY, AISLE[0]])),
            self.builder.model(groin_vault([BAY, AISLE[1]])),
            self.builder.model(groin_vault([AISLE[1], AISLE[0]])),
        ];
        for side in &SIDES {
            let vault = &vaults[usize::from(side.bays < 4)];
            for x in side.bays() {
                self.builder.place(vault, &side.place(x, COLUMN, 0.0));
            }
            for [x, _] in side.corners() {
                self.builder.place(&vaults[2], &side.place(x, COLUMN, 0.0));
            }
            for [x, length] in side.pieces() {
                let size = [length, side.depth];
                self.builder.add(paved(size), &side.place(x, FIRST, 0.0));
                self.builder.add(planked(size), &side.place(x, SECOND, 0.0));
                let mut ceiling = Chunk::default();
                soffit(ceiling.on(Surface::Wood), size, 0.0);
                self.builder.add(ceiling, &side.place(x, EAVES, 0.0));
            }
        }
    }

    /// Outer walls: a niche, a tall window, a small window over one another in each bay, and plain corners.
    pub(super) fn walls(&mut self) {
        let bay = self.builder.model(wall_bay());
        let corner = self.builder.model(plain_wall(AISLE[1] + THICK));
        for side in &SIDES {
            for x in side.bays() {
                self.builder.place(&bay, &side.place(x, 0.0, -side.depth));
            }
            for [x, _] in side.corners() {
                let x = if x < 0.0 { x - THICK } else { x };
                self.builder.place(&corner, &side.place(x, 0.0, -side.depth));
            }
        }
        // Behind the corners of the long sides the short ones need walls too.
        let end = self.builder.model(plain_wall(AISLE[0]));
        for side in SIDES.iter().filter(|side| side.bays < 4) {
            for x in [-AISLE[0], side.bays as f32 * BAY] {
                self.builder.place(&end, &side.place(x, 0.0, -side.depth));
            }
        }
    }
}

/// A column without ornament that stands on the origin.
fn slender_column(height: f32) -> Chunk {
    let mut chunk = Chunk::default();
    let profile = [
        [0.24, 0.0],
        [0.24, 0.12],
        [0.2, 0.16],
        [0.22, 0.24],
        [0.15, 0.32],
        [0.145, height * 0.5],
        [0.125, height - 0.36],
        [0.16, height - 0.32],
        [0.13, height - 0.28],
        [0.22, height - 0.1],
        [0.26, height - 0.08],
        [0.26, height],
    ];
    chunk.on(Surface::Marble).lathe(&profile, 14, false);
    chunk
}

/// A bay of an arcade on its columns, from x 0 to [`BAY`]: wall with an arch, `height` high with its cornice.
fn arcade(arch: Arch, height: f32, detail: &Detail) -> Chunk {
    let half = BAY / 2.0;
    let mut chunk = Chunk::default();
    let wall = arch.wall([half, height - CORNICE], THICK, Surface::Limestone, detail);
    chunk.append(&wall, &Place::at(half, 0.0, 0.0));
    let (face, top) = (THICK / 2.0, height);
    let section = [
        [face, top - CORNICE],
        [face + 0.05, top - 0.2],
        [face + 0.07, top - 0.14],
        [face + 0.18, top - 0.08],
        [face + 0.22, top - 0.05],
        [face + 0.22, top],
        [face, top + 0.002],
    ];
    let mut cornice = Mesh::default();
    cornice.moulding(&section, [0.0, BAY], 1);
    chunk.on(Surface::Limestone).append(&cornice, &Place::at(0.0, 0.0, 0.0));
    // Its underside beside the columns, which are narrower than the wall.
    let foot = [[-half, -arch.half], [arch.half, half]];
    for [x0, x1] in foot {
        let corner = Vec3::new(half + x0, 0.0, -face);
        chunk.on(Surface::Limestone).rect(corner, [Vec3::X * (x1 - x0), Vec3::Z * THICK], [1, 1], [0.0, 0.0]);
    }
    dressed(chunk, Surface::Limestone)
}

/// Balusters between plinth and rail, from x 0 to [`BAY`].
fn balustrade() -> Chunk {
    const COUNT: u32 = 8;
    let mut chunk = Chunk::default();
    let stone = chunk.on(Surface::Marble);
    stone.block(Vec3::new(0.0, 0.0, -0.14), Vec3::new(BAY, 0.14, 0.14), false);
    stone.block(Vec3::new(0.0, RAIL - 0.14, -0.13), Vec3::new(BAY, RAIL - 0.1, 0.13), true);
    stone.block(Vec3::new(0.0, RAIL - 0.1, -0.17), Vec3::new(BAY, RAIL, 0.17), true);
    let profile = [
        [0.07, 0.14],
        [0.07, 0.19],
        [0.045, 0.22],
        [0.085, 0.36],
        [0.08, 0.42],
        [0.04, 0.58],
        [0.04, 0.7],
        [0.06, 0.76],
        [0.06, RAIL - 0.14],
    ];
    let mut baluster = Mesh::default();
    baluster.lathe(&profile, 8, true);
    let (first, last) = (0.42, BAY - 0.42);
    for k in 0..COUNT {
        let x = first + (last - first) * k as f32 / (COUNT - 1) as f32;
        stone.append(&baluster, &Place::at(x, 0.0, 0.0));
    }
    chunk
}

/// Four panels of wrought iron between two columns, from x 0 to [`BAY`].
fn railing() -> Chunk {
    let mut chunk = Chunk::default();
    for k in 0..4 {
        let width = (BAY - 0.3) / 4.0;
        let corner = Vec3::new(0.15 + width * k as f32, 0.02, 0.0);
        chunk.on(Surface::Railing).panel(corner, [Vec3::X * width, Vec3::Y * (RAIL - 0.06)]);
    }
    chunk
}

/// The floor of a gallery, from the face of its arcade into the openings of the wall: `size` (along x, towards -z).
fn gallery_floor(mesh: &mut Mesh, [length, depth]: [f32; 2]) {
    let front = Vec3::new(0.0, 0.0, THICK / 2.0);
    let axes = [Vec3::X * length, Vec3::Z * -(depth + SILL + THICK / 2.0)];
    mesh.rect(front, axes, [FINE.cells(length), FINE.cells(depth)], [0.0, 0.0]);
}

/// The floor of the first gallery.
fn paved(size: [f32; 2]) -> Chunk {
    let mut chunk = Chunk::default();
    gallery_floor(chunk.on(Surface::Flags), size);
    chunk
}

/// The floor of the second gallery with its handrail, and the ceiling of the first one with its joists.
fn planked([length, depth]: [f32; 2]) -> Chunk {
    let mut chunk = Chunk::default();
    let wood = chunk.on(Surface::Wood);
    gallery_floor(wood, [length, depth]);
    soffit(wood, [length, depth], -0.24);
    // The corners have no railing.
    if length > AISLE[1] {
        wood.block(Vec3::new(0.0, RAIL - 0.05, -0.06), Vec3::new(length, RAIL, 0.06), true);
    }
    chunk
}

/// A bay of the outer wall from x 0 to [`BAY`], its inner face at z = 0.
fn wall_bay() -> Chunk {
    let half = BAY / 2.0;
    let storeys = [
        (0.0, FIRST, Arch { half: 1.05, spring: 1.9, band: 0.3 }),
        (FIRST, SECOND, Arch { half: 0.8, spring: 2.1, band: 0.26 }),
        (SECOND, EAVES, Arch { half: 0.6, spring: 1.5, band: 0.2 }),
    ];
    let mut stone = Chunk::default();
    let mut glass = Mesh::default();
    for (low, high, arch) in storeys {
        let wall = arch.wall([half, high - low], THICK, Surface::Limestone, &COARSE);
        stone.append(&wall, &Place::at(half, low, -THICK / 2.0));
        let back = if low == 0.0 { -0.5 } else { -0.35 };
        let pane = if low == 0.0 { stone.on(Surface::Limestone) } else { &mut glass };
        pane_of(&arch, pane, &Place::at(half, low, back));
    }
    let mut chunk = dressed(stone, Surface::Limestone);
    *chunk.on(Surface::StainedGlass) = glass;
    chunk
}

/// What closes an arch's opening: a plate whose texture is as large as metres make it.
fn pane_of(arch: &Arch, mesh: &mut Mesh, place: &Place) {
    let mut pane = Mesh::default();
    let at = |x: f32, y: f32| (Vec3::new(x, y, 0.0), [0.5 * x, 0.5 * y]);
    let foot = arch.outline(0.0);
    pane.surface([1, 1], |u, v| at(foot[0] * (1.0 - 2.0 * u), arch.spring * v));
    pane.surface([1, 6], |u, v| {
        let [x, y] = arch.outline(1.0 + 0.5 * v);
        at(x * (1.0 - 2.0 * u), y)
    });
    mesh.append(&pane, place);
}

/// A wall without openings from x 0 to `length`, its inner face at z = 0.
fn plain_wall(length: f32) -> Chunk {
    let mut chunk = Chunk::default();
    let stone = chunk.on(Surface::Limestone);
    let cells = [MEDIUM.cells(length), MEDIUM.cells(EAVES)];
    let up = Vec3::Y * EAVES;
    stone.rect(Vec3::ZERO, [Vec3::X * length, up], cells, [0.0, 0.0]);
    stone.rect(Vec3::new(length, 0.0, -THICK), [Vec3::X * -length, up], cells, [0.0, 0.0]);
    chunk
}
