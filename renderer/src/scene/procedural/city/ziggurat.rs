//! Towers: storeys on storeys, each smaller than the one below.

use glam::Vec3;

use super::super::maths::Place;
use super::super::mesh::Chunk;
use super::super::palette::Surface;
use super::storey::{Crown, Dress, Storey};

/// Inward lean of walls over their height.
const LEAN: f32 = 0.1;

/// A storey of a tower: half its width and its height, metres, and what its walls are of.
pub(super) struct Tier {
    half: f32,
    height: f32,
    wall: Surface,
}

const fn tier(half: f32, height: f32, wall: Surface) -> Tier {
    Tier { half, height, wall }
}

/// The kinds of towers, from the ground up.
pub(super) static TOWERS: [&[Tier]; 5] = [
    &[
        tier(8.5, 6.2, Surface::Limestone),
        tier(6.0, 4.6, Surface::Brick),
        tier(3.7, 3.6, Surface::GlazedBrick),
    ],
    &[
        tier(8.8, 4.6, Surface::Brick),
        tier(6.9, 4.0, Surface::TempleWall),
        tier(5.0, 3.6, Surface::Brick),
        tier(3.2, 3.2, Surface::GlazedBrick),
    ],
    &[tier(8.0, 9.5, Surface::TempleWall), tier(5.0, 6.5, Surface::RedPlaster)],
    &[
        tier(8.6, 3.8, Surface::RedPlaster),
        tier(7.1, 3.5, Surface::Limestone),
        tier(5.6, 3.3, Surface::RedPlaster),
        tier(4.2, 3.1, Surface::Limestone),
        tier(2.9, 2.9, Surface::GlazedBrick),
    ],
    &[
        tier(7.6, 7.2, Surface::GlazedBrick),
        tier(5.2, 5.4, Surface::TempleWall),
        tier(3.2, 4.2, Surface::GlazedBrick),
    ],
];

/// The great ziggurat, from the ground up; its terraces are as wide as the stairs to the next need.
static GREAT: [Tier; 4] = [
    tier(22.0, 8.0, Surface::TempleWall),
    tier(15.4, 6.5, Surface::Brick),
    tier(9.6, 5.5, Surface::Limestone),
    tier(5.0, 4.6, Surface::GlazedBrick),
];

/// A plateau that a tower stands on, `half` its width.
pub(super) fn plateau(half: f32, height: f32) -> Chunk {
    let storey = Storey { foot: [half; 2], low: 0.0, height, batter: 0.14 };
    storey.build(&Dress { wall: Surface::Limestone, crown: Crown::Edge, stair: Some(1.8) })
}

/// A tower of these storeys with stairs to its first terrace.
pub(super) fn tower(tiers: &'static [Tier]) -> Chunk {
    let mut chunk = Chunk::default();
    let origin = Place::at(0.0, 0.0, 0.0);
    for (k, (storey, tier)) in stacked(tiers).enumerate() {
        let crown = Crown::Merlons { apart: 1.9 };
        chunk.append(&storey.build(&Dress { wall: tier.wall, crown, stair: None }), &origin);
        if k == 0 {
            chunk.append(&door(1.1), &Place::at(0.0, storey.low, storey.foot[1]));
        }
    }
    chunk
}

/// The great ziggurat, a chunk a storey: stairs lead to each terrace but the last, where a temple stands.
pub(super) fn great() -> Vec<Chunk> {
    let last = GREAT.len() - 1;
    let build = |(k, (storey, tier)): (usize, (Storey, &Tier))| {
        let stair = (k < last).then_some(3.4 - 0.7 * k as f32);
        let dress = Dress { wall: tier.wall, crown: Crown::Merlons { apart: 1.7 }, stair };
        let mut chunk = storey.build(&dress);
        if k == last {
            chunk.append(&door(1.3), &Place::at(0.0, storey.low, storey.foot[1]));
            chunk.append(
                &horns(storey.foot[0] - storey.batter),
                &Place::at(0.0, storey.low + storey.height, 0.0),
            );
        }
        chunk
    };
    stacked(&GREAT).enumerate().map(build).collect()
}

fn stacked(tiers: &'static [Tier]) -> impl Iterator<Item = (Storey, &'static Tier)> {
    let on = |low: &mut f32, tier: &'static Tier| {
        let Tier { half, height, .. } = *tier;
        let storey = Storey { foot: [half; 2], low: *low, height, batter: LEAN * height };
        *low += height;
        Some((storey, tier))
    };
    tiers.iter().scan(0.0, on)
}

/// A doorway in a golden frame, before a wall whose foot is at z = 0; `half` its width.
fn door(half: f32) -> Chunk {
    let mut chunk = Chunk::default();
    let (height, front) = (2.6 * half, 0.75);
    let frame = chunk.on(Surface::Gold);
    for x in [-half - 0.3, half] {
        frame.block(Vec3::new(x, 0.0, -0.4), Vec3::new(x + 0.3, height, front), false);
    }
    let lintel = Vec3::new(half + 0.45, height + 0.45, front + 0.1);
    frame.block(Vec3::new(-lintel.x, height, -0.6), lintel, true);
    let inside = Vec3::new(-half, 0.0, front - 0.35);
    chunk.on(Surface::Room).rect(inside, [Vec3::X * (2.0 * half), Vec3::Y * height], [1, 1], [0.0, 0.0]);
    chunk
}

/// Golden horns on the corners of the temple's roof, and its spire.
fn horns(half: f32) -> Chunk {
    let mut chunk = Chunk::default();
    let gold = chunk.on(Surface::Gold);
    let at = half - 0.4;
    for (x, z) in [(-at, -at), (at, -at), (at, at), (-at, at)] {
        gold.rod([Vec3::new(x, 0.0, z), Vec3::new(1.12 * x, 1.7, 1.12 * z)], [0.32, 0.03], 8);
    }
    gold.lathe(
        &[[1.5, 0.0], [1.5, 0.5], [1.1, 0.5], [1.1, 1.0], [0.7, 1.0], [0.7, 1.5], [0.0, 2.6]],
        16,
        false,
    );
    chunk
}
