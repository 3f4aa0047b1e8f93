//! How the octree over a frame's lights is made.

use crate::octree::OctreeSettings;
use std::fmt;
use std::str::FromStr;

/// How octrees are made; pictures and lists are the same by every way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OctreeWay {
    /// Anew where lights are others, in the smallest tables.
    Rebuild,
    /// The same, but what no neighbour gives of its hashes is drawn with this seed (Tegelaers section 7.3.1).
    Seed(u64),
    /// The same, but leaves with the same lights share one run of light indices.
    Shared,
    /// The same, but only where there is geometry (Tegelaers section 8.2.1, which designs it).
    Geometry,
}

impl OctreeWay {
    /// `settings` for octrees made so.
    pub fn of(self, settings: OctreeSettings) -> OctreeSettings {
        match self {
            Self::Rebuild | Self::Geometry => settings,
            Self::Seed(seed) => OctreeSettings { seed, ..settings },
            Self::Shared => OctreeSettings { share_runs: true, ..settings },
        }
    }
}

impl fmt::Display for OctreeWay {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Rebuild => f.write_str("rebuild"),
            Self::Seed(seed) => write!(f, "seed-{seed}"),
            Self::Shared => f.write_str("shared"),
            Self::Geometry => f.write_str("geometry"),
        }
    }
}

impl FromStr for OctreeWay {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.strip_prefix("seed-")) {
            ("rebuild", _) => Ok(Self::Rebuild),
            ("shared", _) => Ok(Self::Shared),
            ("geometry", _) => Ok(Self::Geometry),
            (_, Some(seed)) if seed.bytes().all(|byte| byte.is_ascii_digit()) => seed
                .parse()
                .map(Self::Seed)
                .map_err(|_| format!("`{text}`: `{seed}` is no seed such as in seed-7")),
            _ => Err(format!(
                "`{text}` is no way to make octrees: valid are rebuild, seed-N, shared and geometry"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_are_read_as_they_are_written() {
        for way in [
            OctreeWay::Rebuild,
            OctreeWay::Seed(0),
            OctreeWay::Seed(u64::MAX),
            OctreeWay::Shared,
            OctreeWay::Geometry,
        ] {
            assert_eq!(way.to_string().parse(), Ok(way));
        }
        for (wrong, told) in [
            ("seed-", "`` is no seed"),
            ("seed-99999999999999999999", "is no seed such as in seed-7"),
            ("seed--1", "no way to make octrees"),
            ("dense", "valid are rebuild, seed-N, shared and geometry"),
        ] {
            let error = wrong.parse::<OctreeWay>().unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }
}
