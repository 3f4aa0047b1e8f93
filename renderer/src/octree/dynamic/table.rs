//! A table whose keys come and go (Tegelaers section 8.2.3).

use super::super::layers::{Entries, Stored, perfect_hash};
use super::super::linkless::HashTable;
use super::super::perfect_hash::{FreeSlots, PerfectHash, distinct, offset_index};
use super::super::settings::{OctreeError, OctreeSettings};
use super::report::UpdateReport;
use super::{LayerTables, StoredLayer};
use glam::{U8Vec3, UVec3};
use std::collections::BTreeMap;

/// A table as the host knows it: which key is on which slot, and what was written since it was uploaded.
#[derive(Debug, Clone)]
pub(super) struct Table<T> {
    hash: PerfectHash,
    /// The key on each slot.
    keys: Vec<Option<UVec3>>,
    values: Vec<T>,
    free: FreeSlots,
    /// Keys that use each offset.
    buckets: Vec<Vec<UVec3>>,
    count: u32,
    /// Keys without a slot, until the table is hashed anew.
    waiting: BTreeMap<[u32; 3], T>,
    written: Written,
}

/// What was written since it was uploaded.
#[derive(Debug, Clone, Default)]
struct Written {
    all: bool,
    slots: Vec<usize>,
    offsets: Vec<usize>,
}

impl<T: Copy + Default + PartialEq> Table<T> {
    fn new(hash: PerfectHash, entries: impl Iterator<Item = (UVec3, T)>) -> Self {
        let slots = (hash.side as usize).pow(3);
        let mut table = Self {
            keys: vec![None; slots],
            values: vec![T::default(); slots],
            free: FreeSlots::new(hash.side),
            buckets: vec![Vec::new(); hash.offsets.len()],
            count: 0,
            waiting: BTreeMap::new(),
            written: Written::default(),
            hash,
        };
        entries.for_each(|(key, value)| table.occupy(key, value));
        table
    }

    /// Without slots: any key waits.
    fn without_slots() -> Self {
        Self::new(PerfectHash { side: 0, offset_side: 1, offsets: vec![U8Vec3::ZERO] }, std::iter::empty())
    }

    /// What is stored for a key.
    pub fn get(&self, key: UVec3) -> Option<T> {
        let waiting = || self.waiting.get(&key.to_array()).copied();
        self.slot_with(key).map(|slot| self.values[slot]).or_else(waiting)
    }

    /// Stores something for a key, or takes the key away; whether that was anything new.
    pub fn set(&mut self, key: UVec3, value: Option<T>) -> bool {
        if self.get(key) == value {
            return false;
        }
        match (self.slot_with(key), value) {
            (Some(slot), Some(value)) => self.write(slot, value),
            (Some(_), None) => {
                self.vacate(key);
                let bucket = self.bucket(key);
                self.buckets[bucket].retain(|other| *other != key);
                self.count -= 1;
            }
            (None, None) => {
                self.waiting.remove(&key.to_array());
            }
            (None, Some(value)) if !self.waiting.contains_key(&key.to_array()) && self.make_room(key) => {
                self.occupy(key, value);
            }
            (None, Some(value)) => {
                self.waiting.insert(key.to_array(), value);
            }
        }
        true
    }

    fn slot_with(&self, key: UVec3) -> Option<usize> {
        let slot = (!self.keys.is_empty()).then(|| self.hash.slot(key))?;
        (self.keys[slot] == Some(key)).then_some(slot)
    }

    /// Whether the slot of a new key is free, if need be by another offset for it and the keys that share it.
    fn make_room(&mut self, key: UVec3) -> bool {
        if self.keys.is_empty() {
            return false;
        }
        self.free.is_free(self.hash.place(key)) || self.move_bucket(key)
    }

    /// Chooses the offset of a new key's bucket anew, so that it and those in it lie on free slots; whether there is one.
    fn move_bucket(&mut self, key: UVec3) -> bool {
        let bucket = self.bucket(key);
        let members = self.buckets[bucket].clone();
        let places: Vec<UVec3> = members.iter().chain([&key]).map(|key| *key % self.hash.side).collect();
        if !distinct(&places) {
            return false;
        }
        let values: Vec<T> = members.iter().map(|member| self.vacate(*member)).collect();
        let before = self.hash.offsets[bucket];
        let offset = self.free.offset_for(&places, before.as_uvec3());
        self.hash.offsets[bucket] = offset.map_or(before, |offset| offset.as_u8vec3());
        self.written.offsets.push(bucket);
        members.into_iter().zip(values).for_each(|(member, value)| self.settle(member, value));
        offset.is_some()
    }

    /// Puts a new key on its slot, which is free.
    fn occupy(&mut self, key: UVec3, value: T) {
        let bucket = self.bucket(key);
        self.buckets[bucket].push(key);
        self.count += 1;
        self.settle(key, value);
    }

    /// Takes a slot for a key.
    fn settle(&mut self, key: UVec3, value: T) {
        let slot = self.hash.slot(key);
        self.free.take(self.hash.place(key));
        self.keys[slot] = Some(key);
        self.write(slot, value);
    }

    /// Frees the slot of a key; what was stored.
    fn vacate(&mut self, key: UVec3) -> T {
        let slot = self.hash.slot(key);
        let value = self.values[slot];
        self.free.give(self.hash.place(key));
        self.keys[slot] = None;
        self.write(slot, T::default());
        value
    }

    fn bucket(&self, key: UVec3) -> usize {
        offset_index(key, self.hash.offset_side)
    }

    fn write(&mut self, slot: usize, value: T) {
        self.values[slot] = value;
        self.written.slots.push(slot);
    }

    fn entries(&self) -> impl Iterator<Item = (UVec3, T)> {
        let stored = self.keys.iter().zip(&self.values);
        let stored = stored.filter_map(|(key, value)| key.map(|key| (key, *value)));
        stored.chain(self.waiting.iter().map(|(key, value)| (UVec3::from_array(*key), *value)))
    }

    /// Hashes the table anew where keys wait, at its size if that can be; whether it has another size then.
    ///
    /// # Errors
    /// There is no room for it, or no perfect hash was found.
    pub fn hash_anew(
        &mut self,
        depth: u32,
        settings: &OctreeSettings,
        report: &mut UpdateReport,
    ) -> Result<bool, OctreeError> {
        if self.waiting.is_empty() {
            return Ok(false);
        }
        report.rebuilt += 1;
        let mut entries: Vec<(UVec3, T)> = self.entries().collect();
        // As a walk of the octree would not, but always the same.
        entries.sort_unstable_by_key(|(key, _)| key.to_array());
        let keys: Vec<UVec3> = entries.iter().map(|(key, _)| *key).collect();
        let same = PerfectHash::of_sides(&keys, [self.hash.side, self.hash.offset_side], settings.seed);
        let resized = same.is_none();
        let hash = match same {
            Some(hash) => hash,
            None => perfect_hash(&keys, depth, settings)?,
        };
        *self = Self::new(hash, entries.into_iter());
        self.written.all = true;
        Ok(resized)
    }

    /// Copies what was written to where the device's slots are, and notes which.
    pub fn copy(&self, table: &mut HashTable, slots: &mut [T], copied: &mut Vec<usize>) {
        table.keys = self.count;
        let first = table.slots as usize;
        let before = copied.len();
        if self.written.all {
            copied.extend(first..first + self.values.len());
        } else {
            copied.extend(self.written.slots.iter().map(|slot| first + slot));
        }
        copied[before..].iter().for_each(|slot| slots[*slot] = self.values[slot - first]);
    }

    /// Copies offsets that were chosen anew to where the device's are, and notes which. Nothing counts as written then.
    pub fn copy_offsets(&mut self, table: &HashTable, offsets: &mut [[u8; 4]], copied: &mut Vec<usize>) {
        let first = table.offsets as usize;
        let Written { all, offsets: changed, .. } = std::mem::take(&mut self.written);
        let changed = if all { (0..self.hash.offsets.len()).collect() } else { changed };
        for at in changed {
            offsets[first + at] = self.hash.offsets[at].extend(0).to_array();
            copied.push(first + at);
        }
    }

    fn stored(&self) -> Stored<T> {
        let (keys, values) = self.entries().unzip();
        Stored { hash: self.hash.clone(), entries: Entries { keys, values } }
    }
}

impl LayerTables {
    pub(super) fn new(layer: StoredLayer) -> Self {
        fn table<T: Copy + Default + PartialEq>(Stored { hash, entries }: Stored<T>) -> Table<T> {
            let mut table = Table::new(hash, entries.keys.into_iter().zip(entries.values));
            table.written = Written::default();
            table
        }
        let data = layer.data.map_or_else(Table::without_slots, table);
        Self { structure: table(layer.structure), data }
    }

    /// Whether keys wait for a table to be hashed anew.
    pub(super) fn overflows(&self) -> bool {
        !(self.structure.waiting.is_empty() && self.data.waiting.is_empty())
    }

    pub(super) fn stored(&self) -> StoredLayer {
        let data = (!self.data.keys.is_empty()).then(|| self.data.stored());
        StoredLayer { structure: self.structure.stored(), data }
    }

    pub(super) fn forget_writes(&mut self) {
        self.structure.written = Written::default();
        self.data.written = Written::default();
    }
}
