//! Files: run directories with a manifest, CSV tables, EXR and PNG images, and the closing summary.
//!
//! Everything is written to a temporary name and renamed, so that a file that exists is whole. This module
//! knows no passes: it is given the records of [`crate::measure`].
//!
//! ```text
//! OUT/
//!   summary.csv            one row a method and lighting (and scene, where there are several)
//!   <run>/                 named by method, and by lighting, way and test where the sweep has several
//!     run.json             how the run came to be
//!     frames.csv  clusterings.csv  histograms.csv  memory.csv  timings.csv  trace.json
//!     frames/NNNNNN.exr  NNNNNN.png  NNNNNN_lights.png  NNNNNN_share.png  NNNNNN_heat.png  NNNNNN_clusters.png
//!            NNNNNN_slices.png  NNNNNN_birdseye.png  NNNNNN_plan.png  NNNNNN_gbuffer.png
//!   <run>.error.json       why a run failed, until it succeeds
//! ```
//!
//! Of several scenes each has a directory `OUT/<scene>[-<recording>]/` in which its runs lie.

mod atomic;
mod check;
mod color;
mod image_exr;
mod manifest;
mod preview;
mod rows;
mod run;
mod run_times;
mod saved;
mod stages;
mod strict;
mod summary;
mod tables;
mod target;
mod trace;

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;

pub(crate) use atomic::cause;
pub use atomic::{prepare_file, prepare_output, remove_abandoned, write_whole};
pub use check::check_run;
pub use color::{cluster_color, cubehelix, slice_color, tone_map};
pub(crate) use color::{srgb_decode, srgb_encode};
pub use image_exr::write_exr;
pub use manifest::{DeviceInfo, MANIFEST, Manifest, RUN_FORMAT, Source, git_revision, rfc3339_utc};
pub use preview::write_png;
pub use preview::{heat_preview, image_preview, light_preview, share_preview, write_previews};
pub use rows::FrameRow;
pub(crate) use rows::{
    ClusteringRow, FRAGMENTS_PER_CLUSTER, HistogramRow, LIGHTS_PER_CLUSTER, MemoryRow, OctreeBuildRow,
    OctreeRow, Row, TimingRow,
};
pub use run::{PlannedRun, RunWriter, planned_runs, write_summary};
pub use run_times::{ColumnTimes, MeasuredTimes, saved_samples, saved_times};
pub use saved::{
    Age, Older, age, find_runs, is_complete, newest_of_each, saved_fingerprint, saved_frames, saved_means,
    saved_memory,
};
pub use stages::StageMinima;
pub(crate) use stages::{FRAME, kind as stage_kind, makes_lists};
pub(crate) use strict::{all_rows, each_row};
pub use summary::{Intervals, RunMeans, Summary, SummaryRow, Values};
pub(crate) use summary::{TABLE_LINES, grouped, with_interval};
