//! The passes of a method of grids: from depth to visible clusters to light lists, clustering by clustering.
//!
//! ```text
//! Depth ──mark, compact──> VisibleClusters ─┬─(bounds, cones)─┐    or mark, sort_tiles, tile_offsets
//! (all clusters) ──list_clusters────────────┘          │
//! Lights ──transform, cull, build, light_rectangles────┴──(count), (offsets), assign──> LightLists
//! (cells as boxes) ──build_boxes, where the projection is another──┘
//! ```
//!
//! Only lists by offsets need these, and brute force counts for no others.

use crate::assign::{Assigner, ClusterBounds, Clusters, Compaction};
use crate::pass::Recorder;
use crate::passes::{
    Depth, Frame, LightLists, Lights, VisibleClusters, assign, bounds, build_boxes, cones, cull_lights,
    depth, hierarchy, list_clusters, mark, raster, scan, sort_tiles, take_places,
};

/// Records all clusterings; the depth that comes back is what is there with what marking needed beside.
pub fn record(r: &mut Recorder, frame: &Frame, (lights, depth): (Lights, Depth)) -> (Depth, LightLists) {
    let mut made = (depth, LightLists::NONE);
    for clustering in 0..frame.clusterings.len() {
        r.scope(("cluster", clustering), |r| {
            let (depth, visible) = match frame.clusters {
                Clusters::Visible => visible_clusters(r, frame, clustering, made.0),
                Clusters::All => (made.0, list_clusters::record(r, frame, clustering)),
            };
            let depth = match frame.bounds {
                ClusterBounds::Cell => depth,
                ClusterBounds::Depth | ClusterBounds::Box => measured_bounds(r, frame, (depth, visible)),
            };
            made = (depth, made.1 | light_lists(r, frame, lights, visible));
        });
    }
    made
}

/// The prepass of the clustering's views, where it is not there yet, and the clusters that hold something of what it shows.
fn visible_clusters(
    r: &mut Recorder,
    frame: &Frame,
    clustering: usize,
    depth: Depth,
) -> (Depth, VisibleClusters) {
    let depth = prepass(r, frame, clustering, depth);
    for view in frame.clusterings[clustering].views.clone() {
        mark::record(r, frame, (clustering, view), depth);
        if frame.compaction == Compaction::Sort {
            sort_tiles::record(r, frame, (clustering, view), depth);
        }
    }
    (depth, compact(r, frame, clustering))
}

/// Lists the clusters that are marked, or that sorted tiles have.
pub fn compact(r: &mut Recorder, frame: &Frame, clustering: usize) -> VisibleClusters {
    match frame.compaction {
        Compaction::Ranks => scan::compact(r, frame, clustering),
        Compaction::Atomic => take_places::record(r, frame, clustering),
        Compaction::Sort => scan::tile_offsets(r, frame, clustering),
    }
}

/// The depth of the clustering's views, where it is not there yet.
fn prepass(r: &mut Recorder, frame: &Frame, clustering: usize, mut depth: Depth) -> Depth {
    for eyes in frame.eyes_of(frame.clusterings[clustering].views.clone()) {
        if !depth.covers(frame, eyes) {
            depth = depth | depth::record(r, frame, eyes);
        }
    }
    depth
}

/// What the samples of visible clusters take of their cells, with the depth that tells.
fn measured_bounds(r: &mut Recorder, frame: &Frame, (depth, visible): (Depth, VisibleClusters)) -> Depth {
    let clustering = visible.clustering();
    let depth = prepass(r, frame, clustering, depth);
    for view in frame.clusterings[clustering].views.clone() {
        bounds::record(r, frame, view, (depth, visible));
    }
    if frame.normal_cones.are_on() {
        for view in frame.clusterings[clustering].views.clone() {
            cones::record(r, frame, view, (depth, visible));
        }
    }
    depth
}

/// The light lists of the visible clusters.
pub fn light_lists(r: &mut Recorder, frame: &Frame, lights: Lights, visible: VisibleClusters) -> LightLists {
    build_boxes::record(r, frame, visible);
    match frame.assigner {
        Assigner::Brute => assign::transform_lights(r, frame, lights, visible),
        Assigner::Rectangles => assign::light_rectangles(r, frame, lights, visible),
        Assigner::Raster => {
            raster::mesh_frames(r, frame, lights, visible);
            raster::shells(r, frame, visible);
        }
        Assigner::RasterCount => raster::mesh_frames(r, frame, lights, visible),
        Assigner::Hierarchy => {
            cull_lights::cull_lights(r, frame, lights, visible);
            hierarchy::build_hierarchy(r, frame, visible);
        }
        Assigner::Scatter => cull_lights::cull_lights(r, frame, lights, visible),
    }
    let has_offsets = frame.lists.has_offsets();
    if has_offsets || frame.assigner != Assigner::Brute {
        assign::count_lights(r, frame, visible);
    }
    if has_offsets {
        scan::light_offsets(r, frame, visible);
    }
    match frame.lists.links() {
        Some(_) => raster::linked_lists(r, frame, visible),
        None => assign::assign_lights(r, frame, visible),
    }
}
