//! What buffers hold, and when they grew.

use serde::{Deserialize, Serialize};

/// How many entries a clustering's buffers hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capacities {
    /// Most visible clusters.
    pub visible_clusters: u32,
    /// Most light indices.
    pub light_indices: u32,
    /// Entries of each light list, where all have as many; else 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub list_entries: u32,
}

fn is_zero(entries: &u32) -> bool {
    *entries == 0
}

/// Buffers grew because a frame needed more, and the frame was rendered again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct GrowthEvent {
    /// Frame number in the recording.
    pub frame: u32,
    /// The clustering that needed most.
    pub clustering: u32,
    /// Which buffer: `visible_clusters` or `light_indices`; or `list_entries`, what each list has of the latter.
    pub buffer: String,
    /// How many entries the buffer held.
    pub from: u32,
    /// How many entries the buffer holds since.
    pub to: u32,
}
