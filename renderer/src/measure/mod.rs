//! What a run measures, as plain data: counters and histograms of the atemporal run, stage times of the
//! temporal runs.

mod record;

pub use record::{ClusterRecord, ClusteringCounts, FrameCounts, FrameTimes, StageTime, ViewPixels};
