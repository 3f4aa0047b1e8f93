//! The thesis's results as they would be were all its claims true.

use super::evaluation::{CLUSTERED, HASHED, NAIVE, Pipeline, TILED, node};
use crate::measure::Purpose;
use crate::output::{MemoryRow, OctreeRow};
use crate::report::results::{BuiltOctree, Picture, Run, metric};
use crate::report::testing::{FRAMES, run};

/// What the frames of a method take in a pipeline.
#[derive(Debug, Clone, Copy)]
pub struct Costs {
    /// Lights that are computed for a pixel: of none, and more for each.
    pub computations: [f64; 2],
    /// Milliseconds: of nothing, of a million pixels, and of as many for each light.
    pub ms: [f64; 3],
    /// How far frames lie from the mean, in parts of it.
    pub swing: f64,
    /// Bytes of groups and lists: of no pixels, and for each.
    pub bytes: [f64; 2],
}

/// Sets of lights.
pub const SETS: [u32; 3] = [60, 300, 1200];
/// Sides of the square images.
pub const SIDES: [u32; 3] = [160, 320, 640];
/// Seeds of hashes beside the usual one.
pub const SEEDS: [&str; 3] = ["seed-1", "seed-2", "seed-3"];
/// Where each frame lies, in swings; their squares have the mean 4/5.
const PLACES: [f64; FRAMES.len()] = [-1.0, 1.0, 0.0, -1.0, 1.0];
/// Every method.
const METHODS: [&str; 13] = [
    "all-lights",
    "tiled-mm-8",
    "tiled-mm-16",
    "tiled-mm-32",
    "clustered-mm-16",
    "clustered-mm-32",
    "hashed-0.25-1",
    "hashed-0.5-1",
    "hashed-0.25-3",
    "hashed-0.5-3",
    "hashed-1-3",
    "hashed-2-3",
    "hashed-3-3",
];

/// Costs by which every claim holds.
pub fn costs(run: &Run) -> Costs {
    let deferred = Pipeline::of(run) == Pipeline::Deferred;
    let (computations, swing) = match run.method.kind().name {
        NAIVE => ([0.0, 1.0], 0.2),
        TILED => ([18.0, 0.25], 0.3),
        _ => ([9.0, 0.125], 0.1),
    };
    let each = match (run.method.kind().name, deferred) {
        (NAIVE, true) => 4.0,
        (_, true) => 1.0,
        (NAIVE, false) => 16.0,
        (TILED, false) => 4.0,
        (_, false) => 2.0,
    };
    // Nodes half as large are a level deeper.
    let steps =
        node(run.method).filter(|_| run.method.kind().name == HASHED).map_or(0.0, |radii| 4.0 - radii.log2());
    let bytes = match run.method.kind().name {
        TILED => [0.0, 0.5],
        CLUSTERED => [500.0, 2.0],
        _ => [4e5, 0.0],
    };
    let swing = if deferred { swing } else { 2.0 * swing };
    Costs { computations, ms: [0.3, 0.5 + 2.0 * steps, each], swing, bytes }
}

/// A run of the street.
pub fn of(
    method: &str,
    pipeline: Pipeline,
    (lights, side): (u32, u32),
    costs: impl Fn(&Run) -> Costs,
) -> Run {
    let mut blank = run(method, 1, lights, |_, _| None);
    blank.setting.resolution = [side, side];
    if pipeline == Pipeline::Deferred {
        blank.setting.way = blank.setting.way.with("pipeline", "deferred");
    }
    let costs = costs(&blank);
    let [pixels, count] = [f64::from(side * side), f64::from(lights)];
    let swung = |frame: u32| {
        let place = FRAMES.iter().zip(PLACES).find(|(known, _)| **known == frame);
        1.0 + costs.swing * place.map_or(0.0, |(_, place)| place)
    };
    let filled = run(method, 1, lights, move |name, frame| {
        let [fixed, of_pixels, of_lights] = costs.ms;
        let ms = fixed + pixels / 1e6 * (of_pixels + of_lights * count);
        Some(match name {
            metric::FRAME => swung(frame) * ms,
            metric::SHADE => swung(frame) * (ms - fixed),
            metric::COMPUTATIONS => {
                swung(frame) * pixels * (costs.computations[0] + costs.computations[1] * count)
            }
            metric::FRAGMENTS => {
                if pipeline == Pipeline::Deferred {
                    pixels
                } else {
                    2.5 * pixels
                }
            }
            _ => 0.1,
        })
    });
    let bytes = (costs.bytes[0] + costs.bytes[1] * pixels) as u64;
    let row = MemoryRow {
        structure: "lists".into(),
        purpose: Purpose::Lists.to_string(),
        allocated: bytes,
        used: bytes,
        most: bytes,
    };
    let image = "frame.png".into();
    let picture = Picture { frame: 300, image, ..Picture::default() };
    let radii = node(filled.method).filter(|_| filled.method.kind().name == HASHED);
    let octree = radii.map(|radii| octree(1.0 / radii, lights));
    Run { setting: blank.setting, memory: vec![row], octree, pictures: vec![picture], ..filled }
}

/// An octree whose tables and steps grow with the cube of the nodes along an axis.
fn octree(nodes: f64, lights: u32) -> BuiltOctree {
    let deepest = (8.0 + nodes.log2()).ceil() as u32;
    let table = |name: &str, depth: u32, part: f64| {
        let cubes = part * nodes.powi(3) * f64::from(lights);
        OctreeRow {
            table: name.into(),
            depth,
            keys: cubes as u64,
            slot_side: (100.0 * nodes * part) as u32,
            offset_side: (50.0 * nodes * part) as u32,
            slot_bytes: (1000.0 * cubes) as u64,
            light_indices: (250.0 * cubes) as u64,
            ..OctreeRow::default()
        }
    };
    let tables = vec![
        table("structure", deepest - 2, 0.25),
        table("structure", deepest - 1, 1.0),
        table("data", deepest - 1, 1.0),
        table("data", deepest, 1.0),
    ];
    let steps = [("light_octrees", 1.0), ("hash_layers", 3.0)];
    let steps = steps.map(|(step, ms)| (step.to_owned(), ms * nodes.powi(3) * f64::from(lights)));
    BuiltOctree { tables, steps: steps.into() }
}

/// Every run of one scene, where runs cost what `costs` says.
pub fn everything(costs: impl Fn(&Run) -> Costs) -> Vec<Run> {
    let mut runs = vec![];
    for pipeline in Pipeline::BOTH {
        for method in METHODS {
            for (lights, side) in SETS.into_iter().flat_map(|lights| SIDES.map(|side| (lights, side))) {
                runs.push(of(method, pipeline, (lights, side), &costs));
            }
        }
    }
    for seed in SEEDS {
        for lights in [SETS[0], SETS[2]] {
            let mut run = of("hashed-0.5-3", Pipeline::Deferred, (lights, SIDES[0]), &costs);
            run.setting.way = run.setting.way.with("octree", seed);
            runs.push(run);
        }
    }
    runs
}

/// The run in another scene, whose lights are others.
pub fn elsewhere(mut run: Run) -> Run {
    (run.setting.scene, run.setting.recording) = ("hall".into(), "hall".into());
    run.setting.options.push("light volumes two".into());
    run
}
