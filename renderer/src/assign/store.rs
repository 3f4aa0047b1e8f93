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
    /// From node to node, which the fill pass of meshes hands out from a pool (Örtegren and Persson section 4.4); of no other way.
    Linked(Links),
}

/// Lists of nodes that tell the next one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Links {
    /// What a node has.
    pub node: NodeLayout,
    /// Whether lists are sorted once they are filled, so that sums of light repeat to the bit. Otherwise they are walked in the order in
    /// which nodes were handed out, which differs from run to run.
    pub sorted: bool,
}

/// What a node of a linked list has (Örtegren and Persson table 4.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeLayout {
    /// Kind in 8 bits, light in 24, next node in 32.
    Bits64,
    /// Light in 12 bits, next node in 20. The paper gives two of the 12 to the kind.
    Bits32,
}

impl NodeLayout {
    /// Words of a node.
    pub fn words(self) -> u64 {
        match self {
            Self::Bits64 => 2,
            Self::Bits32 => 1,
        }
    }

    /// Most nodes that links tell apart from the end of a list.
    pub fn most_nodes(self) -> u64 {
        match self {
            Self::Bits64 => u32::MAX.into(),
            Self::Bits32 => (1 << 20) - 1,
        }
    }

    /// Most lights: what nodes tell, and sorting is made for.
    pub fn most_lights(self) -> u32 {
        match self {
            Self::Bits64 => 1 << 14,
            Self::Bits32 => 1 << 12,
        }
    }
}

/// Nodes of the pool for each cluster of the grid to begin with: the paper's.
pub const NODES_PER_CLUSTER: u32 = 30;

/// Every store of linked lists, with its name.
const LINKED: [(&str, Links); 4] = [
    ("linked-64", Links { node: NodeLayout::Bits64, sorted: true }),
    ("linked-32", Links { node: NodeLayout::Bits32, sorted: true }),
    ("linked-64-unsorted", Links { node: NodeLayout::Bits64, sorted: false }),
    ("linked-32-unsorted", Links { node: NodeLayout::Bits32, sorted: false }),
];

impl fmt::Display for Links {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let named = LINKED.iter().find(|(_, links)| links == self);
        f.write_str(named.map_or("", |(name, _)| name))
    }
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

    /// What nodes are like, where lists are linked.
    pub fn links(self) -> Option<Links> {
        match self {
            Self::Linked(links) => Some(links),
            Self::Offsets | Self::Fixed(_) | Self::Capped(_) => None,
        }
    }

    /// The number in the name: entries of each list, or most lights of one; 0 where nothing bounds a list.
    pub fn bound(self) -> u32 {
        match self {
            Self::Offsets | Self::Linked(_) => 0,
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
            Self::Linked(links) => links.fmt(f),
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
        if let Some((_, links)) = LINKED.iter().find(|(name, _)| *name == text) {
            return Ok(Self::Linked(*links));
        }
        numbered("fixed-", MOST_FIXED, Self::Fixed)
            .or_else(|| numbered("capped-", MOST_CAPPED, Self::Capped))
            .unwrap_or_else(|| {
                Err(format!(
                    "`{text}` is no store of lists: valid are offsets, fixed-N, capped-N, {}",
                    LINKED.map(|(name, _)| name).join(", ")
                ))
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
                .into_iter()
                .chain(LINKED.map(|(_, links)| ListStore::Linked(links)))
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
