//! Stage `sort_tiles[v]`: which slices of each tile hold samples, by sorting these (Tegelaers section 6.2).
//!
//! ```text
//! depth ─┬─sort_tiles──> tile_counts, tile_slices ──tile_offsets──> tile_offsets, visible_clusters, their number
//! cluster_bits (of transparent geometry) ─┘
//! ```
//!
//! The clusters are those of marking with a prefix sum, in another order.

use super::handles::Depth;
use super::inputs::{Eyes, Frame};
use crate::buffers::{BufferName as B, set};
use crate::pass::{Dispatch, Push, Recorder, Size};

/// Finds the slices of a view's tiles; its `depth` is there, and its transparent geometry is marked.
pub fn record(r: &mut Recorder, frame: &Frame, (clustering, view): (usize, usize), depth: Depth) {
    debug_assert!(depth.covers(frame, Eyes::One(view)));
    r.scope(("sort_tiles", view), |r| {
        let [columns, rows, _] = frame.clusterings[clustering].dimensions;
        r.dispatch(&Dispatch {
            depth: Some(frame.targets[view].depth_image()),
            push: Push::view(view),
            ..Dispatch::new(
                &frame.pipelines.clustered().sort_tiles().sort_tiles,
                frame.buffers(clustering),
                Size::Workgroups(columns, rows),
                (set(&[B::ClusterBits]), set(&[B::TileCounts, B::TileSlices])),
            )
        });
    });
}
