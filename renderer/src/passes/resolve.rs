//! Stage `resolve`: the samples of every pixel averaged, with MSAA alone.

use super::handles::Color;
use super::inputs::{ColorTarget, Frame, ViewTargets};
use crate::pass::Recorder;

/// Resolves every view's targets.
pub fn record(r: &mut Recorder, frame: &Frame, _color: Color) {
    let targets = || frame.targets.iter().flat_map(ViewTargets::made);
    if targets().all(|target| target.resolved.is_none()) {
        return;
    }
    r.scope("resolve", |r| targets().for_each(|target| resolve(r, target, frame.resolution)));
}

/// Resolves one target of a view; without MSAA there is nothing to do.
pub fn resolve(r: &mut Recorder, target: &ColorTarget, size: [u32; 2]) {
    if let Some(resolved) = &target.resolved {
        r.resolve(target.drawn.color(), resolved.color(), size);
    }
}
