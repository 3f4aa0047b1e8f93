//! Sets of buffer names, as bits.

use super::{BUFFER_COUNT, BufferName};
use std::fmt;
use std::ops::{BitOr, Sub};

/// A set of the buffers that shaders see.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct BufferSet(u64);

const _: () = assert!(BUFFER_COUNT <= u64::BITS as usize, "a set has a bit for each buffer");

/// The set of the buffers `names`.
pub const fn set(names: &[BufferName]) -> BufferSet {
    let (mut bits, mut place) = (0, 0);
    while place < names.len() {
        bits |= 1 << names[place] as u32;
        place += 1;
    }
    BufferSet(bits)
}

impl BufferSet {
    /// The set of no buffers.
    pub const EMPTY: Self = Self(0);

    /// Adds one buffer to the set.
    pub fn insert(&mut self, name: BufferName) {
        self.0 |= set(&[name]).0;
    }

    /// Whether a buffer is in the set.
    pub fn contains(self, name: BufferName) -> bool {
        self.0 & set(&[name]).0 != 0
    }

    /// Buffers of the set, in the order of the table.
    pub fn names(self) -> impl Iterator<Item = BufferName> {
        BufferName::ALL.into_iter().filter(move |&name| self.contains(name))
    }
}

impl BitOr for BufferSet {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Sub for BufferSet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}

impl fmt::Debug for BufferSet {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_set().entries(self.names()).finish()
    }
}
