//! Stage `mark[v]`: which clusters hold visible fragments (Gelderen section 5.2). In atemporal runs the same
//! fragments are visited once more, when clusters are ranked, to count those of each visible cluster.

use super::draws::{self, SurfacePipelines};
use super::handles::Depth;
use super::inputs::{Eyes, Frame};
use crate::assign::{Compaction, Marking};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::draw_list::SurfaceKind;
use crate::pass::{Dispatch, Push, Recorder, Size};
use crate::pipelines::VisitPipelines;

/// Marks the clusters of one view's fragments, whose `depth` is there: opaque and masked ones from the depth buffer or from
/// their geometry, transparent ones always from their geometry.
pub fn record(r: &mut Recorder, frame: &Frame, (clustering, view): (usize, usize), depth: Depth) {
    debug_assert!(depth.covers(frame, Eyes::One(view)));
    r.scope(("mark", view), |r| {
        let this = &frame.clusterings[clustering];
        if view == this.views.start {
            r.clear(&this.buffers[B::ClusterBits]);
        }
        let found = (BufferSet::EMPTY, set(&[B::ClusterBits]));
        let by_pixel = Size::pixels(frame.resolution);
        let mark = &frame.pipelines.clustered().mark;
        match frame.compaction {
            Compaction::Ranks | Compaction::Atomic => {
                visit(r, frame, (clustering, view), (mark, by_pixel), found);
            }
            // What depth shows is sorted instead.
            Compaction::Sort => visit_kinds(r, frame, view, (mark, &[SurfaceKind::Transparent]), found),
        }
    });
}

/// Counts the fragments of each visible cluster, or of each leaf of an octree, of all views; atemporal runs alone, after the frame.
pub fn count_fragments(r: &mut Recorder, frame: &Frame, clustering: usize) {
    if frame.octree.as_ref().is_some_and(|octree| octree.sizes.leaves == 0) {
        return;
    }
    let this = &frame.clusterings[clustering];
    r.clear(&this.buffers[B::VisibleFragments]);
    let found = (frame.group_places(), set(&[B::VisibleFragments]));
    for view in this.views.clone() {
        let by_pixel = Size::pixels(frame.resolution);
        visit(r, frame, (clustering, view), (frame.pipelines.count_fragments(), by_pixel), found);
    }
}

/// Visits the cluster of every fragment of a view: those of the depth buffer in workgroups of a size, with what that reads and
/// writes.
pub(super) fn visit(
    r: &mut Recorder,
    frame: &Frame,
    (clustering, view): (usize, usize),
    (pipelines, size): (&VisitPipelines, Size),
    (reads, writes): (BufferSet, BufferSet),
) {
    let kinds = match (frame.marking, &pipelines.depth) {
        (Marking::Depth, Some(pipeline)) => {
            r.dispatch(&Dispatch {
                pipeline,
                buffers: frame.buffers(clustering),
                size,
                reads,
                writes,
                depth: Some(frame.targets[view].depth_image()),
                push: Push::view(view),
            });
            &[SurfaceKind::Transparent][..]
        }
        (Marking::Depth, None) | (Marking::Geometry, _) => &SurfaceKind::ALL[..],
    };
    visit_kinds(r, frame, view, (pipelines, kinds), (reads, writes));
}

/// Visits the cluster of every fragment of surfaces of some kinds, the last ones of all.
fn visit_kinds(
    r: &mut Recorder,
    frame: &Frame,
    view: usize,
    (pipelines, kinds): (&VisitPipelines, &[SurfaceKind]),
    found: (BufferSet, BufferSet),
) {
    let draws =
        SurfaceKind::ALL.map(|kind| (kind, SurfacePipelines::One(&pipelines.geometry[kind as usize])));
    let first = SurfaceKind::ALL.len() - kinds.len();
    draws::visits(r, frame, view, &draws[first..], found);
}
