//! Runs made up for tests.

use super::results::{Distribution, Frames, LightingName, ResultSet, Run, Setting, metric};
use super::way::Way;
use crate::geometry::CellShape;
use crate::machine::{Conditions, Machine};
use crate::methods::Method;
use crate::stats::Samples;
use std::collections::BTreeMap;

/// Frames of every made-up run: two of them look at far geometry.
pub const FRAMES: [u32; 5] = [0, 300, 560, 580, 640];

/// A setting on the street's recording.
pub fn setting(views: u32) -> Setting {
    Setting {
        scene: "street".into(),
        recording: "bistro".into(),
        views,
        resolution: [320, 180],
        msaa: 1,
        ..Setting::default()
    }
}

/// A run whose metrics are `value` of (metric, frame); `None` leaves cells empty.
pub fn run(method: &str, views: u32, lights: u32, value: impl Fn(&str, u32) -> Option<f64>) -> Run {
    let names = [
        metric::VISIBLE,
        metric::INDICES,
        metric::COMPUTATIONS,
        metric::TESTS,
        metric::FRAGMENTS,
        metric::DISCONTINUITY,
        metric::FRAME,
        metric::CLUSTER,
        metric::VISIBILITY,
        metric::COUNT,
        metric::ASSIGN,
        metric::SHADE,
    ];
    let cells = |name: &str| FRAMES.map(|frame| value(name, frame)).to_vec();
    let method: Method = method.parse().unwrap();
    Run {
        name: format!("{method}_{lights}"),
        setting: setting(views),
        extent: None,
        light_box_m: None,
        method,
        lighting: LightingName { count: Some(lights), label: format!("{lights} lights"), sha256: None },
        device: ["device".into(), "driver 1".into(), "1.3".into()],
        machine: Machine::default(),
        conditions: Conditions::default(),
        doubts: vec![],
        started: "2026-01-01T00:00:00Z".into(),
        duration_s: 2.0,
        temporal_runs: 2,
        grid: Some([20, 12, 58]),
        frames: Frames {
            numbers: FRAMES.to_vec(),
            metrics: names.iter().map(|&name| (name.to_owned(), cells(name))).collect(),
        },
        times: BTreeMap::new(),
        stages: BTreeMap::new(),
        distributions: BTreeMap::from([
            (Distribution::Lights, vec![vec![3, 0, 5]; FRAMES.len()]),
            (Distribution::Fragments, vec![vec![0, 8]; FRAMES.len()]),
        ]),
        most_fragments: Some(4096),
        memory: vec![],
        octree: None,
        pictures: vec![],
        lists_all: false,
        groups: vec![],
    }
}

/// The run as three temporal runs measured it: a time of it in each, of which the least are those it has.
pub fn timed(mut run: Run, metric: &'static str, factors: [f64; 3]) -> Run {
    let least = factors.iter().copied().fold(f64::INFINITY, f64::min);
    let of_run = |factor: f64| run.frames.values(metric).map(|time| time * factor / least).collect();
    let samples = Samples::new(FRAMES.len(), factors.map(of_run).to_vec()).unwrap();
    run.times.insert(metric, samples);
    run
}

/// The run by another test of light against cluster.
pub fn by_test(mut run: Run, test: &str) -> Run {
    if run.method.kind().cells() == Some(CellShape::Frustum) {
        run.setting.way = Way::named("brute", test, run.method);
    }
    run
}

/// A result set of these runs.
pub fn set(runs: Vec<Run>) -> ResultSet {
    ResultSet { runs, older: vec![], version: "0.1.0".into(), git_revision: "unknown".into() }
}

/// Fails where XML is not well-formed: tags that do not nest, attributes without quotes, stray signs.
pub fn assert_well_formed(xml: &str) {
    let mut open: Vec<&str> = vec![];
    let mut rest = xml;
    while let Some(start) = rest.find('<') {
        assert!(
            !rest[..start].contains('>'),
            "a stray > before {}",
            &rest[start..][..30.min(rest.len() - start)]
        );
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.starts_with('?') {
            assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
            let outside: String = tag.split('"').step_by(2).collect();
            assert_eq!(outside.matches('=').count() * 2, tag.matches('"').count(), "{tag}");
            if !tag.ends_with('/') {
                open.push(tag.split(' ').next().unwrap());
            }
        }
    }
    assert!(open.is_empty(), "never closed: {open:?}");
}
