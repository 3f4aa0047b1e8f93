//! What the buffers of a run take, and what its frames need of them: pure.
//!
//! A frame needs of a buffer what it would have if it were made for exactly that frame: its cells, its visible clusters and its
//! light indices.

use super::{BufferInfo, BufferName, ClusteringSizes, Owner};
use crate::measure::{Capacities, ClusteringCounts, OctreeSizes, StructureMemory};

/// How many buffers of a name there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Copies {
    /// Clusterings of a frame.
    pub clusterings: u64,
    /// Frames in flight.
    pub slots: u64,
}

impl Copies {
    /// Of a buffer that sizes decide on; `None` of any other.
    fn of(self, owner: Owner) -> Option<u64> {
        match owner {
            Owner::Clustering => Some(self.clusterings),
            Owner::ClusteringFrame => Some(self.clusterings * self.slots),
            Owner::Engine => Some(1),
            Owner::Frame | Owner::Scene | Owner::Session => None,
        }
    }
}

impl ClusteringSizes {
    /// Every structure that the temporal runs of a run have, in the order of the table of buffers, by what was counted of each
    /// clustering of each frame. Buffers of the scene, of views and of drawing are the same for all methods and not among them.
    pub fn memory(&self, copies: Copies, frames: &[&[ClusteringCounts]]) -> Vec<StructureMemory> {
        let sizes = Self { counting: false, ..*self };
        BufferName::ALL.into_iter().filter_map(|name| sizes.structure(name.info(), copies, frames)).collect()
    }

    /// What a buffer takes; `None` where the way at hand leaves it empty.
    fn structure(
        &self,
        info: &BufferInfo,
        copies: Copies,
        frames: &[&[ClusteringCounts]],
    ) -> Option<StructureMemory> {
        let (size, copies) = (info.size?, copies.of(info.owner)?);
        let allocated = Some(copies * size(self)).filter(|bytes| *bytes > 0)?;
        let of_frame = |frame: &&[ClusteringCounts]| match info.owner {
            Owner::Engine => size(self),
            _ => frame.iter().map(|counts| size(&self.exactly(counts))).sum(),
        };
        let needed: Vec<u64> = frames.iter().map(of_frame).collect();
        Some(StructureMemory {
            structure: info.name,
            purpose: info.purpose,
            allocated,
            used: needed.iter().sum::<u64>() / (needed.len() as u64).max(1),
            most: needed.into_iter().max().unwrap_or(0),
        })
    }

    /// Sizes for what one clustering of a frame had, and nothing more.
    fn exactly(&self, counts: &ClusteringCounts) -> Self {
        let entries = |count: u64| u32::try_from(count).unwrap_or(u32::MAX);
        let [x, y, z] = counts.dimensions.map(u64::from);
        Self {
            clusters: x * y * z,
            tiles: x * y,
            slice_planes: self.slice_planes.min(entries(z + 1)),
            capacities: Capacities {
                visible_clusters: entries(counts.visible_clusters),
                light_indices: entries(counts.light_indices),
                octree: counts.octree.as_ref().map_or_else(OctreeSizes::default, |octree| octree.sizes),
                ..self.capacities
            },
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assign::{Assigner, ClusterBounds, Clusters, Compaction, ListStore};
    use crate::geometry::NormalCones;
    use crate::measure::Purpose;

    const NO_OCTREE: OctreeSizes = OctreeSizes { nodes: 0, leaves: 0, offsets: 0, indices: 0 };

    const SIZES: ClusteringSizes = ClusteringSizes {
        clusters: 4096,
        tiles: 256,
        listed: Clusters::Visible,
        bounds: ClusterBounds::Box,
        normal_cones: NormalCones::OFF,
        boxed: false,
        compaction: Compaction::Ranks,
        lists: ListStore::Offsets,
        slice_planes: 17,
        lights: 100,
        spots: false,
        capacities: Capacities {
            visible_clusters: 1000,
            light_indices: 5000,
            list_entries: 0,
            octree: NO_OCTREE,
        },
        assigner: Assigner::Brute,
        shell_layers: false,
        has_octree: false,
        counting: true,
        pixels: 64,
    };

    fn counts(dimensions: [u32; 3], visible_clusters: u64, light_indices: u64) -> ClusteringCounts {
        ClusteringCounts { dimensions, visible_clusters, light_indices, ..ClusteringCounts::default() }
    }

    fn told(memory: &[StructureMemory], name: &str) -> [u64; 3] {
        let found = memory.iter().find(|one| one.structure == name).unwrap_or_else(|| panic!("{name}"));
        [found.allocated, found.used, found.most]
    }

    #[test]
    fn frames_need_what_they_would_have_alone() {
        let (large, small) = (counts([16, 16, 16], 900, 4000), counts([16, 16, 8], 10, 0));
        let frames: [&[ClusteringCounts]; 2] = [&[large.clone(), small.clone()], &[small.clone(), small]];
        let memory = SIZES.memory(Copies { clusterings: 2, slots: 2 }, &frames);
        assert_eq!(told(&memory, "light_indices"), [2 * 4 * 5000, 4 * 4000 / 2, 4 * 4000]);
        assert_eq!(told(&memory, "visible_clusters"), [2 * 4 * 1000, 4 * (910 + 20) / 2, 4 * 910]);
        assert_eq!(told(&memory, "cluster_bounds"), [2 * 24 * 1000, 24 * (910 + 20) / 2, 24 * 910]);
        assert_eq!(told(&memory, "cluster_bits"), [2 * 512, (512 + 256 + 2 * 256) / 2, 512 + 256]);
        assert_eq!(told(&memory, "slice_planes"), [4 * 4 * 17, 4 * (17 + 9 + 18) / 2, 4 * (17 + 9)]);
        let lights = told(&memory, "lights");
        assert!(lights[0] >= 100 * 32 && lights == [lights[0]; 3], "the clusterings share them");
        assert!(memory.iter().all(|one| one.used <= one.most && one.most <= one.allocated), "{memory:?}");
    }

    #[test]
    fn lists_of_a_fixed_size_take_all_their_entries() {
        let capacities = Capacities { list_entries: 40, ..SIZES.capacities };
        let sizes = ClusteringSizes { lists: ListStore::Fixed(32), capacities, ..SIZES };
        let frame = [counts([16, 16, 16], 900, 4000)];
        let memory = sizes.memory(Copies { clusterings: 1, slots: 2 }, &[&frame]);
        assert_eq!(told(&memory, "light_indices"), [4 * 40 * 1000, 4 * 40 * 900, 4 * 40 * 900]);
        assert!(memory.iter().all(|one| one.structure != "list_offsets"));
    }

    #[test]
    fn what_is_not_there_is_not_told() {
        let memory = SIZES.memory(Copies { clusterings: 1, slots: 2 }, &[]);
        let names: Vec<&str> = memory.iter().map(|one| one.structure).collect();
        for absent in ["counters", "pixels", "candidates", "light_nodes", "views", "instances"] {
            assert!(!names.contains(&absent), "{absent}");
        }
        assert_eq!(told(&memory, "light_indices")[1..], [0, 0], "no frame needed anything");
        let of = |purpose| memory.iter().filter(move |one| one.purpose == purpose).map(|one| one.structure);
        assert_eq!(of(Purpose::Lists).collect::<Vec<_>>(), ["list_offsets", "light_indices"]);
        assert_eq!(of(Purpose::Lights).collect::<Vec<_>>(), ["lights"]);
        assert_eq!(
            of(Purpose::Grouping).collect::<Vec<_>>(),
            ["grid", "slice_planes", "cluster_bits", "word_ranks", "visible_clusters", "cluster_bounds"]
        );
    }
}
