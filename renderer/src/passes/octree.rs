//! Stage `octree`: the tables of the octree over the lights, built by the host, to the device; where it has those of this frame, nothing.
//!
//! `octree > empty_octree, light_octrees, add_lights, merge_nodes, hash_layers` tell how long the host built, in the order in which it
//! did (Tegelaers section 7.2), `upload` is the device's.

use super::handles::LightLists;
use super::inputs::Frame;
use crate::buffers::BufferName as B;
use crate::clustering::ClusteringBuffers;
use crate::measure::OctreeSizes;
use crate::octree::BuildTimes;
use crate::pass::{BufferCopy, Recorder};
use crate::vk::Buffer;

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

    /// What it takes with so many entries.
    pub fn bytes(self, sizes: &OctreeSizes) -> u64 {
        let (entries, bytes) = match self {
            Self::Nodes => (sizes.nodes, OctreeSizes::NODE_BYTES),
            Self::Leaves => (sizes.leaves, OctreeSizes::LEAF_BYTES),
            Self::Offsets => (sizes.offsets, OctreeSizes::OFFSET_BYTES),
            Self::Indices => (sizes.indices, OctreeSizes::INDEX_BYTES),
        };
        u64::from(entries) * bytes
    }
}

/// The octree of a frame as the host wrote it.
pub struct OctreeTables<'a> {
    /// Tables in the order of [`Table::ALL`].
    pub staging: &'a [Buffer; Table::ALL.len()],
    /// How many entries they have.
    pub sizes: OctreeSizes,
    /// Whether the device has those of another frame.
    pub wanted: bool,
    /// How long the host took to build it for this frame.
    pub times: BuildTimes,
}

/// Tells how long the host built, and copies the tables unless the device has them.
pub fn record(r: &mut Recorder, frame: &Frame) -> LightLists {
    let Some(tables) = &frame.octree else { return LightLists::NONE };
    r.scope("octree", |r| {
        tables.times.steps().into_iter().for_each(|(step, seconds)| r.host_step(step, seconds));
        r.scope("upload", |r| {
            if tables.wanted {
                frame.clusterings.iter().for_each(|this| upload(r, tables, &this.buffers));
            }
        });
    });
    LightLists::of_octree()
}

fn upload(r: &mut Recorder, tables: &OctreeTables, to: &ClusteringBuffers) {
    for (table, from) in Table::ALL.into_iter().zip(tables.staging) {
        let size = table.bytes(&tables.sizes);
        if size > 0 {
            r.copy(&BufferCopy { from, to: &to[table.buffer()], offset: 0, size });
        }
    }
}
