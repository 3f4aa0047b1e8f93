//! Cones of spot lights against clusters on the device: lists equal to their CPU twin by every way, and no light is lost.

use super::*;
use crate::config::{Assign, Test};
use crate::geometry::{ConeTest, VolumeTest};
use crate::selftest::cases::points_and_spots;

/// A grid with about half of its clusters visible.
struct Case {
    method: Method,
    grid: Grid,
    bits: Vec<u32>,
    visible: Vec<u32>,
    lights: Vec<Light>,
}

impl Case {
    fn new((method, grid): (Method, Grid), lights: Vec<Light>) -> Self {
        let clusters = grid.cluster_count();
        let bits = random_bits(clusters, 2, 5);
        let visible = cpu::compact(&fragments_of(&bits, clusters)).visible;
        Self { method, grid, bits, visible, lights }
    }

    fn lists(&self, test: VolumeTest, assign: Assign) -> Lists {
        let room = Capacities {
            visible_clusters: self.grid.cluster_count() as u32,
            light_indices: 2_000_000,
            ..Capacities::default()
        };
        let config = Config { test: vec![Test::Named(test)], assign: vec![assign], ..config() };
        let mut bench = Bench::with_config(&config, self.method, self.grid, &self.lights, room);
        bench.compact(&self.bits);
        bench.lists()
    }
}

fn cases() -> [Case; 2] {
    [(PERSP, frustum_grid([7, 6, 13])), (ORTHO, box_grid([11, 9, 13]))]
        .map(|of| Case::new(of, points_and_spots(900)))
}

#[test]
fn lists_of_cones_equal_their_twin_by_every_way() {
    for case in cases() {
        for name in ["exact+cone", "exact+cone-sat", "hs+cone", "sat-epv+cone-sat"] {
            let test: VolumeTest = name.parse().unwrap();
            let spheres = case.lists(test.sphere.into(), Assign::Brute).indices.len();
            let twin = cpu::assign(&case.grid, &case.visible, &case.lights, test, 1e-3);
            let brute = case.lists(test, Assign::Brute);
            assert_eq!(list_checks::twin_fault(&brute, &twin), None, "{name}");
            let borderline: usize = twin.borderline.iter().map(Vec::len).sum();
            assert!(borderline * 30 < twin.indices.len(), "{name}: {borderline} pairs are too close to call");
            assert!(brute.indices.len() > 1000 && brute.indices.len() < spheres, "{name}");
            for assign in [Assign::Hierarchy, Assign::Scatter] {
                assert_eq!(case.lists(test, assign), brute, "{name} by {assign}");
            }
        }
    }
}

/// Rectangles hand on what their own test lets pass, and cones are asked all the same.
#[test]
fn rectangles_ask_cones_too() {
    let [case, _] = cases();
    for cone in [ConeTest::Separating, ConeTest::Exact] {
        let test = VolumeTest { cone, ..crate::geometry::SphereTest::Projected.into() };
        let brute = case.lists(test, Assign::Brute);
        assert!(brute.indices.len() > 1000);
        assert_eq!(case.lists(test, Assign::Rectangles), brute, "{cone:?}");
    }
}

/// What touches a cluster from outside is on its list, whatever the rounding.
#[test]
fn axes_leave_no_more_than_exact_tests_do_and_lose_nothing() {
    for case in cases() {
        let [all, axes, exact] = ["exact", "exact+cone-sat", "exact+cone"]
            .map(|name| case.lists(name.parse().unwrap(), Assign::Brute));
        let mut saved = 0;
        for place in 0..case.visible.len() {
            let within = |few: &Lists, many: &Lists| {
                few.of(place).iter().all(|light| many.of(place).binary_search(light).is_ok())
            };
            assert!(within(&exact, &axes) && within(&axes, &all), "cluster {}", case.visible[place]);
            saved += all.of(place).len() - exact.of(place).len();
        }
        assert!(saved > 1000, "{saved}");
    }
}
