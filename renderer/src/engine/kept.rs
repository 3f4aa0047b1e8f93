//! Light lists as their store keeps them, read back and put in the order of their clusters: whatever the store, and whichever
//! places clusters have, what comes out is the same.

use crate::assign::{ListStore, NodeLayout};
use crate::buffers::ClusteringSizes;
use crate::gpu_interface::ClusteringState;
use std::ops::Range;

/// What was read of the lists of one clustering, each part as far as the store has it.
pub struct KeptLists<'a> {
    /// How the lists are kept.
    pub sizes: &'a ClusteringSizes,
    /// The cluster that has each place among the lists.
    pub clusters: &'a [u32],
    /// Where each list begins, and in the store by offsets where the last one ends.
    pub offsets: &'a [u32],
    /// How many lights each list should have, in stores that keep it.
    pub lengths: &'a [u32],
    /// The lights.
    pub indices: &'a [u32],
}

impl KeptLists<'_> {
    /// How many words there are of clusters, offsets, lengths and indices.
    pub fn words(sizes: &ClusteringSizes, state: &ClusteringState) -> [u64; 4] {
        let visible = u64::from(state.visible);
        match sizes.lists {
            ListStore::Offsets => [visible, visible + 1, 0, state.index_total.into()],
            ListStore::Fixed(_) => [visible, 0, visible, visible * u64::from(sizes.list_bound())],
            ListStore::Capped(_) => [visible, visible, visible, state.index_total.into()],
            ListStore::Linked(links) => {
                let nodes = u64::from(state.index_total).min(sizes.light_indices());
                [visible, visible, 0, nodes * links.node.words()]
            }
        }
    }

    /// Places by ascending cluster.
    pub fn order(&self) -> Vec<usize> {
        let mut places: Vec<usize> = (0..self.clusters.len()).collect();
        places.sort_by_key(|&place| self.clusters[place]);
        places
    }

    /// Offsets and lights of the lists at these places, one behind the other; each list by ascending light.
    pub fn in_order(&self, order: &[usize]) -> (Vec<u32>, Vec<u32>) {
        let (mut offsets, mut indices) = (vec![0], Vec::with_capacity(self.indices.len()));
        for &place in order {
            match self.sizes.lists.links() {
                None => indices.extend_from_slice(&self.indices[self.range(place)]),
                Some(links) => {
                    let first = indices.len();
                    indices.extend(walk(links.node, self.indices, self.offsets[place]));
                    indices[first..].sort_unstable();
                }
            }
            offsets.push(indices.len() as u32);
        }
        (offsets, indices)
    }

    /// Where the list at a place lies among the indices, if it lies in one piece.
    fn range(&self, place: usize) -> Range<usize> {
        match self.sizes.lists {
            ListStore::Offsets => self.offsets[place] as usize..self.offsets[place + 1] as usize,
            ListStore::Fixed(_) => {
                let entries = self.sizes.list_bound();
                let first = place * entries as usize;
                first..first + self.lengths[place].min(entries) as usize
            }
            ListStore::Capped(_) => {
                let first = self.offsets[place] as usize;
                first..first + self.lengths[place] as usize
            }
            ListStore::Linked(_) => 0..0,
        }
    }

    /// How many lights all lists should have; of capped ones, those that were not dropped.
    pub fn wanted(&self, state: &ClusteringState) -> u64 {
        match self.sizes.lists {
            ListStore::Offsets | ListStore::Capped(_) | ListStore::Linked(_) => state.index_total.into(),
            ListStore::Fixed(_) => self.lengths.iter().map(|&length| u64::from(length)).sum(),
        }
    }
}

/// The lights of a linked list that begins at a node of a pool, in the order in which it is walked.
pub fn walk(layout: NodeLayout, pool: &[u32], first: u32) -> impl Iterator<Item = u32> {
    let node = move |at: u32| {
        let at = at as usize;
        match layout {
            NodeLayout::Bits64 => {
                let node = pool.get(2 * at..)?.first_chunk::<2>()?;
                Some((node[0] & 0xFF_FFFF, node[1]))
            }
            NodeLayout::Bits32 => pool.get(at).map(|node| (node >> 20, node & 0xF_FFFF)),
        }
    };
    std::iter::successors(node(first), move |&(_, next)| node(next)).map(|(light, _)| light)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assign::{Assigner, ClusterBounds, Clusters, Compaction};
    use crate::geometry::NormalCones;
    use crate::measure::Capacities;

    fn sizes(lists: ListStore) -> ClusteringSizes {
        ClusteringSizes {
            clusters: 10,
            tiles: 10,
            listed: Clusters::Visible,
            bounds: ClusterBounds::Cell,
            normal_cones: NormalCones::OFF,
            boxed: false,
            compaction: Compaction::Atomic,
            lists,
            slice_planes: 0,
            lights: 100,
            spots: false,
            capacities: Capacities {
                visible_clusters: 10,
                light_indices: 20,
                list_entries: 3,
                ..Capacities::default()
            },
            assigner: Assigner::Brute,
            shell_layers: false,
            has_octree: false,
            counting: true,
            pixels: 1,
        }
    }

    #[test]
    fn every_store_has_the_same_lists_by_ascending_cluster() {
        let clusters = &[7, 2, 5];
        let state = ClusteringState { visible: 3, index_total: 4, ..ClusteringState::default() };
        for (store, [offsets, lengths, indices]) in [
            (ListStore::Offsets, [&[0, 1, 1, 4][..], &[], &[9, 4, 6, 8]]),
            (ListStore::Fixed(3), [&[], &[1, 0, 3], &[9, 0, 0, 0, 0, 0, 4, 6, 8]]),
            (ListStore::Capped(3), [&[3, 0, 0], &[1, 0, 3], &[4, 6, 8, 9]]),
        ] {
            let sizes = &sizes(store);
            let kept = KeptLists { sizes, clusters, offsets, lengths, indices };
            let read = [clusters.len(), offsets.len(), lengths.len(), indices.len()];
            assert_eq!(KeptLists::words(sizes, &state), read.map(|words| words as u64), "{store}");
            let order = kept.order();
            assert_eq!(order, [1, 2, 0]);
            assert_eq!(kept.in_order(&order), (vec![0, 0, 3, 4], vec![4, 6, 8, 9]), "{store}");
            assert_eq!(kept.wanted(&state), 4, "{store}");
        }
    }

    #[test]
    fn lists_longer_than_their_entries_say_what_they_lack() {
        let sizes = &sizes(ListStore::Fixed(2));
        let kept = KeptLists { sizes, clusters: &[1], offsets: &[], lengths: &[5], indices: &[3, 4, 6] };
        assert_eq!(kept.in_order(&[0]), (vec![0, 3], vec![3, 4, 6]));
        assert_eq!(kept.wanted(&ClusteringState::default()), 5);
    }
}
