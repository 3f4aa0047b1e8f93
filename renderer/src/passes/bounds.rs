//! Stage `bounds[v]`: what the fragments of each visible cluster take of its cell (Enhuber section 3.2), to be tested against
//! lights instead of it.
//!
//! The fragments that marking and shading see, at the same places, give it, in any order: the bounds are the same.

use super::handles::{Depth, VisibleClusters};
use super::inputs::{Eyes, Frame};
use super::mark::visit;
use crate::assign::ClusterBounds;
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::TILE_WORKGROUP;
use crate::pass::{Recorder, Size};

/// Lets the bounds of the visible clusters hold all fragments of one view, whose `depth` is there.
pub fn record(r: &mut Recorder, frame: &Frame, view: usize, (depth, visible): (Depth, VisibleClusters)) {
    debug_assert!(depth.covers(frame, Eyes::One(view)));
    let clustering = visible.clustering;
    r.scope(("bounds", view), |r| {
        let this = &frame.clusterings[clustering];
        if view == this.views.start {
            r.clear(&this.buffers[B::ClusterBounds]);
        }
        let found = (frame.places(), set(&[B::ClusterBounds]));
        let size = match frame.bounds {
            ClusterBounds::Depth => by_tile(frame.resolution, this.dimensions),
            ClusterBounds::Cell | ClusterBounds::Box => Size::pixels(frame.resolution),
        };
        visit(r, frame, (clustering, view), (frame.pipelines.bounds(), size), found);
    });
}

/// Pixels that a thread of a tile's workgroup takes, at most: large tiles are several workgroups'.
const PIXELS_A_THREAD: u64 = 256;

/// A workgroup for every tile, or several, along y.
fn by_tile(resolution: [u32; 2], [columns, rows, _]: [u32; 3]) -> Size {
    // No tile on the screen is wider than all columns but the last.
    let width = |pixels: u32, tiles: u32| u64::from(pixels / (tiles - 1).max(1)) + 1;
    let pixels = width(resolution[0], columns) * width(resolution[1], rows);
    let parts = pixels.div_ceil(PIXELS_A_THREAD * u64::from(TILE_WORKGROUP));
    Size::Workgroups(columns, rows * parts as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_thread_takes_more_pixels_than_it_may() {
        for (resolution, pixels) in
            [([1920, 1080], 28.0), ([1920, 1080], 1.5), ([16_384, 16_384], 1e6), ([640, 360], 639.5)]
        {
            let tiles = resolution.map(|side| (f64::from(side) / pixels).ceil() as u32);
            let Size::Workgroups(columns, workgroups) = by_tile(resolution, [tiles[0], tiles[1], 1]) else {
                panic!("a size that the host knows")
            };
            assert_eq!((columns, workgroups % tiles[1]), (tiles[0], 0));
            let on_screen = resolution.map(|side| f64::from(side).min(pixels).ceil());
            let threads = f64::from(workgroups / tiles[1] * TILE_WORKGROUP);
            assert!(
                on_screen[0] * on_screen[1] / threads <= PIXELS_A_THREAD as f64,
                "{resolution:?} {pixels}"
            );
        }
    }
}
