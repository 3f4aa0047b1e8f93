//! What the family keeps on the device: a clustering for each grid, whose buffers hold so much.

use crate::assign::Clusters;
use crate::measure::Capacities;

/// What a clustering's buffers hold at first, for grids of up to `clusters` clusters: every cluster where all have lists,
/// else what the configuration says, which grows.
pub fn capacities(clusters: u64, listed: Clusters, first: Capacities) -> Capacities {
    match listed {
        Clusters::Visible => first,
        Clusters::All => {
            Capacities { visible_clusters: u32::try_from(clusters).unwrap_or(u32::MAX), ..first }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_clusters_of_the_largest_grid_have_room() {
        let first = Capacities { visible_clusters: 16, light_indices: 99, ..Capacities::default() };
        assert_eq!(capacities(1000, Clusters::Visible, first), first);
        assert_eq!(capacities(1000, Clusters::All, first), Capacities { visible_clusters: 1000, ..first });
        assert_eq!(capacities(u64::MAX, Clusters::All, first).visible_clusters, u32::MAX);
    }
}
