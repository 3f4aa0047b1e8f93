//! What an octree is built of and by, and what can be wrong with it.

use glam::DVec3;

/// How the scene's octree is built. Both routes make the same tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Route {
    /// An octree of each light, then all of them joined from the root down (Tegelaers section 7.1.3).
    #[default]
    TopDown,
    /// The deepest cells that each light fills, flooded from the corners of its grid, then merged upwards (section 7.1.2).
    BottomUp,
}

/// What the device's buffers can hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OctreeLimits {
    /// Most entries of the list of light indices.
    pub indices: usize,
    /// Most slots of all tables of one kind together, and most offsets.
    pub slots: usize,
}

impl Default for OctreeLimits {
    fn default() -> Self {
        Self { indices: 1 << 27, slots: 1 << 27 }
    }
}

/// How an octree over lights is built and stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OctreeSettings {
    /// Edge of the deepest cells, metres.
    pub node: f64,
    /// Depth at which lookups begin. At most the depth of the deepest branches, to which it is brought down.
    pub start_depth: u32,
    /// How far past the lights the octree reaches at least, metres: room in which they may move.
    pub room: f64,
    /// Seed of the offsets that no neighbour gives.
    pub seed: u64,
    /// Slots per key of a table: 1 for the smallest, more where keys are to be added later.
    pub slack: f64,
    /// Whether leaves with the same lights share one run of indices.
    pub share_runs: bool,
    /// How the scene's octree is built.
    pub route: Route,
    /// What the device can hold.
    pub limits: OctreeLimits,
}

impl OctreeSettings {
    /// The smallest tables for deepest cells of an edge (metres), with lookups that begin at a depth.
    pub fn new(node: f64, start_depth: u32) -> Self {
        Self {
            node,
            start_depth,
            room: 0.0,
            seed: 23,
            slack: 1.0,
            share_runs: false,
            route: Route::default(),
            limits: OctreeLimits::default(),
        }
    }
}

/// Why there is no octree of some lights.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OctreeError {
    /// The edge of the deepest cells is no length.
    #[error("the octree's node size is {0}; it must be a length above 0")]
    NodeSize(f64),
    /// A light has no place or reaches nowhere, or endlessly.
    #[error(
        "light {light} has its centre at {centre} and the radius {radius}; an octree needs a finite centre and a finite radius above 0"
    )]
    Light {
        /// Index of the light.
        light: usize,
        /// Where it is.
        centre: DVec3,
        /// How far it reaches, metres.
        radius: f64,
    },
    /// Cells of this size around these lights have coordinates of too many bits.
    #[error(
        "the lights span {extent:.3e} m, an octree of depth {depth} with nodes of {node} m where {most} is the most; choose a larger node size (from {least:.3e} m)"
    )]
    TooDeep {
        /// Greatest extent of the lights, metres.
        extent: f64,
        /// Edge of the deepest cells, metres.
        node: f64,
        /// How deep the tree would be.
        depth: u32,
        /// How deep it may be.
        most: u32,
        /// Smallest node size that works, metres.
        least: f64,
    },
    /// The octrees or the grids of single lights are too large to be made.
    #[error(
        "the lights are too large for nodes of {node} m: by themselves they take over {most} nodes; choose a larger node size"
    )]
    LargeLights {
        /// Edge of the deepest cells, metres.
        node: f64,
        /// Most branches, or cells of grids, of all lights together.
        most: usize,
    },
    /// The leaves hold more light indices than there is room for.
    #[error(
        "the octree's leaves hold more than {most} light indices, the most that the device can read, with nodes of {node} m; choose a larger node size"
    )]
    TooManyIndices {
        /// Edge of the deepest cells, metres.
        node: f64,
        /// Most entries of the list.
        most: usize,
    },
    /// A table is larger than there is room for.
    #[error(
        "the octree's tables need {slots} slots, more than the {most} that the device can read, with nodes of {node} m; choose a larger node size"
    )]
    TooManySlots {
        /// Edge of the deepest cells, metres.
        node: f64,
        /// Slots needed.
        slots: usize,
        /// Most slots.
        most: usize,
    },
    /// No offsets were found that put each key of a layer on a slot of its own.
    #[error(
        "found no perfect hash for the {keys} keys of depth {depth} with nodes of {node} m; choose another node size"
    )]
    NoHash {
        /// Edge of the deepest cells, metres.
        node: f64,
        /// Depth of the keys.
        depth: u32,
        /// How many keys there are.
        keys: usize,
    },
}

impl From<OctreeError> for crate::Error {
    fn from(error: OctreeError) -> Self {
        Self::input(error.to_string())
    }
}
