//! The street: where its houses, paving and furniture stand.
//!
//! ```text
//!   z -57  \ \            two rows along street A, which runs down to the square
//!           \A\
//!   z -12    \ \___
//!            |   __\____________   the square, with street B leading east
//!   z  16    |__________B_______|  closed by a row at its end
//!          x -9                66
//! ```

mod facade;
mod furnish;
mod ground;
mod house;
mod roof;

use glam::Vec3;
use rayon::prelude::*;

use super::builder::Builder;
use super::maths::{Dice, Place};
use super::{Detail, Size};
use house::{House, Style};

/// A row of houses: their front line as (x, z) points, the street to the right of who walks along it.
struct Row {
    points: &'static [[f32; 2]],
    /// Fewest and most storeys above the ground floor.
    storeys: [u32; 2],
}

const ROWS: [Row; 4] = [
    // East side of street A, the corner at the square, north side of street B.
    Row {
        points: &[
            [26.0, -42.8],
            [0.2, -7.9],
            [4.0, 4.2],
            [14.0, 8.2],
            [31.0, 9.4],
            [52.0, 12.4],
            [53.0, 1.0],
        ],
        storeys: [1, 3],
    },
    // A side street's north side and the west side of street A.
    Row { points: &[[-18.0, -14.7], [-9.4, -15.1], [13.6, -46.2]], storeys: [1, 2] },
    // South side of street B, west side of the square, the side street's south side.
    Row {
        points: &[[53.5, 37.0], [52.0, 26.0], [20.0, 17.8], [-9.0, 15.6], [-9.6, -6.0], [-17.5, -5.5]],
        storeys: [1, 3],
    },
    // The end of street B.
    Row { points: &[[66.0, 6.0], [66.5, 36.0]], storeys: [3, 4] },
];

/// How far houses reach back from their front line, metres.
const DEPTH: f32 = 7.0;

/// Where low flight must stay free of tall furniture: (x, z) along the streets.
const FLIGHT: [[f32; 2]; 22] = [
    [17.8, -41.8],
    [15.4, -36.8],
    [11.1, -31.2],
    [2.1, -20.2],
    [-1.9, -14.4],
    [-5.7, -8.4],
    [-6.0, -5.0],
    [-5.2, -1.5],
    [-4.8, 1.8],
    [-5.5, 3.3],
    [-4.4, 5.2],
    [1.1, 9.3],
    [3.5, 11.9],
    [6.7, 13.2],
    [13.7, 14.1],
    [22.9, 14.1],
    [27.2, 15.8],
    [35.9, 16.0],
    [40.5, 18.0],
    [51.5, 18.3],
    [55.1, 21.0],
    [58.6, 22.6],
];

fn detail(size: Size) -> Detail {
    match size {
        Size::Small => Detail { step: 40.0, round: 8, leaves: 60, level: 0 },
        Size::Medium => Detail { step: 0.38, round: 21, leaves: 1100, level: 1 },
        Size::Large => Detail { step: 0.095, round: 42, leaves: 8000, level: 2 },
    }
}

/// The whole street, ready to be finished.
pub(super) fn build(size: Size) -> Builder {
    let detail = detail(size);
    let mut builder = Builder::default();
    for (chunk, place) in ground::tiles(&detail) {
        builder.add(chunk, &place);
    }
    let houses = houses();
    let built: Vec<_> = houses.par_iter().map(|house| house.build(&detail)).collect();
    for (house, chunks) in houses.iter().zip(built) {
        for chunk in chunks {
            builder.add(chunk, &house.place);
        }
    }
    furnish::furnish(&mut builder, &houses, &detail);
    builder
}

/// All houses, row by row.
fn houses() -> Vec<House> {
    let mut dice = Dice::new(1889);
    ROWS.iter().flat_map(|row| row.houses(&mut dice)).collect()
}

impl Row {
    fn houses(&self, dice: &mut Dice) -> Vec<House> {
        let sides: Vec<Side> = self.points.windows(2).map(|ends| Side::new(ends[0], ends[1])).collect();
        let mut houses = Vec::new();
        for (k, side) in sides.iter().enumerate() {
            let before = k.checked_sub(1).map_or(0.0, |before| side.mitre(&sides[before]));
            let after = sides.get(k + 1).map_or(0.0, |after| side.mitre(after));
            let count = (side.length / 13.0).round().max(1.0) as u32;
            for lot in 0..count {
                let start = side.length * lot as f32 / count as f32;
                let mitre = [if lot == 0 { before } else { 0.0 }, if lot + 1 == count { after } else { 0.0 }];
                houses.push(self.house(side, start, side.length / count as f32, mitre, dice));
            }
        }
        houses
    }

    fn house(&self, side: &Side, start: f32, width: f32, mitre: [f32; 2], dice: &mut Dice) -> House {
        let [x, z] = side.start;
        let [ex, ez] = side.along;
        let [low, high] = self.storeys;
        House {
            place: Place::along(Vec3::new(x + ex * start, 0.0, z + ez * start), side.along),
            width,
            depth: DEPTH,
            mitre,
            storeys: low + dice.below(high - low + 1),
            style: Style::throw(dice),
            seed: u64::from(dice.below(u32::MAX)),
        }
    }
}

/// One straight part of a row.
struct Side {
    start: [f32; 2],
    along: [f32; 2],
    length: f32,
}

impl Side {
    fn new(start: [f32; 2], end: [f32; 2]) -> Self {
        let (dx, dz) = (end[0] - start[0], end[1] - start[1]);
        let length = (dx * dx + dz * dz).sqrt();
        Self { start, along: [dx / length, dz / length], length }
    }

    /// How far the joint with a neighbour side moves along this side for each metre towards the street.
    fn mitre(&self, neighbour: &Self) -> f32 {
        let [ex, ez] = self.along;
        let [fx, fz] = neighbour.along;
        let outward = [-ez - fz, ex + fx];
        let (along, out) = (outward[0] * ex + outward[1] * ez, outward[1] * ex - outward[0] * ez);
        along / out
    }
}

/// Distance in the plane of (x, z) from the flight through the streets.
fn distance_to_flight(point: Vec3) -> f32 {
    FLIGHT
        .windows(2)
        .map(|ends| {
            let (dx, dz) = (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
            let (px, pz) = (point.x - ends[0][0], point.z - ends[0][1]);
            let t = ((px * dx + pz * dz) / (dx * dx + dz * dz)).clamp(0.0, 1.0);
            let (qx, qz) = (px - dx * t, pz - dz * t);
            (qx * qx + qz * qz).sqrt()
        })
        .fold(f32::INFINITY, f32::min)
}
