//! How fine the meshes around point lights are that are rasterised.

use crate::geometry::{MeshKind, SphereLevel};
use std::fmt;
use std::slice;
use std::str::FromStr;

/// Which level of detail the meshes around points have (Örtegren and Persson, further work). Spots have one mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeshDetail {
    /// One level for all.
    Level(SphereLevel),
    /// For each light the coarsest whose mesh reaches beyond it by at most this part of a tile's width, as seen from the eye: as
    /// [`SphereLevel::of_detail`] has it for the distance of the light's centre.
    Auto(f64),
}

impl MeshDetail {
    /// Every level that a light may have, the coarsest first.
    pub fn levels(&self) -> &[SphereLevel] {
        match self {
            Self::Level(level) => slice::from_ref(level),
            Self::Auto(_) => &SphereLevel::ALL,
        }
    }

    /// Every mesh that a light may have, those of points, then that of spots; devices have their templates in this order.
    pub fn meshes(&self) -> Vec<MeshKind> {
        self.levels().iter().copied().map(MeshKind::Sphere).chain([MeshKind::Spot]).collect()
    }

    /// The level of a point that reaches `radius` metres, `distance` metres from the eye, where tiles are so wide in tangents.
    pub fn level(&self, radius: f64, distance: f64, tile_width: f64) -> SphereLevel {
        match self {
            Self::Level(level) => *level,
            Self::Auto(part) => SphereLevel::of_detail(radius, distance, part * tile_width),
        }
    }

    /// How far the meshes of every level but the finest reach beyond their lights, in radii and parts of a tile's width, as a list of
    /// GLSL; `None` where there is one level.
    pub fn glsl_beyond(&self) -> Option<String> {
        let Self::Auto(part) = self else { return None };
        let [coarser @ .., _finest] = self.levels() else { return None };
        let beyond = |level: &SphereLevel| format!("{:e}", level.beyond() / part);
        Some(coarser.iter().map(beyond).collect::<Vec<_>>().join(", "))
    }
}

impl fmt::Display for MeshDetail {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Level(level) => level.fmt(f),
            Self::Auto(part) => write!(f, "auto-{part}"),
        }
    }
}

impl FromStr for MeshDetail {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        let Some(part) = text.strip_prefix("auto-") else {
            let named = SphereLevel::ALL.into_iter().find(|level| level.to_string() == text);
            return named.map(Self::Level).ok_or_else(|| {
                format!("`{text}` is no detail of meshes: valid are 12, 42, 162, 642 (vertices), auto-PART")
            });
        };
        let within = |part: &f64| PARTS.contains(part);
        part.parse().ok().filter(within).map(Self::Auto).ok_or_else(|| {
            let [least, most] = [PARTS.start(), PARTS.end()];
            format!(
                "`{text}`: `{part}` is no part of a tile's width from {least} to {most}, such as in auto-0.25"
            )
        })
    }
}

/// Parts of a tile's width that may be asked for: within them the squares that shaders compare keep all their digits.
const PARTS: std::ops::RangeInclusive<f64> = 1e-4..=1e4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in ["12", "42", "162", "642", "auto-0.25", "auto-3", "auto-0.0001"] {
            assert_eq!(name.parse::<MeshDetail>().unwrap().to_string(), name);
        }
        for name in ["", "43", "auto", "auto-", "auto-0", "auto--1", "auto-NaN", "auto-inf", "042"] {
            let message = name.parse::<MeshDetail>().unwrap_err();
            assert!(message.contains(&format!("`{name}`")) && message.contains("auto-"), "{message}");
        }
    }

    #[test]
    fn only_what_chooses_has_several_levels() {
        let one = MeshDetail::Level(SphereLevel::V162);
        assert_eq!(one.meshes(), [MeshKind::Sphere(SphereLevel::V162), MeshKind::Spot]);
        assert_eq!(one.glsl_beyond(), None);
        let several = MeshDetail::Auto(0.5);
        assert_eq!((several.levels(), several.meshes().len()), (SphereLevel::ALL.as_slice(), 5));
        let beyond = several.glsl_beyond().unwrap();
        let read: Vec<f64> = beyond.split(", ").map(|number| number.parse().unwrap()).collect();
        assert_eq!(read.len(), 3);
        for (number, level) in read.into_iter().zip(SphereLevel::ALL) {
            assert!((number - 2.0 * (level.circumradius() - 1.0)).abs() < 1e-12);
        }
    }
}
