//! Which fragments are seen in the end, with overdraw: shading has counted all that may be hidden. Atemporal runs alone, after
//! the frame, whose depth is that of shading.

use super::draws::{self, SurfacePipelines};
use super::inputs::Frame;
use crate::buffers::{BufferName as B, set};
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;

/// Takes the fragments of all views that are seen off the hidden ones, and counts those whose group is missing. There is nothing
/// to do after a prepass, where what is shaded is seen.
pub fn record(r: &mut Recorder, frame: &Frame) {
    let Some([opaque, masked]) = &frame.pipelines.seen else { return };
    let solid = [
        (SurfaceKind::Opaque, SurfacePipelines::One(opaque)),
        (SurfaceKind::Masked, SurfacePipelines::One(masked)),
    ];
    for view in 0..frame.targets.len() {
        draws::visits(r, frame, view, &solid, (frame.list_places(), set(&[B::Counters])));
    }
}
