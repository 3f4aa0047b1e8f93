//! What the whole-program tests share: running the binary, running the library, reference data.

pub mod program;
pub mod scenes;

pub use manylight::selftest::{METHODS, difference};

use flate2::read::GzDecoder;
use image::RgbImage;
use manylight::assign::Marking;
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::inputs::Inputs;
use manylight::lights::Lighting;
use manylight::measure::{ClusterLists, FrameCounts, FrameTimes, ViewPixels};
use manylight::methods::Method;
use manylight::output::{PlannedRun, planned_runs};
use manylight::replay::{RunResult, RunSink, Watch, replay};
use manylight::selftest::{count_fault, picture_fault};
use manylight::still::Look;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::AtomicBool;

/// The environment variable that rewrites golden files instead of comparing with them.
pub const BLESS: &str = "MANYLIGHT_BLESS";

/// Methods by their names.
///
/// # Panics
/// Where a name is none.
pub fn methods(names: &[&str]) -> Vec<Method> {
    names.iter().map(|name| name.parse().expect("a method's name")).collect()
}

/// The methods of the self-test that serve so many samples, marked so: shaded by pixel, several may lie off their model.
pub fn methods_serving(msaa: u32, marking: Marking) -> Vec<Method> {
    let serves = |method: &Method| {
        Config { methods: vec![*method], msaa, marking, ..Config::default() }.check_case().is_ok()
    };
    methods(&METHODS).into_iter().filter(serves).collect()
}

/// Rain of which as many lights reach a point as of the thousand of the default, 14 m far: a quarter of them, 22 m far. Shading without
/// lists, which tests compare with, takes a quarter of the time, and lists are as long.
pub fn few_far_lights() -> Vec<Lighting> {
    vec![Lighting { intensity: 252.0, ..Lighting::with_count(250) }]
}

/// Three small frames of a recording by these methods, in few lights that reach far, counted and pictured, nothing timed.
pub fn three_frames(recording: &str, msaa: u32, marking: Marking, names: &[&str]) -> Config {
    Config {
        recording: recording.to_owned(),
        methods: methods(names),
        lights: few_far_lights(),
        resolution: [80, 48],
        msaa,
        marking,
        frames: FrameRange { first: 100, end: Some(581), step: 240 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

/// Whether golden files are being rewritten.
pub fn blessing() -> bool {
    std::env::var_os(BLESS).is_some()
}

/// A file of `tests/data`.
pub fn data(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(path)
}

/// The unpacked bytes of a gzip file of `tests/data`, named without its `.gz`.
pub fn unpacked(path: &str) -> Vec<u8> {
    let mut bytes = vec![];
    let file = File::open(data(&format!("{path}.gz"))).expect("a file of tests/data");
    GzDecoder::new(file).read_to_end(&mut bytes).expect("a gzip file");
    bytes
}

/// A command that runs the binary, which is built beside the tests.
///
/// # Panics
/// Where it was not built: `cargo test` alone does not build the binary of another package.
pub fn manylight() -> Command {
    let test = std::env::current_exe().expect("the path of this test");
    let directory = test.ancestors().nth(2).expect("target/<profile>/deps/<test>");
    let binary = directory.join(format!("manylight{}", std::env::consts::EXE_SUFFIX));
    assert!(binary.is_file(), "build the program first: cargo build --release --package manylight");
    Command::new(binary)
}

/// Copies the shader sources to a directory that a test may change.
///
/// # Panics
/// Where they cannot be copied.
pub fn copy_shaders(to: &Path) {
    copy_tree(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-glsl"), to);
}

fn copy_tree(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a directory can be made");
    for entry in std::fs::read_dir(from).expect("a directory of sources") {
        let entry = entry.expect("a file of sources");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy_tree(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).expect("a file can be copied");
        }
    }
}

/// One run with all it measured.
pub struct Run {
    /// What was planned of the run.
    pub planned: PlannedRun,
    /// Counters of each frame.
    pub counts: Vec<FrameCounts>,
    /// Times by frame and run.
    pub times: Vec<FrameTimes>,
    /// Pictures of each frame, one a view.
    pub images: Vec<(u32, Vec<ViewPixels>)>,
    /// Further looks, by frame.
    pub looks: Vec<(u32, Look, RgbImage)>,
    /// Lists by frame and clustering.
    pub lists: Vec<ClusterLists>,
    /// What the run says of itself.
    pub result: RunResult,
}

#[derive(Default)]
struct Collect {
    images: Vec<(u32, Vec<ViewPixels>)>,
    looks: Vec<(u32, Look, RgbImage)>,
    lists: Vec<ClusterLists>,
    runs: Vec<Run>,
}

impl RunSink for Collect {
    fn begin(&mut self, _: &PlannedRun) -> manylight::Result<()> {
        Ok(())
    }

    fn images(&mut self, frame: u32, views: &[ViewPixels]) -> manylight::Result<()> {
        self.images.push((frame, views.to_vec()));
        Ok(())
    }

    fn look(&mut self, frame: u32, look: Look, image: &RgbImage) -> manylight::Result<()> {
        self.looks.push((frame, look, image.clone()));
        Ok(())
    }

    fn lists(&mut self, lists: ClusterLists) -> manylight::Result<()> {
        self.lists.push(lists);
        Ok(())
    }

    fn finish(&mut self, planned: &PlannedRun, mut result: RunResult) -> manylight::Result<()> {
        self.runs.push(Run {
            planned: planned.clone(),
            counts: std::mem::take(&mut result.counts),
            times: std::mem::take(&mut result.times),
            images: std::mem::take(&mut self.images),
            looks: std::mem::take(&mut self.looks),
            lists: std::mem::take(&mut self.lists),
            result,
        });
        Ok(())
    }
}

/// Replays `config` by the library, with the validation layers on, and keeps everything.
///
/// # Panics
/// Where the replay fails.
pub fn run(config: Config) -> Vec<Run> {
    let inputs = Inputs::load(&config).unwrap_or_else(|error| panic!("{error}"));
    run_inputs(config, &inputs)
}

/// Replays as [`run`] does, with inputs at hand.
///
/// # Panics
/// Where the replay fails.
pub fn run_inputs(mut config: Config, inputs: &Inputs) -> Vec<Run> {
    config.validate = true;
    let watch = Watch { interrupt: &AtomicBool::new(false), progress: &|| {} };
    let mut collect = Collect::default();
    let mut planned = planned_runs(&config);
    planned.retain(|run| !config.exclude.iter().any(|rule| rule.matches(&run.config)));
    replay(&config, inputs, &planned, &watch, &mut collect).unwrap_or_else(|error| panic!("{error}"));
    collect.runs
}

/// Checks that every run has the pictures and the counts of the first, which is over all lights.
///
/// # Panics
/// Where one has not, or there is nothing to check.
pub fn assert_equal_the_truth(runs: &[Run], marking: Marking) {
    let (truth, others) = runs.split_first().expect("a run over all lights");
    assert!(!others.is_empty() && !truth.images.is_empty(), "nothing to compare");
    for run in others {
        let name = &run.planned.name;
        assert_eq!((run.images.len(), run.counts.len()), (truth.images.len(), truth.counts.len()), "{name}");
        for ((frame, views), (_, truths)) in run.images.iter().zip(&truth.images) {
            assert_eq!(views.len(), truths.len(), "{name} frame {frame}");
            for (view, truth) in views.iter().zip(truths) {
                assert_eq!(picture_fault(view, truth), None, "{name} frame {frame}");
            }
        }
        for (counts, truth) in run.counts.iter().zip(&truth.counts) {
            assert_eq!(count_fault(counts, truth, marking), None, "{name} frame {}", counts.frame);
        }
    }
}
