//! The list-building passes on the device against their CPU twins, and the stage times against known work.

use super::workbench::{Case, Lists, Room, Workbench, given};
use super::*;
use crate::cpu;
use crate::geometry::Grid;
use crate::lights::Light;
use crate::measure::Capacities;
use crate::pass::{BufferCopy, Faults};
use crate::passes::{assign, lights as light_upload, readback, scan};
use crate::scene::Scene;
use crate::scene::procedural::by_name;
use crate::selftest::cases::{
    ORTHO, ORTIZ, PERSP, box_grid, fragments_of, frustum_grid, pose, rain, random_bits, random_lights,
};
use crate::selftest::{compaction_fault, lists as list_checks, offsets_fault, tenfold, touching_lights};
use glam::DVec3;
use std::ops::{Deref, DerefMut};

const RESOLUTION: [u32; 2] = [64, 32];

fn config() -> Config {
    Config { resolution: RESOLUTION, validate: true, ..Config::default() }
}

fn street() -> Scene {
    by_name("street").expect("a built-in scene")
}

fn lights(count: u32) -> Vec<Light> {
    rain(count).unwrap()
}

fn frame_of(grid: Grid) -> FramePlan {
    workbench::frame_of(grid, RESOLUTION)
}

/// A workbench on which whatever fails fails the test.
struct Bench(Workbench);

impl Deref for Bench {
    type Target = Workbench;

    fn deref(&self) -> &Workbench {
        &self.0
    }
}

impl DerefMut for Bench {
    fn deref_mut(&mut self) -> &mut Workbench {
        &mut self.0
    }
}

impl Bench {
    fn new(method: Method, grid: Grid, lights: &[Light], capacities: Capacities) -> Self {
        Self::with_config(&config(), method, grid, lights, capacities)
    }

    fn with_config(
        config: &Config,
        method: Method,
        grid: Grid,
        lights: &[Light],
        capacities: Capacities,
    ) -> Self {
        Self::with_scene(config, &street(), Case { method, grid, lights, capacities })
    }

    fn with_scene(config: &Config, scene: &Scene, case: Case) -> Self {
        Self(Workbench::new(config, scene, case, Faults::default()).unwrap())
    }

    fn write(&mut self, plan: &FramePlan, list: &[Light]) {
        self.0.write(plan, list).unwrap();
    }

    fn run(&mut self, commands: impl FnOnce(&mut Recorder, &Frame)) {
        self.0.run(commands).unwrap();
    }

    fn upload(&mut self, name: BufferName, data: &[u32]) {
        self.0.upload(name, data).unwrap();
    }

    fn download(&mut self, name: BufferName, words: usize) -> Vec<u32> {
        self.0.download(name, words).unwrap()
    }

    fn compact(&mut self, bits: &[u32]) -> ClusteringState {
        self.0.compact(bits).unwrap()
    }

    fn lists(&mut self) -> Lists {
        self.0.lists().unwrap()
    }
}

mod assign_equality;
mod bounds;
mod boxes;
mod cones;
mod cull;
mod list_stores;
mod list_twins;
mod normal_cones;
mod octree;
mod raster;
mod rectangles;
mod sort_tiles;
mod sphere_tests;
mod targets;

#[test]
fn compaction_equals_its_twin_at_odd_sizes() {
    for (case, clusters) in
        [1u64, 31, 32, 33, 1023, 8191, 8193, 32 * 1024, 32 * 1024 + 1, 32 * 1024 * 257 + 5]
            .into_iter()
            .enumerate()
    {
        // More cannot be dispatched everywhere; a third is visible.
        let room = Capacities {
            visible_clusters: clusters.min(4_000_000) as u32,
            light_indices: 16,
            ..Capacities::default()
        };
        let mut bench = Bench::new(ORTHO, box_grid([clusters as u32, 1, 1]), &lights(10), room);
        assert_eq!(compaction_fault(&mut bench, clusters, case as u64 + 1).unwrap(), None);
    }
}

#[test]
fn visible_clusters_beyond_the_capacity_are_counted() {
    let room = Capacities { visible_clusters: 100, light_indices: 16, ..Capacities::default() };
    let mut bench = Bench::new(ORTHO, box_grid([5000, 1, 1]), &lights(10), room);
    let bits = random_bits(5000, 2, 9);
    let twin = cpu::compact(&fragments_of(&bits, 5000));
    let state = bench.compact(&bits);
    assert_eq!((state.visible_total as usize, state.visible), (twin.visible.len(), 100));
    assert_eq!(bench.download(BufferName::VisibleClusters, 100), twin.visible[..100]);
}

#[test]
fn list_offsets_equal_their_twin_at_odd_sizes() {
    for clusters in [1u32, 63, 255, 256, 257, 1025, 16_384, 16_385, 70_000] {
        let room = Capacities { visible_clusters: clusters, light_indices: 16, ..Capacities::default() };
        let mut bench = Bench::new(ORTHO, box_grid([clusters, 1, 1]), &lights(1000), room);
        assert_eq!(offsets_fault(&mut bench, clusters).unwrap(), None);
    }
}

#[test]
fn totals_beyond_32_bits_saturate_and_offsets_never_descend() {
    // Few blocks, and more than one workgroup takes.
    for clusters in [2000u32, 20_000] {
        let room = Capacities { visible_clusters: clusters, light_indices: 16, ..Capacities::default() };
        let mut bench = Bench::new(ORTHO, box_grid([clusters, 1, 1]), &lights(10), room);
        let state = bench.compact(&random_bits(u64::from(clusters), 1, 1));
        bench.upload(BufferName::ListLengths, &vec![1 << 24; state.visible as usize]);
        bench.run(|r, frame| {
            scan::light_offsets(r, frame, given());
            readback::states(r, frame);
        });
        let offsets = bench.download(BufferName::ListOffsets, clusters as usize + 1);
        let twin: Vec<u32> =
            (0..=u64::from(clusters)).map(|i| (i << 24).min(u64::from(u32::MAX)) as u32).collect();
        assert!(offsets == twin, "{clusters} clusters");
        assert_eq!(bench.engine.states(&bench.session, 0)[0].index_total, u32::MAX);
    }
}

/// Not a test of speed: whether a stage's time holds that stage's work and no other's.
#[test]
fn a_stage_ten_times_as_heavy_grows_alone() {
    let room = Capacities { visible_clusters: 40_000, light_indices: 16, ..Capacities::default() };
    let mut bench = Bench::new(PERSP, frustum_grid([32, 32, 32]), &lights(1000), room);
    bench.compact(&random_bits(32 * 32 * 32, 1, 3));
    let growth = tenfold(&mut bench).unwrap();
    assert_eq!(growth.fault(), None, "{growth}");
}
