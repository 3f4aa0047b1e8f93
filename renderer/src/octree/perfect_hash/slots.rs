//! Which slots of a table are free, as bits.

use glam::UVec3;

/// Offsets along an axis that 8 bits tell apart.
const OFFSETS: usize = 256;

/// Words of 64 that hold a bit for each offset along an axis.
const WORDS: usize = OFFSETS / 64;

/// The free slots of a cubic table: a bit a slot.
///
/// A row along x stands twice over in its bits, so that what begins anywhere in it and goes around is read in one go.
#[derive(Debug, Clone)]
pub(in super::super) struct FreeSlots {
    side: usize,
    /// Words of a row.
    stride: usize,
    bits: Vec<u64>,
    /// Free slots of each row.
    in_row: Vec<u32>,
}

impl FreeSlots {
    /// A table of `side`^3 slots, all free.
    pub fn new(side: u32) -> Self {
        let side = side as usize;
        // What is read from the last slot of a row on goes past its second half by at most one word.
        let stride = (2 * side).div_ceil(64) + 1;
        let row: Vec<u64> =
            (0..stride).map(|word| first_bits((2 * side).saturating_sub(64 * word))).collect();
        Self { side, stride, bits: row.repeat(side * side), in_row: vec![side as u32; side * side] }
    }

    /// Whether a slot is free.
    pub fn is_free(&self, slot: UVec3) -> bool {
        let x = slot.x as usize;
        self.bits[self.row(slot.y, slot.z) * self.stride + x / 64] >> (x % 64) & 1 != 0
    }

    /// Takes a free slot.
    pub fn take(&mut self, slot: UVec3) {
        self.flip(slot);
        let row = self.row(slot.y, slot.z);
        self.in_row[row] -= 1;
    }

    /// Gives a slot back that was taken.
    pub fn give(&mut self, slot: UVec3) {
        self.flip(slot);
        let row = self.row(slot.y, slot.z);
        self.in_row[row] += 1;
    }

    /// Turns a slot's bits around.
    fn flip(&mut self, slot: UVec3) {
        let row = self.row(slot.y, slot.z);
        for x in [slot.x as usize, slot.x as usize + self.side] {
            self.bits[row * self.stride + x / 64] ^= 1 << (x % 64);
        }
    }

    /// The first offset from `start` on, and around, that puts all of some places on free slots. Offsets are below the side and below
    /// 256 along each axis.
    pub fn offset_for(&self, places: &[UVec3], start: UVec3) -> Option<UVec3> {
        let reach = self.side.min(OFFSETS) as u32;
        let (first, rows) = (start.y + reach * start.z, reach * reach);
        (first..rows).chain(0..first).find_map(|row| {
            let (y, z) = (row % reach, row / reach);
            let free = self.along_x(places, y, z, reach)?;
            Some(UVec3::new(first_from(free, start.x), y, z))
        })
    }

    /// The offsets along x, as bits, that put all of some places on free slots, with those along y and z as given.
    fn along_x(&self, places: &[UVec3], y: u32, z: u32, reach: u32) -> Option<[u64; WORDS]> {
        let words = (reach as usize).div_ceil(64);
        let mut free: [u64; WORDS] =
            std::array::from_fn(|word| first_bits((reach as usize).saturating_sub(64 * word)));
        for place in places {
            let row = self.row(self.around(place.y + y), self.around(place.z + z));
            if self.in_row[row] == 0 {
                return None;
            }
            let bits = &self.bits[row * self.stride..][..self.stride];
            let mut any = 0;
            for (word, free) in free[..words].iter_mut().enumerate() {
                *free &= window(bits, place.x as usize + 64 * word);
                any |= *free;
            }
            if any == 0 {
                return None;
            }
        }
        Some(free)
    }

    /// A coordinate below twice the side, around the table.
    fn around(&self, at: u32) -> u32 {
        if at as usize >= self.side { at - self.side as u32 } else { at }
    }

    fn row(&self, y: u32, z: u32) -> usize {
        y as usize + self.side * z as usize
    }
}

/// A word with its first `count` bits set, at most all.
fn first_bits(count: usize) -> u64 {
    if count >= 64 { u64::MAX } else { (1 << count) - 1 }
}

/// 64 bits from `start` on; those past the end are 0.
fn window(bits: &[u64], start: usize) -> u64 {
    let (word, shift) = (start / 64, start % 64);
    let low = bits.get(word).copied().unwrap_or(0) >> shift;
    let high = bits.get(word + 1).copied().unwrap_or(0);
    // In two steps, for a shift by 64 has no meaning.
    low | high << 1 << (63 - shift)
}

/// The first bit set from `start` on, and around, of bits of which some are.
fn first_from(bits: [u64; WORDS], start: u32) -> u32 {
    let first = |bits: [u64; WORDS]| {
        (0_u32..).step_by(64).zip(bits).find_map(|(at, word)| (word != 0).then(|| at + word.trailing_zeros()))
    };
    let later =
        std::array::from_fn(|word| bits[word] & !first_bits((start as usize).saturating_sub(64 * word)));
    first(later).or_else(|| first(bits)).expect("a bit that is set")
}
