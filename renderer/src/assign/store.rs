//! How light lists are kept, and how visible clusters get their places among them.

use crate::nearest;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// How the light lists lie in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListStore {
    /// One behind the other: lengths are known first, and their prefix sum says where each list begins.
    Offsets,
    /// So many entries for each list, at its cluster's place among the visible ones, with its length beside them (Enhuber
    /// section 3.2, who ends lists by -1). Where a list is longer, all get more entries and the frame is rendered again.
    Fixed(u32),
    /// At most so many lights for each list, in a range that a counter hands out once they are known (Ortiz). Of more, those
    /// with the lowest indices are kept, and the others dropped and counted.
    Capped(u32),
}

/// Entries that lists of one size may be given to begin with.
pub const MOST_FIXED: u32 = 1 << 20;
/// Most lights of a capped list: a thread keeps them to itself before they have a place.
pub const MOST_CAPPED: u32 = 1024;

impl ListStore {
    /// Whether lengths are counted, and summed to offsets, before any list is written.
    pub fn has_offsets(self) -> bool {
        self == Self::Offsets
    }

    /// The number in the name: entries of each list, or most lights of one; 0 where nothing bounds a list.
    pub fn bound(self) -> u32 {
        match self {
            Self::Offsets => 0,
            Self::Fixed(entries) => entries,
            Self::Capped(lights) => lights,
        }
    }
}

impl fmt::Display for ListStore {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Offsets => f.write_str("offsets"),
            Self::Fixed(entries) => write!(f, "fixed-{entries}"),
            Self::Capped(lights) => write!(f, "capped-{lights}"),
        }
    }
}

impl FromStr for ListStore {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbered = |name: &str, most: u32, make: fn(u32) -> Self| {
            let number = text.strip_prefix(name)?;
            let in_range = number.parse().ok().filter(|number| (1..=most).contains(number));
            Some(in_range.map(make).ok_or_else(|| {
                format!("`{text}`: `{number}` is no whole number from 1 to {most}, such as in {name}100")
            }))
        };
        if text == "offsets" {
            return Ok(Self::Offsets);
        }
        numbered("fixed-", MOST_FIXED, Self::Fixed)
            .or_else(|| numbered("capped-", MOST_CAPPED, Self::Capped))
            .unwrap_or_else(|| {
                Err(format!("`{text}` is no store of lists: valid are offsets, fixed-N and capped-N"))
            })
    }
}

/// How visible clusters get their places among the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Compaction {
    /// By a prefix sum: in the order of the grid.
    Ranks,
    /// By an atomic counter, a thread a cluster, in an order that differs from run to run (Enhuber section 3.2, Ortiz).
    Atomic,
    /// By sorting the samples of each tile by their slices: tile by tile, in the order of slices (Tegelaers section 6.2).
    Sort,
}

impl fmt::Display for Compaction {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Ranks => "ranks",
            Self::Atomic => "atomic",
            Self::Sort => "sort",
        })
    }
}

impl FromStr for Compaction {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "way of compaction")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stores_are_read_as_they_are_written() {
        for store in
            [ListStore::Offsets, ListStore::Fixed(1), ListStore::Fixed(MOST_FIXED), ListStore::Capped(100)]
        {
            assert_eq!(store.to_string().parse(), Ok(store));
        }
        for (wrong, told) in [
            ("fixed-0", "`0` is no whole number from 1 to 1048576"),
            ("capped-1025", "`1025` is no whole number from 1 to 1024"),
            ("capped-", "`` is no whole number"),
            ("fixed-1e3", "`1e3` is no"),
            ("linked", "`linked` is no store of lists"),
        ] {
            let error = wrong.parse::<ListStore>().unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }
}
