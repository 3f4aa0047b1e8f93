//! The model that each pixel of a view's prepass shows, for methods whose groups are models: what looks at pixels finds groups
//! by it. Atemporal runs alone.

use super::draws::{self, SurfacePipelines};
use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::draw_list::SurfaceKind;
use crate::pass::Recorder;

/// Draws the models of a view into the `pixels` of a clustering, where groups are models.
pub(super) fn record(r: &mut Recorder, frame: &Frame, (view, clustering): (usize, usize)) {
    let Some([opaque, masked]) = &frame.pipelines.pixel_models else { return };
    r.clear(&frame.clusterings[clustering].buffers[B::Pixels]);
    let solid = [
        (SurfaceKind::Opaque, SurfacePipelines::One(opaque)),
        (SurfaceKind::Masked, SurfacePipelines::One(masked)),
    ];
    draws::visits(r, frame, view, &solid, (BufferSet::EMPTY, set(&[B::Pixels])));
}
