//! What an update did.

use std::ops::Range;

/// What an update did to an octree's tables.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct UpdateReport {
    /// Lights that changed, came or went.
    pub changed: usize,
    /// Whether the whole octree was built anew.
    pub anew: bool,
    /// Keys put, taken away, or with another value; 0 where the whole octree was built anew.
    pub edits: usize,
    /// Tables hashed anew.
    pub rebuilt: usize,
    /// Leaves that may list more lights than reach all of their cells.
    pub extras: usize,
    /// What to upload.
    pub dirty: Dirty,
}

/// What of an octree changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Dirty {
    /// All of it, and where things lie.
    All,
    /// Parts, ascending, each of the vector of its name; the list of indices may have grown. What lies between two parts that are near
    /// each other is among them.
    Parts {
        /// Of [`LinklessOctree::structure`](super::super::LinklessOctree::structure).
        structure: Vec<Range<usize>>,
        /// Of [`LinklessOctree::leaves`](super::super::LinklessOctree::leaves).
        leaves: Vec<Range<usize>>,
        /// Of [`LinklessOctree::offsets`](super::super::LinklessOctree::offsets).
        offsets: Vec<Range<usize>>,
        /// Of [`LinklessOctree::indices`](super::super::LinklessOctree::indices).
        indices: Vec<Range<usize>>,
    },
}

/// Two parts with no more places between them are one: a copy costs more than a few places.
const NEAR: usize = 8;

impl Default for Dirty {
    fn default() -> Self {
        Self::ranges([Vec::new(), Vec::new(), Vec::new()], Vec::new())
    }
}

impl Dirty {
    /// Whether nothing is to be uploaded.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::All => false,
            Self::Parts { structure, leaves, offsets, indices } => {
                [structure, leaves, offsets, indices].into_iter().all(Vec::is_empty)
            }
        }
    }

    /// Parts, of single places of structure, leaves and offsets, and of runs of indices.
    pub(super) fn ranges(places: [Vec<usize>; 3], indices: Vec<Range<usize>>) -> Self {
        let single = |places: Vec<usize>| joined(places.into_iter().map(|place| place..place + 1).collect());
        let [structure, leaves, offsets] = places.map(single);
        Self::Parts { structure, leaves, offsets, indices: joined(indices) }
    }
}

/// Ranges in order, those that are near each other as one.
fn joined(mut ranges: Vec<Range<usize>>) -> Vec<Range<usize>> {
    ranges.sort_unstable_by_key(|range| (range.start, range.end));
    let mut joined: Vec<Range<usize>> = Vec::new();
    for range in ranges {
        match joined.last_mut() {
            Some(last) if range.start <= last.end + NEAR => last.end = last.end.max(range.end),
            _ => joined.push(range),
        }
    }
    joined
}
