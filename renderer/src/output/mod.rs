//! Files: run directories with a manifest, CSV tables, EXR and PNG images, and the closing summary.
//!
//! Everything is written to a temporary name and renamed, so that a file that exists is whole. This module
//! knows no passes: it is given the records of [`crate::measure`].
//!
//! ```text
//! OUT/
//!   summary.csv            one row a method and lighting (and scene, where there are several)
//!   <run>/                 named by method (and lighting, where there are several)
//!     run.json             how the run came to be
//!     frames.csv  clusterings.csv  histograms.csv  timings.csv  trace.json
//!     frames/NNNNNN.exr  NNNNNN.png  NNNNNN_lights.png  NNNNNN_clusters.png  NNNNNN_birdseye.png
//!   <run>.error.json       why a run failed, until it succeeds
//! ```
//!
//! Of several scenes each has a directory `OUT/<scene>[-<recording>]/` in which its runs lie.

mod atomic;
mod color;
mod image_exr;
mod manifest;
mod preview;
mod run;
mod saved;
mod stages;
mod summary;
mod tables;
mod trace;

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

pub use atomic::{remove_abandoned, write_whole};
pub use color::{cluster_color, cubehelix, tone_map};
pub(crate) use color::{srgb_decode, srgb_encode};
pub use image_exr::write_exr;
pub use manifest::{DeviceInfo, Manifest, RUN_FORMAT, Source, git_revision, rfc3339_utc};
pub use preview::write_png;
pub use preview::{cluster_preview, image_preview, light_preview, write_previews};
pub use run::{PlannedRun, RunWriter, planned_runs, prepare_output, write_summary};
pub use saved::{find_runs, is_complete, saved_fingerprint, saved_means};
pub(crate) use stages::kind as stage_kind;
pub use stages::{GpuTimes, StageMinima};
pub use summary::{MethodRun, Ratios, RunMeans, Summary, SummaryRow, Values};
pub(crate) use summary::{TABLE_LINES, grouped};
