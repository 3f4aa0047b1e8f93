//! How passes are recorded: every one in one call of the [`Recorder`], from which its label, its barriers and what it
//! binds follow; stages, with timestamps, are the recorder's scopes.

mod access;
mod compute;
mod declared;
mod recorder;
mod transfer;

pub use access::{Access, Use};
pub use compute::{DepthImage, Dispatch, Push, Size};
pub use declared::Declared;
pub use recorder::{FrameTracker, Recorder, ScopeName, ScopeSpan, ScopeTree, Timestamps};
pub use transfer::BufferCopy;
