//! From fragment counts to the list of visible clusters.

/// In [`Compacted::visible_index`]: the cluster has no fragment.
pub const NOT_VISIBLE: u32 = u32::MAX;

/// Visible clusters and the way back.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Compacted {
    /// Linear indices of the clusters with at least one fragment, ascending.
    pub visible: Vec<u32>,
    /// Position in `visible` of each cluster of the grid, or [`NOT_VISIBLE`].
    pub visible_index: Vec<u32>,
}

/// Lists the clusters with fragments, from the fragment count of every cluster of the grid.
pub fn compact(fragments: &[u32]) -> Compacted {
    let mut visible = Vec::new();
    let mut visible_index = vec![NOT_VISIBLE; fragments.len()];
    for (cluster, &count) in fragments.iter().enumerate() {
        if count > 0 {
            visible_index[cluster] = visible.len() as u32;
            visible.push(cluster as u32);
        }
    }
    Compacted { visible, visible_index }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visible_clusters_ascend_and_know_their_place() {
        let Compacted { visible, visible_index } = compact(&[0, 2, 0, 0, 9, 1]);
        assert_eq!(visible, [1, 4, 5]);
        assert_eq!(visible_index, [NOT_VISIBLE, 0, NOT_VISIBLE, NOT_VISIBLE, 1, 2]);
        assert_eq!(compact(&[]), Compacted { visible: vec![], visible_index: vec![] });
    }
}
