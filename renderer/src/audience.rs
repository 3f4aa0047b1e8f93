//! Whom long work tells how far it has come.

/// The user's side of long work: a bar over the frames that are known to come, and lines above it.
pub trait Audience {
    /// This is under way.
    fn say(&self, what: &str);
    /// So many more frames will be rendered at most.
    fn more(&self, frames: u64);
    /// One of them was.
    fn advance(&self);
    /// So many of them need not be.
    fn skip(&self, frames: u64);
    /// Good to know.
    fn note(&self, text: &str);
}
