//! Claims on made-up runs for which they hold and for which they do not; figures and tables of them.

use super::evaluation::Evaluation;
use super::{claims, figures, tables};
use crate::assign::{Clusters, ListStore};
use crate::config::Config;
use crate::geometry::VolumeTest;
use crate::output::MemoryRow;
use crate::report::claim::{self, Claim, Verdict};
use crate::report::results::{Run, metric};
use crate::report::testing::{run, set};
use crate::report::way::Way;

/// Lights, slices of a run, whether they are linear, and tiles across.
#[derive(Clone, Copy)]
struct Asked {
    lights: u32,
    columns: u32,
    slices: u32,
    linear: bool,
}

/// What the paper's device would have made of a grid: nodes, milliseconds of the four parts, and of shading.
struct Made {
    nodes: f64,
    parts: [f64; 4],
    shading: f64,
}

/// Numbers for which every claim of times holds: shells go with lights and a little with tiles, fills with all of the grid, shading with
/// lights and less with slices.
fn as_printed(asked: Asked) -> Made {
    let (lights, wide) = (f64::from(asked.lights), f64::from(asked.columns) / 24.0);
    let depth = f64::from(asked.slices) / 32.0;
    let law = if asked.linear { 0.9 } else { 1.0 };
    let many = asked.linear && asked.lights >= 1000 && asked.slices == 32
        || asked.linear && asked.lights == 4000 && asked.slices == 64;
    let shading = lights * (2.0 - 0.1 * depth - 0.4 * wide) * if many || !asked.linear { 1.0 } else { 1.1 };
    Made {
        nodes: 50.0 * lights * wide * wide * depth * law,
        parts: [
            lights * wide.powf(0.1),
            0.1 * lights * wide * wide * depth,
            0.5 * lights * wide.powf(0.3),
            0.1 * lights * wide * wide * depth,
        ],
        shading: shading * if many { 0.95 } else { 1.0 },
    }
}

fn memory(structure: &str, bytes: f64) -> MemoryRow {
    let [allocated, used, most] = [bytes as u64; 3];
    MemoryRow { structure: structure.into(), purpose: "lists".into(), allocated, used, most }
}

/// A run with lists of nodes of so many bits.
fn raster(asked: Asked, bits: u32, made: &Made) -> Run {
    let Asked { lights, columns, slices, linear } = asked;
    let name = format!("raster-{columns}-{}-{slices}-{}", columns / 2, if linear { "l" } else { "e" });
    let (nodes, shading) = (made.nodes, made.shading);
    let value = move |name: &str, _| Some(if name == metric::INDICES { nodes } else { shading });
    let mut run = run(&name, 1, lights, value);
    run.grid = Some([columns, columns / 2, slices]);
    let stages = ["shell_points", "fill_points", "shell_spots", "fill_spots"].into_iter().zip(made.parts);
    run.stages = stages.map(|(stage, ms)| (stage.to_owned(), ms)).collect();
    let clusters = f64::from(columns * columns / 2 * slices);
    let shells = 2.0 * f64::from(columns * columns / 2 * lights);
    run.memory = vec![
        memory("list_offsets", 4.0 * clusters),
        memory("light_indices", 30.0 * clusters * f64::from(bits) / 8.0),
        memory("shell_ranges", shells),
    ];
    let lists: ListStore = format!("linked-{bits}").parse().unwrap();
    run.setting.way = Way::new(&Config { lists: vec![lists], ..Config::default() }, run.method);
    run
}

fn every(bits: u32, make: impl Fn(Asked) -> Made) -> Vec<Run> {
    let mut runs = vec![];
    for lights in [400, 1000, 2000, 4000] {
        for columns in [24, 48] {
            for slices in [32, 64, 128] {
                for linear in [false, true] {
                    let asked = Asked { lights, columns, slices, linear };
                    runs.push(raster(asked, bits, &make(asked)));
                }
            }
        }
    }
    runs
}

fn claim_of(id: &str, runs: Vec<Run>) -> Claim {
    let claims = claim::check(&claims::CLAIMS, super::evaluation::judged(&set(runs)));
    claims.into_iter().find(|claim| claim.id == id).unwrap()
}

fn verdict(id: &str, runs: Vec<Run>) -> Verdict {
    claim_of(id, runs).verdict
}

#[test]
fn without_data_nothing_is_said() {
    for id in claims::CLAIMS.map(|claim| claim.id) {
        let claim = claim_of(id, vec![run("indi-persp-64", 1, 400, |_, _| Some(1.0))]);
        assert!(claim.verdict == Verdict::NotEnoughData && claim.evidence.is_empty(), "{id}");
    }
}

#[test]
fn claims_of_times_hold_for_a_device_like_the_papers() {
    for id in ["K1", "K2", "K3", "K4", "K5", "K6", "K8", "K10"] {
        let claim = claim_of(id, every(64, as_printed));
        let wrong: Vec<_> = claim.evidence.iter().filter(|evidence| !evidence.holds).collect();
        assert_eq!(claim.verdict, Verdict::Holds, "{id}: {wrong:?}");
    }
}

/// Makes another device of the one like the paper's.
type Change = fn(Asked, &mut Made);

/// For each claim, numbers that contradict it alone or with others.
#[test]
fn claims_fall_where_numbers_contradict_them() {
    let with = |change: Change| {
        every(64, move |asked| {
            let mut made = as_printed(asked);
            change(asked, &mut made);
            made
        })
    };
    let contradicting: [(&str, Change); 8] = [
        ("K1", |asked, made| made.parts[2] *= f64::from(asked.slices)),
        ("K2", |asked, made| made.parts[3] /= f64::from(asked.slices)),
        ("K3", |asked, made| made.shading *= f64::from(asked.lights)),
        ("K4", |asked, made| made.shading *= if asked.linear { 0.5 } else { 1.0 }),
        ("K5", |asked, made| made.shading *= f64::from(asked.columns)),
        ("K6", |asked, made| made.nodes *= if asked.linear { 2.0 } else { 1.0 }),
        ("K8", |asked, made| made.parts[0] *= f64::from(asked.slices)),
        ("K10", |asked, made| made.parts[0] *= f64::from(asked.columns)),
    ];
    for (id, change) in contradicting {
        assert_eq!(verdict(id, with(change)), Verdict::DoesNotHold, "{id}");
    }
}

#[test]
fn narrow_nodes_beat_wide_ones_where_both_are_there() {
    let both = |slow: f64| {
        let narrow = every(32, move |asked| {
            let made = as_printed(asked);
            Made { shading: slow * made.shading, ..made }
        });
        [every(64, as_printed), narrow].concat()
    };
    assert_eq!(verdict("K11", both(0.5)), Verdict::Holds);
    assert_eq!(verdict("K11", both(9.0)), Verdict::DoesNotHold);
    assert_eq!(verdict("K11", every(32, as_printed)), Verdict::NotEnoughData);
}

/// A run of other methods under the same lights.
fn other(method: &str, config: &Config, value: f64) -> Run {
    let mut run = run(method, 1, 400, move |_, _| Some(value));
    run.grid = Some([24, 12, 32]);
    run.setting.way = Way::new(config, run.method);
    run
}

const ASKED: Asked = Asked { lights: 400, columns: 24, slices: 32, linear: false };

#[test]
fn meshes_list_no_fewer_and_few_more_than_exact_tests() {
    let test: VolumeTest = "exact+cone".parse().unwrap();
    let slices = vec!["second-plane-5".parse().unwrap()];
    let config =
        Config { test: vec![test.into()], clusters: vec![Clusters::All.into()], slices, ..Config::default() };
    let with =
        |exact: f64| vec![raster(ASKED, 64, &as_printed(ASKED)), other("ortiz-24-12-32", &config, exact)];
    let nodes = as_printed(ASKED).nodes;
    assert_eq!(verdict("K9", with(0.9 * nodes)), Verdict::Holds);
    assert_eq!(verdict("K9", with(1.1 * nodes)), Verdict::DoesNotHold);
    assert_eq!(verdict("K9", with(0.5 * nodes)), Verdict::DoesNotHold);
    let other_test = Config { test: vec!["exact".parse::<VolumeTest>().unwrap().into()], ..config.clone() };
    let runs = vec![raster(ASKED, 64, &as_printed(ASKED)), other("ortiz-24-12-32", &other_test, nodes)];
    assert_eq!(verdict("K9", runs), Verdict::NotEnoughData);
    let tables = tables::all(&set(with(0.9 * nodes)));
    let tests = tables.iter().find(|table| table.id == "ortegren-tests").unwrap();
    let in_vain: Vec<f64> = tests.rows.iter().map(|row| row.numbers[1].unwrap().round()).collect();
    assert_eq!(in_vain, [11.0, 0.0]);
}

#[test]
fn spots_are_compared_with_tiles_where_all_lights_are_spots() {
    let with = |tiles: f64, spots: &str| {
        let mut runs =
            vec![raster(ASKED, 64, &as_printed(ASKED)), other("tiled-16", &Config::default(), tiles)];
        runs.iter_mut().for_each(|run| run.setting.options = vec![spots.into()]);
        runs
    };
    let shading = as_printed(ASKED).shading;
    assert_eq!(verdict("K7", with(2.0 * shading, "spots 1")), Verdict::Holds);
    assert_eq!(verdict("K7", with(0.5 * shading, "spots 1")), Verdict::DoesNotHold);
    assert_eq!(verdict("K7", with(2.0 * shading, "spots 0.5")), Verdict::NotEnoughData);
}

#[test]
fn figures_and_tables_have_every_case() {
    let set = set(every(64, as_printed));
    let evaluations = Evaluation::all(&set);
    assert_eq!((evaluations.len(), evaluations[0].cases.len()), (1, 48));
    let figures = figures::all(&set).unwrap();
    let ids: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
    assert_eq!(ids, ["KF1", "KF5", "KF9", "KF10", "KF11", "KF13", "KF16", "KF17", "KF18"]);
    let drawn = |id: &str| figures.iter().find(|figure| figure.id == id).unwrap().chart.as_ref();
    for id in ["KF5", "KF9", "KF10"] {
        assert_eq!(drawn(id).unwrap().panels.len(), 4, "{id}: a row for each number of lights");
    }
    assert!(drawn("KF13").is_none() && drawn("KF18").is_none(), "nothing was rendered to files");
    let tables = tables::all(&set);
    assert_eq!(tables.iter().map(|table| table.id).collect::<Vec<_>>(), ["ortegren-nodes", "ortegren-times"]);
    let first = &tables[1].rows[0];
    assert_eq!(first.labels, ["400 lights", "24x12x32-E", "linked-64"]);
    assert_eq!(first.numbers.iter().rev().take(6).flatten().copied().collect::<Vec<_>>(), [1.0; 6]);
    let last = tables[1].rows.last().unwrap();
    let paper = last.numbers[11].unwrap();
    assert!((paper - 1_929_030.0 / 224_822.0).abs() < 1e-9, "{paper}");
}
