//! Records with recognisable values, for the tests of this module.

use super::{DeviceInfo, Manifest, RUN_FORMAT, Source, git_revision};
use crate::config::Config;
use crate::lights::Lighting;
use crate::machine::{Conditions, CpuTicks, Device, Heap, Host, Machine};
use crate::measure::{
    Capacities, ClusterRecord, ClusteringCounts, DeviceCounts, Extremes, FrameCounts, FrameTimes,
    GrowthEvent, Purpose, StageTime, StructureMemory, ViewPixels,
};
use half::f16;

/// A manifest of a run of one frame.
pub(super) fn manifest() -> Manifest {
    Manifest {
        format: RUN_FORMAT.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        git_revision: git_revision().into(),
        fingerprint: "0f".into(),
        method: "encl-ortho-4".into(),
        lighting: Some(Lighting::with_count(1000)),
        config: Config::default(),
        assigned_by: "brute".into(),
        scene: Source { name: "street".into(), sha256: "00".into() },
        recording: Source { name: "bistro-vive".into(), sha256: "11".into() },
        extent: None,
        lights_file: None,
        generated: None,
        frame_count: Some(1),
        device: DeviceInfo { name: "llvmpipe".into(), driver: "Mesa".into(), api: "1.3.230".into() },
        machine: Machine {
            host: Host { cpu: Some("Quick".into()), os: "Linux".into(), ..Host::default() },
            device: Device {
                kind: "cpu".into(),
                heaps: vec![Heap { bytes: 1 << 30, device_local: true }],
                ..Device::default()
            },
        },
        conditions: Conditions {
            timed_s: 0.5,
            load_average: Some([0.25, 1.5]),
            cpu: Some(CpuTicks { cpus: 2, all: 100, own: 40, others: 30 }),
            ..Conditions::default()
        },
        doubts: vec!["others were at work".into()],
        timing: None,
        capacities: Capacities { visible_clusters: 1, light_indices: 2, ..Capacities::default() },
        memory_bytes: Some(memory().iter().map(|structure| structure.allocated).sum()),
        growth: vec![GrowthEvent {
            frame: 40,
            clustering: 0,
            buffer: "light_indices".into(),
            from: 1,
            to: 2,
        }],
        discontinuity: Some(Extremes { least: 40, most: 40 }),
        started: "2026-11-05T09:03:07Z".into(),
        duration_s: 1.5,
    }
}

/// A view whose every pixel differs; the first pixel was hit by nothing.
pub(crate) fn view(name: &str, width: u32, height: u32) -> ViewPixels {
    let pixels = width * height;
    let shade = |i: u32, scale: f32| f16::from_f32(i as f32 * scale);
    ViewPixels {
        name: name.into(),
        width,
        height,
        color: (0..pixels).map(|i| [shade(i, 0.01), shade(i, 0.02), shade(i, 0.03), f16::ONE]).collect(),
        background: [0.0; 3],
        depth: (0..pixels).map(|i| if i == 0 { f32::INFINITY } else { i as f32 * 0.1 }).collect(),
        lights: pixels * 3,
        light_count: (0..pixels).map(|i| i * 3).collect(),
        fragment_count: (0..pixels).map(|i| i * 7).collect(),
        cluster_index: (0..pixels).map(|i| if i == 0 { u32::MAX } else { i }).collect(),
        dimensions: [2, 2, 1],
        world_from_view: glam::DMat4::IDENTITY,
        clip_from_view: glam::DMat4::IDENTITY,
    }
}

/// A frame of two clusterings with three and one visible clusters.
pub(super) fn counts(frame: u32) -> FrameCounts {
    let cluster = |index, fragments, lights| ClusterRecord { index, fragments, lights };
    FrameCounts {
        frame,
        time_s: f64::from(frame) / 90.0,
        views: 2,
        clusterings: vec![
            ClusteringCounts {
                dimensions: [10, 12, 24],
                visible_clusters: 3,
                light_indices: 9,
                intersection_tests: 3000,
                lists_hash: 0xabc,
                clusters: vec![cluster(4, 100, 2), cluster(5, 50, 5), cluster(9, 100, 2)],
                ..ClusteringCounts::default()
            },
            ClusteringCounts {
                dimensions: [2, 3, 4],
                visible_clusters: 1,
                light_indices: 0,
                intersection_tests: 1000,
                lists_hash: u64::MAX,
                clusters: vec![cluster(0, 7, 0)],
                ..ClusteringCounts::default()
            },
        ],
        counters: DeviceCounts {
            lighting_computations: 650,
            needed_computations: 600,
            fragments_shaded: 257,
            ..DeviceCounts::default()
        },
        lights_per_fragment: vec![vec![(2, 200), (5, 50)], vec![(0, 7)]],
    }
}

/// Structures of a run.
pub(super) fn memory() -> [StructureMemory; 2] {
    let of = |structure, purpose, [allocated, used, most]: [u64; 3]| StructureMemory {
        structure,
        purpose,
        allocated,
        used,
        most,
    };
    [of("light_indices", Purpose::Lists, [4096, 36, 40]), of("lights", Purpose::Lights, [320, 320, 320])]
}

/// A frame of one temporal run in which the frame took `total` milliseconds: a quarter of it clustering, a half
/// shading.
pub(super) fn times(run: u32, frame: u32, total: f64) -> FrameTimes {
    let stage = |stage: &str, gpu_ms| StageTime { stage: stage.into(), gpu_ms, cpu_ms: 0.5 };
    let stages = vec![
        stage("frame", total),
        stage("frame/cluster[0]", total / 4.0),
        stage("frame/cluster[0]/mark[0]", total / 8.0),
        stage("frame/shade[0]", total / 2.0),
    ];
    FrameTimes { run, frame, stages }
}
