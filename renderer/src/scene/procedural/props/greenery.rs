//! Trees and shrubs: trunks and branches with crowns of leaf cards.

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Dice, Place};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;

/// A cloud of leaf cards in an ellipsoid, gathered in clumps.
struct Crown {
    centre: Vec3,
    radii: Vec3,
    cards: u32,
    /// Side of a card, metres.
    side: f32,
    /// 0 for an even crown, 1 for one of separate clumps.
    clumped: f32,
}

impl Crown {
    /// Cards near the shell, fronts outward, tinted at random.
    fn grow(&self, mesh: &mut Mesh, dice: &mut Dice) {
        let clumps: [Vec3; 11] = std::array::from_fn(|_| {
            self.centre + dice.direction() * self.radii * self.clumped * dice.range(0.4, 0.55)
        });
        for _ in 0..self.cards {
            let out = dice.direction();
            let depth = (1.0 - 0.48 * self.clumped) * (1.0 - 0.5 * dice.unit() * dice.unit());
            let centre = clumps[dice.below(11) as usize] + out * self.radii * depth;
            let facing = (out + dice.direction() * 0.7).normalize_or(out);
            let place = Place::upright(centre, facing).turned(f64::from(dice.unit()));
            let half = self.side * dice.range(0.4, 0.6);
            let mut card = Mesh::default();
            let (x, z) = (Vec3::X * half, Vec3::Z * half);
            card.panel(z - x, [x * 2.0, z * -2.0]);
            let light = dice.range(190.0, 255.0) as u8;
            card.paint([light, light, dice.range(150.0, 220.0) as u8]);
            mesh.append(&card, &place);
        }
    }
}

/// A street tree about 6 m high; its crown stays within 1.9 m of the trunk.
pub(in super::super) fn tree(detail: &Detail, seed: u64) -> Chunk {
    let mut dice = Dice::new(seed);
    let mut chunk = Chunk::default();
    let segments = detail.around(0.5, 6);
    let bark = chunk.on(Surface::Bark);
    bark.lathe(&[[0.26, 0.0], [0.17, 0.35], [0.14, 1.6], [0.12, 2.9], [0.05, 4.4]], segments, true);
    for _ in 0..4 + 4 * detail.level {
        let out = dice.direction();
        let from = Vec3::Y * dice.range(2.3, 3.6);
        let to = from + Vec3::new(out.x, 0.9 + 0.4 * out.y.abs(), out.z) * dice.range(0.8, 1.3);
        bark.rod([from, to], [0.07, 0.02], segments / 2 + 2);
    }
    let crown = Crown {
        centre: Vec3::Y * 4.5,
        radii: Vec3::new(1.45, 1.6, 1.45),
        cards: detail.leaves,
        side: leaf_side(detail.leaves, 7.4),
        clumped: 1.0,
    };
    crown.grow(chunk.on(Surface::Foliage), &mut dice);
    chunk
}

/// A slim cypress about 7 m high.
pub(in super::super) fn cypress(detail: &Detail, seed: u64) -> Chunk {
    let mut dice = Dice::new(seed);
    let mut chunk = Chunk::default();
    chunk.on(Surface::Bark).lathe(&[[0.2, 0.0], [0.12, 1.0], [0.04, 5.5]], detail.around(0.4, 5), true);
    let cards = detail.leaves;
    let crown = Crown {
        centre: Vec3::Y * 3.9,
        radii: Vec3::new(0.8, 3.3, 0.8),
        cards,
        side: leaf_side(cards, 7.4),
        clumped: 0.0,
    };
    crown.grow(chunk.on(Surface::Foliage), &mut dice);
    chunk
}

/// A pot with a shrub.
pub(in super::super) fn planter(detail: &Detail, seed: u64) -> Chunk {
    let mut dice = Dice::new(seed);
    let mut chunk = Chunk::default();
    let profile = [
        [0.0, 0.0],
        [0.22, 0.0],
        [0.32, 0.5],
        [0.36, 0.5],
        [0.36, 0.58],
        [0.30, 0.58],
        [0.28, 0.5],
        [0.0, 0.5],
    ];
    chunk.on(Surface::Terracotta).lathe(&profile, detail.around(0.8, 7), false);
    let cards = (detail.leaves / 4).max(12);
    let crown = Crown {
        centre: Vec3::Y * 0.95,
        radii: Vec3::new(0.38, 0.42, 0.38),
        cards,
        side: leaf_side(cards, 1.6),
        clumped: 0.5,
    };
    crown.grow(chunk.on(Surface::Foliage), &mut dice);
    chunk
}

/// Side of a card such that `cards` of them cover a crown alike at every detail.
fn leaf_side(cards: u32, spread: f32) -> f32 {
    (spread / (cards as f32).sqrt()).max(0.11)
}
