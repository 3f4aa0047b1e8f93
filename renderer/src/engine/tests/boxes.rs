//! The boxes around cells on the device: equal to their twin, and lists by them are those of their twin by all ways.

use super::bounds::{method, random_bounds, with_clusters, words_of};
use super::*;
use crate::assign::Bounds;
use crate::config::{Assign, Test};
use crate::geometry::{ClusterSpace, SliceLaw, SphereTest};
use crate::gpu_interface::ClusterBox;
use crate::passes::build_boxes;
use crate::selftest::cases::sliced;

/// What f32 may make of corners, in parts of the grid's reach: far less than what radii grow by.
const CLOSE: f64 = 4e-7;

pub fn by_law(law: SliceLaw) -> Config {
    Config { slices: vec![law.into()], ..config() }
}

/// The boxes that the device makes of a grid.
fn boxes(config: &Config, grid: Grid) -> Vec<ClusterBox> {
    let room = Capacities { visible_clusters: 16, light_indices: 16, ..Capacities::default() };
    let mut bench = Bench::with_config(config, ORTIZ, grid, &lights(10), room);
    bench.run(|r, frame| build_boxes::record(r, frame, given()));
    let words = size_of::<ClusterBox>() / 4 * grid.cluster_count() as usize;
    bytemuck::cast_slice(&bench.download(BufferName::ClusterBoxes, words)).to_vec()
}

#[test]
fn boxes_equal_their_twin() {
    for law in SliceLaw::EXAMPLES {
        let grid = sliced(law);
        let (device, twin) = (boxes(&by_law(law), grid), cpu::build_boxes(&grid));
        assert_eq!(device.len(), twin.len());
        for (cluster, (device, [low, high])) in device.iter().zip(&twin).enumerate() {
            for (own, of_twin) in [(device.low, low), (device.high, high)] {
                let off = (glam::Vec3::from(own).as_dvec3() - *of_twin).abs().max_element();
                assert!(off < CLOSE * 100.0, "{law} {cluster}: {own:?} is not {of_twin}");
            }
        }
    }
}

/// A pose, and nothing else of a grid, is another: the boxes are those that are there.
#[test]
fn boxes_stay_where_the_camera_moves_and_follow_what_it_sees() {
    let room = Capacities { visible_clusters: 60, light_indices: 600, ..Capacities::default() };
    let grid = frustum_grid([5, 4, 3]);
    let mut bench = Bench::with_config(&config(), ORTIZ, grid, &lights(10), room);
    let moved = Grid { pose: crate::geometry::views::Pose::IDENTITY, ..grid };
    let ClusterSpace::Perspective { mut frustum, slices } = grid.space else { panic!("a frustum") };
    frustum.x1 += 0.125;
    let wider = Grid { space: ClusterSpace::Perspective { frustum, slices }, ..grid };
    for (grid, builds) in [(grid, true), (moved, false), (wider, true), (moved, true), (moved, false)] {
        let lights = lights(10);
        let all = FrameLights { list: &lights, revision: 1 };
        let Bench(Workbench { engine, session, .. }) = &mut bench;
        engine.render(session, 0, (&frame_of(grid), all), (&mut nothing, &mut nothing)).unwrap();
        let stages = bench.stage_times().unwrap();
        let built = stages.iter().filter(|(path, _)| path == "frame/cluster[0]/build_boxes").count();
        assert_eq!(built, usize::from(builds));
        let words = bench.download(BufferName::ClusterBoxes, size_of::<ClusterBox>() / 4);
        let there: &[ClusterBox] = bytemuck::cast_slice(&words);
        let [low, _] = cpu::build_boxes(&grid)[0];
        assert!((f64::from(there[0].low[0]) - low.x).abs() < 1e-4);
    }
}

#[test]
fn no_touching_light_is_lost_by_boxes() {
    let grid = frustum_grid([7, 6, 13]);
    for farthest in [30.0, 20_000.0] {
        let clusters: Vec<u32> = (0..grid.cluster_count() as u32).collect();
        let (touched, lights): (Vec<u32>, Vec<Light>) =
            touching_lights(&grid, &clusters, farthest, 4000).unwrap().into_iter().unzip();
        let room = Capacities { visible_clusters: 600, light_indices: 3_000_000, ..Capacities::default() };
        let mut bench = Bench::new(ORTIZ, grid, &lights, room);
        bench.compact(&random_bits(grid.cluster_count(), 1, 5));
        let lists = bench.lists();
        for (light, &cluster) in (0u32..).zip(&touched) {
            let list = lists.of(cluster as usize);
            assert!(list.binary_search(&light).is_ok(), "cluster {cluster} lost light {light}");
        }
    }
}

#[test]
fn lists_by_boxes_are_those_of_their_twin_by_all_ways() {
    let lights = random_lights(3001, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u));
    for law in [SliceLaw::Geometric, SliceLaw::SecondPlane { metres: 5.0 }, SliceLaw::UniformNdc] {
        let grid = sliced(law);
        let mut all = vec![];
        for (assign, room) in [
            (Assign::Brute, Room::Plenty),
            (Assign::Hierarchy, Room::Plenty),
            (Assign::Scatter, Room::Plenty),
            (Assign::Hierarchy, Room::None),
            (Assign::Scatter, Room::None),
        ] {
            let config = Config { assign: vec![assign], ..by_law(law) };
            let (mut bench, clusters) = with_clusters(&config, (ORTIZ, grid), &lights);
            bench.leave(room);
            all.push((bench.lists(), clusters));
        }
        let (brute, clusters) = &all[0];
        for (place, (lists, _)) in all.iter().enumerate() {
            assert!(lists == brute, "{law}: way {place} has other lists");
        }
        let twin = cpu::assign(&grid, clusters, &lights, SphereTest::Box, 1e-3);
        assert_eq!(list_checks::twin_fault(brute, &twin), None, "{law}");
        let exact = Config { test: vec![Test::from(SphereTest::Exact)], ..by_law(law) };
        let least = with_clusters(&exact, (ORTIZ, grid), &lights).0.lists();
        assert!(least.indices.len() > 1000 && least.indices.len() < brute.indices.len(), "{law}");
    }
}

/// What is measured of clusters is tested as the box around it.
#[test]
fn lists_by_boxes_around_measured_bounds_are_those_of_their_twin_by_all_ways() {
    let lights = random_lights(3001, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u));
    let grid = sliced(SliceLaw::Geometric);
    let mut all = vec![];
    for assign in [Assign::Brute, Assign::Hierarchy, Assign::Scatter] {
        let config = Config { assign: vec![assign], bounds: vec![Bounds::Measured.into()], ..config() };
        let (mut bench, clusters) = with_clusters(&config, (ORTIZ, grid), &lights);
        let bounds = random_bounds(&grid, &clusters);
        let words: Vec<u32> = bounds.iter().flat_map(|bounds| words_of(bounds, false)).collect();
        bench.upload(BufferName::ClusterBounds, &words);
        all.push((bench.lists(), clusters, bounds));
    }
    let (brute, clusters, bounds) = &all[0];
    assert!(all.iter().all(|(lists, ..)| lists == brute));
    let test = Test::Auto.of(&method("ortiz-16-9-24"));
    let twin = cpu::assign_measured(&grid, (clusters, bounds), &lights, test, 1e-3);
    assert_eq!(list_checks::twin_fault(brute, &twin), None);
    assert!(brute.indices.len() > 1000);
}
