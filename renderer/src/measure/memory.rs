//! What structures on the device take.

use std::fmt;

/// What a structure on the device is for, by which its memory is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purpose {
    /// Which groups of fragments there are, and how a fragment finds its own.
    Grouping,
    /// Light lists, as shading reads them.
    Lists,
    /// The lights.
    Lights,
    /// What building the lists takes beside all that.
    Building,
}

impl Purpose {
    /// All purposes, in the order in which they are told.
    pub const ALL: [Self; 4] = [Self::Grouping, Self::Lists, Self::Lights, Self::Building];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Grouping => "grouping",
            Self::Lists => "lists",
            Self::Lights => "lights",
            Self::Building => "building",
        }
    }

    /// The purpose of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|purpose| purpose.name() == name)
    }
}

impl fmt::Display for Purpose {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What one structure takes of the device's memory in the temporal runs of a run: over all clusterings, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructureMemory {
    /// Name of the structure: of its buffer.
    pub structure: &'static str,
    /// What it is for.
    pub purpose: Purpose,
    /// What was allocated at the end, for every frame in flight that has its own.
    pub allocated: u64,
    /// What a frame needs of that, mean over frames, rounded down.
    pub used: u64,
    /// What the frame that needs most needs.
    pub most: u64,
}
