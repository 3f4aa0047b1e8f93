//! The city: stepped towers on plateaus between streets, around a great ziggurat, within a wall.
//!
//! It is 222 m wide and long, and 29 m high; the great ziggurat stands over the origin, and streets lie at
//! y = 0. From afar all of it is seen at once; from a street, little but two rows of walls, the nearest 4 m away.
//!
//! ```text
//!   z -105 ############################
//!          # []  []  []  []  []  []  [] #   [] a plateau with a tower of 2 to 5 storeys, 22 m wide
//!          # []  []  []  []  []  []  [] #      streets of 8 m between them
//!          # []  []  .---------.  []  [] #
//!   z   0  # []  []  |  _/^\_  |  []  [] #   the precinct: the great ziggurat of 4 storeys, pools, trees
//!          # []  []  '----=----'  []  [] #   = its stairs, which face +Z
//!          # []  []  []  []  []  []  [] #
//!   z  105 ############################   the wall, with a bastion every 30 m
//!          x -105       0         105
//! ```

mod storey;
mod things;
mod ziggurat;

use glam::Vec3;

use super::builder::{Builder, Model};
use super::maths::{Dice, Place};
use super::mesh::{Chunk, Mesh};
use super::palette::Surface;
use super::{Detail, props};
use storey::{Crown, Dress, Storey};

/// Distance between the middles of plateaus, metres.
const PITCH: f32 = 30.0;
/// Plateaus lie at -`REACH`..=`REACH` times the pitch.
const REACH: i32 = 3;
/// Half the width of a plateau.
const PLATEAU: f32 = 11.0;
/// Half the width of the precinct, which takes the place of nine plateaus.
const PRECINCT: f32 = 41.0;
/// Height of plateaus over the streets.
const STEP: f32 = 1.4;
/// Height of the precinct over the streets.
const GREAT_STEP: f32 = 2.0;
/// Half the width of the city to the inner foot of its wall.
const WALL: f32 = 105.0;
/// Thickness of the wall.
const THICK: f32 = 5.0;
/// How far the land around the city reaches.
const LAND: f32 = 240.0;

/// Detail of what grows.
const GREEN: Detail = Detail { step: 4.0, round: 14, leaves: 130, level: 0 };

/// The whole city, ready to be finished.
pub(super) fn build() -> Builder {
    let mut city = City::default();
    city.streets();
    city.towers();
    city.precinct();
    city.wall();
    city.lamps();
    city.builder
}

/// The city under construction.
#[derive(Default)]
struct City {
    builder: Builder,
}

/// Middles of all plateaus beside the precinct, (x, z), row by row.
fn blocks() -> impl Iterator<Item = [f32; 2]> {
    let axis = || -REACH..=REACH;
    let outside = |x: i32, z: i32| x.abs() > 1 || z.abs() > 1;
    axis().flat_map(move |z| {
        axis().filter(move |x| outside(*x, z)).map(move |x| [x as f32 * PITCH, z as f32 * PITCH])
    })
}

/// A level ring around the origin between two squares, half their widths given, in four rectangles.
fn ring(surface: Surface, [inner, outer]: [f32; 2], cells: u32) -> Chunk {
    let mut chunk = Chunk::default();
    let mut side = Mesh::default();
    let (corner, length) = (Vec3::new(-outer, 0.0, outer), inner + outer);
    side.rect(corner, [Vec3::X * length, Vec3::Z * (inner - outer)], [cells, 1], [0.0, 0.0]);
    for quarter in 0..4 {
        chunk.on(surface).append(&side, &Place::at(0.0, 0.0, 0.0).turned(f64::from(quarter) / 4.0));
    }
    chunk
}

impl City {
    /// The streets around each plateau and around the precinct, and the land outside the wall.
    fn streets(&mut self) {
        let around = self.builder.model(ring(Surface::Road, [PLATEAU, PITCH / 2.0], 2));
        for [x, z] in blocks() {
            self.builder.put(&around, [x, 0.0, z], 0.0);
        }
        let origin = Place::at(0.0, 0.0, 0.0);
        self.builder.add(ring(Surface::Road, [PRECINCT, 1.5 * PITCH], 8), &origin);
        self.builder.add(ring(Surface::Meadow, [WALL + THICK, LAND], 4), &Place::at(0.0, -0.02, 0.0));
    }

    /// Plateaus with their towers, each turned to one of the four sides.
    fn towers(&mut self) {
        let plateau = self.builder.model(ziggurat::plateau(PLATEAU, STEP));
        let kinds: Vec<Model> =
            ziggurat::TOWERS.iter().map(|tiers| self.builder.model(ziggurat::tower(tiers))).collect();
        let garden = self.garden();
        let mut dice = Dice::new(2016);
        for [x, z] in blocks() {
            let (kind, turn) = (dice.below(kinds.len() as u32), f64::from(dice.below(4)) / 4.0);
            self.builder.put(&plateau, [x, 0.0, z], turn);
            self.builder.put(&kinds[kind as usize], [x, STEP, z], turn);
            for [side, along] in [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
                if dice.chance(0.4) {
                    let (tree, turn) = (&garden[dice.below(2) as usize], f64::from(dice.unit()));
                    self.builder.put(tree, [x + side * 9.7, STEP, z + along * 9.7], turn);
                }
            }
        }
    }

    /// The two kinds of trees.
    fn garden(&mut self) -> [Model; 2] {
        [props::cypress(&GREEN, 71), props::tree(&GREEN, 72)].map(|chunk| self.builder.model(chunk))
    }

    /// The great ziggurat and what lies around it.
    fn precinct(&mut self) {
        let floor = Storey { foot: [PRECINCT; 2], low: 0.0, height: GREAT_STEP, batter: 0.2 };
        let dress = Dress { wall: Surface::Limestone, crown: Crown::Edge, stair: Some(6.0) };
        self.builder.add(floor.build(&dress), &Place::at(0.0, 0.0, 0.0));
        for chunk in ziggurat::great() {
            self.builder.add(chunk, &Place::at(0.0, GREAT_STEP, 0.0));
        }
        let pool = self.builder.model(things::pool([6.0, 5.0]));
        let brazier = self.builder.model(things::brazier());
        let garden = self.garden();
        for side in [-1.0, 1.0] {
            self.builder.put(&pool, [side * 17.0, GREAT_STEP, 33.0], 0.0);
            for z in [26.5, 39.0] {
                self.builder.put(&brazier, [side * 6.6, GREAT_STEP, z], 0.0);
            }
            for k in 0..8 {
                let along = -35.0 + 9.0 * k as f32;
                let turn = 0.13 * f64::from(k);
                self.builder.put(&garden[0], [side * 36.0, GREAT_STEP, along], turn);
                self.builder.put(&garden[(k % 2) as usize], [along, GREAT_STEP, -36.0 + side], turn + 0.4);
            }
            for (low, half) in [(8.0, 18.2), (14.5, 13.2)] {
                for z in [-half, 0.0, half] {
                    self.builder.put(&garden[1], [side * half, GREAT_STEP + low, z], f64::from(z) / 40.0);
                }
            }
        }
    }

    /// The wall: a piece a pitch, a bastion where two meet.
    fn wall(&mut self) {
        let dress = |wall| Dress { wall, crown: Crown::Merlons { apart: 2.4 }, stair: None };
        let piece = Storey { foot: [PITCH / 2.0, THICK / 2.0], low: 0.0, height: 8.0, batter: 0.5 };
        let bastion = Storey { foot: [3.6, 3.6], low: 0.0, height: 11.0, batter: 0.7 };
        let piece = self.builder.model(piece.build(&dress(Surface::Brick)));
        let bastion = self.builder.model(bastion.build(&dress(Surface::GlazedBrick)));
        let out = WALL + THICK / 2.0;
        for quarter in 0..4 {
            let side = Place::at(0.0, 0.0, 0.0).turned(f64::from(quarter) / 4.0);
            for k in -REACH..=REACH {
                self.builder.place(&piece, &side.then(&Place::at(k as f32 * PITCH, 0.0, out)));
                let joint = (k as f32 - 0.5) * PITCH;
                self.builder.place(&bastion, &side.then(&Place::at(joint, 0.0, out)));
            }
        }
    }

    /// Lamps where streets cross, out of the middle.
    fn lamps(&mut self) {
        let lamp = self.builder.model(things::lamp());
        let crossings = || (-REACH..=REACH + 1).map(|k| (k as f32 - 0.5) * PITCH);
        for (x, z) in crossings().flat_map(|z| crossings().map(move |x| (x, z))) {
            if x.abs().max(z.abs()) < WALL - 1.0 && x.abs().max(z.abs()) > PRECINCT {
                self.builder.put(&lamp, [x + 3.0, 0.0, z + 3.0], 0.125);
            }
        }
    }
}
