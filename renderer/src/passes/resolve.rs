//! Stage `resolve`: the samples of every pixel averaged, with MSAA alone.

use super::handles::Color;
use super::inputs::{Frame, ViewTargets};
use crate::pass::Recorder;

/// Resolves every view's colour.
pub fn record(r: &mut Recorder, frame: &Frame, _color: Color) {
    if frame.targets.iter().all(|target| target.resolved.is_none()) {
        return;
    }
    r.scope("resolve", |r| {
        for target in frame.targets {
            resolve(r, target, frame.resolution);
        }
    });
}

/// Resolves one view's colour; without MSAA there is nothing to do.
pub fn resolve(r: &mut Recorder, target: &ViewTargets, size: [u32; 2]) {
    if let Some(resolved) = &target.resolved {
        r.resolve(target.color.color(), resolved.color(), size);
    }
}
