//! What buffers hold, and when they grew.

use serde::{Deserialize, Serialize};

/// How many entries a clustering's buffers hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capacities {
    /// Most visible clusters.
    pub visible_clusters: u32,
    /// Most light indices.
    pub light_indices: u32,
    /// Entries of each light list, where all have as many; else 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub list_entries: u32,
    /// What the tables of an octree hold; nothing where there is none.
    #[serde(default, skip_serializing_if = "OctreeSizes::is_empty")]
    pub octree: OctreeSizes,
}

/// How many entries the tables of an octree have, or hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct OctreeSizes {
    /// Slots for branches of all depths.
    pub nodes: u32,
    /// Slots for filled leaves of all depths.
    pub leaves: u32,
    /// Offsets of the hashes of both.
    pub offsets: u32,
    /// Lights of all leaves.
    pub indices: u32,
}

impl OctreeSizes {
    /// Bytes of a slot for a branch.
    pub const NODE_BYTES: u64 = size_of::<u16>() as u64;
    /// Bytes of a slot for a leaf.
    pub const LEAF_BYTES: u64 = size_of::<[u32; 2]>() as u64;
    /// Bytes of an offset.
    pub const OFFSET_BYTES: u64 = size_of::<[u8; 4]>() as u64;
    /// Bytes of a light of a leaf.
    pub const INDEX_BYTES: u64 = size_of::<u32>() as u64;

    /// What all tables take, bytes.
    pub fn bytes(&self) -> u64 {
        let Self { nodes, leaves, offsets, indices } = *self;
        [
            (nodes, Self::NODE_BYTES),
            (leaves, Self::LEAF_BYTES),
            (offsets, Self::OFFSET_BYTES),
            (indices, Self::INDEX_BYTES),
        ]
        .into_iter()
        .map(|(entries, bytes)| u64::from(entries) * bytes)
        .sum()
    }

    /// Whether there are no entries at all.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// As many entries of each.
    pub fn all(entries: u32) -> Self {
        Self { nodes: entries, leaves: entries, offsets: entries, indices: entries }
    }

    /// Each with the name of its buffer.
    pub fn named(&mut self) -> [(&'static str, &mut u32); 4] {
        let Self { nodes, leaves, offsets, indices } = self;
        [
            ("octree_nodes", nodes),
            ("octree_leaves", leaves),
            ("octree_offsets", offsets),
            ("octree_indices", indices),
        ]
    }
}

fn is_zero(entries: &u32) -> bool {
    *entries == 0
}

/// Buffers grew because a frame needed more; unless that was known before, the frame was rendered again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct GrowthEvent {
    /// Frame number in the recording.
    pub frame: u32,
    /// The clustering that needed most.
    pub clustering: u32,
    /// Which buffer: `visible_clusters` or `light_indices`; or `list_entries`, what each list has of the latter; or a table of an octree.
    pub buffer: String,
    /// How many entries the buffer held.
    pub from: u32,
    /// How many entries the buffer holds since.
    pub to: u32,
}
