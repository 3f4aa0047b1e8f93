//! Drapes, lanterns, vases and the fountain.

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Place, mix, noise, sin_cos, smoothstep};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::{BAY, EAVES, FIRST, Hall, MEDIUM, NAVE, SIDES};

/// Height of what a drape hangs from, over the first gallery's floor.
const DRAPE: f32 = 3.3;

impl Hall {
    /// Drapes in every other arch of the first gallery's long sides, veils across the nave.
    pub(super) fn drapes(&mut self) {
        let colors = [Surface::Crimson, Surface::Teal, Surface::Ochre];
        let drapes = colors.map(|surface| self.builder.model(drape(surface)));
        for side in SIDES.iter().filter(|side| side.bays > 3) {
            for (k, x) in side.bays().enumerate().filter(|(k, _)| k % 4 != 3) {
                let place = side.place(x + BAY / 2.0, FIRST, 0.0);
                self.builder.place(&drapes[k % 4], &place);
            }
        }
        let veil = self.builder.model(veil());
        for x in [-10.5, -3.5, 3.5, 10.5] {
            self.builder.place(&veil, &Place::at(x, EAVES - 0.7, 0.0));
        }
    }

    /// Lanterns under the vaults of the aisles, in every other bay.
    pub(super) fn lanterns(&mut self) {
        let lantern = self.builder.model(lantern(&MEDIUM));
        for side in &SIDES {
            for x in side.bays().skip(usize::from(side.bays > 3)).step_by(2) {
                let place = side.place(x + BAY / 2.0, 3.0, -0.5 * side.depth);
                self.builder.place(&lantern, &place);
            }
        }
    }
}

/// A cloth in folds that hangs in an arch from y = [`DRAPE`] down over the rail, drawn together in its middle.
fn drape(surface: Surface) -> Chunk {
    const FOLDS: f64 = 6.0;
    let mut chunk = Chunk::default();
    chunk.on(surface).surface([48, 15], |u, v| {
        let height = mix(-1.1, DRAPE, v);
        let tied = 1.0 - smoothstep(0.0, 1.7, (height - 1.5).abs());
        let width = 2.35 * (1.0 - 0.45 * tied);
        let (sin, _) = sin_cos(FOLDS * f64::from(u) + 0.25 * f64::from(noise(u * 3.0, v * 2.0, 64, 401)));
        let depth = mix(0.05, 0.11, 1.0 - v) * (1.0 + 0.4 * tied) * sin;
        // It hangs over rail and cornice, on the side of the nave.
        let over = 0.74 * (1.0 - smoothstep(1.0, 2.9, height));
        (Vec3::new((u - 0.5) * width, height, over + depth), [2.6 * u, height])
    });
    let rod = [Vec3::new(-1.28, DRAPE + 0.02, 0.0), Vec3::new(1.28, DRAPE + 0.02, 0.0)];
    chunk.on(surface).rod(rod, [0.035, 0.035], 8);
    chunk
}

/// A thin cloth that sags across the nave, from wall to wall, 1.6 m wide along x; y = 0 where it hangs.
fn veil() -> Chunk {
    let mut chunk = Chunk::default();
    chunk.on(Surface::Veil).surface([40, 8], |u, v| {
        let t = 2.0 * u - 1.0;
        let (sin, _) = sin_cos(f64::from(1.5 * v + 0.8 * u));
        let sag = -1.9 * (1.0 - t * t) + 0.1 * sin * (1.0 - t * t);
        let wide = 1.6 * (1.0 - 0.35 * (t * t));
        (Vec3::new((v - 0.5) * wide, sag, t * (NAVE[1] - 0.25)), [12.0 * u, 1.6 * v])
    });
    chunk
}

/// A lantern of eight panes on a chain, its middle at the origin.
fn lantern(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let iron = chunk.on(Surface::Iron);
    let cap = [[0.27, 0.24], [0.28, 0.28], [0.14, 0.42], [0.05, 0.48], [0.03, 0.56], [0.0, 0.6]];
    iron.lathe(&cap, 8, false);
    iron.lathe(&[[0.0, -0.4], [0.06, -0.36], [0.03, -0.3], [0.18, -0.26], [0.2, -0.24]], 8, false);
    for k in 0..8 {
        let (sin, cos) = sin_cos(f64::from(k) / 8.0);
        let [low, high] = [(0.19, -0.25), (0.265, 0.26)].map(|(r, y)| Vec3::new(r * cos, y, -r * sin));
        iron.rod([low, high], [0.014, 0.014], 5);
    }
    let mut link = Mesh::default();
    link.ring(0.06, 0.014, detail.around(0.2, 6));
    for k in 0..10 {
        let place = Place::at(0.0, 0.63 + 0.1 * k as f32, 0.0).turned(0.25 * f64::from(k)).tilted(0.25);
        iron.append(&link, &place);
    }
    chunk.on(Surface::LampGlass).lathe(&[[0.17, -0.24], [0.245, 0.24]], 8, false);
    chunk
}

/// A glazed vase 1.3 m high.
pub(super) fn vase(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let profile = [
        [0.0, 0.0],
        [0.2, 0.0],
        [0.21, 0.05],
        [0.16, 0.1],
        [0.2, 0.24],
        [0.33, 0.5],
        [0.38, 0.72],
        [0.34, 0.92],
        [0.2, 1.06],
        [0.14, 1.12],
        [0.15, 1.2],
        [0.23, 1.28],
        [0.24, 1.3],
        [0.21, 1.3],
        [0.12, 1.16],
        [0.0, 1.1],
    ];
    chunk.on(Surface::Glaze).lathe(&profile, detail.around(0.75, 12), true);
    chunk
}

/// An eight-sided basin 2.2 m in radius with a bowl over it, at the origin.
pub(super) fn fountain(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let marble = chunk.on(Surface::Marble);
    let rim = [
        [2.3, 0.0],
        [2.3, 0.12],
        [2.2, 0.18],
        [2.2, 0.46],
        [2.28, 0.5],
        [2.28, 0.6],
        [1.9, 0.6],
        [1.9, 0.1],
        [0.0, 0.1],
    ];
    marble.lathe(&rim, 8, false);
    let segments = detail.around(0.6, 16);
    let stem = [
        [0.42, 0.1],
        [0.3, 0.4],
        [0.17, 0.8],
        [0.2, 1.05],
        [0.8, 1.32],
        [0.95, 1.42],
        [0.97, 1.48],
        [0.88, 1.46],
        [0.2, 1.3],
        [0.12, 1.6],
        [0.16, 1.72],
        [0.0, 1.86],
    ];
    marble.lathe(&stem, segments, true);
    let water = chunk.on(Surface::Water);
    water.lathe(&[[1.9, 0.48], [0.3, 0.48]], 8, true);
    water.lathe(&[[0.9, 1.44], [0.14, 1.44]], segments, true);
    chunk.on(Surface::Water).revolve(&[[1.25, 0.5], [1.14, 1.0], [0.97, 1.47]], segments, true, |turn, _| {
        1.0 + 0.02 * noise(turn * 24.0, 0.5, 24, 402)
    });
    chunk
}
