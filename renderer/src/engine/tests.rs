//! The list-building passes on the device against their CPU twins, and the stage times against known work.

use super::*;
use crate::cpu;
use crate::geometry::views::{Pose, View, ViewSet};
use crate::geometry::{ClusterSpace, Frustum, Grid};
use crate::lights::rain::{Rain, RainParameters};
use crate::lights::{Lighting, PointLight};
use crate::measure::Capacities;
use crate::methods::grid::light_lists;
use crate::methods::{Sharing, Space};
use crate::pass::BufferCopy;
use crate::passes::{Eyes, VisibleClusters, assign, depth, lights as light_upload, readback, scan};
use crate::scene::Scene;
use crate::scene::procedural::by_name;
use glam::{DQuat, DVec3};

const PERSP: Method = Method::grid(Sharing::Indi, Space::Persp { pixels: 64.0 });
const ORTHO: Method = Method::grid(Sharing::Indi, Space::Ortho { metres: 4.0 });
const RESOLUTION: [u32; 2] = [64, 32];

/// The visible clusters that a test put on the device.
fn given() -> VisibleClusters {
    VisibleClusters::given(0)
}

fn config() -> Config {
    Config { resolution: RESOLUTION, validate: true, ..Config::default() }
}

fn street() -> Scene {
    by_name("street").expect("a built-in scene")
}

fn view() -> View {
    let pose =
        Pose { position: DVec3::new(1.0, 2.0, 3.0), rotation: DQuat::from_rotation_y(0.7), mirror: None };
    View { pose, frustum: Frustum::from_fov(1.3, RESOLUTION, 0.4, 100.0).unwrap() }
}

fn box_grid(dimensions: [u32; 3]) -> Grid {
    let max = DVec3::from_array(dimensions.map(f64::from));
    Grid { pose: view().pose, space: ClusterSpace::Orthographic { min: -max, max }, dimensions }
}

fn frustum_grid(dimensions: [u32; 3]) -> Grid {
    let frustum = Frustum { x0: -1.2, x1: 1.0, y0: -0.7, y1: 0.9, z0: -100.0, z1: -0.4 };
    let ratio = (100.0f64 / 0.4).powf(1.0 / f64::from(dimensions[2])) - 1.0;
    Grid { pose: view().pose, space: ClusterSpace::Perspective { frustum, ratio }, dimensions }
}

fn lights(count: u32) -> Vec<PointLight> {
    let lighting = Lighting { count, intensity: 20.0, cutoff: 0.5, r0: 0.1 };
    Rain::new(&RainParameters::default(), &lighting, 1.0 / 90.0, 30).unwrap().lights().to_vec()
}

/// A frame of one view that looks from where `grid` does.
fn frame_of(grid: Grid) -> FramePlan {
    FramePlan { frame: 0, views: vec![View { pose: grid.pose, ..view() }], grids: vec![grid] }
}

/// A device with one planned frame whose grid is `grid`, ready for single passes.
struct Bench {
    engine: Engine,
    session: Session,
    words: u64,
    revision: u64,
}

impl Bench {
    fn new(method: Method, grid: Grid, lights: &[PointLight], capacities: Capacities) -> Self {
        Self::with_config(&config(), method, grid, lights, capacities)
    }

    fn with_config(
        config: &Config,
        method: Method,
        grid: Grid,
        lights: &[PointLight],
        capacities: Capacities,
    ) -> Self {
        Self::with_scene(config, &street(), (method, grid), lights, capacities)
    }

    fn with_scene(
        config: &Config,
        scene: &Scene,
        (method, grid): (Method, Grid),
        lights: &[PointLight],
        capacities: Capacities,
    ) -> Self {
        let mut session = Session::new(config, scene, ViewSet { count: 1, mirrors: false }).unwrap();
        let words = grid.cluster_count().div_ceil(32);
        let plan = frame_of(grid);
        let plans = std::slice::from_ref(&plan);
        let assigner = config.assign[0].fixed().expect("tests name what they test");
        let run = Config { methods: vec![method], ..config.clone() };
        let mode = Mode { lights: lights.len() as u32, capacities, assigner, counting: true };
        let engine = Engine::new(&mut session, &run, LargestGrid::of(plans), mode).unwrap();
        let mut this = Self { engine, session, words, revision: 0 };
        this.write(&plan, lights);
        this
    }

    /// Writes what a frame is made from, with other lights than before.
    fn write(&mut self, plan: &FramePlan, list: &[PointLight]) {
        self.revision += 1;
        let lights = FrameLights { list, revision: self.revision };
        self.engine.write_host_data(&mut self.session, 0, plan, lights).unwrap();
    }

    fn run(&mut self, commands: impl FnOnce(&mut Recorder, &Frame)) {
        self.engine.follow_up(&mut self.session, 0, commands).unwrap();
        self.session.context.check_validation().unwrap();
    }

    /// Fills one of the clustering's buffers from the host.
    fn upload(&mut self, name: BufferName, data: &[u32]) {
        let usage = vk::BufferUsageFlags::TRANSFER_SRC;
        let source =
            Buffer::new(&self.session.context, "test data", 4 * data.len() as u64, usage, Memory::Upload)
                .unwrap();
        source.write(0, data);
        self.run(|r, frame| {
            let to = &frame.clusterings[0].buffers[name];
            r.copy(&BufferCopy { from: &source, to, offset: 0, size: 4 * data.len() as u64 });
        });
    }

    fn download(&mut self, name: BufferName, words: usize) -> Vec<u32> {
        let usage = vk::BufferUsageFlags::TRANSFER_DST;
        let size = 4 * words as u64;
        let target =
            Buffer::new(&self.session.context, "test result", size, usage, Memory::Readback).unwrap();
        self.run(|r, frame| {
            let from = &frame.clusterings[0].buffers[name];
            r.copy(&BufferCopy { from, to: &target, offset: 0, size });
        });
        target.read(0, words)
    }

    /// Marks clusters, compacts them, and gives the device's state.
    fn compact(&mut self, bits: &[u32]) -> ClusteringState {
        assert_eq!(bits.len() as u64, self.words);
        self.upload(BufferName::ClusterBits, bits);
        self.run(|r, frame| {
            scan::compact(r, frame, 0);
            readback::states(r, frame);
        });
        self.engine.states(&self.session, 0)[0]
    }
}

/// Light lists: their offsets, then their lights.
#[derive(PartialEq, Eq)]
struct Lists {
    offsets: Vec<u32>,
    indices: Vec<u32>,
}

impl Lists {
    /// The lights of one list.
    fn of(&self, list: usize) -> &[u32] {
        &self.indices[self.offsets[list] as usize..self.offsets[list + 1] as usize]
    }
}

impl Bench {
    /// The lists of what [`Self::compact`] made visible.
    fn lists(&mut self) -> Lists {
        self.run(|r, frame| {
            let lights = light_upload::record(r, frame);
            light_lists(r, frame, lights, given());
            readback::states(r, frame);
        });
        let state = self.engine.states(&self.session, 0)[0];
        Lists {
            offsets: self.download(BufferName::ListOffsets, state.visible as usize + 1),
            indices: self.download(BufferName::LightIndices, state.index_total.max(1) as usize),
        }
    }
}

mod assign_equality;
mod cull;
mod list_twins;
mod sphere_tests;
mod targets;

/// A small deterministic generator; quality does not matter here.
fn noise(seed: u64) -> impl FnMut() -> u32 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u32
    }
}

/// Bits with about one in `sparsity` set, none beyond `clusters`.
fn random_bits(clusters: u64, sparsity: u32, seed: u64) -> Vec<u32> {
    let mut random = noise(seed);
    let mut bits = vec![0; clusters.div_ceil(32) as usize];
    for cluster in 0..clusters {
        if random().is_multiple_of(sparsity) {
            bits[(cluster / 32) as usize] |= 1 << (cluster % 32);
        }
    }
    bits
}

fn fragments_of(bits: &[u32], clusters: u64) -> Vec<u32> {
    (0..clusters).map(|c| bits[(c / 32) as usize] >> (c % 32) & 1).collect()
}

#[test]
fn compaction_equals_its_twin_at_odd_sizes() {
    for (case, clusters) in
        [1u64, 31, 32, 33, 1023, 8191, 8193, 32 * 1024, 32 * 1024 + 1, 32 * 1024 * 257 + 5]
            .into_iter()
            .enumerate()
    {
        // More cannot be dispatched everywhere; a third is visible.
        let room = Capacities { visible_clusters: clusters.min(4_000_000) as u32, light_indices: 16 };
        let mut bench = Bench::new(ORTHO, box_grid([clusters as u32, 1, 1]), &lights(10), room);
        let bits = random_bits(clusters, 3, case as u64 + 1);
        let twin = cpu::compact(&fragments_of(&bits, clusters));
        let state = bench.compact(&bits);
        assert_eq!(state.visible_total as usize, twin.visible.len(), "{clusters} clusters");
        let visible = bench.download(BufferName::VisibleClusters, state.visible as usize);
        assert_eq!(visible, twin.visible, "{clusters} clusters");
        let ranks = bench.download(BufferName::WordRanks, bits.len());
        let counts: Vec<u32> = bits.iter().map(|word| word.count_ones()).collect();
        assert_eq!(ranks, cpu::scan(&counts)[..bits.len()], "{clusters} clusters");
    }
}

#[test]
fn visible_clusters_beyond_the_capacity_are_counted() {
    let room = Capacities { visible_clusters: 100, light_indices: 16 };
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
        let room = Capacities { visible_clusters: clusters, light_indices: 16 };
        let mut bench = Bench::new(ORTHO, box_grid([clusters, 1, 1]), &lights(1000), room);
        let state = bench.compact(&random_bits(u64::from(clusters), 1, 1));
        let mut random = noise(u64::from(clusters));
        let counts: Vec<u32> = (0..state.visible).map(|_| random() % 100).collect();
        bench.upload(BufferName::ListLengths, &counts);
        bench.run(|r, frame| {
            scan::light_offsets(r, frame, given());
            readback::states(r, frame);
        });
        let twin = cpu::scan(&counts);
        assert_eq!(bench.download(BufferName::ListOffsets, twin.len()), twin, "{clusters} clusters");
        assert_eq!(Some(&bench.engine.states(&bench.session, 0)[0].index_total), twin.last());
    }
}

#[test]
fn totals_beyond_32_bits_saturate_and_offsets_never_descend() {
    // Few blocks, and more than one workgroup takes.
    for clusters in [2000u32, 20_000] {
        let room = Capacities { visible_clusters: clusters, light_indices: 16 };
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

/// Two stages of known work, one of compute and one of rasterisation, each repeated as often as said; milliseconds.
fn staged_times(bench: &mut Bench, compute: u32, raster: u32) -> [f64; 2] {
    let mut best = [f64::INFINITY; 2];
    for _ in 0..4 {
        bench.run(|r, frame| {
            r.scope("frame", |r| {
                crate::passes::cull::record(r, frame);
                r.scope("compute", |r| {
                    for _ in 0..compute {
                        assign::count_lights(r, frame, given());
                    }
                });
                r.scope("raster", |r| {
                    for _ in 0..raster {
                        depth::record(r, frame, Eyes::One(0));
                    }
                });
            });
        });
        let paths: Vec<String> = bench.engine.tree.paths().map(str::to_owned).collect();
        let times: Vec<f64> =
            bench.session.frame_slots[0].timestamps.read().unwrap().map(|(gpu_ms, _)| gpu_ms).collect();
        for (stage, best) in ["frame/compute", "frame/raster"].iter().zip(&mut best) {
            let position = paths.iter().position(|path| path == stage).unwrap();
            *best = best.min(times[position]);
        }
    }
    best
}

/// Not a test of speed: whether a stage's time holds that stage's work and no other's.
#[test]
fn a_stage_ten_times_as_heavy_grows_alone() {
    let room = Capacities { visible_clusters: 40_000, light_indices: 16 };
    let lights = lights(1000);
    let mut bench = Bench::new(PERSP, frustum_grid([32, 32, 32]), &lights, room);
    bench.compact(&random_bits(32 * 32 * 32, 1, 3));
    let [compute, raster] = staged_times(&mut bench, 1, 1);
    let [heavy_compute, light_raster] = staged_times(&mut bench, 10, 1);
    let [light_compute, heavy_raster] = staged_times(&mut bench, 1, 10);
    assert!(heavy_compute > 4.0 * compute, "compute {compute} ms grew to {heavy_compute} ms only");
    assert!(heavy_raster > 4.0 * raster, "raster {raster} ms grew to {heavy_raster} ms only");
    assert!(light_raster < 3.0 * raster, "raster {raster} ms took {light_raster} ms beside heavy compute");
    assert!(
        light_compute < 3.0 * compute,
        "compute {compute} ms took {light_compute} ms beside heavy raster"
    );
}
