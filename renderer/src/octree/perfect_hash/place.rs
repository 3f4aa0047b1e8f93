//! The offsets of a perfect hash (Lefebvre and Hoppe section 4.1).
//!
//! Keys fall into buckets by the offset that they have in common. The largest bucket is placed first, where there is most
//! room. Its offset is one of its neighbours' where that puts all of its keys on free slots, for then keys that lie side by
//! side stay so; else the first that does from a random one on. None is left out: a bucket without an offset has none.

use super::slots::FreeSlots;
use super::{linear, offset_index};
use glam::{U8Vec3, UVec3};
use rand_core::Rng;
use rand_pcg::Pcg32;

/// Places of keys by bucket: those of bucket `b` are `places[starts[b]..starts[b + 1]]`.
struct Buckets {
    starts: Vec<u32>,
    places: Vec<UVec3>,
}

/// The offsets, `offset_side`^3, that put all keys on slots of their own in a table of `side`^3; `None` where none were found.
pub(super) fn offsets(keys: &[UVec3], side: u32, offset_side: u32, mut random: Pcg32) -> Option<Vec<U8Vec3>> {
    let buckets = Buckets::new(keys, side, offset_side);
    // Keys nearer to each other than both sides together tell apart differ by one of them.
    let all_distinct = extent(keys) < u64::from(side) * u64::from(offset_side);
    let mut free = FreeSlots::new(side);
    let mut offsets: Vec<Option<U8Vec3>> = vec![None; buckets.count()];
    for bucket in buckets.largest_first() {
        let places = buckets.places(bucket);
        if !(all_distinct || distinct(places)) {
            return None;
        }
        let around = neighbours(bucket, offset_side);
        let offset = neighbours_offset(&free, places, around.map(|other| offsets[other]), side);
        let offset = offset.or_else(|| free.offset_for(places, start(&mut random, side)))?;
        places.iter().for_each(|place| free.take(shifted(*place, offset, side)));
        offsets[bucket] = Some(offset.as_u8vec3());
    }
    Some(offsets.into_iter().map(Option::unwrap_or_default).collect())
}

impl Buckets {
    /// Keys as places in a table of `side`^3 without an offset, in the order of their buckets.
    fn new(keys: &[UVec3], side: u32, offset_side: u32) -> Self {
        let mut starts = vec![0; (offset_side as usize).pow(3) + 1];
        let buckets: Vec<u32> = keys.iter().map(|key| offset_index(*key, offset_side) as u32).collect();
        buckets.iter().for_each(|bucket| starts[*bucket as usize + 1] += 1);
        for bucket in 1..starts.len() {
            starts[bucket] += starts[bucket - 1];
        }
        let mut next = starts.clone();
        let mut places = vec![UVec3::ZERO; keys.len()];
        for (key, bucket) in keys.iter().zip(buckets) {
            places[next[bucket as usize] as usize] = *key % side;
            next[bucket as usize] += 1;
        }
        Self { starts, places }
    }

    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    fn len(&self, bucket: usize) -> usize {
        (self.starts[bucket + 1] - self.starts[bucket]) as usize
    }

    fn places(&self, bucket: usize) -> &[UVec3] {
        &self.places[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    /// Buckets with keys, the largest first and in order among those of a size.
    fn largest_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.count()).filter(|bucket| self.len(*bucket) > 0).collect();
        order.sort_by_key(|bucket| std::cmp::Reverse(self.len(*bucket)));
        order
    }
}

/// How far keys reach along an axis at most.
fn extent(keys: &[UVec3]) -> u64 {
    let low = keys.iter().copied().reduce(UVec3::min).unwrap_or_default();
    let high = keys.iter().copied().reduce(UVec3::max).unwrap_or_default();
    u64::from((high - low).max_element())
}

/// Whether no two places are the same: what agrees by both sides no offset parts.
pub(in super::super) fn distinct(places: &[UVec3]) -> bool {
    let mut sorted: Vec<[u32; 3]> = places.iter().map(|place| place.to_array()).collect();
    sorted.sort_unstable();
    sorted.windows(2).all(|pair| pair[0] != pair[1])
}

/// The 26 buckets around one, around the ends of their table.
fn neighbours(bucket: usize, offset_side: u32) -> [usize; 26] {
    let side = offset_side as usize;
    let at = UVec3::new((bucket % side) as u32, (bucket / side % side) as u32, (bucket / side / side) as u32);
    std::array::from_fn(|index| {
        // The 14th of the 27 is the bucket itself.
        let index = (index + usize::from(index > 12)) as u32;
        let step = UVec3::new(index % 3, index / 3 % 3, index / 9);
        linear((at + offset_side - 1 + step) % offset_side, offset_side)
    })
}

/// The first of some offsets that puts all places on free slots.
fn neighbours_offset(
    free: &FreeSlots,
    places: &[UVec3],
    offsets: [Option<U8Vec3>; 26],
    side: u32,
) -> Option<UVec3> {
    let mut last = None;
    offsets.into_iter().flatten().map(U8Vec3::as_uvec3).find(|offset| {
        let new = last.replace(*offset) != Some(*offset);
        new && places.iter().all(|place| free.is_free(shifted(*place, *offset, side)))
    })
}

/// Where a place of the table comes to lie.
fn shifted(place: UVec3, offset: UVec3, side: u32) -> UVec3 {
    let at = place + offset;
    // Below the side, what is left wraps to far more.
    at.min(at.wrapping_sub(UVec3::splat(side)))
}

/// Where the search for an offset begins.
fn start(random: &mut Pcg32, side: u32) -> UVec3 {
    let mut axis = || random.next_u32() % side.min(256);
    UVec3::new(axis(), axis(), axis())
}
