//! How the temporal runs of a method were made.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The order of the temporal runs of methods, lightings and ways that share scene, recording and resolution.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Order {
    /// In turn: the first temporal run of each, then the second of each, so that what changes on the machine meets all.
    #[default]
    Interleaved,
    /// All temporal runs of one, then those of the next.
    Sequential,
}

/// How the temporal runs of a method were made.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// In turn with others, or one after the other.
    pub order: Order,
    /// Names of the runs that were timed in turn, in their order, this one among them.
    pub group: Vec<String>,
    /// How many temporal runs were kept.
    pub runs: u32,
    /// Those that were disturbed as a whole, and made once more in their place.
    pub disturbed: Vec<Disturbance>,
    /// How precisely times are known, where that decided how many runs were made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reached: Option<Precision>,
}

/// A temporal run that was disturbed as a whole.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Disturbance {
    /// Its number.
    pub run: u32,
    /// Median over its frames, GPU milliseconds of a frame.
    pub median_ms: f64,
    /// Median of the same of the other runs.
    pub others_ms: f64,
    /// How far from that three quarters of the others lie at most.
    pub spread_ms: f64,
}

/// How precisely frame times are known: halves of 95 % intervals, in percent of what they are intervals of.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Precision {
    /// Of the mean frame time.
    pub mean_percent: Option<f64>,
    /// Name of the run that it is compared with: the first of the group under the same lights.
    pub base: String,
    /// Of the ratio to that run's mean frame time; 0 for that run itself.
    pub ratio_percent: Option<f64>,
    /// Whether both are as narrow as was asked for.
    pub precise: bool,
}
