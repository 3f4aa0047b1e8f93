//! Things that stand about: modelled once around the origin (standing on y = 0) and placed many times.

mod furniture;
mod greenery;

pub(super) use furniture::{bollard, chair, crate_box, kiosk, lamp, scooter, table};
pub(super) use greenery::{cypress, planter, tree};
