//! What is told of the octree of a frame.

use super::OctreeSizes;
use crate::octree::{BuildTimes, TableMemory};
use std::fmt;

/// The octree over the lights of a frame.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct OctreeCounts {
    /// How often the frame built it as a whole: 0 or 1.
    pub rebuilds: u64,
    /// How many of its tables the frame hashed: all where it built it.
    pub tables_hashed: u64,
    /// What the frame took to the device of it, bytes.
    pub uploaded: u64,
    /// Light indices of lights that do not reach all cells of their leaf, which an octree that is kept leaves in lists.
    pub extra_indices: u64,
    /// Entries of its tables.
    pub sizes: OctreeSizes,
    /// Its tables, by depth, of a frame that built it.
    pub tables: Vec<OctreeTable>,
}

/// What a table of an octree holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableKind {
    /// Branches, and what their children are.
    Structure,
    /// Filled leaves, and where their lists lie.
    Data,
}

impl TableKind {
    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Structure => "structure",
            Self::Data => "data",
        }
    }
}

/// One table of an octree: a perfect spatial hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OctreeTable {
    /// What it holds.
    pub kind: TableKind,
    /// Depth of the nodes that are its keys.
    pub depth: u32,
    /// What it takes.
    pub memory: TableMemory,
    /// Lights of all its leaves.
    pub light_indices: u64,
}

/// When an octree was built whose steps no timed frame has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BuildPhase {
    /// In a frame that was counted.
    Counted,
    /// In the frame that warms up, before those that are timed.
    WarmUp,
}

impl fmt::Display for BuildPhase {
    /// Its name in tables.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Counted => "counted",
            Self::WarmUp => "warm-up",
        })
    }
}

/// How an octree was built over the lights of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OctreeBuild {
    /// Frame number in the recording.
    pub frame: u32,
    /// How many lights there were.
    pub lights: u64,
    /// How many nodes its tables hold.
    pub nodes: u64,
    /// How long each step took.
    pub times: BuildTimes,
}
