//! How passes are recorded: every one through the [`Recorder`], which opens its label and timestamp scope
//! and derives its barriers from what the pass says it reads and writes.

mod access;
mod recorder;

pub use access::{Access, Use};
pub use recorder::{FrameTracker, Recorder, ScopeName, ScopeSpan, ScopeTree, Timestamps};
