//! All ways of assignment give the same lists, word for word.

use super::*;
use crate::config::{Assign, Test};
use crate::geometry::SphereTest;

/// The lists of every set of lights among the clusters of `bits`.
fn lists_of(
    (assign, test, lists_room): (Assign, Test, Room),
    (method, grid): (Method, Grid),
    sets: &[Vec<Light>],
    bits: &[u32],
) -> Vec<Lists> {
    let most = sets.iter().max_by_key(|lights| lights.len()).expect("a case has lights");
    let room = Capacities {
        visible_clusters: grid.cluster_count() as u32,
        light_indices: 6_000_000,
        ..Capacities::default()
    };
    let config = Config { assign: vec![assign], test: vec![test], ..config() };
    let mut bench = Bench::with_config(&config, method, grid, most, room);
    let plan = frame_of(grid);
    sets.iter()
        .map(|lights| {
            bench.write(&plan, lights);
            bench.leave(lists_room);
            bench.compact(bits);
            bench.lists()
        })
        .collect()
}

/// Lights that trees and ranges may stumble over, each set beside ordinary ones of a like number.
fn light_sets() -> Vec<Vec<Light>> {
    let ahead = pose().transform_point(DVec3::new(0.5, 0.3, -9.0)).as_vec3().to_array();
    let one_place = |count| vec![Light { position: ahead, ..random_lights(1, 3, 1.0, |_| 6.0)[0] }; count];
    vec![
        vec![],
        random_lights(1, 1, 1.0, |_| 3.0),
        random_lights(9, 2, 20.0, |_| 8.0),
        lights(1000),
        // Radii from centimetres to more than the grid.
        random_lights(3001, 4, 40.0, |u| 0.02 * 10_000f32.powf(u * u)),
        one_place(700),
        random_lights(500, 5, 9000.0, |_| 30.0),
        // Too many for bits.
        random_lights(20_001, 6, 60.0, |u| 0.1 + 3.0 * u),
        random_lights(17_000, 7, 60.0, |u| 0.02 * 3000f32.powf(u.powi(8))),
        one_place(16_500),
        random_lights(18_000, 8, 9000.0, |_| 100.0),
    ]
}

fn all_ways_agree((method, grid): (Method, Grid), test: Test, sets: &[Vec<Light>]) {
    let bits = random_bits(grid.cluster_count(), 7, 11);
    let brute = lists_of((Assign::Brute, test, Room::Plenty), (method, grid), sets, &bits);
    let ways = [
        (Assign::Hierarchy, Room::Plenty),
        (Assign::Scatter, Room::Plenty),
        (Assign::Brute, Room::None),
        (Assign::Hierarchy, Room::None),
        (Assign::Scatter, Room::None),
    ];
    // How lists are kept does not depend on the test.
    let ways = ways.into_iter().take(if test == Test::Auto { 5 } else { 2 });
    let rectangles = [(Assign::Rectangles, Room::Plenty), (Assign::Rectangles, Room::None)];
    let seen = rectangles.into_iter().filter(|_| test == Test::from(SphereTest::Projected));
    for (assign, room) in ways.chain(seen) {
        let lists = lists_of((assign, test, room), (method, grid), sets, &bits);
        for (case, (these, those)) in lists.iter().zip(&brute).enumerate() {
            assert!(these.offsets == those.offsets, "{assign}, {test}, {room:?}, set {case}: other lengths");
            assert!(these.indices == those.indices, "{assign}, {test}, {room:?}, set {case}: other lists");
        }
    }
    let lengths: Vec<u32> = brute.iter().map(|lists| lists.offsets.last().copied().unwrap_or(0)).collect();
    let worth = lengths.iter().filter(|&&length| length > 1000).count();
    let filled = sets.iter().filter(|lights| !lights.is_empty()).count();
    assert!(worth * 5 >= filled * 2, "next to nothing is assigned: {lengths:?}");
}

#[test]
fn perspective_lists_are_the_same_by_all_ways() {
    all_ways_agree((PERSP, frustum_grid([13, 9, 21])), Test::Auto, &light_sets());
}

#[test]
fn orthographic_lists_are_the_same_by_all_ways() {
    all_ways_agree((ORTHO, box_grid([17, 13, 11])), Test::Auto, &light_sets());
}

#[test]
fn lists_are_the_same_by_all_ways_whatever_the_test() {
    let radii = |u: f32| 0.02 * 3000f32.powf(u.powi(8));
    let sets = [lights(1000), random_lights(17_000, 7, 60.0, radii)];
    for test in ["mm", "sat-n", "sat-e", "hs+sat-n", "sat-epv", "exact"] {
        let test = test.parse().unwrap();
        all_ways_agree((PERSP, frustum_grid([7, 5, 11])), test, &sets);
    }
    for test in ["hs", "sat-n", "sat-e"] {
        all_ways_agree((ORTHO, box_grid([7, 6, 5])), test.parse().unwrap(), &sets);
    }
}
