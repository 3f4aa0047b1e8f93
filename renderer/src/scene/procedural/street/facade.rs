//! The street fronts: bays of windows, balconies, shops and doors between string courses and a cornice.

mod ground_floor;
mod window;

use std::ops::Range;

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Dice, smoothstep};
use super::super::mesh::Chunk;
use super::super::palette::Surface;
use super::ground;
use super::house::{GROUND_FLOOR, House, STOREY};

/// A rectangle in the plane of the front, metres.
#[derive(Debug, Clone, Copy)]
struct Area {
    x: [f32; 2],
    y: [f32; 2],
}

impl Area {
    fn width(&self) -> f32 {
        self.x[1] - self.x[0]
    }

    fn height(&self) -> f32 {
        self.y[1] - self.y[0]
    }

    fn middle(&self) -> f32 {
        (self.x[0] + self.x[1]) * 0.5
    }
}

/// The chunk of some bays of a front, under construction.
struct Front<'a> {
    house: &'a House,
    detail: &'a Detail,
    dice: Dice,
    chunk: Chunk,
}

/// The front's bays `bays` from the pavement to the cornice, in the house's space.
pub(super) fn build(house: &House, bays: Range<u32>, detail: &Detail) -> Chunk {
    let dice = Dice::new(house.seed.wrapping_add(u64::from(bays.start)));
    let mut front = Front { house, detail, dice, chunk: Chunk::default() };
    let bay = house.width / house.bays() as f32;
    let x = [bays.start as f32 * bay, bays.end as f32 * bay];
    for k in bays {
        let x = [k as f32 * bay, (k + 1) as f32 * bay];
        front.ground_floor(k, Area { x, y: [0.0, GROUND_FLOOR] });
        for storey in 0..house.storeys {
            let y = GROUND_FLOOR + STOREY * storey as f32;
            front.storey(storey, Area { x, y: [y, y + STOREY] });
        }
    }
    front.chunk.on(house.style.wall).paint(house.style.tint);
    front.balconies(x);
    front.mouldings(x);
    let ends = [0, 1].map(|side| {
        let at_end = (x[side] - house.width * side as f32).abs() < 0.01;
        if at_end { house.mitre[side] } else { 0.0 }
    });
    ground::pavement(x, ends, detail, &mut front.chunk);
    front.chunk
}

impl Front<'_> {
    /// One window of an upper storey with its wall.
    fn storey(&mut self, storey: u32, cell: Area) {
        let full = self.has_balcony(storey);
        let sill = cell.y[0] + if full { 0.12 } else { 0.75 };
        let half = 0.58;
        let opening = Area { x: [cell.middle() - half, cell.middle() + half], y: [sill, cell.y[0] + 2.62] };
        self.wall_around(cell, opening);
        self.window(opening);
        if !full {
            self.guard(opening);
        }
    }

    fn has_balcony(&self, storey: u32) -> bool {
        storey == 0 || storey + 1 == self.house.storeys
    }

    /// The wall of `cell` but for `opening`.
    fn wall_around(&mut self, cell: Area, opening: Area) {
        let between = [opening.y[0], opening.y[1]];
        self.wall(Area { x: [cell.x[0], opening.x[0]], y: between });
        self.wall(Area { x: [opening.x[1], cell.x[1]], y: between });
        self.wall(Area { x: cell.x, y: [cell.y[0], opening.y[0]] });
        self.wall(Area { x: cell.x, y: [opening.y[1], cell.y[1]] });
    }

    /// A piece of wall whose stone courses stand out where the tessellation can show them.
    fn wall(&mut self, area: Area) {
        if area.width() < 0.01 || area.height() < 0.01 {
            return;
        }
        let cells = [self.detail.cells(area.width()), self.detail.cells(area.height())];
        let axes = [Vec3::X * area.width(), Vec3::Y * area.height()];
        let deep = if self.house.style.wall == Surface::Limestone { 0.03 } else { 0.008 };
        let corner = Vec3::new(area.x[0], area.y[0], 0.0);
        self.chunk.on(self.house.style.wall).relief(corner, axes, cells, corner.truncate().into(), |uv| {
            // One course of the wall's texture is 3 m / 7 high.
            let course = uv[1] * 7.0 / 3.0;
            let edge = (course - course.floor() - 0.5).abs();
            -deep * smoothstep(0.3, 0.5, edge)
        });
    }

    /// Balconies along the storeys that have them.
    fn balconies(&mut self, x: [f32; 2]) {
        for storey in 0..self.house.storeys {
            if !self.has_balcony(storey) {
                continue;
            }
            let reach = if storey == 0 { 0.75 } else { 0.55 };
            self.balcony(x, GROUND_FLOOR + STOREY * storey as f32, reach);
        }
    }

    fn balcony(&mut self, [x0, x1]: [f32; 2], y: f32, reach: f32) {
        let profile =
            [[0.0, y - 0.3], [reach * 0.4, y - 0.24], [reach, y - 0.12], [reach, y + 0.04], [0.0, y + 0.04]];
        let cells = self.detail.cells(x1 - x0);
        self.chunk.on(Surface::Trim).moulding(&profile, [x0, x1], cells);
        let (z, foot) = (reach - 0.06, y + 0.04);
        let railing = self.chunk.on(Surface::Railing);
        railing.rect(Vec3::new(x0, foot, z), [Vec3::X * (x1 - x0), Vec3::Y], [cells, 1], [x0, 0.0]);
        if self.detail.level == 0 {
            return;
        }
        let segments = self.detail.around(0.25, 4);
        let iron = self.chunk.on(Surface::Iron);
        let top = foot + 1.0;
        iron.rod([Vec3::new(x0, top, z), Vec3::new(x1, top, z)], [0.025, 0.025], segments);
        let posts = ((x1 - x0) / 1.35).round() as u32;
        for k in 0..=posts {
            let post = Vec3::new(x0 + (x1 - x0) * k as f32 / posts as f32, foot, z);
            iron.rod([post, post + Vec3::Y], [0.02, 0.02], segments);
            if self.detail.level > 1 {
                iron.ball(post + Vec3::Y * 1.06, 0.045, 1.0, segments);
            }
        }
        // Shops have their signs there.
        if y > GROUND_FLOOR || !self.house.style.shops {
            self.consoles([x0, x1], y, reach);
        }
    }

    /// Stone brackets under a balcony.
    fn consoles(&mut self, [x0, x1]: [f32; 2], y: f32, reach: f32) {
        let count = ((x1 - x0) / 1.35).round() as u32;
        for k in 0..count {
            let x = x0 + (x1 - x0) * (k as f32 + 0.5) / count as f32;
            let scroll = [
                [0.0, y - 0.85],
                [0.1, y - 0.82],
                [0.16, y - 0.7],
                [0.14, y - 0.6],
                [reach * 0.4, y - 0.45],
                [reach * 0.8, y - 0.3],
                [reach * 0.8, y - 0.14],
            ];
            self.chunk.on(Surface::Trim).moulding(&scroll, [x - 0.1, x + 0.1], 1);
        }
    }

    /// String courses and the cornice.
    fn mouldings(&mut self, x: [f32; 2]) {
        let cells = self.detail.cells(x[1] - x[0]);
        let band =
            |y: f32, depth: f32| [[0.0, y - 0.12], [depth, y - 0.08], [depth, y + 0.06], [0.0, y + 0.1]];
        let trim = self.chunk.on(Surface::Trim);
        for storey in 1..self.house.storeys {
            let y = GROUND_FLOOR + STOREY * storey as f32;
            trim.moulding(&band(y, 0.09), x, cells);
        }
        let top = self.house.height();
        let cornice: &[[f32; 2]] = if self.detail.level == 0 {
            &[[0.0, -0.45], [0.14, -0.3], [0.45, -0.1], [0.45, 0.06], [0.0, 0.1]]
        } else {
            &[
                [0.0, -0.5],
                [0.08, -0.5],
                [0.08, -0.4],
                [0.16, -0.32],
                [0.18, -0.22],
                [0.34, -0.16],
                [0.38, -0.1],
                [0.46, -0.04],
                [0.46, 0.06],
                [0.0, 0.12],
            ]
        };
        let cornice: Vec<[f32; 2]> = cornice.iter().map(|[z, y]| [*z, top + y]).collect();
        trim.moulding(&cornice, x, cells);
        if self.detail.level > 0 {
            let count = ((x[1] - x[0]) / 0.45) as u32;
            for k in 0..count {
                let left = x[0] + (x[1] - x[0]) * (k as f32 + 0.25) / count as f32;
                trim.block(Vec3::new(left, top - 0.3, 0.0), Vec3::new(left + 0.2, top - 0.14, 0.32), true);
            }
        }
    }
}
