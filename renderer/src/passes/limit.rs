//! Pass `limit[c]` of benchmarks: the least that assignment can do. It overwrites the lists.

use super::inputs::Frame;
use crate::buffers::{BufferName as B, set};
use crate::gpu_interface::{ASSIGN_WORKGROUP, PACKET_ROW};
use crate::layouts::Pipeline;
use crate::pass::{Dispatch, Recorder, Size};

/// Reads every light once, and writes every entry of a clustering's lists, of which there are `entries`, once.
pub fn record(r: &mut Recorder, frame: &Frame, (clustering, entries): (usize, u32), pipeline: &Pipeline) {
    r.scope(("limit", clustering), |r| {
        let groups = frame.lights.count.max(entries).div_ceil(ASSIGN_WORKGROUP);
        let size = Size::Workgroups(groups.min(PACKET_ROW), groups.div_ceil(PACKET_ROW));
        let declared = (set(&[B::Lights, B::State]), set(&[B::LightIndices]));
        r.dispatch(&Dispatch::new(pipeline, frame.buffers(clustering), size, declared));
    });
}
