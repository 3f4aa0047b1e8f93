//! The shaders' own index of a fragment's cluster against the planes that lights are tested with, in frusta that strain
//! single precision; and that no light is lost there.

use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::engine::{FramePlan, plan_frames};
use manylight::geometry::{Frustum, half_space};
use manylight::inputs::Inputs;
use manylight::lights::Attenuation;
use manylight_tests::scenes::{Quad, recording, write_quads};
use manylight_tests::{Run, methods, run};
use std::fmt::Write as _;
use std::path::Path;

const RESOLUTION: [u32; 2] = [320, 180];
/// Bands of the screen, each with a surface that leads through a part of the depths.
const BANDS: u32 = 15;

/// One eye in the world's origin that looks along -Z.
#[derive(Debug, Clone, Copy)]
struct Eye {
    near: f64,
    far: f64,
    tangents: [f64; 4],
    method: &'static str,
}

/// Near and far as in the default recordings; a long way; a longer one through a narrow angle; as long as recordings go;
/// off the axis, and more so.
const EYES: [Eye; 6] = [
    Eye { near: 0.4, far: 100.0, tangents: [-0.7, 0.75, -0.4, 0.45], method: "indi-persp-16" },
    Eye { near: 0.05, far: 5000.0, tangents: [-0.6, 0.5, -0.3, 0.35], method: "indi-persp-24" },
    Eye { near: 1e-3, far: 1e5, tangents: [-0.01, 0.01, -0.006, 0.006], method: "indi-persp-16" },
    Eye { near: 1e-6, far: 1e6, tangents: [-0.7, 0.75, -0.4, 0.45], method: "indi-persp-32" },
    Eye { near: 0.1, far: 100.0, tangents: [50.0, 50.02, -0.01, 0.01], method: "indi-persp-16" },
    Eye { near: 0.01, far: 1000.0, tangents: [199.0, 200.0, -0.3, 0.3], method: "indi-persp-32" },
];

impl Eye {
    /// Bands of surfaces, from the left side to the right through one of as many parts of the depths, by their logarithms.
    fn quads(&self) -> Vec<Quad> {
        let [x0, x1, y0, y1] = self.tangents;
        let depth =
            |k: f64| self.near * 1.01 * (0.95 * self.far / (1.01 * self.near)).powf(k / f64::from(BANDS));
        let height = |k: f64| y0 + (y1 - y0) * k / f64::from(BANDS);
        let point = |x: f64, y: f64, d: f64| [x * d, y * d, -d].map(|value| value as f32);
        let wide = 0.1 * (x1 - x0);
        (0..BANDS)
            .map(f64::from)
            .map(|k| {
                let (left, right) = (depth(k), depth(k + 1.0));
                [
                    point(x0 - wide, height(k), left),
                    point(x1 + wide, height(k), right),
                    // A little farther, so that rows differ.
                    point(x1 + wide, height(k + 1.0), 1.03 * right),
                    point(x0 - wide, height(k + 1.0), 1.01 * left),
                ]
            })
            .collect()
    }

    fn config(&self, directory: &Path, lights: &str) -> Config {
        let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
        write_quads(Path::new(&path("s.gltf")), &self.quads(), [0.0; 3], &[]);
        let [x0, x1, y0, y1] = self.tangents;
        let row = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, x0, x1, y0, y1];
        let head = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0];
        let recording = recording([self.near, self.far], head, [[0.0; 3], [1.0; 3]], &[row]);
        std::fs::write(path("r.json"), recording.to_string()).unwrap();
        std::fs::write(path("lights.csv"), format!("x,y,z,r,g,b,i,i0,r0,r1\n{lights}")).unwrap();
        Config {
            scene: path("s.gltf"),
            recording: path("r.json"),
            lights: vec![],
            lights_file: Some(path("lights.csv").into()),
            attenuation: Attenuation::Stp,
            methods: methods(&[self.method]),
            resolution: RESOLUTION,
            frames: FrameRange { first: 0, end: Some(1), step: 1 },
            runs: 0.into(),
            exr: ExrFrames::All,
            ..Config::default()
        }
    }
}

/// The view-space point that a pixel shows, by its tangents in f64 and the depth that the device has.
fn point_of(frustum: &Frustum, pixel: usize, depth: f32) -> [f64; 3] {
    let [width, height] = RESOLUTION.map(f64::from);
    let across = ((pixel as u32 % RESOLUTION[0]) as f64 + 0.5) / width;
    let down = ((pixel as u32 / RESOLUTION[0]) as f64 + 0.5) / height;
    let (x, y) = (frustum.x0 + frustum.size().x * across, frustum.y1 - frustum.size().y * down);
    let depth = f64::from(depth);
    [x * depth, y * depth, -depth]
}

/// What radii grow by at least, metres: a pixel may lie so far outside its cluster.
fn allowed(eye: &Eye) -> f64 {
    let [x0, x1, y0, y1] = eye.tangents;
    let corner = (1.0 + x0.abs().max(x1.abs()).powi(2) + y0.abs().max(y1.abs()).powi(2)).sqrt();
    (8e-7 * eye.far).max(2.4e-6 * (corner - 2.0) * eye.far)
}

/// Pixels that hit something, as (pixel, depth, cluster).
fn hits(run: &Run) -> impl Iterator<Item = (usize, f32, u32)> {
    let pixels = &run.images[0].1[0];
    let all = pixels.depth.iter().zip(&pixels.cluster_index).enumerate();
    all.filter(|(_, (depth, _))| depth.is_finite()).map(|(pixel, (&depth, &cluster))| (pixel, depth, cluster))
}

fn plan(config: &Config) -> FramePlan {
    let inputs = Inputs::load(config).unwrap();
    plan_frames(config, &inputs.recording).unwrap().remove(0)
}

#[test]
fn fragments_lie_between_the_planes_of_their_cluster() {
    for eye in EYES {
        let directory = tempfile::tempdir().unwrap();
        let config = eye.config(directory.path(), "0,0,-1,1,1,1,1,0.5,0.1,1\n");
        let plan = plan(&config);
        let (grid, frustum) = (&plan.grids[0], &plan.views[0].frustum);
        let mut planes = vec![];
        grid.slice_planes(&mut planes);
        let run = run(config).remove(0);
        let (mut seen, mut slices) = (0, vec![]);
        for (pixel, depth, cluster) in hits(&run) {
            let cell = grid.cluster_at(cluster);
            let slice = cell[2] as usize;
            assert!(slice == 0 || planes[slice] <= depth, "{eye:?}: {depth} is before slice {slice}");
            assert!(
                slice + 2 == planes.len() || depth < planes[slice + 1],
                "{eye:?}: {depth} is behind slice {slice}"
            );
            let outside = -half_space(grid, cell, point_of(frustum, pixel, depth).into(), 0.0);
            assert!(outside < 0.5 * allowed(&eye), "{eye:?}: {outside} m outside its cluster at {depth} m");
            seen += 1;
            slices.push(slice);
        }
        slices.sort_unstable();
        slices.dedup();
        assert!(
            seen > 50_000 && slices.len() > (planes.len() / 2).min(1000),
            "{eye:?}: {seen} pixels in {} slices",
            slices.len()
        );
    }
}

/// Lights that end at a pixel, by the last bits of their radius, as rows of a lights file.
fn touching_lights(frustum: &Frustum, run: &Run) -> String {
    let mut text = String::new();
    for (number, (pixel, depth, _)) in hits(run).step_by(97).enumerate() {
        let point = point_of(frustum, pixel, depth);
        let turn = number as f64 * 2.399;
        let height = (number % 19) as f64 / 9.0 - 1.0;
        let level = (1.0 - height * height).max(0.0).sqrt();
        let direction = [level * turn.cos(), height, level * turn.sin()];
        let away = f64::from(depth) * [0.003, 0.02, 0.1, 0.4][number % 4];
        let place: [f32; 3] = [0, 1, 2].map(|axis| (point[axis] + away * direction[axis]) as f32);
        let distance = (0..3).map(|axis| (f64::from(place[axis]) - point[axis]).powi(2)).sum::<f64>().sqrt();
        let (r1, [x, y, z]) = ((distance as f32).next_up().next_up(), place);
        writeln!(text, "{x},{y},{z},1,1,1,{},0.5,{},{r1}", 0.5 * r1 * r1, 0.1 * r1).unwrap();
    }
    text
}

#[test]
fn no_light_that_touches_a_fragment_is_lost() {
    for eye in EYES {
        let directory = tempfile::tempdir().unwrap();
        let first = eye.config(directory.path(), "0,0,-1,1,1,1,1,0.5,0.1,1\n");
        let frustum = plan(&first).views[0].frustum;
        let lights = touching_lights(&frustum, &run(first).remove(0));
        let config = Config {
            methods: methods(&["all-lights", eye.method]),
            assign: vec![Assign::Brute, Assign::Hierarchy, Assign::Scatter],
            test: ["hs", "sat-epv", "exact"].map(|test| test.parse().unwrap()).to_vec(),
            exr: ExrFrames::List(vec![]),
            ..eye.config(directory.path(), &lights)
        };
        let runs = run(config);
        let needed = |run: &Run| run.counts[0].counters.needed_computations;
        assert!(needed(&runs[0]) > 300, "{eye:?}: {} computations are needed", needed(&runs[0]));
        for run in &runs[1..] {
            assert_eq!(needed(run), needed(&runs[0]), "{eye:?}, {} lost lights", run.planned.name);
        }
    }
}
