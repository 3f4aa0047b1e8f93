//! What an atemporal frame counted on the device, read back and put into records.

use super::Engine;
use super::kept::KeptLists;
use super::session::Session;
use crate::buffers::ClusteringSizes;
use crate::gpu_interface::ClusteringState;
use crate::measure::{ClusterLists, ClusterRecord, ClusteringCounts, DeviceCounts, OctreeCounts};
use crate::passes::readback;
use crate::vk::{Buffer, Memory};
use crate::{Error, Result};
use ash::vk;

/// Everything counted of one clustering in one frame.
pub struct Counted {
    state: ClusteringState,
    /// Counters of the clustering, as the shaders counted.
    pub counters: DeviceCounts,
    lights_per_fragment: Vec<u32>,
    visible_clusters: Vec<u32>,
    visible_fragments: Vec<u32>,
    /// Light lists of the clustering, by ascending cluster.
    pub lists: ClusterLists,
    /// How many lights the lists should have.
    light_indices: u64,
    /// The octree whose leaves have the lists.
    octree: Option<OctreeCounts>,
}

/// Reads words of so many buffers of a clustering of the frame that ended in a slot.
fn read_words<const N: usize>(
    engine: &mut Engine,
    session: &mut Session,
    (slot, clustering): (usize, usize),
    sources: [readback::Source; N],
) -> Result<[Vec<u32>; N]> {
    let size = 4 * sources.iter().map(|(_, words)| words).sum::<u64>();
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let target = Buffer::new(&session.context, "counter readback", size, usage, Memory::Readback)?;
    engine.follow_up(session, slot, |r, frame| {
        readback::copy_counted(r, frame, clustering, &sources, &target);
    })?;
    let mut offset = 0;
    Ok(sources.map(|(_, words)| {
        let data = target.read(offset, words as usize);
        offset += 4 * words;
        data
    }))
}

impl Counted {
    /// Reads what the frame that ended in `slot` counted with `lights` lights; `state` is that of the clustering, zero
    /// for a method whose lists the device does not build.
    pub fn read(
        engine: &mut Engine,
        session: &mut Session,
        (slot, frame, clustering): (usize, u32, usize),
        (state, lights): (ClusteringState, u32),
    ) -> Result<Self> {
        let at = (slot, clustering);
        match engine.octree_counts() {
            Some(octree) => {
                let words = read_words(engine, session, at, readback::of_leaves(&octree.sizes, lights))?;
                Ok(Self::of_leaves(words, octree, (frame, clustering)))
            }
            None => {
                let words = KeptLists::words(&engine.sizes, &state);
                let words = read_words(engine, session, at, readback::of_cells(words, lights))?;
                Ok(Self::of_cells(words, &engine.sizes, state, (frame, clustering)))
            }
        }
    }

    /// From [`readback::of_cells`].
    fn of_cells(
        words: [Vec<u32>; 7],
        sizes: &ClusteringSizes,
        state: ClusteringState,
        (frame, clustering): (u32, usize),
    ) -> Self {
        let [counters, lights_per_fragment, clusters, fragments, offsets, lengths, indices] = words;
        let lengths = &lengths;
        let kept = KeptLists { sizes, clusters: &clusters, offsets: &offsets, lengths, indices: &indices };
        let order = kept.order();
        let in_order = |values: &[u32]| order.iter().map(|&place| values[place]).collect();
        let (offsets, indices) = kept.in_order(&order);
        Self {
            state,
            counters: DeviceCounts::from_words(&counters),
            lights_per_fragment,
            visible_clusters: in_order(&clusters),
            visible_fragments: in_order(&fragments),
            lists: ClusterLists { frame, clustering: clustering as u32, offsets, indices },
            light_indices: kept.wanted(&state),
            octree: None,
        }
    }

    /// From [`readback::of_leaves`]. Slots without lights are those of no leaf.
    fn of_leaves(words: [Vec<u32>; 5], octree: OctreeCounts, (frame, clustering): (u32, usize)) -> Self {
        let [counters, lights_per_fragment, fragments, runs, indices] = words;
        let (mut slots, mut visible_fragments) = (vec![], vec![]);
        let mut lists =
            ClusterLists { frame, clustering: clustering as u32, offsets: vec![0], indices: vec![] };
        for (slot, run) in runs.chunks_exact(2).enumerate().filter(|(_, run)| run[1] > 0) {
            let (first, count) = (run[0] as usize, run[1] as usize);
            lists.indices.extend_from_slice(&indices[first..first + count]);
            lists.offsets.push(lists.indices.len() as u32);
            slots.push(slot as u32);
            visible_fragments.push(fragments[slot]);
        }
        let (visible, index_total) = (slots.len() as u32, lists.indices.len() as u32);
        Self {
            state: ClusteringState {
                visible,
                visible_total: visible,
                index_total,
                ..ClusteringState::default()
            },
            counters: DeviceCounts::from_words(&counters),
            lights_per_fragment,
            visible_clusters: slots,
            visible_fragments,
            light_indices: index_total.into(),
            lists,
            octree: Some(octree),
        }
    }

    /// Refuses a frame whose lists do not ascend, or in which fewer lights were evaluated than the lists of its fragments
    /// name.
    ///
    /// # Errors
    /// The driver ended a loop over `lights` lights early.
    pub fn check(&self, lights: u32) -> Result<()> {
        let listed: u64 = self.lights_per_fragment().iter().map(|&(lights, n)| u64::from(lights) * n).sum();
        let evaluated = self.counters.lighting_computations;
        if evaluated == listed && self.lists.ascend(lights) {
            return Ok(());
        }
        Err(Error::Device(format!(
            "the driver evaluated {evaluated} of {listed} lights in frame {}, or built lists that do not ascend: it ends long \
             loops early (lavapipe does, after 65 535 turns); use fewer lights, or smaller radii",
            self.lists.frame
        )))
    }

    /// (lights, fragments) of every bin with fragments, ascending.
    pub fn lights_per_fragment(&self) -> Vec<(u32, u64)> {
        let bins = (0..).zip(self.lights_per_fragment.iter().map(|&fragments| u64::from(fragments)));
        bins.filter(|(_, fragments)| *fragments > 0).collect()
    }

    /// The clustering's record; `capacity` is how many light indices fitted.
    pub fn clustering(&self, dimensions: [u32; 3], capacity: u32) -> ClusteringCounts {
        let state = &self.state;
        let cut_off = self.light_indices.saturating_sub(self.lists.indices.len() as u64);
        let beyond = u64::from(state.index_total.saturating_sub(capacity));
        let clusters = self.visible_clusters.iter().zip(&self.visible_fragments).enumerate();
        ClusteringCounts {
            dimensions,
            visible_clusters: u64::from(state.visible_total),
            light_indices: self.light_indices,
            intersection_tests: self.counters.intersection_tests,
            light_indices_dropped: cut_off.max(beyond),
            visible_clusters_dropped: u64::from(state.visible_total - state.visible),
            lists_hash: self.lists.hash(self.visible_clusters.iter().copied()),
            clusters: clusters
                .map(|(visible, (&index, &fragments))| ClusterRecord {
                    index,
                    fragments,
                    lights: self.lists.list(visible).len() as u32,
                })
                .collect(),
            octree: self.octree.clone(),
        }
    }
}
