//! Each step of hierarchy and scatter against its twin, which takes what the step before left on the device.

use super::*;
use crate::assign::tree_depth;
use crate::config::{Assign, Test};
use crate::cpu::{Candidate, CellRange, CulledLights, FoundLists, Visible};
use crate::geometry::{LightVolume, SphereTest, VolumeKind};
use crate::gpu_interface::{self as device, BLOCK_WORDS, COUNTER_COUNT, GridData, TREE_WIDTH};
use crate::measure::DeviceCounts;
use crate::passes::{build_boxes, cull_lights, hierarchy};
use crate::selftest::sorted_items;
use std::mem::offset_of;

/// How small a margin is too close to call, metres and cells: f32 is good for a tenth of it here.
const EPSILON: f64 = 2e-3;

/// A device that has culled lights, with what they were culled for.
struct CulledDevice {
    bench: Bench,
    grid: Grid,
    visible: Vec<u32>,
    test: SphereTest,
    lights: u32,
    /// Volumes of all lights.
    volumes: Vec<LightVolume>,
}

impl CulledDevice {
    fn new(assign: Assign, (method, grid): (Method, Grid), test: &str, lights: &[Light]) -> Self {
        let clusters = grid.cluster_count();
        let bits = random_bits(clusters, 7, 11);
        let visible = cpu::compact(&fragments_of(&bits, clusters)).visible;
        let room = Capacities {
            visible_clusters: clusters as u32,
            light_indices: 6_000_000,
            ..Capacities::default()
        };
        let test: Test = test.parse().unwrap();
        let config = Config { assign: vec![assign], test: vec![test], ..config() };
        let mut bench = Bench::with_config(&config, method, grid, lights, room);
        bench.compact(&bits);
        bench.run(|r, frame| {
            let lights = light_upload::record(r, frame);
            build_boxes::record(r, frame, given());
            assign::transform_lights(r, frame, lights, given());
        });
        let volumes = bench.volumes(BufferName::LightVolumes, lights.len());
        bench.run(|r, frame| {
            let lights = light_upload::record(r, frame);
            cull_lights::cull_lights(r, frame, lights, given());
        });
        Self { bench, grid, visible, test: test.of(&method).sphere, lights: lights.len() as u32, volumes }
    }

    fn visible(&self) -> Visible<'_> {
        Visible { grid: &self.grid, clusters: &self.visible }
    }

    fn state(&mut self) -> ClusteringState {
        self.bench.state().unwrap()
    }

    /// What the device has as candidates, and as their volumes.
    fn candidates(&mut self) -> (Vec<Candidate>, Vec<LightVolume>) {
        let count = self.state().candidates as usize;
        let words = self.bench.download(BufferName::Candidates, 4 * count.max(1));
        let unpacked = words
            .chunks_exact(4)
            .take(count)
            .map(|w| Candidate { light: w[0], cells: unpack([w[1], w[2], w[3]]) });
        let unpacked = unpacked.collect();
        (unpacked, self.bench.volumes(BufferName::LightVolumes, count))
    }

    /// Counts lights, and gives how many tests that took.
    fn count(&mut self) -> u64 {
        self.bench.upload(BufferName::Counters, &[0; 2 * COUNTER_COUNT]);
        self.bench.run(|r, frame| assign::count_lights(r, frame, given()));
        let words = self.bench.download(BufferName::Counters, 2 * COUNTER_COUNT);
        DeviceCounts::from_words(&words).intersection_tests
    }

    /// Finishes the lists, and gives them.
    fn finish(&mut self) -> Lists {
        self.bench.run(|r, frame| {
            scan::light_offsets(r, frame, given());
            assign::assign_lights(r, frame, given());
        });
        let state = self.state();
        Lists {
            offsets: self.bench.download(BufferName::ListOffsets, state.visible as usize + 1),
            indices: self.bench.download(BufferName::LightIndices, state.index_total.max(1) as usize),
        }
    }
}

impl Bench {
    pub fn volumes(&mut self, name: BufferName, count: usize) -> Vec<LightVolume> {
        let words = self.download(name, count.max(1) * size_of::<device::LightVolume>() / 4);
        bytemuck::cast_slice(&words)[..count].iter().map(volume).collect()
    }
}

/// A volume as the device has it.
fn volume(device: &device::LightVolume) -> LightVolume {
    assert_eq!(VolumeKind::ALL[device.kind as usize], VolumeKind::Sphere);
    LightVolume::sphere(glam::Vec3::from(device.centre).as_dvec3(), device.radius.into())
}

fn unpack(words: [u32; 3]) -> CellRange {
    CellRange { low: words.map(|word| word & 0xFFFF), high: words.map(|word| word >> 16) }
}

/// Grids of both spaces and lights of many sizes.
fn cases() -> Vec<((Method, Grid), &'static str, Vec<Light>)> {
    let mixed = || random_lights(3001, 4, 40.0, |u| 0.02 * 10_000f32.powf(u * u));
    let persp = (PERSP, frustum_grid([13, 9, 21]));
    let ortho = (ORTHO, box_grid([17, 13, 11]));
    vec![
        (persp, "hs", mixed()),
        (persp, "exact", lights(1000)),
        ((ORTIZ, persp.1), "box", mixed()),
        (persp, "sat-n", lights(300)),
        (ortho, "box", mixed()),
        (ortho, "hs", random_lights(9, 2, 20.0, |_| 8.0)),
        (ortho, "box", random_lights(20_001, 6, 60.0, |u| 0.1 + 3.0 * u)),
        ((PERSP, frustum_grid([40, 33, 70])), "hs", lights(4097)),
    ]
}

#[test]
fn culled_lights_equal_their_twin() {
    for (case, (method, test, lights)) in cases().into_iter().enumerate() {
        let mut culled = CulledDevice::new(Assign::Scatter, method, test, &lights);
        let blocks = cpu::mark_blocks(&culled.grid, &culled.visible);
        let words = culled.bench.download(BufferName::BlockBits, BLOCK_WORDS as usize);
        assert!(words == blocks.words(), "case {case}: other blocks");
        let (device, volumes) = culled.candidates();
        let twin = cpu::cull_lights(&culled.visible(), &culled.volumes, culled.test, EPSILON);
        let CulledLights { candidates, borderline } = twin;
        let sure = |list: &[Candidate]| -> Vec<Candidate> {
            list.iter().filter(|c| borderline.binary_search(&c.light).is_err()).copied().collect()
        };
        assert_eq!(sure(&device), sure(&candidates), "case {case}");
        for (candidate, volume) in device.iter().zip(&volumes) {
            assert_eq!(volume, &culled.volumes[candidate.light as usize], "case {case}");
        }
        assert!(device.is_sorted_by_key(|candidate| candidate.light));
        assert!(borderline.len() * 10 < lights.len().max(60), "case {case}: {} too close", borderline.len());
        assert!(!device.is_empty(), "case {case} keeps nothing");
    }
}

#[test]
fn the_hierarchy_equals_its_twin() {
    for (case, (method, test, lights)) in cases().into_iter().enumerate() {
        let mut culled = CulledDevice::new(Assign::Hierarchy, method, test, &lights);
        let (candidates, volumes) = culled.candidates();
        culled.bench.run(|r, frame| hierarchy::build_hierarchy(r, frame, given()));
        let order = sorted_as_their_twin(&mut culled, &volumes);
        let sorted: Vec<LightVolume> = order.iter().map(|&number| volumes[number as usize]).collect();
        assert!(culled.bench.volumes(BufferName::TreeVolumes, sorted.len()) == sorted, "case {case}");
        assert_eq!(culled.bench.download(BufferName::TreeLights, order.len()), order, "case {case}");
        let tree = cpu::build_nodes(sorted, culled.lights);
        nodes_equal(&mut culled, &tree);
        let descent = cpu::descend(&culled.visible(), &tree, culled.test, EPSILON);
        let tests = culled.count();
        assert!(tests.abs_diff(descent.tests) <= descent.borderline_tests, "case {case}: {tests} tests");
        assert!(descent.borderline_tests * 20 < descent.tests, "case {case}");
        let light_at = |place: u32| candidates[order[place as usize] as usize].light;
        lists_equal(&culled.finish(), &descent.lists, light_at);
    }
}

/// Checks keys and order, and gives the order: numbers of candidates.
fn sorted_as_their_twin(culled: &mut CulledDevice, volumes: &[LightVolume]) -> Vec<u32> {
    let twin = cpu::keys(&culled.grid, volumes, culled.lights, 0.02);
    let items = sorted_items(&mut culled.bench, culled.lights, volumes.len() as u32).unwrap();
    let mut keys = vec![u32::MAX; volumes.len()];
    for &(key, number) in &items {
        keys[number as usize] = key;
    }
    for (key, twin) in keys.iter().zip(&twin) {
        assert!(twin.borderline || *key == twin.key, "key {key:b}, not {:b}", twin.key);
    }
    let close = twin.iter().filter(|key| key.borderline).count();
    assert!(close * 5 < volumes.len().max(25), "{close} keys are too close to call");
    let order: Vec<u32> = items.into_iter().map(|(_, number)| number).collect();
    assert_eq!(order, cpu::sorted(&keys));
    order
}

fn nodes_equal(culled: &mut CulledDevice, tree: &cpu::Tree) {
    let depths = tree_depth(culled.lights);
    let first = |depth: u32| (TREE_WIDTH.pow(depth) - 1) / (TREE_WIDTH - 1);
    let last = first(depths - 1) as usize + tree.depths[depths as usize - 2].len();
    let words = culled.bench.download(BufferName::LightNodes, 8 * last);
    for (depth, nodes) in (1..depths).zip(&tree.depths) {
        for (place, node) in nodes.iter().enumerate() {
            let at = 8 * (first(depth) as usize + place);
            let device: Vec<f32> = words[at..at + 7].iter().map(|&word| f32::from_bits(word)).collect();
            let twin = [&node.centre.to_array()[..], &[node.radius], &node.half_extent.to_array()].concat();
            // A multiplication and the addition after it may be rounded once or twice.
            let equal = |(a, b): (&f32, &f32)| (a - b).abs() <= 1e-6 * b.abs();
            assert!(device.iter().zip(&twin).all(equal), "depth {depth}, node {place}: {device:?}, {twin:?}");
        }
    }
}

/// Lists of lights against found numbers, which `light_of` turns into lights.
fn lists_equal(device: &Lists, twin: &FoundLists, light_of: impl Fn(u32) -> u32) {
    let mut borderline = 0;
    for (position, (numbers, close)) in twin.lights.iter().zip(&twin.borderline).enumerate() {
        let close = cpu::sort_lists(close, &light_of);
        let sure = |lights: &[u32]| -> Vec<u32> {
            lights.iter().copied().filter(|light| close.binary_search(light).is_err()).collect()
        };
        assert_eq!(sure(device.of(position)), sure(&cpu::sort_lists(numbers, &light_of)), "list {position}");
        borderline += close.len();
    }
    assert_eq!(device.offsets.len(), twin.lights.len() + 1);
    assert!(borderline * 50 < device.indices.len().max(50), "{borderline} pairs are too close to call");
}

#[test]
fn scattering_equals_its_twin() {
    for (case, (method, test, lights)) in cases().into_iter().enumerate() {
        let mut culled = CulledDevice::new(Assign::Scatter, method, test, &lights);
        let (candidates, volumes) = culled.candidates();
        let tests = culled.count();
        let state = culled.state();
        let groups = cpu::scatter_groups(&culled.visible(), &candidates);
        let words = culled.bench.download(BufferName::Groups, 6 * groups.len());
        let packets: u32 = groups.iter().map(cpu::ClusterGroup::packets).sum();
        let packet_groups = culled.bench.download(BufferName::PacketGroups, packets.max(1) as usize);
        let group_lights = culled.bench.download(BufferName::GroupLights, 64 * packets.max(1) as usize);
        assert_eq!((state.packets, state.listed), (packets, 1), "case {case}");
        for (number, (group, w)) in (0u32..).zip(groups.iter().zip(words.chunks_exact(6))) {
            assert_eq!(unpack([w[0], w[1], w[2]]), group.cells, "case {case}, group {number}");
            let count = group.candidates.len() as u32;
            assert_eq!(w[3..], [count, count, group.first_packet], "case {case}, group {number}");
            let of_group = group.first_packet as usize..(group.first_packet + group.packets()) as usize;
            assert!(packet_groups[of_group].iter().all(|&of| of == number), "case {case}");
            let first = 64 * group.first_packet as usize;
            let listed = &group_lights[first..first + count as usize];
            assert_eq!(cpu::sort_lists(listed, |n| n), group.candidates, "case {case}, group {number}");
        }
        let (lists, twin_tests) = cpu::scatter(&culled.visible(), &groups, &volumes, culled.test, EPSILON);
        assert_eq!(tests, twin_tests, "case {case}");
        lists_equal(&culled.finish(), &lists, |number| candidates[number as usize].light);
    }
}

#[test]
fn lists_are_read_off_their_bits_as_by_their_twin() {
    for assign in [Assign::Hierarchy, Assign::Scatter] {
        let (method, test, lights) = cases().remove(0);
        let mut culled = CulledDevice::new(assign, method, test, &lights);
        let (candidates, _) = culled.candidates();
        if assign == Assign::Hierarchy {
            culled.bench.run(|r, frame| hierarchy::build_hierarchy(r, frame, given()));
        }
        culled.count();
        let state = culled.state();
        assert_eq!((state.masked, state.mask_words), (1, state.candidates.div_ceil(32)));
        let words = (state.visible * state.mask_words) as usize;
        let masks = culled.bench.download(BufferName::LightMasks, words);
        let twin = cpu::read_masks(&masks, state.mask_words as usize);
        let lengths = culled.bench.download(BufferName::ListLengths, twin.len());
        assert_eq!(lengths, twin.iter().map(|list| list.len() as u32).collect::<Vec<_>>());
        let lists = culled.finish();
        assert_eq!(lists.offsets, cpu::scan(&lengths));
        for (position, numbers) in twin.iter().enumerate() {
            let lights: Vec<u32> = numbers.iter().map(|&n| candidates[n as usize].light).collect();
            assert_eq!(lists.of(position), lights);
        }
        assert!(lists.indices.len() > 1000);
    }
}

#[test]
fn lists_in_any_order_are_sorted_as_by_their_twin() {
    let (method, test, lights) = cases().remove(0);
    let mut culled = CulledDevice::new(Assign::Scatter, method, test, &lights);
    culled.bench.engine.clusterings[0].host[0][BufferName::Grid]
        .write(offset_of!(GridData, mask_capacity) as u64, &[0u32]);
    culled.bench.run(|r, frame| {
        let lights = light_upload::record(r, frame);
        cull_lights::cull_lights(r, frame, lights, given());
    });
    let (candidates, _) = culled.candidates();
    culled.count();
    let state = culled.state();
    assert_eq!(state.masked, 0);
    culled.bench.run(|r, frame| {
        scan::light_offsets(r, frame, given());
        assign::write_lists(r, frame, given());
    });
    let total = culled.state().index_total as usize;
    let offsets = culled.bench.download(BufferName::ListOffsets, state.visible as usize + 1);
    let unsorted =
        Lists { indices: culled.bench.download(BufferName::LightIndices, total), offsets: offsets.clone() };
    culled.bench.run(|r, frame| assign::sort_lists(r, frame, given()));
    let sorted = Lists { indices: culled.bench.download(BufferName::LightIndices, total), offsets };
    for list in 0..state.visible as usize {
        let twin = cpu::sort_lists(unsorted.of(list), |number| candidates[number as usize].light);
        assert_eq!(sorted.of(list), twin, "list {list}");
    }
    assert!(total > 1000);
}
