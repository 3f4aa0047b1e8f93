//! What is known of a run's frames before the device is asked: views and grids of each.

use crate::config::Config;
use crate::geometry::Grid;
use crate::geometry::views::View;
use crate::methods::{Division, Method, Scenery};
use crate::recording::Recording;
use crate::{Error, Result, origin};
use glam::DVec3;

/// One frame as planned on the host.
#[derive(Debug, Clone, PartialEq)]
pub struct FramePlan {
    /// Frame number in the recording.
    pub frame: u32,
    /// Rendering cameras of the frame.
    pub views: Vec<View>,
    /// Grids: one a view for Indi, one for Encl, none for a method without clusters. The engine settles them (see
    /// [`Self::settled`]) in each frame.
    pub grids: Vec<Grid>,
}

impl FramePlan {
    /// The frame with its grids where they lie among its lights and geometry.
    #[must_use]
    pub fn settled(&self, method: Method, around: &Scenery) -> Self {
        Self { grids: self.grids.iter().map(|grid| method.settled(grid, around)).collect(), ..self.clone() }
    }

    /// What positions on the device are relative to in this frame, metres.
    pub fn origin(&self) -> DVec3 {
        origin::of_views(&self.views)
    }
}

/// Clusters of a grid that 32-bit indices and the visibility words still serve.
const MAX_CLUSTERS: u64 = 1 << 27;

/// Plans every frame that a run's configuration, which has one method, asks for.
///
/// # Errors
/// A frame range outside the recording, a method that cannot serve the views, a grid that is too large.
pub fn plan_frames(run: &Config, recording: &Recording) -> Result<Vec<FramePlan>> {
    let frames = run.frame_numbers(recording.frame_count())?;
    frames.into_iter().map(|frame| plan_frame(run, recording, frame)).collect()
}

/// How the grids of a run are divided.
fn division(run: &Config) -> Division {
    Division { volume: run.displaced_volume, slices: run.slices[0].of(&run.methods[0]) }
}

fn plan_frame(run: &Config, recording: &Recording, frame: u32) -> Result<FramePlan> {
    let method = run.methods[0];
    let views = recording.views(frame, run.resolution)?;
    let grids = method.plan(&views, run.resolution, division(run))?;
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
