//! The thesis's results as they would be were all its claims true.

use super::evaluation::{EIGHT, TESTS, USUAL_TEST};
use crate::report::results::{FrameGroups, Picture, Run, metric};
use crate::report::testing::{FRAMES, by_test, run};

/// What a kind's frames take.
#[derive(Debug, Clone, Copy)]
pub struct Costs {
    /// Milliseconds without lights, and microseconds a light.
    pub assignment: [f64; 2],
    /// Milliseconds without lights, and microseconds a light.
    pub shading: [f64; 2],
    /// How far frames lie from the mean, in parts of it.
    pub swing: f64,
    /// Lists of a frame.
    pub lists: f64,
    /// Mean lights that a group has more in frame 580, the one of most depth discontinuity, than in frame 300.
    pub growth: f64,
}

/// Numbers of lights.
pub const COUNTS: [u32; 3] = [100, 1000, 10_000];
/// Where each frame lies, in swings; their squares have the mean 4/5.
const PLACES: [f64; FRAMES.len()] = [-1.0, 1.0, 0.0, -1.0, 1.0];

/// Costs of a kind, by which every claim holds.
pub fn costs(kind: &str) -> Costs {
    let growth = match kind {
        "t-i" | "t-e" => 30.0,
        "g" | "m" => 0.0,
        _ => 2.0,
    };
    let (assignment, shading, swing, lists) = match kind {
        "t-i" => ([0.5, 0.2], [0.4, 4.0], 0.5, 84.0),
        "t-e" => ([1.2, 0.2], [0.3, 1.0], 0.3, 84.0),
        "dc-i" => ([0.5, 0.5], [0.3, 2.0], 0.15, 6400.0),
        "dc-e" => ([1.0, 0.3], [0.3, 0.6], 0.1, 6400.0),
        "sc-i" => ([3.0, 0.15], [0.3, 0.7], 0.08, 900.0),
        "sc-e" => ([3.2, 0.15], [0.3, 0.5], 0.05, 900.0),
        "g" => ([0.6, 0.5], [0.3, 2.0], 0.15, 8000.0),
        _ => ([0.1, 0.1], [0.3, 90.0], 0.04, 922.0),
    };
    Costs { assignment, shading, swing, lists, growth }
}

impl Costs {
    /// Milliseconds of assignment and of shading under so many lights.
    pub fn under(&self, lights: u32) -> [f64; 2] {
        [self.assignment, self.shading].map(|[offset, slope]| offset + slope * f64::from(lights) / 1000.0)
    }
}

/// A run by the usual test.
pub fn of(method: &str, lights: u32, costs: Costs) -> Run {
    let [assignment, shading] = costs.under(lights);
    let made = run(method, 1, lights, move |name, frame| {
        let place =
            FRAMES.iter().zip(PLACES).find(|(known, _)| **known == frame).map_or(0.0, |(_, place)| place);
        let swung = |ms: f64| ms * (1.0 + costs.swing * place);
        Some(match name {
            metric::FRAME => swung(assignment + shading),
            metric::SHADE => swung(shading),
            metric::VISIBLE => costs.lists,
            metric::DISCONTINUITY => f64::from(frame),
            _ => 1000.0,
        })
    });
    let mut made = by_test(made, USUAL_TEST);
    made.setting.options = vec!["light source gamma".into()];
    made.pictures = [300, 580].map(picture).to_vec();
    made.groups = [(300, 0.0), (580, costs.growth)].map(|(frame, more)| groups(frame, 10.0 + more)).to_vec();
    made
}

/// A frame that was rendered to a file that nobody reads.
fn picture(frame: u32) -> Picture {
    Picture { frame, image: "frame.png".into(), ..Picture::default() }
}

/// Two groups with so many lights on average.
fn groups(frame: u32, mean: f64) -> FrameGroups {
    let around = mean as u32;
    let rest = (4.0 * (mean - f64::from(around))) as u32;
    FrameGroups { frame, clusterings: vec![vec![(around, 3), (around + rest, 1)]] }
}

/// The methods that stand for the eight kinds.
const METHODS: [&str; 8] =
    ["t-i-28", "t-e-28", "dc-i-128-64", "dc-e-64-40", "sc-i-48-40", "sc-e-48-40", "g-20", "m"];

/// Every run of one scene, where kinds cost what `costs` says.
pub fn everything(costs: impl Fn(&str) -> Costs) -> Vec<Run> {
    let kinds = || METHODS.into_iter().zip(EIGHT);
    let counted = kinds().flat_map(|(method, kind)| COUNTS.map(|lights| of(method, lights, costs(kind))));
    let sizes =
        [("t-i-16", "t-i"), ("t-e-16", "t-e"), ("dc-i-48-40", "dc-i"), ("dc-i-48-64", "dc-i"), ("g-16", "g")];
    let larger = sizes.map(|(method, kind)| of(method, 10_000, slower(costs(kind), 0.5)));
    let tested = [("t-e-28", "t-e"), ("sc-e-48-40", "sc-e")].into_iter().flat_map(|(method, kind)| {
        let others = TESTS.into_iter().enumerate().filter(|(_, test)| *test != USUAL_TEST);
        let costs = costs(kind);
        others
            .map(move |(place, test)| {
                let slower = slower(costs, 0.1 * (place + 1) as f64);
                by_test(of(method, 10_000, slower), test)
            })
            .collect::<Vec<_>>()
    });
    counted.chain(larger).chain(tested).collect()
}

/// The costs with so many more milliseconds of assignment.
pub fn slower(mut costs: Costs, ms: f64) -> Costs {
    costs.assignment[0] += ms;
    costs
}

/// The run in another scene.
pub fn elsewhere(mut run: Run) -> Run {
    (run.setting.scene, run.setting.recording) = ("hall".into(), "hall".into());
    run
}
