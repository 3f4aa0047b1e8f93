//! Filling: from shells to the lights of each cluster (Örtegren and Persson section 4.4).
//!
//! ```text
//! shells ─┬─ count ─ scan ─> offsets ─ place ─> lights of each cluster, ascending     (fill)
//!         └─ link, points before spots ──────> heads and nodes, the last light first (fill_linked)
//! ```

use super::{SliceRange, scan};
use crate::geometry::VolumeKind;

/// The shells of all lights in a grid.
#[derive(Debug, Clone, Copy)]
pub struct Shells<'a> {
    /// Light by light, and tile by tile of each.
    pub ranges: &'a [SliceRange],
    /// Tiles along x and y, and slices.
    pub dimensions: [u32; 3],
}

impl Shells<'_> {
    /// Every light with a cluster that it is in, light by light.
    fn entries(&self) -> impl Iterator<Item = (u32, u32)> {
        let (tiles, [_, _, slices]) = (self.tiles(), self.dimensions);
        let ranges =
            (0u32..).zip(self.ranges).filter_map(move |(at, range)| Some((at, range.slices(slices)?)));
        ranges.flat_map(move |(at, [first, last])| {
            (first..=last).map(move |slice| (at / tiles, at % tiles + tiles * slice))
        })
    }

    fn tiles(&self) -> u32 {
        self.dimensions[0] * self.dimensions[1]
    }

    fn clusters(&self) -> usize {
        self.dimensions.map(|count| count as usize).iter().product()
    }
}

/// Lists one behind the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FilledLists {
    /// Where the list of each cluster begins, and behind them where the last one ends.
    pub offsets: Vec<u32>,
    /// Lights of each list, ascending.
    pub lights: Vec<u32>,
}

/// The lists of all clusters, by counting, then placing.
pub fn fill(shells: &Shells) -> FilledLists {
    let mut lengths = vec![0; shells.clusters()];
    shells.entries().for_each(|(_, cluster)| lengths[cluster as usize] += 1);
    let offsets = scan(&lengths);
    let mut lights = vec![0; offsets.last().map_or(0, |end| *end as usize)];
    let mut next = offsets.clone();
    for (light, cluster) in shells.entries() {
        let place = &mut next[cluster as usize];
        lights[*place as usize] = light;
        *place += 1;
    }
    FilledLists { offsets, lights }
}

/// Behind the last node of a list.
pub const END_OF_LIST: u32 = u32::MAX;

/// Lists of nodes that tell the next one.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LinkedLists {
    /// First node of each cluster's list, or [`END_OF_LIST`].
    pub heads: Vec<u32>,
    /// Light of each node, and the next node or [`END_OF_LIST`].
    pub nodes: Vec<[u32; 2]>,
    /// How many nodes had no room in the pool.
    pub dropped: u64,
}

impl LinkedLists {
    /// The lights of a cluster in the order in which they are walked.
    pub fn walk(&self, cluster: u32) -> impl Iterator<Item = u32> {
        let node = |at: u32| self.nodes.get(at as usize);
        let first = node(self.heads[cluster as usize]);
        std::iter::successors(first, move |[_, next]| node(*next)).map(|[light, _]| *light)
    }
}

/// The lists of all clusters, linked in a pool of so many nodes: each light goes before those of its list, points first, so that
/// walks meet spots first, and of each kind the last light first. On the device, lights of a kind come in any order.
pub fn fill_linked(shells: &Shells, kinds: &[VolumeKind], pool: u32) -> LinkedLists {
    let heads = vec![END_OF_LIST; shells.clusters()];
    let mut lists = LinkedLists { heads, ..LinkedLists::default() };
    for kind in [VolumeKind::Sphere, VolumeKind::Sector] {
        for (light, cluster) in shells.entries().filter(|(light, _)| kinds[*light as usize] == kind) {
            if lists.nodes.len() == pool as usize {
                lists.dropped += 1;
                continue;
            }
            let head = &mut lists.heads[cluster as usize];
            lists.nodes.push([light, *head]);
            *head = lists.nodes.len() as u32 - 1;
        }
    }
    lists
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIMENSIONS: [u32; 3] = [2, 1, 4];

    /// Of three lights the first is in slices 1 to 2 of both tiles, the second nowhere, the third in slices 0 to 1 of the second tile.
    fn ranges() -> Vec<SliceRange> {
        let range = |first: u8, behind: u8| SliceRange::from_bytes([first, behind]);
        let none = SliceRange::EMPTY;
        vec![range(1, 1), range(1, 1), none, none, none, range(0, 2)]
    }

    const KINDS: [VolumeKind; 3] = [VolumeKind::Sector, VolumeKind::Sphere, VolumeKind::Sphere];

    #[test]
    fn lights_are_listed_in_the_clusters_of_their_shells() {
        let ranges = ranges();
        let lists = fill(&Shells { ranges: &ranges, dimensions: DIMENSIONS });
        assert_eq!(lists.offsets, [0, 0, 1, 2, 4, 5, 6, 6, 6]);
        assert_eq!(lists.lights, [2, 0, 0, 2, 0, 0]);
    }

    #[test]
    fn linked_lists_hold_the_same_lights_spots_first() {
        let ranges = ranges();
        let shells = Shells { ranges: &ranges, dimensions: DIMENSIONS };
        let (filled, linked) = (fill(&shells), fill_linked(&shells, &KINDS, 6));
        assert_eq!(linked.walk(3).collect::<Vec<_>>(), [0, 2]);
        for cluster in 0..8 {
            let mut walked: Vec<u32> = linked.walk(cluster).collect();
            walked.sort_unstable();
            let [from, to] = [0, 1].map(|end| filled.offsets[cluster as usize + end] as usize);
            assert_eq!(walked, filled.lights[from..to]);
        }
        assert_eq!((linked.nodes.len(), linked.dropped), (6, 0));
    }

    #[test]
    fn what_has_no_room_is_counted() {
        let ranges = ranges();
        let linked = fill_linked(&Shells { ranges: &ranges, dimensions: DIMENSIONS }, &KINDS, 4);
        assert_eq!((linked.nodes.len(), linked.dropped), (4, 2));
        assert_eq!(linked.walk(3).collect::<Vec<_>>(), [2], "points come first, so that spots have no room");
        assert_eq!(linked.walk(2).collect::<Vec<_>>(), [0]);
    }
}
