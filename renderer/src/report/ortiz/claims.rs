//! What the post says of clusters without measuring, as claims (O1 to O3).

use super::aspects::{DEPTHS, aspects};
use super::tables::{grid_name, grids, list_time};
use super::{SUBDIVISIONS, measures};
use crate::geometry::SliceLaw;
use crate::report::claim::{Findings, Outcome, Stated, mean, milliseconds, number};
use crate::report::results::{ResultSet, Run, metric};
use glam::DVec3;

/// Lists of all clusters take at least so many times as long.
const CONSIDERABLE: f64 = 1.5;

/// Every claim, in the order of the post.
pub const CLAIMS: [Stated; 3] = [
    Stated {
        id: "O1",
        claim: "Exponential slices keep clusters nearest to cubes.",
        criterion: "Of every grid that was replayed, seen 1.261 radians wide from 0.3 to 100 m: the mean, and the largest, of the longest \
                    over the shortest edge of a cluster are lower by exponential slices than by even ones in NDC and in view space. \
                    Computed, not measured.",
        of_ways: false,
        find: cubes,
    },
    Stated {
        id: "O2",
        claim: "One logarithm, one product and one sum find a fragment's slice.",
        criterion: "In every frame visible clusters and light indices are those of a method with the same grid and test that finds slices by \
                    the logarithm of a ratio. (The post claims the cost; that the indices are the same is ours to show.)",
        of_ways: false,
        find: sum,
    },
    Stated {
        id: "O3",
        claim: "Lists for active clusters alone speed assignment up considerably.",
        criterion: "Under every lighting, counting lights and writing the lists takes at least 1.5 times as long for all clusters as for \
                    visible ones.",
        of_ways: false,
        find: active,
    },
];

fn cubes(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for grid in grids(set) {
        let counts = DVec3::from_array(grid.map(f64::from));
        let of = SUBDIVISIONS.map(|(law, name)| (name, aspects(law, counts, DEPTHS)));
        for (what, value) in [
            ("mean edge ratio", of.map(|(_, all)| all.mean)),
            ("largest edge ratio", of.map(|(_, all)| all.largest)),
        ] {
            let numbers = of.iter().zip(value).map(|((name, _), value)| number(*name, value)).collect();
            let [ndc, view, exponential] = value;
            let outcome = Outcome::above(ndc, exponential).and(Outcome::above(view, exponential));
            findings.compare_in(grid_name(grid), what.into(), numbers, outcome);
        }
    }
    if findings.evidence.is_empty() {
        findings.lack("runs of tiles and slices by number");
    }
    findings
}

fn sum(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    let geometric = SliceLaw::Geometric.to_string();
    for run in set.runs.iter().filter(|run| run.method.adds_bias()) {
        if run.setting.way.value("slices", run.method) != geometric {
            continue;
        }
        let alike = |other: &&Run| {
            !other.method.adds_bias()
                && (&other.setting, &other.lighting, other.grid) == (&run.setting, &run.lighting, run.grid)
        };
        let Some(other) = set.runs.iter().find(alike) else { continue };
        let counts = |run: &Run| [metric::VISIBLE, metric::INDICES].map(|metric| run.frames.points(metric));
        let ([clusters, indices], [other_clusters, other_indices]) = (counts(run), counts(other));
        let pairs = clusters.iter().zip(&other_clusters).zip(indices.iter().zip(&other_indices));
        let differing = pairs.filter(|((a, b), (c, d))| a != b || c != d).count() as f64;
        let comparison = format!("{} and {}, {}", run.method, other.method, run.lighting.label);
        let numbers = vec![number("frames", clusters.len() as f64), number("of them different", differing)];
        findings.compare(run, comparison, numbers, Outcome::within(differing, [0.0, 0.0]));
    }
    if findings.evidence.is_empty() {
        findings.lack(
            "runs of tiles and slices by number and of a sparse method with the same tiles and slices, by one test (exact)",
        );
    }
    findings
}

fn active(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    let listed = |run: &Run| run.setting.way.value("clusters", run.method);
    let others = |run: &Run| run.setting.by(&run.setting.way.without("clusters"));
    for visible in set.runs.iter().filter(|run| measures(run.method) && listed(run) == "visible") {
        let is_pair = |all: &&Run| {
            listed(all) == "all"
                && (all.method, &all.lighting) == (visible.method, &visible.lighting)
                && others(all) == others(visible)
        };
        let Some(all) = set.runs.iter().find(is_pair) else { continue };
        let (Some(few), Some(many)) = (list_time(visible), list_time(all)) else { continue };
        let ratio = many / few;
        let mut numbers =
            vec![milliseconds("visible", few), milliseconds("all", many), number("ratio", ratio)];
        for (name, of) in [("visible clusters", visible), ("all clusters", all)] {
            numbers.extend(mean(of, metric::VISIBLE).map(|count| number(name, count)));
        }
        if let (Some(few), Some(many)) = (mean(visible, metric::FRAME), mean(all, metric::FRAME)) {
            numbers.push(number("ratio of the frames", many / few));
        }
        let comparison = format!("counting lights and writing lists, {}", visible.lighting.label);
        findings.compare(visible, comparison, numbers, Outcome::above(ratio, CONSIDERABLE));
    }
    if findings.evidence.is_empty() {
        findings.lack("temporal runs of tiles and slices by number with --clusters visible and all");
    }
    findings
}
