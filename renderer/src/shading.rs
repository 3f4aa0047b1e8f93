//! How opaque and masked surfaces come to be shaded: by whom lights are evaluated, and whether depth is known by then.
//!
//! ```text
//! forward   prepass   depth ──tested for equality──> shade: what is seen, once
//!           overdraw  shade: depth cleared, tested and written; what is hidden later is shaded as well
//! deferred  prepass   depth ──tested for equality──> gbuffer ──> light: what is seen, once
//!           overdraw  gbuffer: depth cleared, tested and written, in place of the prepass ──> light: what is seen, once
//! ```
//!
//! With overdraw a forward fragment that is hidden in the end may look up a group that holds nothing visible. Its list is
//! empty then, for nobody sees the fragment: `fragments_hidden` counts it, `fragments_without_cluster` does not. Deferred
//! shading evaluates lights for what is seen alone; what overdraw costs it is the filling of the G-buffer.

use crate::nearest;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// How opaque and masked surfaces are drawn. Pictures are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Shading {
    /// After a prepass, so that of all fragments those alone are shaded, or put into the G-buffer, that are seen.
    Prepass,
    /// As they are drawn, whatever hides them later (Enhuber, Tegelaers): there is no prepass but where clusters are marked
    /// or measured from it, and none at all where a G-buffer lays down depth.
    Overdraw,
}

/// Who evaluates the lights of opaque and masked surfaces. Light lists are the same, pictures but for what a G-buffer rounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ShadingPipeline {
    /// The fragments of the surfaces.
    Forward,
    /// A pass over all pixels, by what a G-buffer keeps of the surfaces (Tegelaers). Transparent surfaces are shaded forward
    /// then, through the same lists.
    Deferred,
}

impl fmt::Display for Shading {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Prepass => "prepass",
            Self::Overdraw => "overdraw",
        })
    }
}

impl fmt::Display for ShadingPipeline {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Forward => "forward",
            Self::Deferred => "deferred",
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

impl FromStr for ShadingPipeline {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "pipeline")
    }
}
