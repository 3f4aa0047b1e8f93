//! Stage `cones[v]`: which way the surfaces of each visible cluster face (Tegelaers section 4.3), so that lights behind all of them
//! get onto no list.
//!
//! ```text
//! Depth, VisibleClusters ──(what shading will see, drawn once more)──> cluster_cones, a bit for each cone of shading normals
//! ```
//!
//! Opaque, masked and transparent surfaces are drawn as forward shading draws them, with the normals that it finds. Deferred
//! shading sees the same ones, as rounded by its G-buffer, which cones are wide enough for.

use super::draws::{self, SurfacePipelines};
use super::handles::{Depth, VisibleClusters};
use super::inputs::{Eyes, Frame};
use crate::buffers::{BufferName as B, set};
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;

/// Lets the cones of the visible clusters hold the normals of all fragments of one view, whose `depth` is there.
pub fn record(r: &mut Recorder, frame: &Frame, view: usize, (depth, visible): (Depth, VisibleClusters)) {
    debug_assert!(depth.covers(frame, Eyes::One(view)));
    r.scope(("cones", view), |r| {
        let this = &frame.clusterings[visible.clustering];
        if view == this.views.start {
            r.clear(&this.buffers[B::ClusterCones]);
        }
        let pipelines = frame.pipelines.cones();
        let draws =
            SurfaceKind::ALL.map(|kind| (kind, SurfacePipelines::ByTextures(&pipelines[kind as usize])));
        draws::visits(r, frame, view, &draws, (frame.places(), set(&[B::ClusterCones])));
    });
}
