//! The lookup of leaves on the device against its twin, for every pixel of a small frame.

use super::*;
use crate::config::FrameRange;
use crate::engine::{count_frame, plan_frames};
use crate::inputs::Inputs;
use crate::lights::{LightTally, Lighting};
use crate::measure::{ClusterLists, ViewPixels};
use crate::octree::LinklessOctree;

/// A frame of rain over the street, in stereo.
fn config(name: &str) -> Config {
    Config {
        methods: vec![name.parse().unwrap()],
        recording: "bistro-vive".into(),
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        ..super::config()
    }
}

/// The leaf of a place; `None` nearer to another cell than rounding is sure of.
fn sure_leaf(octree: &LinklessOctree, place: DVec3) -> Option<Option<usize>> {
    let cell = |shift: f64| octree.frame.cell(place + DVec3::splat(shift));
    let sure = cell(-2e-3) == cell(2e-3);
    sure.then(|| cell(0.0).and_then(|cell| octree.leaf_of_cell(cell)))
}

/// Compares the pixels of a view with the twin; gives how many lie in a leaf, and how many where no light reaches.
fn compare(octree: &LinklessOctree, view: &ViewPixels) -> [usize; 2] {
    let mut compared = [0; 2];
    for pixel in 0..view.depth.len() {
        let Some(leaf) = view.place(pixel).and_then(|place| sure_leaf(octree, place)) else { continue };
        let group = leaf.map_or(u32::MAX, |slot| slot as u32);
        let lights = leaf.map_or(0, |slot| octree.leaves[slot][1]);
        assert_eq!((view.cluster_index[pixel], view.light_count[pixel]), (group, lights), "pixel {pixel}");
        compared[usize::from(leaf.is_none())] += 1;
    }
    compared
}

#[test]
fn leaves_of_pixels_are_their_twins() {
    for (name, intensity, least) in [
        ("hashed-0.5-3", 100.0, [1000, 0]),
        ("hashed-2m-0", 100.0, [1000, 0]),
        ("hashed-0.2-2", 10.0, [50, 100]),
    ] {
        let lighting = Lighting { intensity, ..Lighting::with_count(800) };
        let run = Config { lights: vec![lighting], ..config(name) };
        let inputs = Inputs::load(&run).unwrap();
        let mut session = Session::new(&run, &inputs.scene, inputs.recording.view_set()).unwrap();
        let plan = &plan_frames(&run, &inputs.recording).unwrap()[0];
        let mut source = inputs.light_source(&run.lights_of_run()).unwrap();
        let lights = source.at_frame(300);
        let mode = Mode::counting(&run, LightTally::of(lights.list));
        let mut engine = Engine::new(&mut session, &run, LargestGrid::default(), mode).unwrap();
        let names = ["left", "right"].map(str::to_owned);
        let mut lists: Vec<ClusterLists> = vec![];
        let mut keep = |of_clustering| {
            lists.push(of_clustering);
            Ok(())
        };
        let about = (0.0, Some(names.as_slice()));
        let frame = count_frame(&mut engine, &mut session, (plan, lights), about, &mut keep).unwrap();
        let octree = engine.octree().expect("there is one");
        let compared: Vec<[usize; 2]> = frame.pixels.iter().map(|view| compare(octree, view)).collect();
        for kind in [0, 1] {
            let found: usize = compared.iter().map(|of_view| of_view[kind]).sum();
            assert!(found >= least[kind], "{name}: {compared:?}");
        }
        lists_are(octree, &lists[0], &frame.counts.clusterings[0]);
    }
}

/// Checks that the device holds the lists of an octree's leaves, as the counts say.
fn lists_are(octree: &LinklessOctree, lists: &ClusterLists, counts: &ClusteringCounts) {
    let filled: Vec<usize> = (0..octree.leaves.len()).filter(|&slot| octree.leaves[slot][1] > 0).collect();
    assert_eq!((lists.offsets.len(), counts.clusters.len()), (filled.len() + 1, filled.len()));
    let mut fragments = 0;
    for (number, (slot, record)) in filled.into_iter().zip(&counts.clusters).enumerate() {
        let [first, count] = octree.leaves[slot].map(|word| word as usize);
        assert_eq!(lists.list(number), &octree.indices[first..first + count], "leaf {slot}");
        assert_eq!((record.index, record.lights), (slot as u32, count as u32));
        fragments += record.fragments;
    }
    assert!(fragments > 50, "fragments of leaves are counted");
}
