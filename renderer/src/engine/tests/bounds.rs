//! Measured bounds and slice laws on the device: bounds equal their twin, and lists by any of them are those of their twin by
//! all ways.

use super::*;
use crate::assign::{Bounds, Clusters};
use crate::config::{Assign, Test};
use crate::cpu::{ClusterBounds, DepthImage, Marks};
use crate::geometry::views::View;
use crate::geometry::{ClusterSpace, MeasuredBounds, SliceLaw, Slices};
use crate::gpu_interface::PixelData;
use crate::passes::{Depth, cull, mark, pixel_clusters};
use crate::selftest::cases::noise;
use crate::vk::{Buffer, Memory};
use ash::vk;

/// What f32 may make of tangents, of metres, and of depths in parts of them.
const CLOSE: f64 = 2e-5;

pub(super) fn method(name: &str) -> Method {
    name.parse().unwrap()
}

/// A configuration whose method measures.
pub(super) fn measuring() -> Config {
    Config { bounds: vec![Bounds::Measured.into()], ..config() }
}

/// Words that the device keeps of a cluster: depth alone, or all three axes.
pub(super) fn words_of(bounds: &MeasuredBounds, depth_alone: bool) -> Vec<u32> {
    let in_order = |value: f64| {
        let bits = (value as f32).to_bits();
        if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
    };
    let axes = if depth_alone { 2..3 } else { 0..3 };
    if bounds.is_empty() {
        return vec![0; 2 * axes.len()];
    }
    let low = axes.clone().map(|axis| !in_order(bounds.low[axis]));
    low.chain(axes.map(|axis| in_order(bounds.high[axis]))).collect()
}

/// What those words say; across depth, nothing is said to be anything.
fn bounds_of(words: &[u32]) -> MeasuredBounds {
    let value = |word: u32| f64::from(f32::from_bits(if word >> 31 == 1 { word ^ 1 << 31 } else { !word }));
    if words[0] == 0 {
        return MeasuredBounds::EMPTY;
    }
    let (low, high) = words.split_at(words.len() / 2);
    let mut bounds = MeasuredBounds { low: DVec3::splat(-1e3), high: DVec3::splat(1e3) };
    for (word, axis) in (3 - low.len()..3).enumerate() {
        (bounds.low[axis], bounds.high[axis]) = (value(!low[word]), value(high[word]));
    }
    bounds
}

/// What a frame leaves on the device: distances of pixels, clusters with their fragments, bounds of these.
pub(super) struct Measured {
    pub(super) depths: Vec<f32>,
    pub(super) clusters: Vec<u32>,
    fragments: Vec<u32>,
    bounds: Vec<MeasuredBounds>,
}

pub(super) fn measure(bench: &mut Bench, method: Method, view: &View) -> Measured {
    let pixels = RESOLUTION.iter().product::<u32>() as usize;
    let (usage, size) = (vk::BufferUsageFlags::TRANSFER_DST, (pixels * size_of::<PixelData>()) as u64);
    let context = bench.session.context.clone();
    let seen = Buffer::new(&context, "test pixels", size, usage, Memory::Readback).unwrap();
    bench.run(|r, frame| {
        let lights = light_upload::record(r, frame);
        cull::record(r, frame);
        method.record(r, frame, (lights, Depth::NONE));
        mark::count_fragments(r, frame, 0);
        pixel_clusters::record(r, frame, &frame.pipelines.pixel_maps, (0, 0), &seen);
    });
    let visible = bench.state().unwrap().visible as usize;
    let words = if method == self::method("t-e-28") { 2 } else { 6 };
    let kept = bench.download(BufferName::ClusterBounds, words * visible);
    let distances: Vec<PixelData> = seen.read(0, pixels);
    let [near, far] = [view.frustum.near(), view.frustum.far()];
    let depth = |distance: f64| near * (far - distance) / (distance * (far - near));
    let seen = |pixel: &PixelData| match pixel.distance.is_finite() {
        true => depth(pixel.distance.into()) as f32,
        false => 0.0,
    };
    Measured {
        depths: distances.iter().map(seen).collect(),
        clusters: bench.download(BufferName::VisibleClusters, visible),
        fragments: bench.download(BufferName::VisibleFragments, visible),
        bounds: kept.chunks(words).map(bounds_of).collect(),
    }
}

#[test]
fn bounds_equal_their_twin() {
    for (name, grid, config) in [
        ("sc-e-48-40", frustum_grid([13, 9, 21]), config()),
        ("dc-e-48-40", frustum_grid([13, 9, 21]), config()),
        ("t-e-28", frustum_grid([17, 11, 1]), config()),
        ("indi-ortho-4", box_grid([23, 17, 29]), measuring()),
    ] {
        let room = Capacities {
            visible_clusters: grid.cluster_count() as u32,
            light_indices: 100_000,
            ..Capacities::default()
        };
        let method = method(name);
        let mut bench = Bench::with_config(&config, method, grid, &lights(50), room);
        let view = frame_of(grid).views[0];
        let device = measure(&mut bench, method, &view);
        let image =
            DepthImage { resolution: RESOLUTION, sample_positions: &[[0.5; 2]], depths: &device.depths };
        let (mut twin, mut marks) = (ClusterBounds::none(&grid), Marks::none(&grid));
        twin.include(image, &view, &grid, 1e-3);
        cpu::mark(image, &view, &grid, 1e-3, &mut marks);
        let (mut held, mut exact) = (0, 0);
        for ((&cluster, &fragments), bounds) in
            device.clusters.iter().zip(&device.fragments).zip(&device.bounds)
        {
            let cluster = cluster as usize;
            let (least, most) = (&twin.least[cluster], &twin.most[cluster]);
            assert_eq!(bounds.is_empty(), fragments == 0, "{name} {cluster}");
            if !least.is_empty() {
                held += 1;
                assert!(bounds.missing(&grid, least) < CLOSE, "{name} {cluster}: {bounds:?} {least:?}");
            }
            // More fragments than the depth buffer shows are transparent ones.
            if fragments > 0 && marks.fragments[cluster] == fragments {
                exact += 1;
                let depths =
                    MeasuredBounds { low: bounds.low.max(most.low), high: bounds.high.min(most.high) };
                let told = if method == self::method("t-e-28") { &depths } else { bounds };
                assert!(most.missing(&grid, told) < CLOSE, "{name} {cluster}: {bounds:?} {most:?}");
                assert!(bounds.low.z > most.low.z - CLOSE * most.low.z.abs().max(1.0), "{name} {cluster}");
                assert!(bounds.high.z < most.high.z + CLOSE * most.high.z.abs().max(1.0), "{name} {cluster}");
            }
        }
        assert!(held > 20 && exact * 2 > held, "{name}: {held} hold something, {exact} are exact");
    }
}

/// Boxes within clusters, some of one point, some empty, in numbers that the device has.
pub(super) fn random_bounds(grid: &Grid, clusters: &[u32]) -> Vec<MeasuredBounds> {
    let mut random = noise(23);
    let mut unit = move || f64::from(random() % 65_536) / 65_536.0;
    let mut of_cluster = |&cluster: &u32| {
        let cell = DVec3::from_array(grid.cluster_at(cluster).map(f64::from));
        let mut bounds = MeasuredBounds::EMPTY;
        for _ in 0..(4.0 * unit()) as u32 {
            bounds.include(grid, grid.point_at(cell + DVec3::new(unit(), unit(), unit())));
        }
        let on_device = |place: DVec3| place.as_vec3().as_dvec3();
        MeasuredBounds { low: on_device(bounds.low), high: on_device(bounds.high) }
    };
    clusters.iter().map(&mut of_cluster).collect()
}

/// A bench with a seventh of the clusters visible, and these.
pub(super) fn with_clusters(
    config: &Config,
    (method, grid): (Method, Grid),
    lights: &[Light],
) -> (Bench, Vec<u32>) {
    let room = Capacities {
        visible_clusters: grid.cluster_count() as u32,
        light_indices: 6_000_000,
        ..Capacities::default()
    };
    let config = Config { clusters: vec![Clusters::Visible.into()], ..config.clone() };
    let mut bench = Bench::with_config(&config, method, grid, lights, room);
    let bits = random_bits(grid.cluster_count(), 7, 11);
    bench.compact(&bits);
    (bench, cpu::compact(&fragments_of(&bits, grid.cluster_count())).visible)
}

/// Whether every list of `few` is part of that of `many`.
fn within(few: &Lists, many: &Lists) -> bool {
    let count = few.offsets.len() - 1;
    (0..count).all(|list| few.of(list).iter().all(|light| many.of(list).binary_search(light).is_ok()))
}

#[test]
fn lists_of_measured_clusters_are_those_of_their_twin_by_all_ways() {
    let cases = [
        (method("sc-e-48-40"), frustum_grid([13, 9, 21])),
        (method("t-e-28"), frustum_grid([19, 13, 1])),
        (ORTHO, box_grid([17, 13, 11])),
    ];
    let lights = random_lights(3001, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u));
    for (method, grid) in cases {
        for test in ["hs", "sat-n", "sat-epv", "exact"] {
            let test: Test = test.parse().unwrap();
            let config = Config { test: vec![test], ..measuring() };
            let mut all = vec![];
            for (assign, room) in [
                (Assign::Brute, Room::Plenty),
                (Assign::Hierarchy, Room::Plenty),
                (Assign::Scatter, Room::Plenty),
                (Assign::Brute, Room::None),
                (Assign::Hierarchy, Room::None),
                (Assign::Scatter, Room::None),
            ] {
                let config = Config { assign: vec![assign], ..config.clone() };
                let (mut bench, clusters) = with_clusters(&config, (method, grid), &lights);
                let bounds = random_bounds(&grid, &clusters);
                let depth_alone = method == self::method("t-e-28");
                let words: Vec<u32> = bounds.iter().flat_map(|b| words_of(b, depth_alone)).collect();
                bench.upload(BufferName::ClusterBounds, &words);
                bench.leave(room);
                let lists = bench.lists();
                for (list, bounds) in bounds.iter().enumerate() {
                    assert!(!bounds.is_empty() || lists.of(list).is_empty(), "{method} {test} {assign}");
                }
                all.push((lists, clusters, bounds));
            }
            let (brute, clusters, bounds) = &all[0];
            for (place, (lists, ..)) in all.iter().enumerate() {
                assert!(lists == brute, "{method} {test}: way {place} has other lists");
            }
            let bounds: Vec<MeasuredBounds> = match method == self::method("t-e-28") {
                true => with_sides(&grid, clusters, bounds),
                false => bounds.clone(),
            };
            let twin = cpu::assign_measured(&grid, (clusters, &bounds), &lights, test.of(&method), 1e-3);
            assert_eq!(list_checks::twin_fault(brute, &twin), None, "{method} {test}");
            let implicit = Config { bounds: vec![Bounds::Implicit.into()], ..config };
            let (mut bench, _) = with_clusters(&implicit, (method, grid), &lights);
            let cells = bench.lists();
            assert!(test.to_string() != "hs" || within(brute, &cells), "{method}: more than of the cell");
            assert!(
                brute.indices.len() > 1000 && brute.indices.len() < cells.indices.len(),
                "{method} {test}"
            );
        }
    }
}

/// The bounds of tiles between the sides of their cells.
pub(super) fn with_sides(grid: &Grid, clusters: &[u32], bounds: &[MeasuredBounds]) -> Vec<MeasuredBounds> {
    let of_cluster = |(bounds, &cluster): (&MeasuredBounds, &u32)| {
        let mut cell = MeasuredBounds::EMPTY;
        grid.cell_corners(grid.cluster_at(cluster)).into_iter().for_each(|corner| cell.include(grid, corner));
        let sides = |own: DVec3, of_cell: DVec3| of_cell.truncate().extend(own.z);
        match bounds.is_empty() {
            true => *bounds,
            false => MeasuredBounds { low: sides(bounds.low, cell.low), high: sides(bounds.high, cell.high) },
        }
    };
    bounds.iter().zip(clusters).map(of_cluster).collect()
}

#[test]
fn lists_of_every_slice_law_are_those_of_their_twin_by_all_ways() {
    let lights = random_lights(3001, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u));
    for law in SliceLaw::EXAMPLES {
        let mut grid = frustum_grid([13, 9, 21]);
        let ClusterSpace::Perspective { frustum, .. } = grid.space else { panic!("a frustum") };
        let slices = Slices::new(law, &frustum, 0.3, 21.0);
        grid.space = ClusterSpace::Perspective { frustum, slices };
        let mut all = vec![];
        for assign in [Assign::Brute, Assign::Hierarchy, Assign::Scatter] {
            let config = Config { assign: vec![assign], slices: vec![law.into()], ..config() };
            let (mut bench, clusters) = with_clusters(&config, (PERSP, grid), &lights);
            all.push((bench.lists(), clusters));
        }
        let (brute, clusters) = &all[0];
        assert!(all.iter().all(|(lists, _)| lists == brute), "{law}");
        let twin = cpu::assign(&grid, clusters, &lights, Test::Auto.of(&PERSP), 1e-3);
        assert_eq!(list_checks::twin_fault(brute, &twin), None, "{law}");
        assert!(brute.indices.len() > 1000, "{law}");
    }
}
