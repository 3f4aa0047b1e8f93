//! Windows of a front: recess, room, casement, sill, surround, shutters, guard rail.

use glam::Vec3;

use super::super::super::palette::Surface;
use super::{Area, Front};

/// Depth of a window's recess, metres.
const RECESS: f32 = 0.3;

impl Front<'_> {
    /// Fills an opening with a window.
    pub(super) fn window(&mut self, opening: Area) {
        self.recess(opening, RECESS, Surface::Trim);
        let lit = self.dice.chance(0.3);
        let axes = [Vec3::X * opening.width(), Vec3::Y * opening.height()];
        let corner = Vec3::new(opening.x[0], opening.y[0], 0.0);
        let room = if lit { Surface::LitRoom } else { Surface::Room };
        self.chunk.on(room).panel(corner - Vec3::Z * RECESS, axes);
        self.chunk.on(Surface::Casement).panel(corner - Vec3::Z * 0.17, axes);
        self.sill(opening);
        if self.house.style.shutters {
            self.shutters(opening);
        }
        if self.detail.level > 0 {
            self.frame(opening);
            if !self.house.style.shutters {
                self.surround(opening);
            }
        }
    }

    /// The four inner sides of an opening, down to `depth` behind the front.
    pub(super) fn recess(&mut self, opening: Area, depth: f32, surface: Surface) {
        let [x0, x1] = opening.x;
        let [y0, y1] = opening.y;
        let (across, up) = (Vec3::X * (x1 - x0), Vec3::Y * (y1 - y0));
        let inward = Vec3::Z * -depth;
        let mesh = self.chunk.on(surface);
        mesh.rect(Vec3::new(x0, y0, 0.0), [inward, up], [1, 1], [0.0; 2]);
        mesh.rect(Vec3::new(x1, y0, -depth), [-inward, up], [1, 1], [0.0; 2]);
        mesh.rect(Vec3::new(x0, y0, 0.0), [across, inward], [1, 1], [0.0; 2]);
        mesh.rect(Vec3::new(x0, y1, -depth), [across, -inward], [1, 1], [0.0; 2]);
    }

    fn sill(&mut self, opening: Area) {
        let y = opening.y[0];
        let profile = [[0.0, y - 0.12], [0.11, y - 0.1], [0.11, y - 0.01], [0.0, y + 0.01]];
        let x = [opening.x[0] - 0.1, opening.x[1] + 0.1];
        self.chunk.on(Surface::Trim).moulding(&profile, x, 1);
    }

    /// Casement bars as solid wood, in front of the pane.
    fn frame(&mut self, opening: Area) {
        let [x0, x1] = opening.x;
        let [y0, y1] = opening.y;
        let joinery = self.chunk.on(Surface::Trim);
        let mut bar = |x: [f32; 2], y: [f32; 2]| {
            joinery.block(Vec3::new(x[0], y[0], -0.19), Vec3::new(x[1], y[1], -0.13), true);
        };
        let middle = (x0 + x1) * 0.5;
        for x in [x0, middle - 0.035, x1 - 0.07] {
            bar([x, x + 0.07], [y0, y1]);
        }
        for share in [0.0, 0.33, 0.66, 0.97] {
            let y = y0 + (y1 - y0) * share;
            bar([x0 + 0.07, middle - 0.035], [y, y + 0.06]);
            bar([middle + 0.035, x1 - 0.07], [y, y + 0.06]);
        }
    }

    /// Stone strips beside the opening and a keystone with a hood above it.
    fn surround(&mut self, opening: Area) {
        let [x0, x1] = opening.x;
        let [y0, y1] = opening.y;
        let cells = self.detail.cells(y1 - y0);
        let trim = self.chunk.on(Surface::Trim);
        for x in [x0 - 0.18, x1] {
            let side = Vec3::new(x, y0, 0.05);
            trim.rect(side, [Vec3::X * 0.18, Vec3::Y * (y1 - y0)], [1, cells], [0.0; 2]);
            trim.rect(side - Vec3::Z * 0.05, [Vec3::Z * 0.05, Vec3::Y * (y1 - y0)], [1, cells], [0.0; 2]);
            let right = side + Vec3::X * 0.18;
            trim.rect(right, [Vec3::Z * -0.05, Vec3::Y * (y1 - y0)], [1, cells], [0.0; 2]);
        }
        let hood =
            [[0.0, 0.0], [0.06, 0.0], [0.06, 0.16], [0.12, 0.2], [0.16, 0.26], [0.16, 0.3], [0.0, 0.34]];
        trim.moulding(&hood.map(|[z, y]| [z, y1 + y]), [x0 - 0.26, x1 + 0.26], self.detail.cells(1.6));
        let middle = opening.middle();
        trim.block(Vec3::new(middle - 0.1, y1 - 0.1, 0.0), Vec3::new(middle + 0.1, y1 + 0.24, 0.11), true);
    }

    /// Open shutters, flat against the wall; slatted where the tessellation can show it.
    fn shutters(&mut self, opening: Area) {
        let half = opening.width() * 0.5;
        let [y0, y1] = opening.y;
        let slats = 14 * self.detail.level;
        let joinery = self.chunk.on(Surface::Joinery);
        for x in [opening.x[0] - half, opening.x[1]] {
            let (low, high) = (Vec3::new(x + 0.03, y0, 0.02), Vec3::new(x + half - 0.03, y1, 0.06));
            joinery.block(low, high, true);
            for k in 0..slats {
                let y = y0 + 0.08 + (y1 - y0 - 0.12) * k as f32 / slats as f32;
                let slat = Vec3::new(x + 0.08, y, 0.06);
                let (along, lean) = (Vec3::X * (half - 0.16), Vec3::new(0.0, 0.09, -0.03));
                joinery.rect(slat + Vec3::Z * 0.03, [along, lean], [1, 1], [0.0; 2]);
                joinery.rect(slat, [along, Vec3::Z * 0.03], [1, 1], [0.0; 2]);
            }
        }
    }

    /// A low rail across a window without balcony.
    pub(super) fn guard(&mut self, opening: Area) {
        let corner = Vec3::new(opening.x[0], opening.y[0], 0.06);
        let axes = [Vec3::X * opening.width(), Vec3::Y * 0.9];
        self.chunk.on(Surface::Railing).panel(corner, axes);
        if self.detail.level > 0 {
            let top = corner + Vec3::Y * 0.9;
            let segments = self.detail.around(0.25, 4);
            self.chunk.on(Surface::Iron).rod([top, top + axes[0]], [0.022, 0.022], segments);
        }
    }
}
