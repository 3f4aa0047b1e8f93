//! Light lists as they are read back in an atemporal run.

/// The light lists of one clustering in one frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClusterLists {
    /// Frame number in the recording.
    pub frame: u32,
    /// Which clustering of the frame.
    pub clustering: u32,
    /// Where the list of each visible cluster (ascending) starts in `indices`, and last their total length.
    pub offsets: Vec<u32>,
    /// Light indices, ascending within each list.
    pub indices: Vec<u32>,
}

impl ClusterLists {
    /// The list of a visible cluster, by its position among the visible ones.
    pub fn list(&self, visible: usize) -> &[u32] {
        &self.indices[self.offsets[visible] as usize..self.offsets[visible + 1] as usize]
    }

    /// Whether each list ascends, and names none but the first `lights` lights.
    pub fn ascend(&self, lights: u32) -> bool {
        let visible = self.offsets.len().saturating_sub(1);
        (0..visible)
            .map(|list| self.list(list))
            .all(|list| list.is_sorted_by(|a, b| a < b) && list.last().is_none_or(|&light| light < lights))
    }

    /// FNV-1a, 64 bits, over each visible cluster's index, list length and list, in order, as little-endian words.
    pub fn hash(&self, clusters: impl Iterator<Item = u32>) -> u64 {
        let mut hash = Fnv::default();
        for (visible, cluster) in clusters.enumerate() {
            let list = self.list(visible);
            hash.add(cluster);
            hash.add(list.len() as u32);
            list.iter().for_each(|&light| hash.add(light));
        }
        hash.0
    }
}

struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}
