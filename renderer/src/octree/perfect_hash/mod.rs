//! Perfect spatial hashing (Lefebvre and Hoppe 2006): sparse keys on a grid, each on a slot of its own in a small table.
//!
//! ```text
//! keys (cells) ─ sizes ─ m, r ─ buckets (keys by p mod r, largest first) ─ place ─ offsets Phi
//!                                    │                                      └ slots: the free ones, as bits
//! h(p) = ((p mod m) + Phi[p mod r]) mod m                       slot of p in a table of m^3
//! ```
//!
//! Tegelaers leaves the last `mod m` out in places, and puts the bound past which the table has slots to spare at 255 keys;
//! it is where its side exceeds what offsets of 8 bits reach.

mod place;
mod sizes;
mod slots;

use glam::{U8Vec3, UVec3};
pub(super) use place::distinct;
use rand_pcg::Pcg32;
pub(super) use slots::FreeSlots;

/// How often a size of the table of offsets is tried where keys are few: whether the last of them find a slot is luck then.
const TRIES: u64 = 4;

/// Keys from which on a size is tried once: many keys know no luck, but take long.
const MANY_KEYS: usize = 1 << 16;

/// A perfect hash of some keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PerfectHash {
    /// Slots along an axis of the table, `m`.
    pub side: u32,
    /// Offsets along an axis of theirs, `r`.
    pub offset_side: u32,
    /// `offset_side`^3 offsets, x first.
    pub offsets: Vec<U8Vec3>,
}

/// How a perfect hash is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HashSettings {
    /// Seed of where the search for an offset begins.
    pub seed: u64,
    /// Slots per key, from 1 on.
    pub slack: f64,
    /// Most slots, and most offsets.
    pub most_slots: usize,
}

/// Why there is no perfect hash of some keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HashError {
    /// It would take this many slots or offsets.
    TooLarge(usize),
    /// No offsets were found, however many there were.
    NotFound,
}

impl PerfectHash {
    /// The hash of distinct keys: as small a table as the settings allow, and the first of growing tables of offsets that does.
    /// That of no keys has one slot.
    ///
    /// # Errors
    /// The table is larger than the settings allow, or no offsets separate the keys.
    pub fn build(keys: &[UVec3], settings: &HashSettings) -> Result<Self, HashError> {
        let side = sizes::slot_side(keys.len(), settings.slack);
        let checked = |side: u32| {
            let slots = (side as usize).pow(3);
            if slots > settings.most_slots { Err(HashError::TooLarge(slots)) } else { Ok(side) }
        };
        checked(side)?;
        let tries = if keys.len() < MANY_KEYS { TRIES } else { 1 };
        for offset_side in sizes::offset_sides(keys.len(), side) {
            checked(offset_side)?;
            let found = (0..tries)
                .map(|attempt| Pcg32::new(settings.seed, attempt))
                .find_map(|random| place::offsets(keys, side, offset_side, random));
            if let Some(offsets) = found {
                return Ok(Self { side, offset_side, offsets });
            }
        }
        Err(HashError::NotFound)
    }

    /// The hash of distinct keys with tables of given sides, of slots and of offsets; `None` where none was found.
    pub fn of_sides(keys: &[UVec3], [side, offset_side]: [u32; 2], seed: u64) -> Option<Self> {
        let holds = (side as usize).pow(3) >= keys.len();
        let offsets =
            holds.then(|| place::offsets(keys, side, offset_side, Pcg32::new(seed, 0))).flatten()?;
        Some(Self { side, offset_side, offsets })
    }

    /// Where in the table the slot of a key is.
    pub fn place(&self, key: UVec3) -> UVec3 {
        let offset = self.offsets[offset_index(key, self.offset_side)];
        (key % self.side + offset.as_uvec3()) % self.side
    }

    /// The slot of a key.
    pub fn slot(&self, key: UVec3) -> usize {
        let offset = self.offsets[offset_index(key, self.offset_side)];
        slot_index(key, self.side, offset)
    }
}

/// Which of `offset_side`^3 offsets is a key's.
pub fn offset_index(key: UVec3, offset_side: u32) -> usize {
    linear(key % offset_side, offset_side)
}

/// Which of `side`^3 slots is a key's, with its offset.
pub fn slot_index(key: UVec3, side: u32, offset: U8Vec3) -> usize {
    linear((key % side + offset.as_uvec3()) % side, side)
}

/// The index of a place in a cube of `side`^3, x first.
fn linear(at: UVec3, side: u32) -> usize {
    let side = side as usize;
    at.x as usize + side * (at.y as usize + side * at.z as usize)
}

#[cfg(test)]
mod tests;
