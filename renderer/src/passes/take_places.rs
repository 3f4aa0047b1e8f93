//! Stage `compact` by a counter: every visible cluster takes the next place, in any order.
//!
//! ```text
//! cluster_bits ──take_places──> cluster_places, visible_clusters, their number ──publish_places──> state, dispatches
//! ```

use super::handles::VisibleClusters;
use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::ASSIGN_WORKGROUP;
use crate::pass::{Dispatch, Recorder, Size};

/// Lists the visible clusters in the order in which they come.
pub fn record(r: &mut Recorder, frame: &Frame, clustering: usize) -> VisibleClusters {
    r.scope("compact", |r| {
        let this = &frame.clusterings[clustering];
        let [take, publish] = frame.pipelines.clustered().take_places();
        let state = set(&[B::State]);
        let taken = state | set(&[B::ClusterPlaces, B::VisibleClusters]);
        r.clear(&this.buffers[B::State]);
        r.dispatch(&Dispatch::new(
            take,
            frame.buffers(clustering),
            Size::threads(this.cluster_count, ASSIGN_WORKGROUP),
            (set(&[B::ClusterBits]), taken),
        ));
        r.dispatch(&Dispatch::new(
            publish,
            frame.buffers(clustering),
            Size::Workgroups(1, 1),
            (BufferSet::EMPTY, state | set(&[B::Dispatches])),
        ));
    });
    VisibleClusters { clustering }
}
