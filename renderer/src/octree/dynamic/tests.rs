//! Octrees that follow their lights, against the lights and against octrees built anew.

use super::super::tests::{crowd, points, shining_outwards};
use super::*;
use glam::DVec3;
use proptest::prelude::*;

/// A change of a light: which, where to, how far it reaches; beyond the last it comes, without a reach the last goes.
type Step = (usize, [f64; 3], f64);

fn steps() -> impl Strategy<Value = Vec<Vec<Step>>> {
    let step = (0..14_usize, [-4.0..4.0f64, -2.0..2.0f64, -4.0..4.0f64], 0.0..2.0f64);
    proptest::collection::vec(proptest::collection::vec(step, 1..4), 1..8)
}

/// Lights beyond x = 0 are spots, so that those that move become another kind, too.
fn apply(lights: &mut Vec<LightVolume>, (light, centre, radius): Step) {
    let place = DVec3::from_array(centre);
    let volume = match centre[0] > 0.0 {
        true => shining_outwards(place, radius, 0.7 * radius),
        false => LightVolume::sphere(place, radius),
    };
    if radius < 0.2 {
        lights.pop();
    } else if light < lights.len() {
        lights[light] = volume;
    } else {
        lights.push(volume);
    }
}

fn settings(node: f64, start: u32, slack: f64) -> OctreeSettings {
    OctreeSettings { slack, room: 7.0, ..OctreeSettings::new(node, start) }
}

/// Checks that each cell lists the lights that reach it, at points all over.
fn check_superset(octree: &LinklessOctree, lights: &[LightVolume]) {
    for point in points() {
        let listed = octree.lights_at(point);
        assert!(listed.is_sorted());
        assert!(listed.iter().all(|light| (*light as usize) < lights.len()));
        for (index, light) in (0..).zip(lights) {
            let away = light.centre.distance(point) - light.radius;
            let reached = light.sector.map_or(away <= 0.0, |sector| sector.contains(point));
            assert!(!reached || listed.contains(&index), "{index} of {listed:?} at {point}");
        }
    }
}

/// The octree as a device has it that uploads what a report says.
fn upload(device: &mut LinklessOctree, octree: &LinklessOctree, report: &UpdateReport) {
    let Dirty::Parts { structure, leaves, offsets, indices } = &report.dirty else {
        *device = octree.clone();
        return;
    };
    fn copy<T: Copy + Default>(from: &[T], to: &mut Vec<T>, parts: &[std::ops::Range<usize>]) {
        to.resize(from.len(), T::default());
        parts.iter().for_each(|part| to[part.clone()].copy_from_slice(&from[part.clone()]));
    }
    copy(&octree.structure, &mut device.structure, structure);
    copy(&octree.leaves, &mut device.leaves, leaves);
    copy(&octree.offsets, &mut device.offsets, offsets);
    copy(&octree.indices, &mut device.indices, indices);
    device.layers.clone_from(&octree.layers);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn after_any_updates_cells_list_all_lights_and_perhaps_more(
        steps in steps(), node in 0.2..1.0f64, start in 0..4_u32, slack in 1.0..2.0f64,
    ) {
        let settings = settings(node, start, slack);
        let mut lights = crowd(8, DVec3::splat(2.0));
        let mut dynamic = DynamicOctree::new(&lights, &settings).unwrap();
        let mut device = dynamic.octree().clone();
        for step in steps {
            step.into_iter().for_each(|step| apply(&mut lights, step));
            let report = dynamic.update(&lights).unwrap();
            upload(&mut device, dynamic.octree(), &report);
            prop_assert_eq!(&device, dynamic.octree());
            check_superset(&device, &lights);
        }
        // Told to begin anew, it is what is built of the lights.
        dynamic.rebuild(&lights, 0).unwrap();
        let fresh = LinklessOctree::build(&lights, &settings).unwrap().octree;
        prop_assert_eq!(dynamic.octree(), &fresh);
    }

    /// What repairing leaves is what the lights say, whatever was listed before.
    #[test]
    fn repaired_octrees_list_no_extra_lights(steps in steps(), node in 0.2..1.0f64) {
        let settings = settings(node, 2, 1.5);
        let mut lights = crowd(8, DVec3::splat(2.0));
        let mut dynamic = DynamicOctree::new(&lights, &settings).unwrap();
        steps.into_iter().flatten().for_each(|step| apply(&mut lights, step));
        dynamic.update(&lights).unwrap();
        let frame = dynamic.octree.frame;
        let mut editor = Editor::new(frame.start_depth, &dynamic.trees, &mut dynamic.extras);
        editor.repair(&mut dynamic.tree);
        prop_assert_eq!(dynamic.extra_indices(), 0);
        let mut expected = top_down::join(&dynamic.trees, usize::MAX).unwrap();
        expected.split(frame.start_depth);
        let mut found = dynamic.tree;
        found.merge();
        expected.merge();
        prop_assert_eq!(found, expected);
    }
}

#[test]
fn lights_that_stay_cost_nothing() {
    let lights = crowd(20, DVec3::splat(5.0));
    let mut dynamic = DynamicOctree::new(&lights, &settings(0.5, 2, 1.0)).unwrap();
    let before = dynamic.octree().clone();
    assert_eq!(dynamic.update(&lights).unwrap(), UpdateReport::default());
    assert_eq!(*dynamic.octree(), before);
}

#[test]
fn a_small_move_uploads_a_small_part() {
    let mut lights = crowd(60, DVec3::new(12.0, 4.0, 12.0));
    let mut dynamic = DynamicOctree::new(&lights, &settings(0.5, 2, 2.0)).unwrap();
    lights[7].centre.x += 0.1;
    let report = dynamic.update(&lights).unwrap();
    assert_eq!((report.changed, report.rebuilt), (1, 0), "{report:?}");
    let Dirty::Parts { leaves, .. } = report.dirty else { panic!("all of it was uploaded") };
    let slots: usize = leaves.iter().map(ExactSizeIterator::len).sum();
    assert!(slots > 0 && slots * 20 < dynamic.octree().leaves.len(), "{slots}");
}

#[test]
fn more_slots_spare_tables_from_being_hashed_anew() {
    let lights = crowd(30, DVec3::splat(5.0));
    let rebuilt = |slack| {
        let mut dynamic = DynamicOctree::new(&lights[..10], &settings(0.5, 2, slack)).unwrap();
        (11..=30).map(|count| dynamic.update(&lights[..count]).unwrap().rebuilt).sum::<usize>()
    };
    let [tight, roomy] = [1.0, 4.0].map(rebuilt);
    assert!(roomy * 2 < tight, "{tight} {roomy}");
}

#[test]
fn lights_that_leave_the_octree_build_it_anew() {
    let mut lights = crowd(20, DVec3::splat(5.0));
    let settings = settings(0.5, 2, 1.0);
    let mut dynamic = DynamicOctree::new(&lights, &settings).unwrap();
    lights[3].centre.y = 40.0;
    let report = dynamic.update(&lights).unwrap();
    assert_eq!(report.dirty, Dirty::All);
    assert_eq!(*dynamic.octree(), LinklessOctree::build(&lights, &settings).unwrap().octree);
    lights[3].radius = f64::NAN;
    assert!(dynamic.update(&lights).is_err());
}

#[test]
fn a_light_that_shrinks_within_a_leaf_stays_in_its_list_until_repaired() {
    // The large light fills leaves that the small one would not.
    let light = |radius| [LightVolume::sphere(DVec3::splat(0.3), radius)];
    let mut dynamic = DynamicOctree::new(&light(4.0), &settings(0.25, 0, 4.0)).unwrap();
    let report = dynamic.update(&light(2.0)).unwrap();
    assert!(report.extras > 0 && dynamic.extra_indices() > 0);
    let far = DVec3::new(2.6, 0.3, 0.3);
    check_superset(dynamic.octree(), &light(2.0));
    let fresh = LinklessOctree::build(&light(2.0), &settings(0.25, 0, 4.0)).unwrap().octree;
    let extra = |octree: &LinklessOctree| {
        points().chain([far]).filter(|point| !octree.lights_at(*point).is_empty()).count()
    };
    assert!(extra(dynamic.octree()) >= extra(&fresh));
}
