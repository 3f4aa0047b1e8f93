//! Hashed light assignment: an octree over the lights, without pointers, on perfect spatial hashes (Tegelaers chapter 7,
//! Lefebvre and Hoppe 2006).
//!
//! ```text
//! lights ─ frame ─ octree of each light ─ scene's octree ─ merged ─ layers ─┬ structure: hash of branches ┐
//!           │                                                           ├ data: hash of leaves       ├─> device
//!           │                                                           └ indices: lights of leaves  ┘
//! point ────┴─ deepest cell ─ layer after layer ─ leaf ─ lights
//! ```
//!
//! The device looks up which child of a node holds a point, layer after layer, with two fetches each; no pointer is
//! followed and no key stored, for only what is in the tables is ever asked for. Everything here is in f64 and knows no
//! device, files or configuration.

mod ball;
mod bottom_up;
mod build;
mod dynamic;
mod frame;
mod geometry;
mod layers;
mod light_grid;
mod light_tree;
mod linkless;
mod memory;
pub mod perfect_hash;
mod sector;
mod settings;
mod stored;
mod top_down;
mod tree;

pub use build::{BuildTimes, Built};
pub use dynamic::{Dirty, DynamicOctree, UpdateReport};
pub use frame::{MOST_DEPTH, OctreeFrame};
pub use geometry::OctreeGeometry;
pub use linkless::{HashTable, Layer, LinklessOctree};
pub use memory::{LayerMemory, TableMemory};
pub use settings::{OctreeError, OctreeLimits, OctreeSettings, Route};
pub use stored::{StoredKind, StoredNode};

#[cfg(test)]
mod tests;
