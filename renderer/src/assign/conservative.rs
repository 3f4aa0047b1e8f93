//! How meshes around lights are rasterised.

use crate::nearest;
use crate::vk::Limits;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// What finds the tiles that the triangles of a mesh may touch, so that none is missed, and where pixels leave the slices. These are
/// the same, whatever does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Conservative {
    /// `hardware` where the device has it, else `compute`.
    Auto,
    /// The device's own conservative rasterisation (VK_EXT_conservative_rasterization); slices are joined in a buffer.
    Hardware,
    /// The same, into layers of images, one a light as the paper has them, joined by blending.
    HardwareLayers,
    /// The device's rasterisation of triangles that are grown by half a tile; slices are joined in a buffer.
    Software,
    /// The same, into layers of images.
    SoftwareLayers,
    /// No rasterisation: compute shaders ask every tile in which a mesh is seen, and of its triangles those that are seen there.
    Compute,
}

/// Slices of a tile that a texel of a layer tells apart.
const MOST_LAYERED_SLICES: u32 = 255;

impl Conservative {
    /// What it is on a device.
    pub fn on(self, limits: &Limits) -> Self {
        match self {
            Self::Auto if limits.conservative_rasterization => Self::Hardware,
            Self::Auto => Self::Compute,
            _ => self,
        }
    }

    /// Whether it needs the device's own conservative rasterisation.
    pub fn is_hardware(self) -> bool {
        matches!(self, Self::Hardware | Self::HardwareLayers)
    }

    /// Whether slices are left in layers of images.
    pub fn has_layers(self) -> bool {
        matches!(self, Self::HardwareLayers | Self::SoftwareLayers)
    }
}

/// Refuses grids of more slices than layers can tell apart, where slices are left there.
///
/// # Errors
/// Says how many there are, and how many there may be.
pub fn check_layered_slices(way: Conservative, slices: u32) -> Result<(), String> {
    if !way.has_layers() || slices <= MOST_LAYERED_SLICES {
        return Ok(());
    }
    Err(format!(
        "--conservative {way} serves up to {MOST_LAYERED_SLICES} slices, as texels of layers have 8 bits, and the grid has {slices}: use \
         --conservative {}",
        if way.is_hardware() { Conservative::Hardware } else { Conservative::Software }
    ))
}

impl fmt::Display for Conservative {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Hardware => "hardware",
            Self::HardwareLayers => "hardware-layers",
            Self::Software => "software",
            Self::SoftwareLayers => "software-layers",
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_serve_as_many_slices_as_a_texel_tells_apart() {
        for way in Conservative::value_variants() {
            assert_eq!(check_layered_slices(*way, 255), Ok(()));
            assert_eq!(check_layered_slices(*way, 256).is_ok(), !way.has_layers(), "{way}");
            assert_eq!(way.to_string().parse(), Ok(*way));
        }
        let message = check_layered_slices(Conservative::HardwareLayers, 300).unwrap_err();
        assert!(message.ends_with("has 300: use --conservative hardware"), "{message}");
    }
}
