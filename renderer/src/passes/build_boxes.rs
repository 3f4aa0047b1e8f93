//! Stage `build_boxes`: the box around each cell along the axes of its view (Ortiz, step 1), to be tested against lights instead of
//! it.
//!
//! Boxes follow from the projection and the resolution, not from where the view is: they are built where there are none yet of
//! the grid at hand, and frames with the same need no such stage.

use super::handles::VisibleClusters;
use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::ASSIGN_WORKGROUP;
use crate::pass::{Dispatch, Recorder, Size};

/// Builds the boxes of a clustering where they are tested and are not there.
pub fn record(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let clustering = visible.clustering;
    let this = &frame.clusterings[clustering];
    let Some(pipeline) = frame.pipelines.build_boxes().filter(|_| this.builds_boxes) else { return };
    r.scope("build_boxes", |r| {
        r.dispatch(&Dispatch::new(
            pipeline,
            frame.buffers(clustering),
            Size::threads(this.cluster_count, ASSIGN_WORKGROUP),
            (BufferSet::EMPTY, set(&[B::ClusterBoxes])),
        ));
    });
}
