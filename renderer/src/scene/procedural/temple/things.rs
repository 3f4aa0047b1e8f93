//! Braziers, statues, pools, cloths and vines.

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Place, noise, sin_cos};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;

/// A bronze bowl of glowing coals on three legs, 1.2 m high.
pub(super) fn brazier(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(0.6, 8);
    let bronze = chunk.on(Surface::Bronze);
    let bowl = [
        [0.0, 0.72],
        [0.2, 0.76],
        [0.42, 0.95],
        [0.5, 1.15],
        [0.53, 1.18],
        [0.5, 1.21],
        [0.46, 1.15],
        [0.42, 1.05],
    ];
    let bowl = if detail.level == 0 { &bowl[1..6] } else { &bowl };
    bronze.lathe(bowl, segments, detail.level > 0);
    for k in 0..3 {
        let (sin, cos) = sin_cos(f64::from(k) / 3.0);
        let out = Vec3::new(cos, 0.0, sin);
        bronze.rod([out * 0.45, out * 0.3 + Vec3::Y * 0.85], [0.03, 0.045], segments / 3 + 2);
        if detail.level > 0 {
            bronze.ball(out * 0.45 + Vec3::Y * 0.04, 0.06, 1.0, segments / 2);
        }
    }
    let embers = chunk.on(Surface::Embers);
    embers.revolve(&[[0.47, 1.1], [0.3, 1.2], [0.0, 1.26]], segments, true, |turn, _| {
        1.0 - 0.12 * noise(turn * 12.0, 0.5, 12, 51)
    });
    for k in 0..3 + 5 * detail.level {
        let (sin, cos) = sin_cos(f64::from(k) * 0.382);
        let reach = 0.07 * (k % 4) as f32;
        let foot = Vec3::new(reach * cos, 1.18, reach * sin);
        let mut flame = Mesh::default();
        let tall = 0.55 - reach;
        let outline = [[0.02, 0.0], [0.08, 0.12 * tall], [0.06, 0.5 * tall], [0.0, tall]];
        flame.lathe(&outline, segments / 2 + 1, true);
        embers.append(&flame, &Place::at(foot.x, foot.y, foot.z).tilted(0.02 * f64::from(k % 3) - 0.02));
    }
    chunk
}

/// A robed figure with a sun disc, 3.4 m high, facing +z.
pub(super) fn statue(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(1.2, 10);
    let marble = chunk.on(Surface::Marble);
    let robe = [
        [0.0, 0.0],
        [0.62, 0.0],
        [0.6, 0.15],
        [0.5, 0.8],
        [0.4, 1.4],
        [0.36, 1.7],
        [0.44, 2.1],
        [0.48, 2.4],
        [0.36, 2.62],
        [0.14, 2.74],
        [0.12, 2.86],
    ];
    // Folds that deepen towards the hem.
    marble.revolve(&robe, segments * 2, true, |turn, y| {
        let (sin, _) = sin_cos(f64::from(turn) * 11.0);
        1.0 + 0.09 * (1.0 - y / 2.9).max(0.0) * sin
    });
    marble.ball(Vec3::new(0.0, 3.06, 0.02), 0.22, 1.2, segments);
    for side in [-1.0_f32, 1.0] {
        let shoulder = Vec3::new(0.42 * side, 2.45, 0.0);
        let elbow = Vec3::new(0.6 * side, 2.0, 0.18);
        let hand = Vec3::new(0.2 * side, 2.05, 0.58);
        marble.ball(shoulder, 0.17, 1.0, segments / 2 + 2);
        marble.rod([shoulder, elbow], [0.15, 0.12], segments / 2 + 2);
        marble.ball(elbow, 0.12, 1.0, segments / 2 + 2);
        marble.rod([elbow, hand], [0.12, 0.08], segments / 2 + 2);
        marble.ball(hand, 0.09, 1.0, segments / 2 + 2);
    }
    let gold = chunk.on(Surface::Gold);
    let disc = Place::at(0.0, 2.15, 0.62).tilted(0.22);
    let mut sun = Mesh::default();
    sun.lathe(
        &[[0.0, -0.03], [0.26, -0.03], [0.28, 0.0], [0.26, 0.03], [0.1, 0.06], [0.0, 0.07]],
        segments,
        true,
    );
    gold.append(&sun, &disc);
    for k in 0..12 {
        let mut ray = Mesh::default();
        ray.rod([Vec3::X * 0.26, Vec3::X * 0.46], [0.045, 0.0], segments / 4 + 3);
        gold.append(&ray, &disc.turned(f64::from(k) / 12.0));
    }
    chunk
}

/// A rectangular pool between two corners (x, z): rim, floor and water; the ground at `y`.
pub(super) fn pool(low: [f32; 2], high: [f32; 2], y: f32, detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let [x0, z0] = low;
    let [x1, z1] = high;
    let rim = chunk.on(Surface::Marble);
    let wide = 0.35;
    let mut border = |low: [f32; 2], high: [f32; 2]| {
        rim.block(Vec3::new(low[0], y, low[1]), Vec3::new(high[0], y + 0.38, high[1]), false);
    };
    border([x0 - wide, z0 - wide], [x1 + wide, z0]);
    border([x0 - wide, z1], [x1 + wide, z1 + wide]);
    border([x0 - wide, z0], [x0, z1]);
    border([x1, z0], [x1 + wide, z1]);
    let corner = Vec3::new(x0, y + 0.02, z1);
    let axes = [Vec3::X * (x1 - x0), Vec3::Z * (z0 - z1)];
    let cells = [detail.cells(x1 - x0), detail.cells(z1 - z0)];
    chunk.on(Surface::Mosaic).rect(corner, axes, [1, 1], [x0, -z1]);
    chunk.on(Surface::Water).relief(corner + Vec3::Y * 0.26, axes, cells, [x0, -z1], |[u, v]| {
        0.03 * noise(u * 1.7 + 100.0, v * 1.7 + 100.0, 1 << 20, 61)
    });
    chunk
}

/// A round fountain of two basins at the origin, 3 m in radius.
pub(super) fn fountain(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(2.0, 16);
    let marble = chunk.on(Surface::Marble);
    let wall = [[3.0, 0.0], [3.0, 0.5], [3.08, 0.55], [3.08, 0.65], [2.7, 0.65], [2.7, 0.1], [0.0, 0.1]];
    marble.lathe(&wall, segments, false);
    let stem =
        [[0.5, 0.1], [0.35, 0.5], [0.2, 1.0], [0.25, 1.4], [1.2, 1.8], [1.26, 1.9], [1.15, 1.92], [0.3, 1.7]];
    marble.lathe(&stem, segments, detail.level > 0);
    let water = chunk.on(Surface::Water);
    water.lathe(&[[2.7, 0.5], [0.3, 0.5]], segments, true);
    water.lathe(&[[1.14, 1.84], [0.0, 1.86]], segments, true);
    // The sheet that falls from the upper basin.
    water.revolve(&[[1.55, 0.52], [1.45, 1.2], [1.26, 1.9]], segments, true, |turn, _| {
        1.0 + 0.02 * noise(turn * 24.0, 0.5, 24, 62)
    });
    chunk.on(Surface::Gold).ball(Vec3::Y * 2.1, 0.3, 1.0, segments / 2);
    chunk
}

/// A cloth 1.4 m wide and 3.6 m long that hangs from the origin, facing +z.
pub(super) fn banner(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let cells = [detail.around(0.3, 2), detail.around(0.5, 3)];
    chunk.on(Surface::Banner).surface(cells, |u, v| {
        let (sin, _) = sin_cos(f64::from(v * 1.3 + u * 0.4));
        (Vec3::new((u - 0.5) * 1.4, -3.6 * (1.0 - v), 0.14 * sin * (1.0 - v)), [u, v])
    });
    let segments = detail.around(0.2, 5);
    let wood = chunk.on(Surface::Gold);
    wood.rod([Vec3::new(-0.85, 0.0, 0.0), Vec3::new(0.85, 0.0, 0.0)], [0.035, 0.035], segments);
    for x in [-0.85, 0.85] {
        wood.ball(Vec3::new(x, 0.0, 0.0), 0.07, 1.0, segments);
    }
    chunk
}

/// A curtain of vines 3 m wide and 3 m long that hangs from the origin, facing +z.
pub(super) fn vines(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let cells = [detail.around(0.4, 2), detail.around(0.4, 2)];
    for layer in 0..1 + detail.level {
        let z = 0.09 * layer as f32;
        chunk.on(Surface::Vines).surface(cells, |u, v| {
            let sway = 0.12 * noise(u * 5.0 + 7.0 * layer as f32, v * 3.0, 64, 71);
            let p = Vec3::new((u - 0.5) * 3.0, 3.0 * (v - 1.0), z + sway);
            (p, [u + 0.37 * layer as f32, v])
        });
    }
    chunk
}
