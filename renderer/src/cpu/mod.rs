//! CPU twins of the GPU passes that build lists: plain, readable, in f64, with the passes' stems.
//!
//! ```text
//! depth image ─mark─> fragments per cluster ─compact─> visible clusters ─assign─> light lists
//!                                          (scan: the prefix sums inside compact and assign)
//! boxes of instances ─cull─> what is drawn
//! ```
//!
//! Where f32 may fall on the other side of a boundary, a twin given an epsilon says so itself ([`Marks`],
//! [`LightLists`], [`Seen`]); everything else must agree exactly.

mod assign;
mod attenuation;
mod compact;
mod cull;
mod mark;
mod scan;

pub use assign::{LightLists, assign};
pub use attenuation::attenuation;
pub use compact::{Compacted, NOT_VISIBLE, compact};
pub use cull::{Seen, cull};
pub use mark::{DepthImage, Marks, mark};
pub use scan::scan;
