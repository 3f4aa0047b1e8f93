//! What a run measures, as plain data: counters and histograms of the atemporal run, stage times of the
//! temporal runs.

mod capacity;
mod counters;
mod lists;
mod record;
mod timing;
mod trace;

pub use capacity::{Capacities, GrowthEvent};
pub use counters::DeviceCounts;
pub use lists::ClusterLists;
pub use record::{ClusterRecord, ClusteringCounts, FrameCounts, FrameTimes, StageTime, ViewPixels};
pub use timing::{Disturbance, Order, Precision, Timing};
pub use trace::{FrameTrace, StageSpan};
