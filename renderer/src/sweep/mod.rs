//! Sweeps: the product of scenes, lightings and methods, run by run, in as many sittings as it takes.
//!
//! ```text
//! config ─> parts (a scene each) ─> selection (shard, names) ─> driver ─┬─> OUT/[<scene>/]<run>/
//!                                                                      └─> OUT/[<scene>/]<run>.error.json
//! what is on disk ─> summary
//! ```
//!
//! A run that is complete and carries the fingerprint it would get today is not made again, so an interrupted
//! sweep goes on where it stood. Runs appear whole or not at all.

mod driver;
mod failure;
mod fingerprint;
mod group;
mod product;
mod selection;
mod table;
mod writer;

pub use driver::{Outcome, Sweep};
pub use failure::Failure;
pub use fingerprint::Fingerprint;
pub(crate) use group::{MOST, most_bytes};
pub use product::{Part, parts};
pub use selection::{Selection, Shard};
pub use table::{Doubtful, summary};
