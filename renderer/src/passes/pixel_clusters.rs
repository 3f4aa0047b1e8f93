//! Stage `pixel_clusters[c]` of stills: the marked cluster of each pixel of any camera.

use super::inputs::Frame;
use super::pixel_maps::look_up;
use crate::layouts::Pipeline;
use crate::pass::Recorder;
use crate::vk::Buffer;

/// Looks the pixels of `view`'s prepass up in `clustering` and copies what is known of them to `target`.
pub fn record(
    r: &mut Recorder,
    frame: &Frame,
    pipeline: &Pipeline,
    (view, clustering): (usize, usize),
    target: &Buffer,
) {
    r.scope(("pixel_clusters", clustering), |r| {
        look_up(r, frame, pipeline, (view, clustering), (target, 0));
        r.hand_over(target);
    });
}
