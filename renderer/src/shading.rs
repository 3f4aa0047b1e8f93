//! How opaque and masked surfaces come to be shaded: once their depth is known, or as they are drawn.
//!
//! ```text
//! prepass   depth ──tested for equality──> shade: what is seen, once
//! overdraw  shade: depth cleared, tested and written; what is hidden later is shaded as well
//! ```
//!
//! With overdraw a fragment that is hidden in the end may look up a group that holds nothing visible. Its list is empty
//! then, for nobody sees the fragment: `fragments_hidden` counts it, `fragments_without_cluster` does not.

use crate::nearest;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// How opaque and masked surfaces are shaded. Pictures are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Shading {
    /// After a prepass, so that of all fragments those alone are shaded that are seen.
    Prepass,
    /// As they are drawn, whatever hides them later (Enhuber, Tegelaers): there is no prepass but where clusters are marked
    /// or measured from it.
    Overdraw,
}

impl fmt::Display for Shading {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Prepass => "prepass",
            Self::Overdraw => "overdraw",
        })
    }
}

impl FromStr for Shading {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "way of shading")
    }
}
