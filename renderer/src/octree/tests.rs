//! Octrees of random lights against the lights themselves.

use super::tree::{Node, Place};
use super::*;
use crate::geometry::{LightVolume, SphericalSector};
use glam::{DVec3, UVec3};
use proptest::prelude::*;
use rand_pcg::Pcg32;
use std::f64::consts::FRAC_PI_2;

/// Lights in a box of 8 by 4 by 8 m.
fn some_lights(most: usize) -> impl Strategy<Value = Vec<LightVolume>> {
    let light = ([-4.0..4.0f64, -2.0..2.0f64, -4.0..4.0f64], 0.1..2.0f64);
    let sphere = |(centre, radius)| LightVolume::sphere(DVec3::from_array(centre), radius);
    proptest::collection::vec(light.prop_map(sphere), 0..most)
}

/// The spot light that shines from `apex` away from the origin.
pub(super) fn shining_outwards(apex: DVec3, range: f64, half_angle: f64) -> LightVolume {
    LightVolume::sector(SphericalSector { apex, axis: apex.normalize_or(DVec3::X), range, half_angle })
}

/// Spots of 3 to 90 degrees among lights that shine all around.
fn spots_and_points(most: usize) -> impl Strategy<Value = Vec<LightVolume>> {
    let angle = proptest::option::weighted(0.7, 0.05..=FRAC_PI_2);
    let shine = |(light, angle): (LightVolume, Option<f64>)| {
        angle.map_or(light, |angle| shining_outwards(light.centre, 2.0 * light.radius, angle))
    };
    (some_lights(most), proptest::collection::vec(angle, most))
        .prop_map(move |(lights, angles)| lights.into_iter().zip(angles).map(shine).collect())
}

/// A hundred points in and around the lights' box, the same each time.
pub(super) fn points() -> impl Iterator<Item = DVec3> {
    (0..100).map(|at| {
        let part = |step: f64| (f64::from(at) * step).fract() - 0.5;
        DVec3::new(part(0.618_034), part(0.754_878), part(0.569_840)) * DVec3::new(14.0, 10.0, 14.0)
    })
}

fn built(lights: &[LightVolume], settings: &OctreeSettings) -> LinklessOctree {
    LinklessOctree::build(lights, settings).unwrap().octree
}

/// Distance from a point to the box of a node, metres.
fn distance(frame: &OctreeFrame, cell: UVec3, centre: DVec3) -> f64 {
    let low = frame.origin + cell.as_dvec3() * frame.node;
    centre.clamp(low, low + frame.node).distance(centre)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn a_cell_lists_exactly_the_lights_that_meet_it(lights in some_lights(12), node in 0.2..3.0f64, start in 0..5_u32) {
        let octree = built(&lights, &OctreeSettings::new(node, start));
        for point in points() {
            let listed = octree.lights_at(point);
            let Some(cell) = octree.frame.cell(point) else {
                prop_assert!(lights.iter().all(|light| light.centre.distance(point) > light.radius));
                continue;
            };
            let away = |light: &LightVolume| distance(&octree.frame, cell, light.centre) - light.radius;
            let met: Vec<u32> = (0..).zip(&lights).filter(|(_, light)| away(light) <= 0.0).map(|(index, _)| index).collect();
            let touched: Vec<u32> = (0..).zip(&lights).filter(|(_, light)| away(light) <= 1e-9).map(|(index, _)| index).collect();
            prop_assert!(listed == met || listed == touched, "{listed:?} {met:?}");
        }
    }

    /// Of a cell that a sector has a ball in, or misses the ball around, the answer is known without the test of octrees.
    #[test]
    fn a_cell_lists_spots_by_what_their_cones_reach(lights in spots_and_points(12), node in 0.2..2.0f64, start in 0..5_u32) {
        let octree = built(&lights, &OctreeSettings::new(node, start));
        for point in points() {
            let Some(cell) = octree.frame.cell(point) else { continue };
            let listed = octree.lights_at(point);
            let middle = octree.frame.origin + (cell.as_dvec3() + 0.5) * octree.frame.node;
            for (index, light) in (0..).zip(&lights) {
                let Some(sector) = light.sector else { continue };
                let (is_listed, away) = (listed.contains(&index), sector.distance(middle));
                prop_assert!(is_listed || away > node / 2.0 - 1e-9 && !sector.contains(point), "{sector:?} lost at {point}");
                prop_assert!(!is_listed || away < node * 0.75f64.sqrt() + 1e-9, "{sector:?} {away} m from {point}");
            }
        }
    }

    #[test]
    fn both_routes_make_the_same_octree(lights in spots_and_points(12), node in 0.2..3.0f64, start in 0..5_u32) {
        let top_down = OctreeSettings::new(node, start);
        let bottom_up = OctreeSettings { route: Route::BottomUp, ..top_down };
        prop_assert_eq!(built(&lights, &top_down), built(&lights, &bottom_up));
    }
}

/// A light as far around as it reaches takes the cells of its ball, one in a cone a part of them.
#[test]
fn narrow_spots_take_few_cells() {
    let indices = |light| built(&[light], &OctreeSettings::new(0.05, 0)).indices.len();
    let around = indices(LightVolume::sphere(DVec3::X, 1.0));
    let [half, narrow] = [FRAC_PI_2, 0.2].map(|angle| indices(shining_outwards(DVec3::X, 1.0, angle)));
    assert!(narrow * 8 < half && half < around, "{narrow} {half} {around}");
}

#[test]
fn without_lights_there_is_an_octree_that_answers_nothing() {
    for start in 0..3 {
        let octree = built(&[], &OctreeSettings::new(0.5, start));
        assert_eq!((octree.frame.depth, octree.layers.len(), octree.leaves.len()), (1, 1, 0));
        assert!(points().all(|point| octree.lights_at(point).is_empty()));
    }
}

#[test]
fn merging_takes_equal_leaves_together_and_nothing_else() {
    let leaf = |light| Node::Leaf(vec![light]);
    let mut equal = Node::Branch(Box::new(std::array::from_fn(|_| leaf(1))));
    equal.merge();
    assert_eq!(equal, leaf(1));
    let mut other = Node::Branch(Box::new(std::array::from_fn(|child| leaf(u32::from(child == 7)))));
    let before = other.clone();
    other.merge();
    assert_eq!(other, before);
}

/// `count` lights of radius 1 m, anywhere in a box of this size.
pub(super) fn crowd(count: usize, size: DVec3) -> Vec<LightVolume> {
    let mut random = Pcg32::new(1, 2);
    let mut part = || f64::from(random.next_u32()) / f64::from(u32::MAX);
    let mut centre = || DVec3::new(part(), part(), part()) * size;
    (0..count).map(|_| LightVolume::sphere(centre(), 1.0)).collect()
}

#[test]
fn the_same_bytes_on_any_number_of_cores() {
    let lights = crowd(60, DVec3::new(12.0, 4.0, 12.0));
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| built(&lights, &OctreeSettings::new(0.3, 2)))
    };
    let one = build(1);
    assert_eq!(one, build(1));
    assert_eq!(one, build(2));
    assert_eq!(one, build(5));
}

/// The lights of the leaf that holds a deepest cell, down the tree itself.
fn leaf_of(tree: &Node, depth: u32, cell: UVec3) -> &[u32] {
    fn below(node: &Node, child: usize) -> &Node {
        node.children()[child]
    }
    Place { depth, cell }.path().fold(tree, below).lights().unwrap()
}

#[test]
fn a_million_lookups_are_those_of_the_tree() {
    let size = DVec3::new(12.0, 4.0, 12.0);
    let lights = crowd(40, size);
    let settings = OctreeSettings::new(0.3, 3);
    let octree = built(&lights, &settings);
    let trees = build::light_trees(&lights, &octree.frame, usize::MAX).unwrap();
    let tree = top_down::join(&trees, usize::MAX).unwrap();
    let mut random = Pcg32::new(3, 4);
    let mut part = || f64::from(random.next_u32()) / f64::from(u32::MAX);
    for _ in 0..1_000_000 {
        let point = DVec3::new(part(), part(), part()) * (size + 2.0) - 1.0;
        let cell = octree.frame.cell(point);
        let expected = cell.map_or(&[][..], |cell| leaf_of(&tree, octree.frame.depth, cell));
        assert_eq!(octree.lights_at(point), expected, "{point}");
    }
}

#[test]
fn lookups_do_not_depend_on_where_they_begin_nor_on_the_seed_or_shared_runs() {
    let lights = crowd(40, DVec3::new(12.0, 4.0, 12.0));
    let plain = OctreeSettings::new(0.3, 0);
    let expected = built(&lights, &plain);
    assert_eq!(expected.layers.len(), 6);
    for start in 0..8 {
        let settings =
            OctreeSettings { start_depth: start, seed: start.into(), share_runs: start % 2 == 1, ..plain };
        let octree = built(&lights, &settings);
        assert_eq!(octree.frame.start_depth, start.min(5));
        assert_eq!(octree.layers.len(), 6 - octree.frame.start_depth as usize);
        for at in 0..64_u32.pow(3) {
            let cell = UVec3::new(at % 64, at / 64 % 64, at / 4096);
            assert_eq!(octree.lights_of_cell(cell), expected.lights_of_cell(cell), "{start} {cell}");
        }
        let shorter = octree.indices.len() < expected.indices.len();
        assert!(shorter == settings.share_runs, "{} {}", octree.indices.len(), expected.indices.len());
    }
}

/// The power of one over the node size by which the number of keys grows where it is halved from `node` metres on.
fn growth(lights: &[LightVolume], node: f64) -> f64 {
    let keys = |table: &TableMemory| table.keys as f64;
    let of_layer = |layer: LayerMemory| keys(&layer.structure) + layer.data.as_ref().map_or(0.0, keys);
    let all =
        |node| built(lights, &OctreeSettings::new(node, 3)).memory().into_iter().map(of_layer).sum::<f64>();
    (all(node / 2.0) / all(node)).log2()
}

#[test]
fn tables_grow_with_the_cube_of_cells_a_metre_where_lights_overlap() {
    let exponent = growth(&crowd(1000, DVec3::new(6.0, 4.0, 6.0)), 0.25);
    assert!((exponent - 3.0).abs() < 0.2, "{exponent}");
}

/// What a light fills within its reach is merged: by itself it takes tables for its surface.
#[test]
fn tables_grow_with_the_square_where_they_do_not() {
    let exponent = growth(&crowd(4, DVec3::splat(30.0)), 0.0625);
    assert!((exponent - 2.0).abs() < 0.2, "{exponent}");
}

#[test]
fn memory_does_not_depend_on_the_seed() {
    for (count, node) in [(15, 0.5), (120, 0.3)] {
        let lights = crowd(count, DVec3::new(20.0, 5.0, 20.0));
        let seeded = |seed| built(&lights, &OctreeSettings { seed, ..OctreeSettings::new(node, 0) }).bytes();
        let bytes: Vec<u64> = (0..10).map(seeded).collect();
        let (least, most) = (bytes.iter().min().unwrap(), bytes.iter().max().unwrap());
        assert!(*most as f64 <= *least as f64 * 1.01, "{bytes:?}");
    }
}

#[test]
fn memory_by_layer_is_what_the_buffers_hold() {
    let octree = built(&crowd(30, DVec3::splat(6.0)), &OctreeSettings::new(0.3, 1));
    let memory = octree.memory();
    assert_eq!(memory.iter().map(|layer| layer.depth).collect::<Vec<_>>(), [1, 2, 3, 4]);
    let slots = memory.iter().map(|layer| layer.structure.slot_bytes).sum::<u64>();
    assert_eq!(slots, 2 * octree.structure.len() as u64);
    let data = memory.iter().filter_map(|layer| layer.data).map(|table| table.slot_bytes).sum::<u64>();
    assert_eq!(data, 8 * octree.leaves.len() as u64);
    let texels = octree.structure.len() + octree.leaves.len() + octree.offsets.len();
    assert_eq!(octree.texels(), texels as u64);
    let bytes = slots + data + 4 * (octree.offsets.len() + octree.indices.len()) as u64;
    assert_eq!(octree.bytes(), bytes);
    // All branches of the starting depth are there, whatever is in them.
    assert_eq!(memory[0].structure.keys, 8);
}

mod broken {
    use super::*;

    fn error(lights: &[LightVolume], settings: &OctreeSettings) -> String {
        let error = LinklessOctree::build(lights, settings).unwrap_err();
        let text = error.to_string();
        assert!(!text.contains('\n'));
        text
    }

    fn light(x: f64, radius: f64) -> LightVolume {
        LightVolume::sphere(DVec3::new(x, 0.0, 0.0), radius)
    }

    #[test]
    fn lights_without_a_place_or_a_reach_are_refused() {
        for broken in [light(0.0, 0.0), light(0.0, f64::NAN), light(0.0, f64::INFINITY), light(f64::NAN, 1.0)]
        {
            let text = error(&[light(0.0, 1.0), broken], &OctreeSettings::new(0.5, 3));
            assert!(text.starts_with("light 1 has its centre at"), "{text}");
        }
        for node in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let text = error(&[light(0.0, 1.0)], &OctreeSettings::new(node, 3));
            assert!(text.contains("must be a length above 0"), "{text}");
        }
    }

    #[test]
    fn lights_far_apart_work_or_ask_for_larger_nodes() {
        let apart = [light(-5e5, 1.0), light(5e5, 1.0)];
        let octree = built(&apart, &OctreeSettings::new(0.5, 3));
        assert_eq!(octree.frame.depth, MOST_DEPTH);
        assert_eq!(octree.lights_at(DVec3::new(5e5, 0.5, 0.0)), [1]);
        let text = error(&apart, &OctreeSettings::new(0.25, 3));
        assert!(text.contains("choose a larger node size (from 4.7"), "{text}");
        let text = error(&[light(-1e308, 1.0), light(1e308, 1.0)], &OctreeSettings::new(0.25, 3));
        assert!(text.contains("choose a larger node size"), "{text}");
    }

    #[test]
    fn lights_in_one_place_work() {
        let octree = built(&vec![light(3.0, 1.0); 200], &OctreeSettings::new(0.5, 3));
        assert_eq!(octree.lights_at(DVec3::new(3.0, 0.0, 0.9)).len(), 200);
        let octree = built(&[light(3.0, 1e-300), light(3.0, 1e-300)], &OctreeSettings::new(0.5, 3));
        assert_eq!(octree.lights_at(DVec3::new(3.0, 0.0, 0.0)), [0, 1]);
    }

    #[test]
    fn what_the_device_cannot_hold_asks_for_larger_nodes() {
        let lights = crowd(20, DVec3::splat(5.0));
        for limits in
            [OctreeLimits { indices: 500, slots: 1 << 20 }, OctreeLimits { indices: 1 << 20, slots: 500 }]
        {
            for route in [Route::TopDown, Route::BottomUp] {
                let settings = OctreeSettings { limits, route, ..OctreeSettings::new(0.3, 0) };
                let text = error(&lights, &settings);
                assert!(text.contains("500") && text.ends_with("choose a larger node size"), "{text}");
            }
        }
    }

    #[test]
    fn lights_of_too_many_cells_ask_for_larger_nodes() {
        let settings = OctreeSettings { route: Route::BottomUp, ..OctreeSettings::new(1e-3, 0) };
        let text = error(&[light(0.0, 1.5)], &settings);
        assert!(text.contains("too large for nodes of 0.001 m"), "{text}");
    }
}
