//! The tests of light against cluster on the device: equal to their CPU twins, and no light is ever lost.

use super::*;
use crate::config::Test;
use crate::geometry::SphereTest;

/// Each part of each test, alone and with others.
const TESTS: [&str; 9] =
    ["hs", "sat-e", "sat-n", "sat-p", "sat-v", "hs+sat-n", "sat-epv", "hs+sat-enpv", "exact"];

fn perspective() -> (Method, Grid) {
    (PERSP, frustum_grid([13, 9, 21]))
}

fn orthographic() -> (Method, Grid) {
    (ORTHO, box_grid([23, 17, 29]))
}

/// Tests of the clusters of perspective grids.
fn tests_of(method: Method) -> impl Iterator<Item = SphereTest> {
    let seen = (method == PERSP).then_some("mm");
    TESTS.into_iter().chain(seen).map(|name| name.parse().unwrap())
}

/// A grid with about half of its clusters visible, on the device.
struct Case {
    grid: Grid,
    visible: Vec<u32>,
    lights: Vec<Light>,
    bits: Vec<u32>,
}

impl Case {
    fn new(grid: Grid, lights: Vec<Light>) -> Self {
        let clusters = grid.cluster_count();
        let bits = random_bits(clusters, 2, 5);
        let visible = cpu::compact(&fragments_of(&bits, clusters)).visible;
        Self { grid, visible, lights, bits }
    }

    /// The list of each visible cluster, by brute force.
    fn lists(&self, method: Method, test: SphereTest) -> Lists {
        let room = Capacities {
            visible_clusters: self.grid.cluster_count() as u32,
            light_indices: 8_000_000,
            ..Capacities::default()
        };
        let config = Config { test: vec![Test::from(test)], ..config() };
        let mut bench = Bench::with_config(&config, method, self.grid, &self.lights, room);
        bench.compact(&self.bits);
        let lists = bench.lists();
        assert!(lists.indices.len() > 1000, "the case assigns next to nothing");
        lists
    }
}

/// Lists of the device equal the twin's, but for pairs that the twin itself marks as too close to call.
fn lists_equal_their_twin((method, grid): (Method, Grid), test: SphereTest, lights: Vec<Light>) {
    let case = Case::new(grid, lights);
    let lists = case.lists(method, test);
    let twin = cpu::assign(&grid, &case.visible, &case.lights, test, 1e-4);
    assert_eq!(list_checks::twin_fault(&lists, &twin), None, "{test}");
    let borderline: usize = twin.borderline.iter().map(Vec::len).sum();
    // Where the near plane cuts a sphere, 0.4 m ahead, clusters are centimetres wide.
    let rare = if test == SphereTest::Projected { 10 } else { 200 };
    assert!(borderline * rare < twin.indices.len(), "{test}: {borderline} pairs are too close to call");
}

#[test]
fn perspective_lists_equal_their_twin() {
    for count in [500, 1000, 5001] {
        lists_equal_their_twin(perspective(), SphereTest::HALF_SPACES, lights(count));
    }
}

#[test]
fn orthographic_lists_equal_their_twin() {
    lists_equal_their_twin(orthographic(), SphereTest::Box, lights(4097));
}

#[test]
fn lists_of_all_tests_equal_their_twins() {
    for (method, grid) in [(PERSP, frustum_grid([7, 6, 13])), (ORTHO, box_grid([11, 9, 13]))] {
        for test in tests_of(method) {
            lists_equal_their_twin((method, grid), test, random_lights(1000, 9, 15.0, |u| 1.0 + 4.0 * u));
        }
    }
}

fn no_touching_light_is_lost(method: Method, grid: Grid, farthest: f64) {
    let visible = Case::new(grid, vec![]).visible;
    let (touched, lights): (Vec<u32>, Vec<Light>) =
        touching_lights(&grid, &visible, farthest, 4000).unwrap().into_iter().unzip();
    let case = Case::new(grid, lights);
    for test in tests_of(method) {
        let lists = case.lists(method, test);
        for (light, cluster) in (0u32..).zip(&touched) {
            let list = lists.of(visible.binary_search(cluster).unwrap());
            assert!(list.binary_search(&light).is_ok(), "{test}: cluster {cluster} lost light {light}");
        }
    }
}

#[test]
fn no_touching_light_is_lost_in_perspective_grids() {
    no_touching_light_is_lost(PERSP, frustum_grid([7, 6, 13]), 30.0);
    // Few, large clusters: the lengths that are projected are as long as the grid.
    no_touching_light_is_lost(PERSP, frustum_grid([2, 2, 3]), 30.0);
    // Tiles: one slice over the whole depth.
    no_touching_light_is_lost(PERSP, frustum_grid([40, 30, 1]), 30.0);
}

#[test]
fn no_touching_light_is_lost_in_orthographic_grids() {
    no_touching_light_is_lost(ORTHO, box_grid([11, 9, 13]), 30.0);
}

#[test]
fn no_touching_light_is_lost_however_large() {
    no_touching_light_is_lost(PERSP, frustum_grid([7, 6, 13]), 20_000.0);
    no_touching_light_is_lost(ORTHO, box_grid([11, 9, 13]), 20_000.0);
}

/// Camera, grid and lights as far from the world's origin as recordings go. Lights are where single precision can have them.
#[test]
fn no_touching_light_is_lost_anywhere_in_the_world() {
    for away in [1e3, 1e4, 1e5, 1e6] {
        let direction = DVec3::new(0.6, 0.1, -0.8);
        for (method, grid) in [(PERSP, frustum_grid([7, 6, 13])), (ORTHO, box_grid([11, 9, 13]))] {
            no_touching_light_is_lost(method, grid.relative_to(direction * -away), 30.0);
        }
    }
}
