//! How the octree over a frame's lights is made.

use crate::octree::OctreeSettings;
use std::fmt;
use std::str::FromStr;

/// How octrees are made. Pictures are the same by every way, and so are lists, but those that [`Self::Dynamic`] leaves too long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OctreeWay {
    /// Anew where lights are others, in the smallest tables.
    Rebuild,
    /// The same, but what no neighbour gives of its hashes is drawn with this seed (Tegelaers section 7.3.1).
    Seed(u64),
    /// The same, but leaves with the same lights share one run of light indices.
    Shared,
    /// The same, but only where there is geometry (Tegelaers section 8.2.1, which designs it).
    Geometry,
    /// Kept where lights are others, and edited where these have changed (Tegelaers section 8.2.3, which designs it), in tables with so
    /// many slots a key.
    Dynamic(f64),
}

/// Most slots a key: more would be tables of air.
const MOST_SLACK: f64 = 100.0;

impl OctreeWay {
    /// `settings` for octrees made so; those that are kept reach `room` metres past their lights.
    pub fn of(self, settings: OctreeSettings, room: f64) -> OctreeSettings {
        match self {
            Self::Rebuild | Self::Geometry => settings,
            Self::Dynamic(slack) => OctreeSettings { slack, room, ..settings },
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
            Self::Dynamic(slack) => write!(f, "dynamic-{slack}"),
        }
    }
}

impl FromStr for OctreeWay {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.split_once('-')) {
            ("rebuild", _) => Ok(Self::Rebuild),
            ("shared", _) => Ok(Self::Shared),
            ("geometry", _) => Ok(Self::Geometry),
            (_, Some(("seed", seed))) if seed.bytes().all(|byte| byte.is_ascii_digit()) => seed
                .parse()
                .map(Self::Seed)
                .map_err(|_| format!("`{text}`: `{seed}` is no seed such as in seed-7")),
            (_, Some(("dynamic", slack))) => slack_of(slack).map(Self::Dynamic).ok_or_else(|| {
                format!("`{text}`: tables have 1 to {MOST_SLACK} slots a key, such as in dynamic-1.5")
            }),
            _ => Err(format!(
                "`{text}` is no way to make octrees: valid are rebuild, seed-N, shared, geometry and dynamic-SLACK"
            )),
        }
    }
}

/// Reads how many slots a key has.
fn slack_of(text: &str) -> Option<f64> {
    let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    text.parse().ok().filter(|slack| is_plain && (1.0..=MOST_SLACK).contains(slack))
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
            OctreeWay::Dynamic(1.0),
            OctreeWay::Dynamic(1.25),
        ] {
            assert_eq!(way.to_string().parse(), Ok(way));
        }
        for (wrong, told) in [
            ("seed-", "`` is no seed"),
            ("seed-99999999999999999999", "is no seed such as in seed-7"),
            ("seed--1", "no way to make octrees"),
            ("dynamic", "valid are"),
            ("dynamic-", "1 to 100 slots a key"),
            ("dynamic-0.9", "1 to 100 slots a key"),
            ("dynamic-1e1", "1 to 100 slots a key"),
            ("dynamic-NaN", "1 to 100 slots a key"),
            ("dynamic-1.5-geometry", "1 to 100 slots a key"),
            ("dense", "valid are rebuild, seed-N, shared, geometry and dynamic-SLACK"),
        ] {
            let error = wrong.parse::<OctreeWay>().unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }
}
