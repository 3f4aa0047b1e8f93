//! Trees, lamps, café terraces, scooters and lights across the street.

use glam::Vec3;

use super::super::Detail;
use super::super::builder::{Builder, Model};
use super::super::maths::{Dice, Place};
use super::super::mesh::Chunk;
use super::super::palette::Surface;
use super::super::props;
use super::distance_to_flight;
use super::house::House;

/// Height of the pavement, on which most things stand.
const PAVEMENT: f32 = 0.14;

/// Models that are placed many times.
struct Models {
    trees: [Model; 3],
    planters: [Model; 2],
    lamp: Model,
    terrace: Model,
    scooter: Model,
    crates: Model,
    bollard: Model,
}

impl Models {
    fn new(builder: &mut Builder, detail: &Detail) -> Self {
        Self {
            trees: [11, 12, 13].map(|seed| builder.model(props::tree(detail, seed))),
            planters: [21, 22].map(|seed| builder.model(props::planter(detail, seed))),
            lamp: builder.model(props::lamp(detail)),
            terrace: builder.model(props::terrace(detail)),
            scooter: builder.model(props::scooter(detail)),
            crates: builder.model(props::crate_box(detail)),
            bollard: builder.model(props::bollard(detail)),
        }
    }
}

/// Furnishes the pavements before the houses, the square and the air over street B.
pub(super) fn furnish(builder: &mut Builder, houses: &[House], detail: &Detail) {
    let models = Models::new(builder, detail);
    let mut dice = Dice::new(1871);
    for house in houses {
        let mut pavement = Pavement { house, models: &models, builder, dice: &mut dice, detail };
        pavement.kerbside();
        pavement.walls();
    }
    builder.add(props::kiosk(detail), &Place::at(-0.6, 0.0, -2.2));
    for (from, to) in [
        ([1.5, 15.7], [5.0, 5.0]),
        ([13.0, 16.8], [15.0, 8.8]),
        ([25.0, 18.6], [26.5, 9.6]),
        ([36.0, 21.4], [38.5, 11.0]),
    ] {
        let [from, to] = [from, to].map(|[x, z]| Vec3::new(x, 8.6, z));
        builder.add(garland(from, to, detail), &Place::at(0.0, 0.0, 0.0));
    }
}

/// The pavement before one house.
struct Pavement<'a> {
    house: &'a House,
    models: &'a Models,
    builder: &'a mut Builder,
    dice: &'a mut Dice,
    detail: &'a Detail,
}

impl Pavement<'_> {
    fn at(&self, x: f32, y: f32, z: f32) -> Place {
        self.house.place.then(&Place::at(x, y, z))
    }

    /// Room for things at `z` metres from the front: x from, to.
    fn stretch(&self, z: f32) -> [f32; 2] {
        [self.house.end(0, z).max(0.0) + 0.8, self.house.end(1, z).min(self.house.width) - 0.8]
    }

    /// Things in a line along the kerb; scooters stand beyond it.
    fn kerbside(&mut self) {
        let [x0, x1] = self.stretch(3.6);
        let step = 2.1;
        let count = ((x1 - x0) / step) as u32;
        for k in 0..count {
            let x = x0 + step * (k as f32 + 0.5);
            match k % 5 {
                0 => self.tree_or_lamp(x),
                3 => self.lamp(x),
                4 if self.dice.chance(0.6) => self.scooters(x),
                _ => {
                    let place = self.at(x, PAVEMENT, 2.05);
                    self.builder.place(&self.models.bollard, &place);
                }
            }
        }
    }

    fn tree_or_lamp(&mut self, x: f32) {
        let place = self.at(x, PAVEMENT - 0.02, 1.75);
        let distance = distance_to_flight(place.point(Vec3::ZERO));
        if distance < 3.4 {
            return;
        }
        let model = &self.models.trees[self.dice.below(3) as usize];
        let scale = self.dice.range(0.85, 1.1);
        let place = place.turned(f64::from(self.dice.unit())).scaled(scale);
        self.builder.place(model, &place);
    }

    fn lamp(&mut self, x: f32) {
        let place = self.at(x, PAVEMENT, 1.9);
        if distance_to_flight(place.point(Vec3::ZERO)) > 2.0 {
            self.builder.place(&self.models.lamp, &place);
        }
    }

    fn scooters(&mut self, x: f32) {
        for k in 0..1 + self.detail.level {
            let turn = 0.25 + f64::from(self.dice.range(-0.03, 0.03));
            let place = self.at(x + 0.75 * k as f32, 0.02, 3.4).turned(turn);
            self.builder.place(&self.models.scooter, &place);
        }
    }

    /// Things in a line along the wall: tables before shops, planters and crates elsewhere.
    fn walls(&mut self) {
        let [x0, x1] = self.stretch(0.8);
        let terrace = self.house.style.shops && self.dice.chance(0.75);
        let step = if terrace { 2.0 } else { 2.8 };
        let door = self.house.width * (self.house.bays() / 2) as f32 / self.house.bays() as f32 + 1.35;
        for k in 0..((x1 - x0) / step) as u32 {
            let x = x0 + step * (k as f32 + 0.5);
            if (x - door).abs() < 1.6 {
                continue;
            }
            if terrace {
                self.terrace(x);
            } else {
                self.planter_or_crates(x);
            }
        }
    }

    fn terrace(&mut self, x: f32) {
        let turn = f64::from(self.dice.range(-0.08, 0.08) + 0.5 * self.dice.below(2) as f32);
        let place = self.at(x, PAVEMENT, 1.05).turned(turn);
        self.builder.place(&self.models.terrace, &place);
    }

    fn planter_or_crates(&mut self, x: f32) {
        if self.dice.chance(0.6) {
            let model = &self.models.planters[self.dice.below(2) as usize];
            let place =
                self.house.place.then(&Place::at(x, PAVEMENT, 0.5)).turned(f64::from(self.dice.unit()));
            self.builder.place(model, &place);
            return;
        }
        for k in 0..3 {
            let place = self.at(
                x + 0.3 * (k % 2) as f32,
                PAVEMENT + 0.32 * (k / 2) as f32,
                0.35 + 0.4 * (k % 2) as f32,
            );
            let place = place.turned(f64::from(self.dice.range(-0.04, 0.04)));
            self.builder.place(&self.models.crates, &place);
        }
    }
}

/// A sagging cable of lights between two fronts.
fn garland(from: Vec3, to: Vec3, detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let at = |t: f32| from + (to - from) * t - Vec3::Y * (2.4 * t * (1.0 - t));
    let count = 9 + 6 * detail.level;
    let segments = detail.around(0.3, 4);
    for k in 0..count {
        let (a, b) = (at(k as f32 / count as f32), at((k + 1) as f32 / count as f32));
        chunk.on(Surface::Iron).rod([a, b], [0.012, 0.012], segments / 2 + 2);
        if k > 0 {
            chunk.on(Surface::LampGlass).ball(a - Vec3::Y * 0.1, 0.08, 1.2, segments);
        }
    }
    chunk
}
