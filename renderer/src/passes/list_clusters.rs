//! Stage `list_clusters`: every cluster of the grid as a visible one, where all get lists. Nothing is marked or ranked:
//! a cluster's place among the visible ones is its index.

use super::handles::VisibleClusters;
use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::ASSIGN_WORKGROUP;
use crate::pass::{Dispatch, Recorder, Size};

/// Lists all clusters by ascending index.
pub fn record(r: &mut Recorder, frame: &Frame, clustering: usize) -> VisibleClusters {
    r.scope("list_clusters", |r| {
        let clusters = frame.clusterings[clustering].cluster_count;
        r.dispatch(&Dispatch::new(
            &frame.pipelines.clustered().list_clusters,
            frame.buffers(clustering),
            Size::threads(clusters, ASSIGN_WORKGROUP),
            (BufferSet::EMPTY, set(&[B::State, B::Dispatches, B::VisibleClusters])),
        ));
    });
    VisibleClusters { clustering }
}
