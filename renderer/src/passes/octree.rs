//! Stage `octree`: the tables of the octree over the lights, built by the host, to the device, or those parts of them that the host has
//! edited; where the device has those of this frame, nothing.
//!
//! `octree > empty_octree, light_octrees, add_lights, merge_nodes, hash_layers` tell how long the host built, in the order in which it
//! did (Tegelaers section 7.2), `upload` is the device's.

use super::handles::LightLists;
use super::inputs::Frame;
use crate::buffers::BufferName as B;
use crate::clustering::ClusteringBuffers;
use crate::measure::OctreeSizes;
use crate::octree::{BuildTimes, Dirty};
use crate::pass::{BufferCopy, BufferParts, Recorder};
use crate::vk::Buffer;
use std::ops::Range;

/// The tables of an octree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Table {
    /// Branches.
    Nodes,
    /// Filled leaves.
    Leaves,
    /// Offsets of hashes.
    Offsets,
    /// Lights of leaves.
    Indices,
}

impl Table {
    /// All tables.
    pub const ALL: [Self; 4] = [Self::Nodes, Self::Leaves, Self::Offsets, Self::Indices];

    /// Where it lies on the device.
    pub fn buffer(self) -> B {
        match self {
            Self::Nodes => B::OctreeNodes,
            Self::Leaves => B::OctreeLeaves,
            Self::Offsets => B::OctreeOffsets,
            Self::Indices => B::OctreeIndices,
        }
    }

    /// What an entry takes, bytes.
    fn entry_bytes(self) -> u64 {
        match self {
            Self::Nodes => OctreeSizes::NODE_BYTES,
            Self::Leaves => OctreeSizes::LEAF_BYTES,
            Self::Offsets => OctreeSizes::OFFSET_BYTES,
            Self::Indices => OctreeSizes::INDEX_BYTES,
        }
    }

    /// Which of its entries are lacking; `None` of all of them.
    pub fn parts_of(self, lacking: &Dirty) -> Option<&[Range<usize>]> {
        let Dirty::Parts { structure, leaves, offsets, indices } = lacking else { return None };
        Some(match self {
            Self::Nodes => structure,
            Self::Leaves => leaves,
            Self::Offsets => offsets,
            Self::Indices => indices,
        })
    }

    /// What it takes to bring the device what is lacking of a table of these sizes, bytes.
    pub fn lacking_bytes(self, lacking: &Dirty, sizes: &OctreeSizes) -> u64 {
        let of_parts = |parts: &[Range<usize>]| parts.iter().map(|part| part.len() as u64).sum::<u64>();
        self.parts_of(lacking).map_or(self.bytes(sizes), |parts| of_parts(parts) * self.entry_bytes())
    }

    /// What it takes with so many entries, bytes.
    pub fn bytes(self, sizes: &OctreeSizes) -> u64 {
        let entries = match self {
            Self::Nodes => sizes.nodes,
            Self::Leaves => sizes.leaves,
            Self::Offsets => sizes.offsets,
            Self::Indices => sizes.indices,
        };
        u64::from(entries) * self.entry_bytes()
    }
}

/// The octree of a frame as the host wrote it.
pub struct OctreeTables<'a> {
    /// Tables in the order of [`Table::ALL`].
    pub staging: &'a [Buffer; Table::ALL.len()],
    /// How many entries they have.
    pub sizes: OctreeSizes,
    /// What of them the device has not.
    pub lacking: &'a Dirty,
    /// How long the host took to build or edit it for this frame.
    pub times: BuildTimes,
}

/// Tells how long the host built, and copies what the device has not of the tables.
pub fn record(r: &mut Recorder, frame: &Frame) -> LightLists {
    let Some(tables) = &frame.octree else { return LightLists::NONE };
    r.scope("octree", |r| {
        tables.times.steps().into_iter().for_each(|(step, seconds)| r.host_step(step, seconds));
        r.scope("upload", |r| {
            if !tables.lacking.is_empty() {
                frame.clusterings.iter().for_each(|this| upload(r, tables, &this.buffers));
            }
        });
    });
    LightLists::of_octree()
}

fn upload(r: &mut Recorder, tables: &OctreeTables, to: &ClusteringBuffers) {
    for (table, from) in Table::ALL.into_iter().zip(tables.staging) {
        let (to, size, element) = (&to[table.buffer()], table.bytes(&tables.sizes), table.entry_bytes());
        match table.parts_of(tables.lacking) {
            None if size > 0 => r.copy(&BufferCopy { from, to, offset: 0, size }),
            Some(parts) if !parts.is_empty() => r.copy_parts(&BufferParts { from, to, parts, element }),
            _ => {}
        }
    }
}
