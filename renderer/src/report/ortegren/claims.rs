//! What the paper concludes, as claims (K1 to K9), and what its table says beside (K10, K11).

use super::evaluation::{Case, Evaluation, measures};
use crate::report::claim::{Findings, Number, Outcome, Stated, mean, milliseconds, number};
use crate::report::results::{ResultSet, Run, metric};

/// Slices may change the time of shells by so much.
const SHELL_SLICES: [f64; 2] = [0.9, 1.1];
/// Time grows with lights to a power between these: linear, or less where parts do not depend on lights.
const NEAR_LINEAR: [f64; 2] = [0.6, 1.1];
/// Meshes list at most so many times the lights of exact tests.
const MOST_IN_VAIN: f64 = 1.25;
/// Four times as many tiles take less than so many times as long where triangles bound the shell.
const TRIANGLE_BOUND: f64 = 1.5;
/// The memory of 48x24x128 in that of 24x12x64: the paper's, whose shells take half as much as here, and a tenth about.
const MEMORY_OF_FINEST: [f64; 2] = [5.7, 7.3];
/// The memory of 24x12x128 with 32 bits in that of 48x24x32 with 64: the same.
const MEMORY_OF_NARROW: [f64; 2] = [0.3, 0.42];

/// Every claim, in order.
pub const CLAIMS: [Stated; 11] = [
    Stated {
        id: "K1",
        claim: "Shells take time by tiles, not by slices.",
        criterion: "Of the same tiles, law and lights, shells of points and of spots with most slices take 0.9 to 1.1 times as long as with \
                    fewest. (The paper: 48x24 tiles take 3 % longer than 24x12 for points, 28 % for spots.)",
        of_ways: false,
        find: shells_by_slices,
    },
    Stated {
        id: "K2",
        claim: "Fills take longer with each dimension of the grid.",
        criterion: "Where the tiles or the slices alone grow, fills of points and of spots take longer. (The paper: 4.6 and 6.5 times from \
                    24x12x32 to 48x24x128 by exponential slices.)",
        of_ways: false,
        find: fills_by_dimensions,
    },
    Stated {
        id: "K3",
        claim: "Assignment and shading grow nearly linearly with lights.",
        criterion: "From fewest to most lights, time grows with them to a power of 0.6 to 1.1. (The paper's table: 0.72 from 400 to 4000.)",
        of_ways: false,
        find: growth,
    },
    Stated {
        id: "K4",
        claim: "Exponential slices shade faster under few lights, linear ones of coarse grids under many.",
        criterion: "Under 400 lights every grid shades faster by exponential slices than by linear ones; 24x12x32 from 1000 on, and 24x12x64 \
                    at 4000, by linear ones.",
        of_ways: false,
        find: laws_shade,
    },
    Stated {
        id: "K5",
        claim: "The finest grid shades a quarter faster, for almost seven times the memory.",
        criterion: "Under most lights 48x24x128 by exponential slices shades faster than 24x12x64, and takes 5.7 to 7.3 times the memory. (The \
                    paper: 23.5 % faster, 6.65 times.)",
        of_ways: false,
        find: finest,
    },
    Stated {
        id: "K6",
        claim: "Linear slices assign fewer nodes.",
        criterion: "Of every grid under every number of lights linear slices have fewer nodes than exponential ones.",
        of_ways: false,
        find: laws_assign,
    },
    Stated {
        id: "K7",
        claim: "Spots take fewer lighting computations in clusters with their shape than in tiles with the spheres around them.",
        criterion: "Where all lights are spots, raster methods evaluate fewer lights than tiled ones by spheres.",
        of_ways: false,
        find: spots,
    },
    Stated {
        id: "K8",
        claim: "Of as many clusters, those of deep grids are faster than those of wide ones.",
        criterion: "24x12x128 takes less time for assignment and shading than 48x24x32, by exponential slices under most lights.",
        of_ways: false,
        find: deep_or_wide,
    },
    Stated {
        id: "K9",
        claim: "No light is in a cluster that it does not meet.",
        criterion: "Of the mesh: raster methods list all lights that exact tests of the same grid do (exact+cone, all clusters), and at most \
                    1.25 times as many.",
        of_ways: false,
        find: in_vain,
    },
    Stated {
        id: "K10",
        claim: "Point shells are bound by triangles, not by tiles.",
        criterion: "Ours to add, from the table: four times as many tiles take less than 1.5 times as long.",
        of_ways: false,
        find: triangle_bound,
    },
    Stated {
        id: "K11",
        claim: "Nodes of 32 bits in a deep grid beat nodes of 64 bits in a wide one, in time and in memory.",
        criterion: "Ours to add, from the table: 24x12x128 by exponential slices with linked-32 takes less time than 48x24x32 with linked-64, and \
                    0.30 to 0.42 times its memory, under most lights.",
        of_ways: false,
        find: narrow_nodes,
    },
];

const RUNS: &str = "temporal runs of raster methods";

/// What `find` takes from each evaluation; what is missing where that is nothing.
fn gather(set: &ResultSet, missing: &str, find: impl Fn(&Evaluation, &mut Findings)) -> Findings {
    let mut findings = Findings::default();
    Evaluation::all(set).iter().for_each(|evaluation| find(evaluation, &mut findings));
    if findings.evidence.is_empty() {
        findings.lack(missing);
    }
    findings
}

/// The times of a stage in two cases and their ratio.
fn ratio_of([a, b]: [&Case; 2], time: impl Fn(&Case) -> Option<f64>) -> Option<(f64, Vec<Number>)> {
    let (few, many) = (time(a)?, time(b)?);
    let numbers =
        vec![milliseconds(a.name(), few), milliseconds(b.name(), many), number("ratio", many / few)];
    (few > 0.0).then_some((many / few, numbers))
}

fn only_slices(a: &Case, b: &Case) -> bool {
    a.grid[..2] == b.grid[..2] && a.grid[2] < b.grid[2]
}

fn only_tiles(a: &Case, b: &Case) -> bool {
    a.grid[2] == b.grid[2] && a.tiles() < b.tiles()
}

fn shells_by_slices(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} that differ in slices alone"), |evaluation, findings| {
        let pairs = evaluation.pairs(only_slices);
        let depth = |[a, b]: &[&Case; 2]| b.grid[2] - a.grid[2];
        let most = pairs.iter().map(depth).max().unwrap_or(0);
        for pair in pairs.iter().filter(|pair| depth(pair) == most) {
            for (what, stage) in [("points", "shell_points"), ("spots", "shell_spots")] {
                if let Some((ratio, numbers)) = ratio_of(*pair, |case| case.stage(stage)) {
                    let comparison = format!("shells of {what}, {}", pair[0].lights_name());
                    findings.compare(pair[0].run, comparison, numbers, Outcome::within(ratio, SHELL_SLICES));
                }
            }
        }
    })
}

fn fills_by_dimensions(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} that differ in tiles or in slices alone"), |evaluation, findings| {
        for pair in evaluation.pairs(|a, b| only_slices(a, b) || only_tiles(a, b)) {
            for (what, stage) in [("points", "fill_points"), ("spots", "fill_spots")] {
                if let Some((ratio, numbers)) = ratio_of(pair, |case| case.stage(stage)) {
                    let comparison = format!("fills of {what}, {}", pair[0].lights_name());
                    findings.compare(pair[0].run, comparison, numbers, Outcome::above(ratio, 1.0));
                }
            }
        }
    })
}

fn growth(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} under several numbers of lights"), |evaluation, findings| {
        let lights = evaluation.lights();
        let (Some(&few), Some(&many)) = (lights.first(), lights.last()) else { return };
        if few == many {
            return;
        }
        for a in evaluation.of_lights(few) {
            let Some(b) = evaluation.case(many, a.grid, a.linear) else { continue };
            let (Some(from), Some(to)) = (a.total(), b.total()) else { continue };
            let power = (to / from).ln() / (f64::from(many) / f64::from(few)).ln();
            let numbers = vec![
                milliseconds(a.lights_name(), from),
                milliseconds(b.lights_name(), to),
                number("power", power),
            ];
            findings.compare(a.run, a.name(), numbers, Outcome::within(power, NEAR_LINEAR));
        }
    })
}

/// A grid by exponential and by linear slices.
fn laws<'a>(evaluation: &'a Evaluation, lights: u32) -> Vec<[&'a Case<'a>; 2]> {
    let exponential = evaluation.of_lights(lights).filter(|case| !case.linear);
    exponential.filter_map(|case| Some([case, evaluation.case(lights, case.grid, true)?])).collect()
}

fn laws_shade(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} by both laws under 400 lights, or 1000 to 4000"), |evaluation, findings| {
        for lights in evaluation.lights() {
            for pair in laws(evaluation, lights) {
                let linear_wins = match pair[0].grid {
                    [24, 12, 32] => lights >= 1000,
                    [24, 12, 64] => lights >= 4000,
                    _ => false,
                };
                if lights != 400 && !linear_wins {
                    continue;
                }
                let Some((ratio, numbers)) = ratio_of(pair, |case| case.shading()) else { continue };
                let outcome =
                    if linear_wins { Outcome::above(1.0, ratio) } else { Outcome::above(ratio, 1.0) };
                let comparison = format!("shading, {}", pair[0].lights_name());
                findings.compare(pair[0].run, comparison, numbers, outcome);
            }
        }
    })
}

/// Two grids by exponential slices under most lights.
fn two<'a>(evaluation: &'a Evaluation, grids: [[u32; 3]; 2]) -> Option<[&'a Case<'a>; 2]> {
    let most = *evaluation.lights().last()?;
    let [a, b] = grids.map(|grid| evaluation.case(most, grid, false));
    Some([a?, b?])
}

fn finest(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} with 24x12x64 and 48x24x128"), |evaluation, findings| {
        let Some([coarse, fine]) = two(evaluation, [[24, 12, 64], [48, 24, 128]]) else { return };
        let Some((shading, mut numbers)) = ratio_of([coarse, fine], |case| case.shading()) else { return };
        let (Some(little), Some(much)) = (coarse.memory(), fine.memory()) else { return };
        numbers.push(number("ratio of memory", much / little));
        let outcome = Outcome::above(1.0, shading).and(Outcome::within(much / little, MEMORY_OF_FINEST));
        let comparison = format!("shading, {}, lists {}", coarse.lights_name(), coarse.lists());
        findings.compare(coarse.run, comparison, numbers, outcome);
    })
}

fn laws_assign(set: &ResultSet) -> Findings {
    gather(set, "runs of raster methods by both laws", |evaluation, findings| {
        for lights in evaluation.lights() {
            for [exponential, linear] in laws(evaluation, lights) {
                let (Some(more), Some(fewer)) = (exponential.nodes(), linear.nodes()) else { continue };
                let numbers = vec![number(exponential.name(), more), number(linear.name(), fewer)];
                let comparison = format!("nodes, {}", exponential.lights_name());
                findings.compare(exponential.run, comparison, numbers, Outcome::above(more, fewer));
            }
        }
    })
}

/// Runs of other methods under the same lights, where the two differ in nothing but how they work.
fn others<'a>(set: &'a ResultSet, run: &'a Run, is_one: impl Fn(&Run) -> bool) -> Option<&'a Run> {
    let alike = |other: &&Run| {
        let ([ours, theirs], way) = ([&run.setting, &other.setting], Default::default());
        !measures(other.method)
            && ours.by(&way) == theirs.by(&way)
            && other.lighting == run.lighting
            && is_one(other)
    };
    set.runs.iter().find(alike)
}

fn spots(set: &ResultSet) -> Findings {
    gather(
        set,
        "runs of raster methods and of tiles (tiled-16) whose lights are all spots",
        |evaluation, findings| {
            if !evaluation.setting.options.iter().any(|option| option.starts_with("spots 1")) {
                return;
            }
            for case in &evaluation.cases {
                let tiled = |run: &Run| run.method.to_string().starts_with("tiled-");
                let Some(tiles) = others(set, case.run, tiled) else { continue };
                let (Some(ours), Some(theirs)) =
                    (mean(case.run, metric::COMPUTATIONS), mean(tiles, metric::COMPUTATIONS))
                else {
                    continue;
                };
                let numbers = vec![number(case.name(), ours), number(tiles.method.to_string(), theirs)];
                let comparison = format!("lighting computations, {}", case.lights_name());
                findings.compare(case.run, comparison, numbers, Outcome::above(theirs, ours));
            }
        },
    )
}

fn deep_or_wide(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} with 24x12x128 and 48x24x32"), |evaluation, findings| {
        let Some(pair) = two(evaluation, [[24, 12, 128], [48, 24, 32]]) else { return };
        if let Some((ratio, numbers)) = ratio_of(pair, |case| case.total()) {
            let comparison = format!("assignment and shading, {}", pair[0].lights_name());
            findings.compare(pair[0].run, comparison, numbers, Outcome::above(ratio, 1.0));
        }
    })
}

/// Whether a run tests lights against all of the same clusters, exactly.
pub fn tests_exactly(run: &Run, case: &Case) -> bool {
    let way = |axis| run.setting.way.value(axis, run.method);
    run.grid == Some(case.grid)
        && way("clusters") == "all"
        && way("test") == "exact+cone"
        && way("slices") == case.run.setting.way.value("slices", case.run.method)
}

fn in_vain(set: &ResultSet) -> Findings {
    let missing = "runs of raster methods and of tests of the same grids (ortiz-24-12-32 with --clusters all, --test exact+cone, and the \
                   slices of the raster method)";
    gather(set, missing, |evaluation, findings| {
        for case in &evaluation.cases {
            let Some(exact) = others(set, case.run, |run| tests_exactly(run, case)) else { continue };
            let (Some(ours), Some(theirs)) = (case.nodes(), mean(exact, metric::INDICES)) else { continue };
            let numbers =
                vec![number(case.name(), ours), number("exact+cone", theirs), number("ratio", ours / theirs)];
            let outcome = Outcome::within(ours / theirs, [1.0, MOST_IN_VAIN]);
            findings.compare(case.run, format!("light indices, {}", case.lights_name()), numbers, outcome);
        }
    })
}

fn triangle_bound(set: &ResultSet) -> Findings {
    gather(set, &format!("{RUNS} that differ in tiles alone, by a factor of four"), |evaluation, findings| {
        for pair in evaluation.pairs(|a, b| only_tiles(a, b) && 4 * a.tiles() == b.tiles()) {
            if let Some((ratio, numbers)) = ratio_of(pair, |case| case.stage("shell_points")) {
                let comparison = format!("shells of points, {}", pair[0].lights_name());
                findings.compare(pair[0].run, comparison, numbers, Outcome::above(TRIANGLE_BOUND, ratio));
            }
        }
    })
}

fn narrow_nodes(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    let all = Evaluation::all(set);
    let of = |lists: &str| {
        let is_of = |evaluation: &&Evaluation| evaluation.cases[0].lists().starts_with(lists);
        all.iter().filter(is_of).collect::<Vec<_>>()
    };
    for narrow in of("linked-32") {
        let without =
            |evaluation: &Evaluation| evaluation.setting.by(&evaluation.setting.way.without("lists"));
        let is_pair = |wide: &&&Evaluation| without(wide) == without(narrow);
        let wide = of("linked-64");
        let Some(wide) = wide.iter().find(is_pair) else { continue };
        let Some(&most) = narrow.lights().last() else { continue };
        let (Some(deep), Some(broad)) =
            (narrow.case(most, [24, 12, 128], false), wide.case(most, [48, 24, 32], false))
        else {
            continue;
        };
        let (Some(little), Some(much)) = (deep.memory(), broad.memory()) else { continue };
        let Some((ratio, mut numbers)) = ratio_of([deep, broad], |case| case.total()) else { continue };
        numbers.push(number("part of the memory", little / much));
        let outcome = Outcome::above(ratio, 1.0).and(Outcome::within(little / much, MEMORY_OF_NARROW));
        findings.compare(
            deep.run,
            format!("assignment and shading, {}", deep.lights_name()),
            numbers,
            outcome,
        );
    }
    if findings.evidence.is_empty() {
        findings.lack(format!("{RUNS}: 24x12x128 with --lists linked-32 and 48x24x32 with linked-64"));
    }
    findings
}
