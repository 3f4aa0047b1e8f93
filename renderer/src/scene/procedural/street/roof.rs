//! Mansard roofs: a steep slate slope with dormers over each front, flat zinc behind, chimneys.

use std::ops::Range;

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Dice, Place};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::house::House;

/// How far the steep slope leans back.
pub(super) const SLOPE: f32 = 1.3;
/// Height of the steep slope.
pub(super) const RISE: f32 = 2.5;
/// Height of the ridge over the eaves.
pub(super) const RIDGE: f32 = 3.1;

/// A roof plane between two lines of constant depth and height; its ends follow the house's ends.
fn plane(house: &House, ends: [f32; 2], [from, to]: [[f32; 2]; 2], cells: [u32; 2], mesh: &mut Mesh) {
    let rise = ((to[0] - from[0]) * (to[0] - from[0]) + (to[1] - from[1]) * (to[1] - from[1])).sqrt();
    mesh.surface(cells, |u, v| {
        let (z, y) = (from[0] + (to[0] - from[0]) * v, from[1] + (to[1] - from[1]) * v);
        let end = |side: usize| {
            let inner = ends[side] > 0.01 && ends[side] < house.width - 0.01;
            if inner { ends[side] } else { house.end(side, z) }
        };
        let x = end(0) + (end(1) - end(0)) * u;
        (Vec3::new(x, y, z), [x, rise * v])
    });
}

/// The slope and the dormers over some bays of the front.
pub(super) fn front(house: &House, bays: Range<u32>, detail: &Detail, chunk: &mut Chunk) {
    let bay = house.width / house.bays() as f32;
    let (top, ends) = (house.height(), [bays.start as f32 * bay, bays.end as f32 * bay]);
    let cells = [detail.cells((ends[1] - ends[0]) * 0.7), detail.cells(RISE)];
    plane(house, ends, [[0.0, top], [-SLOPE, top + RISE]], cells, chunk.on(Surface::Slate));
    let mut dice = Dice::new(house.seed ^ u64::from(bays.start) ^ 0xd0);
    for k in bays {
        let x = (k as f32 + 0.5) * bay;
        dormer(Vec3::new(x, top + 0.3, 0.0), dice.chance(0.35), detail, chunk);
    }
}

/// A dormer whose sill's middle is at `foot`.
fn dormer(foot: Vec3, lit: bool, detail: &Detail, chunk: &mut Chunk) {
    let at = |x: f32, y: f32, z: f32| foot + Vec3::new(x, y, z);
    let cheeks = chunk.on(Surface::Trim);
    cheeks.block(at(-0.7, 0.0, -1.3), at(0.7, 1.6, -0.22), false);
    if detail.level > 0 {
        for x in [-0.72, 0.56] {
            cheeks.block(at(x, -0.02, -0.24), at(x + 0.16, 1.6, -0.12), true);
        }
        cheeks.moulding(
            &[[-0.2, 1.5], [-0.1, 1.52], [-0.04, 1.62], [-0.04, 1.66], [-0.2, 1.68]]
                .map(|[z, y]| [foot.z + z, foot.y + y]),
            [foot.x - 0.85, foot.x + 0.85],
            detail.cells(1.7),
        );
        cheeks.block(at(-0.8, -0.08, -0.3), at(0.8, 0.0, -0.05), true);
    }
    chunk.on(Surface::Zinc).gable(at(-0.85, 1.6, -1.6), at(0.85, 2.1, -0.08));
    let room = if lit { Surface::LitRoom } else { Surface::Room };
    let axes = [Vec3::X * 1.1, Vec3::Y * 1.4];
    chunk.on(room).panel(at(-0.55, 0.1, -0.21), axes);
    chunk.on(Surface::Casement).panel(at(-0.55, 0.1, -0.19), axes);
}

/// The flat planes, the slope at the back, and the chimneys.
pub(super) fn top(house: &House, detail: &Detail, chunk: &mut Chunk) {
    let (eaves, d) = (house.height(), house.depth);
    let ends = [0.0, house.width];
    let cells = [detail.cells(house.width / 3.0), detail.cells(d / 6.0)];
    let zinc = chunk.on(Surface::Zinc);
    let ridge = [-d / 2.0, eaves + RIDGE];
    plane(house, ends, [[-SLOPE, eaves + RISE], ridge], cells, zinc);
    plane(house, ends, [ridge, [SLOPE - d, eaves + RISE]], cells, zinc);
    plane(house, ends, [[SLOPE - d, eaves + RISE], [-d, eaves]], cells, chunk.on(Surface::Slate));
    let mut dice = Dice::new(house.seed ^ 0xc41);
    for (side, inset) in [(0, 0.5), (1, -0.5)] {
        let z = -d * dice.range(0.28, 0.7);
        chimney(Vec3::new(house.end(side, z) + inset, eaves + RISE - 0.4, z), detail, chunk);
    }
    for _ in 0..detail.level * 2 {
        let (x, z) = (dice.range(2.0, house.width - 2.0), -d * dice.range(0.25, 0.4));
        skylight(Vec3::new(x, eaves + RISE + 0.25, z), chunk);
    }
}

/// A brick stack with a row of pots, its foot's middle at `foot`.
fn chimney(foot: Vec3, detail: &Detail, chunk: &mut Chunk) {
    let half = Vec3::new(0.3, 0.0, 1.0);
    chunk.on(Surface::Brick).block(foot - half, foot + half + Vec3::Y * 2.1, false);
    let lip = Vec3::new(0.36, 0.0, 1.06);
    chunk.on(Surface::Trim).block(foot - lip + Vec3::Y * 2.1, foot + lip + Vec3::Y * 2.2, true);
    let mut pot = Mesh::default();
    let profile =
        [[0.14, 0.0], [0.11, 0.45], [0.13, 0.47], [0.13, 0.52], [0.09, 0.52], [0.08, 0.2], [0.0, 0.2]];
    let profile = if detail.level == 0 { &profile[..2] } else { &profile };
    pot.lathe(profile, detail.around(0.6, 5), false);
    for k in 0..5 {
        let pot_foot = foot + Vec3::new(0.0, 2.2, -0.76 + 0.38 * k as f32);
        chunk.on(Surface::Terracotta).append(&pot, &Place::at(pot_foot.x, pot_foot.y, pot_foot.z));
    }
}

fn skylight(centre: Vec3, chunk: &mut Chunk) {
    let half = Vec3::new(0.4, 0.12, 0.6);
    chunk.on(Surface::Iron).block(centre - half, centre + half, false);
    let corner = centre + Vec3::new(-0.34, 0.13, 0.54);
    chunk.on(Surface::ShopGlass).rect(corner, [Vec3::X * 0.68, Vec3::Z * -1.08], [1, 1], [0.0; 2]);
}
