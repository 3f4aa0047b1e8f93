//! Visible clusters by sorting the samples of tiles: those of marking, in the order of their twin.

use super::*;
use crate::assign::Compaction;
use crate::geometry::DisplacedVolume;
use crate::methods::Division;

/// Words of visible clusters, and of tile offsets where tiles are sorted, of a frame that the street's pictures are of.
fn visible(method: Method, msaa: u32, compaction: Compaction) -> (Grid, Vec<u32>, Vec<u32>) {
    let config = Config { msaa, compaction: vec![compaction], ..config() };
    let view = frame_of(frustum_grid([1, 1, 1])).views.remove(0);
    let division = Division { slices: method.own_slices(), ..Division::from(DisplacedVolume::View) };
    let grid = method.plan(&[view], RESOLUTION, division).unwrap().remove(0);
    let room =
        Capacities { visible_clusters: grid.cluster_count() as u32, light_indices: 100_000, list_entries: 0 };
    let lights = lights(10);
    let mut bench = Bench::with_config(&config, method, grid, &lights, room);
    let plan = frame_of(grid);
    let all = FrameLights { list: &lights, revision: 1 };
    let Bench(Workbench { engine, session, .. }) = &mut bench;
    engine.render(session, 0, (&plan, all), (&mut nothing, &mut nothing)).unwrap();
    let there = bench.state().unwrap().visible as usize;
    let clusters = bench.download(BufferName::VisibleClusters, there);
    let offsets = match compaction {
        Compaction::Sort => {
            bench.download(BufferName::TileOffsets, (grid.dimensions[0] * grid.dimensions[1] + 1) as usize)
        }
        Compaction::Ranks | Compaction::Atomic => vec![],
    };
    (grid, clusters, offsets)
}

#[test]
fn tiles_are_sorted_as_by_their_twin() {
    for (name, msaa) in [
        ("clustered-mm-8", 1),
        ("clustered-mm-7", 4),
        ("indi-persp-1", 1),
        ("sc-i-24-300", 1),
        ("tiled-64", 1),
    ] {
        let method: Method = name.parse().unwrap();
        let (grid, marked, _) = visible(method, msaa, Compaction::Ranks);
        let (_, clusters, offsets) = visible(method, msaa, Compaction::Sort);
        let twin = cpu::sort_tiles(&grid, &marked);
        assert_eq!((clusters, offsets), (twin.clusters, twin.offsets), "{name}, {msaa} samples");
        assert!(marked.len() > 5 || name == "tiled-64", "{name}: {}", marked.len());
    }
}
