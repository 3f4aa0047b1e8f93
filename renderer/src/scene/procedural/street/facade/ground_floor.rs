//! Ground floors: shops with awnings and signs, doors, plain windows.

use glam::Vec3;

use super::super::super::palette::Surface;
use super::{Area, Front};

/// How far a shop's display reaches back, metres.
const DISPLAY: f32 = 0.9;

impl Front<'_> {
    /// The ground floor of bay `k`: the house's door, a shop, or a window.
    pub(super) fn ground_floor(&mut self, k: u32, cell: Area) {
        if k == self.house.bays() / 2 {
            self.door(cell);
        } else if self.house.style.shops {
            self.shop(cell);
        } else {
            let half = 0.6;
            let opening = Area { x: [cell.middle() - half, cell.middle() + half], y: [1.1, 3.2] };
            self.wall_around(cell, opening);
            self.window(opening);
        }
    }

    fn door(&mut self, cell: Area) {
        let half = 0.75;
        let opening = Area { x: [cell.middle() - half, cell.middle() + half], y: [0.14, 3.3] };
        self.wall_around(cell, opening);
        self.recess(opening, 0.35, Surface::Trim);
        let [x0, x1] = opening.x;
        let corner = Vec3::new(x0, opening.y[0], -0.35);
        let leaf = self.chunk.on(Surface::Wood);
        leaf.rect(corner, [Vec3::X * (x1 - x0), Vec3::Y * 2.5], [1, 1], [0.0; 2]);
        let panels = if self.detail.level == 0 { 1 } else { 3 };
        for column in 0..2 {
            for row in 0..panels {
                let x = x0 + 0.1 + 0.7 * column as f32;
                let height = 2.3 / panels as f32;
                let y = opening.y[0] + 0.1 + height * row as f32;
                leaf.block(Vec3::new(x, y, -0.35), Vec3::new(x + 0.6, y + height - 0.1, -0.31), true);
            }
        }
        let transom = corner + Vec3::new(0.0, 2.5, 0.0);
        let axes = [Vec3::X * (x1 - x0), Vec3::Y * 0.66];
        self.chunk.on(Surface::LitRoom).panel(transom, axes);
        self.chunk.on(Surface::Casement).panel(transom + Vec3::Z * 0.08, axes);
        let segments = self.detail.around(0.4, 5);
        for x in [-0.08, 0.08] {
            self.chunk.on(Surface::Chrome).ball(
                Vec3::new(opening.middle() + x, 1.2, -0.28),
                0.04,
                1.0,
                segments,
            );
        }
        let step = Vec3::new(x0 - 0.1, 0.14, 0.0);
        self.chunk.on(Surface::Pavement).block(step, Vec3::new(x1 + 0.1, 0.24, 0.35), false);
    }

    fn shop(&mut self, cell: Area) {
        let inner = [0, 1].map(|side| self.house.end(side, -DISPLAY));
        let left = (cell.x[0] + 0.2).max(inner[0] + 0.05);
        let right = (cell.x[1] - 0.2).min(inner[1] - 0.05);
        let opening = Area { x: [left, right], y: [0.7, 3.0] };
        let frontage = Area { x: [cell.x[0] + 0.06, cell.x[1] - 0.06], y: [0.14, 3.75] };
        self.wall_around(cell, frontage);
        self.shop_front(frontage, opening);
        self.recess(opening, DISPLAY, Surface::Joinery);
        let axes = [Vec3::X * opening.width(), Vec3::Y * opening.height()];
        let corner = Vec3::new(opening.x[0], opening.y[0], 0.0);
        let room = if self.dice.chance(0.65) { Surface::LitRoom } else { Surface::Room };
        self.chunk.on(room).panel(corner - Vec3::Z * DISPLAY, axes);
        self.chunk.on(Surface::ShopGlass).rect(corner - Vec3::Z * 0.08, axes, [1, 1], [0.0; 2]);
        self.wares(opening);
        self.sign(cell);
        if self.dice.chance(0.6) {
            self.awning(cell);
        }
    }

    /// The painted joinery around a shop window.
    fn shop_front(&mut self, frontage: Area, opening: Area) {
        let joinery = self.chunk.on(Surface::Joinery);
        let [x0, x1] = frontage.x;
        let [y0, y1] = frontage.y;
        let mut board = |x: [f32; 2], y: [f32; 2]| {
            let axes = [Vec3::X * (x[1] - x[0]), Vec3::Y * (y[1] - y[0])];
            joinery.rect(Vec3::new(x[0], y[0], 0.0), axes, [1, 1], [x[0], y[0]]);
        };
        board([x0, x1], [y0, opening.y[0]]);
        board([x0, x1], [opening.y[1], y1]);
        board([x0, opening.x[0]], opening.y);
        board([opening.x[1], x1], opening.y);
        let base = [[0.0, 0.14], [0.1, 0.14], [0.1, 0.5], [0.06, 0.6], [0.0, 0.62]];
        joinery.moulding(&base, [x0, x1], 1);
        if self.detail.level > 0 {
            for x in [x0, x1 - 0.16] {
                joinery.block(Vec3::new(x, 0.6, 0.0), Vec3::new(x + 0.16, 3.0, 0.07), true);
                joinery.block(Vec3::new(x - 0.02, 2.9, 0.0), Vec3::new(x + 0.18, 3.1, 0.1), true);
            }
            let head = [[0.0, 3.6], [0.12, 3.64], [0.2, 3.74], [0.2, 3.8], [0.0, 3.84]];
            joinery.moulding(&head, [x0, x1], 1);
        }
    }

    /// Goods behind the glass.
    fn wares(&mut self, opening: Area) {
        let segments = self.detail.around(0.5, 5);
        for k in 0..2 + 5 * self.detail.level {
            let (x, z) =
                (self.dice.range(opening.x[0] + 0.25, opening.x[1] - 0.25), self.dice.range(-0.75, -0.3));
            let radius = self.dice.range(0.08, 0.16);
            let foot = Vec3::new(x, opening.y[0], z);
            if k % 2 == 0 {
                let half = Vec3::new(radius, 0.0, radius);
                self.chunk.on(Surface::Wood).block(foot - half, foot + half + Vec3::Y * radius * 3.0, false);
            } else {
                self.chunk.on(Surface::Terracotta).ball(foot + Vec3::Y * radius, radius, 1.0, segments);
            }
        }
    }

    /// The board with the shop's name.
    fn sign(&mut self, cell: Area) {
        let corner = Vec3::new(cell.x[0] + 0.25, 3.12, 0.05);
        let axes = [Vec3::X * (cell.width() - 0.5), Vec3::Y * 0.45];
        self.chunk.on(Surface::Sign).panel(corner, axes);
        if self.dice.chance(0.3) {
            self.hanging_sign(cell.x[1] - 0.12);
        }
    }

    /// A sign on a bracket, at right angles to the front.
    fn hanging_sign(&mut self, x: f32) {
        let (low, high) = (Vec3::new(x - 0.04, 2.55, 0.25), Vec3::new(x + 0.04, 3.05, 0.95));
        self.chunk.on(Surface::Joinery).block(low, high, true);
        let (z, y) = (Vec3::Z * 0.66, Vec3::Y * 0.4);
        let sign = self.chunk.on(Surface::Sign);
        sign.panel(Vec3::new(x - 0.05, 2.6, 0.27), [z, y]);
        sign.panel(Vec3::new(x + 0.05, 2.6, 0.93), [-z, y]);
        let segments = self.detail.around(0.25, 4);
        let arm = [Vec3::new(x, 3.1, 0.0), Vec3::new(x, 3.1, 1.0)];
        self.chunk.on(Surface::Iron).rod(arm, [0.02, 0.02], segments);
    }

    /// Striped cloth over the pavement.
    fn awning(&mut self, cell: Area) {
        let (x, across) = (cell.x[0] + 0.05, Vec3::X * (cell.width() - 0.1));
        let (foot, slope) = (Vec3::new(x, 2.5, 1.25), Vec3::new(0.0, 0.55, -1.15));
        let sag = 0.06 * self.detail.level.min(1) as f32;
        let cloth = self.house.style.cloth;
        let mesh = self.chunk.on(Surface::Awning);
        let cells = [self.detail.cells(cell.width()), 1 + 3 * self.detail.level];
        mesh.surface(cells, |u, v| {
            let droop = Vec3::Y * (sag * 4.0 * v * (v - 1.0));
            (foot + across * u + slope * v + droop, [u, 0.25 + 0.75 * v])
        });
        mesh.surface([cells[0], 1], |u, v| (foot + across * u + Vec3::Y * (0.25 * (v - 1.0)), [u, 0.25 * v]));
        mesh.paint(cloth);
        let segments = self.detail.around(0.25, 4);
        let iron = self.chunk.on(Surface::Iron);
        for x in [x, x + across.x] {
            iron.rod([Vec3::new(x, 2.2, 0.0), Vec3::new(x, 2.48, 1.2)], [0.015, 0.015], segments);
        }
    }
}
