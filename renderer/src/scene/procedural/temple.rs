//! The temple of the sun: where its halls, courts and gardens stand.
//!
//! ```text
//!   z  78  stairs        forecourt between two rows of columns
//!      50  gate ------   nave: arcades, barrel vault, a long pool        garden to the
//!      20  stairs -----  up to the sanctuary: statue under a dome        west, x -40..-13
//!     -18  arch -------  down to the cloister, open to the sky
//!     -46  back wall
//! ```

mod architecture;
mod courts;
mod halls;
mod things;

use glam::Vec3;

use super::architecture::column;
use super::builder::{Builder, Model};
use super::maths::{Place, noise};
use super::mesh::{Chunk, Mesh};
use super::palette::Surface;
use super::{Detail, Size, props};

/// Floor of forecourt, nave and cloister.
const FLOOR: f32 = 1.0;
/// Floor of the sanctuary.
const HIGH_FLOOR: f32 = 2.75;
/// Half the distance between the two rows of columns of a hall.
const ROW: f32 = 7.6;
/// Half the width of a hall, to the middle of its walls.
const WALL: f32 = 12.0;
/// Length of a bay of a hall.
const BAY: f32 = 4.2;
/// Height of a hall's columns.
const COLUMN: f32 = 8.0;

fn detail(size: Size) -> Detail {
    match size {
        Size::Small => Detail { step: 40.0, round: 10, leaves: 40, level: 0 },
        Size::Medium => Detail { step: 0.54, round: 26, leaves: 640, level: 1 },
        Size::Large => Detail { step: 0.2, round: 87, leaves: 3300, level: 2 },
    }
}

/// The site under construction and the models that it repeats.
struct Site<'a> {
    builder: Builder,
    detail: &'a Detail,
    models: Models,
}

/// Models that are placed many times.
struct Models {
    tall: Model,
    low: Model,
    brazier: Model,
    statue: Model,
    cypress: [Model; 2],
    planter: Model,
    window_bay: Model,
    banner: Model,
    vines: Model,
}

/// The whole temple, ready to be finished.
pub(super) fn build(size: Size) -> Builder {
    let detail = detail(size);
    let mut site = Site::new(&detail);
    site.meadow();
    site.forecourt();
    site.nave();
    site.sanctuary();
    site.cloister();
    site.garden();
    site.builder
}

impl<'a> Site<'a> {
    fn new(detail: &'a Detail) -> Self {
        let mut builder = Builder::default();
        let models = Models {
            tall: builder.model(column(detail, COLUMN, 0.62)),
            low: builder.model(column(detail, 4.2, 0.34)),
            brazier: builder.model(things::brazier(detail)),
            statue: builder.model(things::statue(detail)),
            cypress: [31, 32].map(|seed| builder.model(props::cypress(detail, seed))),
            planter: builder.model(props::planter(detail, 41)),
            window_bay: builder.model(architecture::window_bay(detail)),
            banner: builder.model(things::banner(detail)),
            vines: builder.model(things::vines(detail)),
        };
        Self { builder, detail, models }
    }

    /// Adds geometry given in world space.
    fn add(&mut self, chunk: Chunk) {
        self.builder.add(chunk, &Place::at(0.0, 0.0, 0.0));
    }

    /// Rolling ground around the temple, in tiles.
    fn meadow(&mut self) {
        const TILE: f32 = 12.0;
        for i in -4..3 {
            for j in -5..7 {
                let corner = Vec3::new(i as f32 * TILE, 0.0, j as f32 * TILE - 3.0);
                let centre = corner + Vec3::new(TILE, 0.0, TILE) * 0.5;
                let reach = centre.x + 6.0;
                if reach * reach / 900.0 + (centre.z - 12.0) * (centre.z - 12.0) / 4900.0 < 1.15 {
                    self.add(meadow_tile(corner, TILE, self.detail));
                }
            }
        }
    }
}

fn meadow_tile(corner: Vec3, side: f32, detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let cells = detail.cells(side).max(4);
    chunk.on(Surface::Meadow).surface([cells; 2], |u, v| {
        let (x, z) = (corner.x + side * u, corner.z + side * (1.0 - v));
        let hill = noise(x * 0.08, z * 0.08, 1 << 20, 5) - 0.6;
        let bump = noise(x * 0.9, z * 0.9, 1 << 20, 6) - 0.5;
        (Vec3::new(x, 0.5 * hill + 0.12 * bump - 0.05, z), [x, -z])
    });
    chunk
}

/// A paved floor: tiles of about 8 m between two corners, facing up, each its own chunk.
fn floor(low: [f32; 2], high: [f32; 2], y: f32, surface: Surface, detail: &Detail) -> Vec<Chunk> {
    let count = [0, 1].map(|axis| ((high[axis] - low[axis]) / 8.0).round().max(1.0) as u32);
    let side = [0, 1].map(|axis| (high[axis] - low[axis]) / count[axis] as f32);
    let mut tiles = Vec::new();
    for i in 0..count[0] {
        for j in 0..count[1] {
            let (x, z) = (low[0] + side[0] * i as f32, low[1] + side[1] * (j + 1) as f32);
            let mut chunk = Chunk::default();
            chunk.on(surface).surface([detail.cells(side[0]), detail.cells(side[1])], |u, v| {
                let (x, z) = (x + side[0] * u, z - side[1] * v);
                // Worn by feet, where the tessellation can show it.
                let worn = if detail.level == 0 { 0.0 } else { noise(x * 0.9, z * 0.9, 1 << 20, 7) };
                (Vec3::new(x, y - 0.015 * worn, z), [x, -z])
            });
            tiles.push(chunk);
        }
    }
    tiles
}

/// Steps from `high` (y, z of the upper edge) down to `low`, between two x.
fn stairs(x: [f32; 2], high: [f32; 2], low: [f32; 2], detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let count = ((high[0] - low[0]) / 0.175).round() as u32;
    let (rise, run) = ((high[0] - low[0]) / count as f32, (low[1] - high[1]) / count as f32);
    let nosing = 0.03 * detail.level.min(1) as f32;
    for k in 0..count {
        let (y, z) = (low[0] + rise * k as f32, low[1] - run * k as f32);
        let out = run.signum();
        let step = chunk.on(Surface::Flags);
        let profile = [
            [0.0, y],
            [0.0, y + rise * 0.7],
            [nosing, y + rise * 0.8],
            [nosing, y + rise],
            [-run.abs(), y + rise],
        ];
        let mut tread = Mesh::default();
        tread.moulding(&profile, x, detail.cells(x[1] - x[0]));
        let turned =
            if out > 0.0 { Place::at(0.0, 0.0, z) } else { Place::at(x[0] + x[1], 0.0, z).turned(0.5) };
        step.append(&tread, &turned);
    }
    chunk
}
