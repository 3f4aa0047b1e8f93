//! What is known of a run's frames before the device is asked: views and grids of each.

use crate::config::Config;
use crate::geometry::Grid;
use crate::geometry::views::View;
use crate::methods::{MethodSpec, Sharing, grid};
use crate::recording::Recording;
use crate::{Error, Result, origin};
use glam::DVec3;
use std::ops::Range;

/// One frame as planned on the host.
#[derive(Debug, Clone, PartialEq)]
pub struct FramePlan {
    /// Frame number in the recording.
    pub frame: u32,
    /// Rendering cameras.
    pub views: Vec<View>,
    /// Grids: one a view for Indi, one for Encl, none for a method without clusters.
    pub grids: Vec<Grid>,
}

impl FramePlan {
    /// What positions on the device are relative to in this frame, metres.
    pub fn origin(&self) -> DVec3 {
        origin::of_views(&self.views)
    }
}

/// Clusters of a grid that 32-bit indices and the visibility words still serve.
const MAX_CLUSTERS: u64 = 1 << 27;

/// Plans every frame that the config asks for.
///
/// # Errors
/// A frame range outside the recording, a method that cannot serve the views, a grid that is too large.
pub fn plan_frames(config: &Config, recording: &Recording, method: &MethodSpec) -> Result<Vec<FramePlan>> {
    let frames = config.frame_numbers(recording.frame_count())?;
    frames.into_iter().map(|frame| plan_frame(config, recording, method, frame)).collect()
}

fn plan_frame(config: &Config, recording: &Recording, method: &MethodSpec, frame: u32) -> Result<FramePlan> {
    let views = recording.views(frame, config.resolution)?;
    let grids = match *method {
        MethodSpec::AllLights => vec![],
        MethodSpec::Clustered { sharing, space } => {
            grid::plan(space, sharing, &views, config.resolution, config.displaced_volume)?
        }
    };
    for grid in &grids {
        if grid.cluster_count() > MAX_CLUSTERS {
            let [x, y, z] = grid.dimensions;
            return Err(Error::input(format!(
                "{method} at frame {frame} needs a grid of {x} x {y} x {z} clusters, more than {MAX_CLUSTERS}: use \
                 larger clusters"
            )));
        }
    }
    Ok(FramePlan { frame, views, grids })
}

/// Which views look up each clustering; one clustering of all views for a method without grids.
pub fn views_of_clusterings(method: &MethodSpec, views: usize) -> Vec<Range<usize>> {
    match method {
        MethodSpec::Clustered { sharing: Sharing::Indi, .. } => (0..views).map(|v| v..v + 1).collect(),
        _ => std::iter::once(0..views).collect(),
    }
}
