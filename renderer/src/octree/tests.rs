//! Octrees of random lights against the lights themselves.

use super::tree::Node;
use super::*;
use glam::{DVec3, UVec3};
use proptest::prelude::*;

/// Lights in a box of 8 by 4 by 8 m.
fn some_lights(most: usize) -> impl Strategy<Value = Vec<Sphere>> {
    let light = ([-4.0..4.0f64, -2.0..2.0f64, -4.0..4.0f64], 0.1..2.0f64);
    let sphere = |(centre, radius)| Sphere { centre: DVec3::from_array(centre), radius };
    proptest::collection::vec(light.prop_map(sphere), 0..most)
}

/// A hundred points in and around the lights' box, the same each time.
fn points() -> impl Iterator<Item = DVec3> {
    (0..100).map(|at| {
        let part = |step: f64| (f64::from(at) * step).fract() - 0.5;
        DVec3::new(part(0.618_034), part(0.754_878), part(0.569_840)) * DVec3::new(14.0, 10.0, 14.0)
    })
}

fn built(lights: &[Sphere], settings: &OctreeSettings) -> LinklessOctree {
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
            let away = |light: &Sphere| distance(&octree.frame, cell, light.centre) - light.radius;
            let met: Vec<u32> = (0..).zip(&lights).filter(|(_, light)| away(light) <= 0.0).map(|(index, _)| index).collect();
            let touched: Vec<u32> = (0..).zip(&lights).filter(|(_, light)| away(light) <= 1e-9).map(|(index, _)| index).collect();
            prop_assert!(listed == met || listed == touched, "{listed:?} {met:?}");
        }
    }

    #[test]
    fn both_routes_make_the_same_octree(lights in some_lights(12), node in 0.2..3.0f64, start in 0..5_u32) {
        let top_down = OctreeSettings::new(node, start);
        let bottom_up = OctreeSettings { route: Route::BottomUp, ..top_down };
        prop_assert_eq!(built(&lights, &top_down), built(&lights, &bottom_up));
    }
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
