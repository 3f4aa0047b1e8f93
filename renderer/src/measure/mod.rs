//! What a run measures, as plain data: counters and histograms of the atemporal run, stage times of the
//! temporal runs.

mod capacity;
mod counters;
mod extremes;
mod lists;
mod memory;
mod octree;
mod record;
mod timing;
mod trace;

pub use capacity::{Capacities, GrowthEvent, OctreeSizes};
pub use counters::{DeviceCounts, OCTAVE_PARTS};
pub use extremes::Extremes;
pub use lists::ClusterLists;
pub use memory::{Purpose, StructureMemory};
pub use octree::{BuildPhase, OctreeBuild, OctreeCounts, OctreeTable, TableKind};
pub use record::{ClusterRecord, ClusteringCounts, FrameCounts, FrameTimes, StageTime, ViewPixels};
pub use timing::{Disturbance, Order, Precision, Timing};
pub use trace::{FrameTrace, StageSpan};
