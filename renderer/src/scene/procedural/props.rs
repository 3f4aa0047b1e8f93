//! Things that stand about: modelled once around the origin (standing on y = 0) and placed many times.

mod furniture;
mod greenery;

pub(super) use furniture::{bollard, crate_box, kiosk, lamp, scooter, terrace};
pub(super) use greenery::{cypress, planter, tree};
