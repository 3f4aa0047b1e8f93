//! Scattering: candidates to groups of visible clusters, and each group against its own.

use super::cull_lights::{Candidate, CellRange};
use super::{FoundLists, Visible};
use crate::geometry::{CellTest, LightVolume, SphereTest};
use crate::gpu_interface::ASSIGN_WORKGROUP;

/// A group: up to [`ASSIGN_WORKGROUP`] visible clusters that follow each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClusterGroup {
    /// The least range that holds its clusters.
    pub cells: CellRange,
    /// Numbers of the candidates whose cells overlap those, ascending.
    pub candidates: Vec<u32>,
    /// Index of the first packet of [`ASSIGN_WORKGROUP`] candidates: how many the groups before have.
    pub first_packet: u32,
}

impl ClusterGroup {
    /// How many packets the candidates of the group fill.
    pub fn packets(&self) -> u32 {
        (self.candidates.len() as u32).div_ceil(ASSIGN_WORKGROUP)
    }
}

/// The groups of the visible clusters, with the candidates that each has to test.
pub fn scatter_groups(visible: &Visible, candidates: &[Candidate]) -> Vec<ClusterGroup> {
    let mut first_packet = 0;
    visible
        .clusters
        .chunks(ASSIGN_WORKGROUP as usize)
        .map(|clusters| {
            let cells = CellRange::around(clusters.iter().map(|&c| visible.grid.cluster_at(c)));
            let near = (0u32..).zip(candidates).filter(|(_, candidate)| candidate.cells.overlaps(&cells));
            let group =
                ClusterGroup { cells, candidates: near.map(|(number, _)| number).collect(), first_packet };
            first_packet += group.packets();
            group
        })
        .collect()
}

/// What scattering finds: lists of numbers of candidates, and how many tests that takes.
pub fn scatter(
    visible: &Visible,
    groups: &[ClusterGroup],
    volumes: &[LightVolume],
    test: SphereTest,
    epsilon: f64,
) -> (FoundLists, u64) {
    let (mut lists, mut tests) = (FoundLists::default(), 0);
    for (group, clusters) in groups.iter().zip(visible.clusters.chunks(ASSIGN_WORKGROUP as usize)) {
        for &cluster in clusters {
            let cell = CellTest::new(test, visible.grid, visible.grid.cluster_at(cluster));
            lists.start_list();
            tests += group.candidates.len() as u64;
            for &number in &group.candidates {
                lists.add(number, cell.margin(&volumes[number as usize]), epsilon);
            }
        }
    }
    (lists, tests)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::cull_lights;
    use crate::cpu::tests::row;
    use glam::DVec3;

    #[test]
    fn groups_take_the_candidates_of_their_cells_and_fill_whole_packets() {
        let grid = row(200);
        let clusters: Vec<u32> = (0..130).collect();
        let visible = Visible { grid: &grid, clusters: &clusters };
        let at = |x: f64| LightVolume::sphere(DVec3::new(x, 0.5, 0.5), 0.7);
        let volumes: Vec<_> =
            [at(10.5), at(64.0), at(150.0), at(129.5)].into_iter().chain([at(80.5); 70]).collect();
        let culled = cull_lights(&visible, &volumes, SphereTest::Box, 1e-4);
        let groups = scatter_groups(&visible, &culled.candidates);
        assert_eq!(groups.iter().map(|group| group.candidates.len()).collect::<Vec<_>>(), [2, 71, 1]);
        assert_eq!(groups.iter().map(|group| group.first_packet).collect::<Vec<_>>(), [0, 1, 3]);
        let kept: Vec<_> = culled.candidates.iter().map(|c| volumes[c.light as usize]).collect();
        let (lists, tests) = scatter(&visible, &groups, &kept, SphereTest::Box, 1e-4);
        assert_eq!(tests, 64 * 2 + 64 * 71 + 2);
        assert_eq!((&lists.lights[10], &lists.lights[63], &lists.lights[64]), (&vec![0], &vec![1], &vec![1]));
        assert_eq!(lists.lights[80].len(), 70);
    }
}
