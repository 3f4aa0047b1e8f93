//! Pools, braziers and lamps.

use glam::Vec3;

use super::super::mesh::Chunk;
use super::super::palette::Surface;

/// A pool on a mosaic floor within a kerb; half its width and depth given.
pub(super) fn pool([x, z]: [f32; 2]) -> Chunk {
    const KERB: f32 = 0.5;
    let mut chunk = Chunk::default();
    let stone = chunk.on(Surface::Marble);
    for side in [-1.0, 1.0] {
        let [along, across] =
            [Vec3::new(side * (x + KERB / 2.0), 0.25, 0.0), Vec3::new(0.0, 0.25, side * (z + KERB / 2.0))];
        for (middle, half) in
            [(along, Vec3::new(KERB / 2.0, 0.25, z + KERB)), (across, Vec3::new(x, 0.25, KERB / 2.0))]
        {
            stone.block(middle - half, middle + half, false);
        }
    }
    let level = |y: f32| (Vec3::new(-x, y, z), [Vec3::X * (2.0 * x), Vec3::Z * (-2.0 * z)]);
    let (floor, axes) = level(0.02);
    chunk.on(Surface::Mosaic).rect(floor, axes, [3, 3], [0.0, 0.0]);
    let (water, axes) = level(0.36);
    chunk.on(Surface::Water).rect(water, axes, [1, 1], [0.0, 0.0]);
    chunk
}

/// A bowl of fire on a foot.
pub(super) fn brazier() -> Chunk {
    let mut chunk = Chunk::default();
    let foot = [[0.5, 0.0], [0.5, 0.18], [0.2, 0.3], [0.14, 1.1], [0.3, 1.25], [0.72, 1.5], [0.78, 1.75]];
    chunk.on(Surface::Bronze).lathe(&foot, 14, true);
    chunk.on(Surface::Embers).ball(Vec3::Y * 1.72, 0.66, 0.45, 12);
    chunk
}

/// A tapering post of stone with a globe of light.
pub(super) fn lamp() -> Chunk {
    let mut chunk = Chunk::default();
    let post = [[0.42, 0.0], [0.42, 0.35], [0.24, 0.4], [0.13, 3.0], [0.26, 3.1], [0.26, 3.2], [0.0, 3.21]];
    chunk.on(Surface::Limestone).lathe(&post, 4, false);
    chunk.on(Surface::LampGlass).ball(Vec3::Y * 3.48, 0.28, 1.0, 12);
    chunk
}
