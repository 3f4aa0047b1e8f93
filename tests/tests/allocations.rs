//! Once an engine has rendered a frame, rendering another allocates nothing on the host: neither planning ahead, nor moving
//! lights, nor recording, nor reading times back.

use manylight::assign::{Assigner, Clusters};
use manylight::config::{Config, FrameRange};
use manylight::culling::Culling;
use manylight::engine::{Engine, LargestGrid, Mode, Session, nothing, plan_frames};
use manylight::inputs::Inputs;
use manylight::lights::{GeneratorKind, Lighting};
use manylight_tests::methods;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's allocator, which counts how often it is asked.
struct Counting;

static ASKED: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ASKED.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ASKED.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often a run's frames ask the allocator once each has been rendered.
fn asked(run: &Config, assigner: Assigner) -> usize {
    let inputs = Inputs::load(run).unwrap();
    let mut session = Session::new(run, &inputs.scene, inputs.recording.view_set()).unwrap();
    let plans = plan_frames(run, &inputs.recording).unwrap();
    let mut lights = inputs.light_source(&run.lights_of_run()).unwrap();
    let count = inputs.light_tally(&run.lights_of_run()).unwrap();
    let mode = Mode { assigner, counting: false, ..Mode::counting(run, count) };
    let mut engine = Engine::new(&mut session, run, LargestGrid::of(&plans), mode).unwrap();
    let mut before = 0;
    for (number, plan) in plans.iter().chain(&plans).enumerate() {
        if number == plans.len() {
            before = ASKED.load(Ordering::Relaxed);
        }
        // Lights fall on, whatever the cameras do.
        let input = (plan, lights.at_frame(plans[0].frame + number as u32));
        engine.render(&mut session, number % 2, input, (&mut nothing, &mut nothing)).unwrap();
        let times: f64 =
            session.frame_slots[number % 2].timestamps.read().unwrap().map(|time| time.gpu_ms).sum();
        assert!(times > 0.0);
    }
    ASKED.load(Ordering::Relaxed) - before
}

#[test]
fn frames_allocate_nothing() {
    let before = ASKED.load(Ordering::Relaxed);
    drop(std::hint::black_box(vec![1_u8]));
    assert!(ASKED.load(Ordering::Relaxed) > before, "an allocation is seen");
    let config = Config {
        resolution: [64, 48],
        frames: FrameRange { first: 290, end: Some(298), step: 1 },
        ..Config::default()
    };
    for name in ["all-lights", "indi-persp-64", "encl-ortho-4", "tiled-16", "ortiz-16-9-24", "g-20", "m"] {
        for (assigner, clusters, culling) in [
            (Assigner::Brute, Clusters::Visible, Culling::Gpu),
            (Assigner::Hierarchy, Clusters::Visible, Culling::Cpu),
            (Assigner::Scatter, Clusters::All, Culling::Gpu),
        ] {
            let run = Config {
                methods: methods(&[name]),
                clusters: vec![clusters.into()],
                culling,
                ..config.clone()
            };
            assert_eq!(asked(&run, assigner), 0, "{name} {assigner} {clusters} {culling:?}");
        }
    }
    // An octree is built anew where lights have moved.
    let run = Config {
        methods: methods(&["hashed-1-3"]),
        light_source: GeneratorKind::Volume,
        lights: vec![Lighting { intensity: 2.0, ..Lighting::with_count(200) }],
        ..config
    };
    assert_eq!(asked(&run, Assigner::Brute), 0, "an octree over lights that stay");
}
