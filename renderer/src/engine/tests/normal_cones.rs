//! Normal cones on the device: lists without the lights behind clusters are those of their twin by all ways, and cones hold the
//! normals of what is seen.

use super::bounds::{measure, measuring, method, random_bounds, with_clusters, with_sides, words_of};
use super::*;
use crate::assign::ListStore;
use crate::config::{Assign, Test};
use crate::cpu::{ClusterCones, DepthImage};
use crate::geometry::{MeasuredBounds, NormalCones};
use crate::gpu_interface::COUNTER_COUNT;
use crate::measure::DeviceCounts;
use crate::scene::{Bounds, Instance, Material, Primitive, Vertex};
use crate::selftest::cases::noise;
use crate::selftest::cases::points_and_spots;
use glam::{DMat4, Vec3};

/// Some cones of each cluster: of most few, of some none or all.
fn random_cones(cones: NormalCones, clusters: usize) -> Vec<u64> {
    let mut random = noise(77);
    let all = u64::MAX >> (u64::BITS - cones.count());
    let mut of_cluster = |cluster: usize| match cluster % 8 {
        0 => 0,
        1 => all,
        few => (0..few - 1).fold(0, |set, _| set | 1 << (random() % cones.count())),
    };
    (0..clusters).map(&mut of_cluster).collect()
}

fn words(cones: NormalCones, sets: &[u64]) -> Vec<u32> {
    let words = [0, 1].map(|word| move |set: &u64| (set >> (32 * word)) as u32);
    sets.iter()
        .flat_map(|set| words[..cones.words() as usize].iter().map(|word| word(set)).collect::<Vec<_>>())
        .collect()
}

#[test]
fn lists_without_lights_behind_are_those_of_their_twin_by_all_ways() {
    let cases = [
        (method("sc-e-48-40"), frustum_grid([13, 9, 21]), "hs", "3"),
        (method("clustered-mm-32"), frustum_grid([13, 9, 21]), "mm", "2"),
        (method("t-e-28"), frustum_grid([19, 13, 1]), "exact", "1"),
        (ORTHO, box_grid([17, 13, 11]), "exact", "3"),
    ];
    for (method, grid, test, divided) in cases {
        let lights = match divided {
            "2" => points_and_spots(1501),
            _ => random_lights(1501, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u)),
        };
        let (test, divided): (Test, NormalCones) = (test.parse().unwrap(), divided.parse().unwrap());
        let config = Config { test: vec![test], normal_cones: vec![divided], ..measuring() };
        let depth_alone = method == bounds::method("t-e-28");
        let mut all = vec![];
        for (assign, room, lists) in [
            (Assign::Brute, Room::Plenty, ListStore::Offsets),
            (Assign::Hierarchy, Room::Plenty, ListStore::Offsets),
            (Assign::Scatter, Room::Plenty, ListStore::Offsets),
            (Assign::Rectangles, Room::Plenty, ListStore::Offsets),
            (Assign::Brute, Room::Plenty, ListStore::Fixed(1501)),
            (Assign::Scatter, Room::None, ListStore::Offsets),
        ] {
            if assign == Assign::Rectangles && test.to_string() != "mm" {
                continue;
            }
            let config = Config { assign: vec![assign], lists: vec![lists], ..config.clone() };
            let (mut bench, clusters) = with_clusters(&config, (method, grid), &lights);
            let bounds = random_bounds(&grid, &clusters);
            let sets = random_cones(divided, clusters.len());
            let measured: Vec<u32> = bounds.iter().flat_map(|bounds| words_of(bounds, depth_alone)).collect();
            bench.upload(BufferName::ClusterBounds, &measured);
            bench.upload(BufferName::ClusterCones, &words(divided, &sets));
            bench.upload(BufferName::Counters, &[0; 2 * COUNTER_COUNT]);
            bench.leave(room);
            let lists = bench.lists();
            let counts = DeviceCounts::from_words(&bench.download(BufferName::Counters, 2 * COUNTER_COUNT));
            all.push((lists, counts.lights_skipped, clusters, bounds, sets));
        }
        let (brute, skipped, clusters, bounds, sets) = &all[0];
        for (place, (lists, others, ..)) in all.iter().enumerate() {
            assert!(lists == brute, "{method}: way {place} has other lists");
            assert_eq!(others, skipped, "{method}: way {place} skips others");
        }
        let bounds: Vec<MeasuredBounds> = match depth_alone {
            true => with_sides(&grid, clusters, bounds),
            false => bounds.clone(),
        };
        let (visible, test) = ((&clusters[..], &bounds[..]), test.of(&method));
        let twin = cpu::assign_facing(&grid, (visible.0, visible.1, sets), &lights, (test, divided), 1e-3);
        assert_eq!(list_checks::twin_fault(brute, &twin), None, "{method}");
        let whole = cpu::assign_measured(&grid, visible, &lights, test, 1e-3);
        let told = whole.indices.len() as i64 - brute.indices.len() as i64;
        let close: usize = whole.borderline.iter().map(Vec::len).sum();
        assert!(told.abs_diff(*skipped as i64) <= close as u64, "{method}: {told} {skipped}");
        assert!(brute.indices.len() > 300 && *skipped > 50, "{method}: {} {skipped}", brute.indices.len());
    }
}

/// Normal of the screen below at a position, in the space of the camera before which it stands; not of unit length.
fn bulge(at: DVec3) -> DVec3 {
    DVec3::new(0.35 * at.x, 0.45 * at.y, 1.0)
}

/// A slanted screen before the camera of `grid`, whose left half shows its front and whose right half its back, turned to the
/// viewer; what is above is unlit.
fn screen(grid: &Grid) -> Scene {
    let mut scene =
        Scene { instances: vec![], primitives: vec![], vertices: vec![], indices: vec![], ..street() };
    let plain = |unlit| Material { double_sided: true, unlit, ..Material::plain("screen") };
    scene.materials = vec![plain(false), plain(true)];
    let rotate = |v: DVec3| grid.pose.rotation * v;
    for (x, y, back, material) in [
        ([-7.0, 0.0], [-5.0, 1.0], false, 0),
        ([0.0, 7.0], [-5.0, 1.0], true, 0),
        ([-7.0, 7.0], [1.0, 5.0], false, 1),
    ] {
        let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
        let vertex_offset = scene.vertices.len() as u32;
        for [x, y] in corners {
            let at = DVec3::new(x, y, -8.0 + 0.2 * x);
            let normal = if back { -bulge(at) } else { bulge(at) };
            scene.vertices.push(Vertex {
                position: grid.pose.transform_point(at).as_vec3().to_array(),
                normal: rotate(normal).as_vec3().to_array(),
                tangent: [1.0, 0.0, 0.0, 1.0],
                uv: [[0.0; 2]; 2],
                color: [255; 4],
            });
        }
        let bounds = Bounds { min: Vec3::splat(-50.0), max: Vec3::splat(50.0) };
        let first_index = scene.indices.len() as u32;
        scene.indices.extend(if back { [0, 2, 1, 0, 3, 2] } else { [0, 1, 2, 0, 2, 3] });
        let primitive = scene.primitives.len() as u32;
        scene.primitives.push(Primitive {
            first_index,
            index_count: 6,
            vertex_offset,
            vertex_count: 4,
            material,
            bounds,
        });
        scene.instances.push(Instance { primitive, world_from_object: DMat4::IDENTITY });
    }
    scene
}

#[test]
fn cones_of_a_bulging_screen_are_those_of_its_normals_on_either_side() {
    let (method, grid) = (method("sc-e-48-40"), frustum_grid([13, 9, 21]));
    let capacities = Capacities { visible_clusters: 2000, light_indices: 100_000, ..Capacities::default() };
    for divided in ["1", "3"] {
        let divided: NormalCones = divided.parse().unwrap();
        let config = Config { normal_cones: vec![divided], ..config() };
        let lights = &lights(20);
        let mut bench = Bench::with_scene(&config, &screen(&grid), Case { method, grid, lights, capacities });
        let view = frame_of(grid).views[0];
        let device = measure(&mut bench, method, &view);
        let kept = bench.download(BufferName::ClusterCones, divided.words() as usize * device.clusters.len());
        let image =
            DepthImage { resolution: RESOLUTION, sample_positions: &[[0.5; 2]], depths: &device.depths };
        let mut twin = ClusterCones::none(&grid);
        let lit = |at: DVec3| at.y < 1.0;
        let mut unlit = 0;
        twin.include((image, &view), &grid, (divided, 1e-3), |at| bulge(at).normalize());
        let mut held = [0; 2];
        for (&cluster, words) in device.clusters.iter().zip(kept.chunks(divided.words() as usize)) {
            let cones = words.iter().rev().fold(0, |cones, &word| cones << 32 | u64::from(word));
            let (least, most) = (twin.least[cluster as usize], twin.most[cluster as usize]);
            let corners = grid.cell_corners(grid.cluster_at(cluster));
            assert_eq!(cones & !most, 0, "{cluster}: {cones:b} {most:b}");
            if corners.iter().all(|&corner| lit(corner)) {
                assert_eq!(least & !cones, 0, "{cluster}: {cones:b} {least:b}");
                held[0] += 1;
                held[1] += usize::from(least.count_ones() > 1);
            } else if !corners.iter().any(|&corner| lit(corner)) {
                assert_eq!(cones, 0, "{cluster}: what is unlit faces no light");
                unlit += 1;
            }
        }
        assert!(held[0] > 20 && held[1] > 3 && unlit > 0, "{divided}: {held:?} {unlit}");
    }
}
