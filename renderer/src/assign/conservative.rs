//! How meshes around lights are rasterised.

use crate::nearest;
use crate::vk::Limits;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// What finds the tiles that the triangles of a mesh may touch, so that none is missed. The slices are the same, whatever does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Conservative {
    /// `hardware` where the device has it, else `compute`.
    Auto,
    /// The device's own conservative rasterisation (VK_EXT_conservative_rasterization).
    Hardware,
    /// The device's rasterisation of the tiles around each triangle.
    Software,
    /// No rasterisation: compute shaders ask every tile in which a mesh is seen.
    Compute,
}

impl Conservative {
    /// What it is on a device.
    pub fn on(self, limits: &Limits) -> Self {
        match self {
            Self::Auto if limits.conservative_rasterization => Self::Hardware,
            Self::Auto => Self::Compute,
            Self::Hardware | Self::Software | Self::Compute => self,
        }
    }
}

impl fmt::Display for Conservative {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Hardware => "hardware",
            Self::Software => "software",
            Self::Compute => "compute",
        })
    }
}

impl FromStr for Conservative {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "way of rasterising")
    }
}
