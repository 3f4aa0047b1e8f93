use super::*;
use crate::gpu_interface::{HashData, OctreeData};
use crate::lights::Light;
use crate::octree::LinklessOctree;
use glam::UVec3;
use proptest::prelude::*;

fn light(position: [f32; 3], r1: f32) -> Light {
    Light { position, tint: [1.0; 3], intensity: 1.0, cutoff: 1.0, r0: 0.01, r1, spot: None }
}

fn hashed(name: &str) -> HashedMethod {
    match name.parse().unwrap() {
        Method::Hashed(hashed) => hashed,
        other => panic!("{other}"),
    }
}

#[test]
fn nodes_are_as_large_as_the_name_says() {
    let lights = [light([0.0; 3], 4.0), light([1.0; 3], 2.0), light([5.0; 3], 3.0)];
    for (name, node, start) in [("hashed-0.5-3", 1.0, 3), ("hashed-0.5m-0", 0.5, 0), ("hashed-3-7", 6.0, 7)] {
        let settings = hashed(name).settings(&lights);
        assert_eq!((settings.node, settings.start_depth), (node, start), "{name}");
    }
    assert_eq!(hashed("hashed-0.5-3").settings(&[]).node, 0.5, "any size does without lights");
}

#[test]
fn a_start_that_would_keep_too_many_nodes_is_refused_in_one_line() {
    hashed("hashed-1-7").check().unwrap();
    let message = hashed("hashed-0.25m-8").check().unwrap_err().to_string();
    assert!(message.starts_with("method hashed-0.25m-8: ") && message.lines().count() == 1, "{message}");
}

#[test]
fn slack_covers_what_is_asked_and_rarely_changes() {
    for farthest in [0.0, 1e-3, 1.0, 300.0, 301.0, 1e6] {
        let slack = slack(farthest);
        assert!(slack >= 2.4e-6 * farthest && slack <= 4.8e-6 * farthest, "{farthest}: {slack}");
    }
    assert_eq!(slack(300.0), slack(301.0));
}

/// The slot of a key by what the device has.
fn slot(table: &HashData, offsets: &[[u8; 4]], key: UVec3) -> usize {
    let at = key % table.offset_side;
    let [x, y, z, _] =
        offsets[(table.offsets + at.x + table.offset_side * (at.y + table.offset_side * at.z)) as usize];
    let offset = UVec3::new(x.into(), y.into(), z.into());
    let slot = (key % table.side + offset) % table.side;
    (table.slots + slot.x + table.side * (slot.y + table.side * slot.z)) as usize
}

/// The leaf of a cell as `lib/octree.glsl` finds it.
fn leaf(data: &OctreeData, octree: &LinklessOctree, cell: UVec3) -> Option<usize> {
    for depth in data.start_depth..data.depth {
        let layer = &data.layers[(depth - data.start_depth) as usize];
        let child = cell >> (data.depth - depth - 1);
        let branch = octree.structure[slot(&layer.branches, &octree.offsets, child >> 1)];
        let side = child & UVec3::ONE;
        let bit = side.x + 2 * side.y + 4 * side.z;
        if branch >> bit & 1 == 1 {
            return (branch >> (8 + bit) & 1 == 1).then(|| slot(&layer.leaves, &octree.offsets, child));
        }
    }
    None
}

proptest! {
    #[test]
    fn the_device_has_all_that_a_lookup_asks(
        lights in prop::collection::vec(([-30.0..30.0f32, -3.0..9.0f32, -30.0..30.0f32], 0.5..9.0f32), 1..12),
        cells in prop::collection::vec([0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64], 50),
        start in 0..4u32,
    ) {
        let lights: Vec<_> = lights.into_iter().map(|(position, r1)| light(position, r1)).collect();
        let method = HashedMethod { node: NodeSize::Metres(2.0), start_depth: start.into() };
        let spheres: Vec<_> = reaches(&lights, 1e-3).collect();
        let octree = LinklessOctree::build(&spheres, &method.settings(&lights)).unwrap().octree;
        let data = data(&octree, DVec3::new(3.0, 0.0, -5.0));
        for part in cells {
            let cell = (DVec3::from_array(part) * f64::from(data.cells)).as_uvec3();
            prop_assert_eq!(leaf(&data, &octree, cell), octree.leaf_of_cell(cell));
        }
        let lights_told: u64 = told_tables(&octree).iter().map(|table| table.light_indices).sum();
        prop_assert_eq!(lights_told, octree.indices.len() as u64);
        let bytes: u64 = told_tables(&octree).iter().map(|table| table.memory.bytes()).sum();
        prop_assert_eq!(bytes + 4 * lights_told, table_sizes(&octree).bytes());
        // The origin that places are relative to moves the tree with them.
        let low = DVec3::from_array(data.origin.map(f64::from)) + DVec3::new(3.0, 0.0, -5.0);
        prop_assert!((low - octree.frame.origin).abs().max_element() < 1e-4);
    }

    /// Whatever lies within the reach of a light finds it, a little farther than it reaches too.
    #[test]
    fn what_lights_reach_finds_them(
        lights in prop::collection::vec(([-30.0..30.0f32, -3.0..9.0f32, -30.0..30.0f32], 0.5..9.0f32), 1..12),
        at in [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64],
    ) {
        let lights: Vec<_> = lights.into_iter().map(|(position, r1)| light(position, r1)).collect();
        let spheres: Vec<_> = reaches(&lights, 1e-3).collect();
        let octree = LinklessOctree::build(&spheres, &hashed("hashed-0.5-1").settings(&lights)).unwrap().octree;
        for (index, light) in (0..).zip(&lights) {
            let (centre, radius) = (DVec3::from_array(light.position.map(f64::from)), f64::from(light.r1));
            let point = centre + DVec3::from_array(at).normalize_or_zero() * (radius + 9e-4);
            prop_assert!(octree.lights_at(point).contains(&index));
        }
    }
}
