//! Tables of made-up results.

use super::all;
use crate::extent::Extent;
use crate::report::enhuber::testing::{costs, elsewhere, everything, of, slower};
use crate::report::results::{Run, metric};
use crate::report::tables::{Row, Table};
use crate::report::testing::{set, timed};

fn timed_thrice(run: Run) -> Run {
    let factors = [1.0, 1.001, 1.002];
    timed(timed(run, metric::FRAME, factors), metric::SHADE, factors)
}

fn table(id: &str, runs: Vec<Run>) -> Table {
    let set = set(runs.into_iter().map(timed_thrice).collect());
    all(&set).into_iter().find(|table| table.id == id).unwrap_or_else(|| panic!("no {id}"))
}

fn row<'a>(table: &'a Table, labels: &[&str]) -> &'a Row {
    let is_it = |row: &&Row| row.labels.iter().zip(labels).all(|(label, wanted)| label == wanted);
    table.rows.iter().find(is_it).unwrap_or_else(|| panic!("{labels:?} in {:?}", table.rows))
}

fn close(number: Option<f64>, expected: f64) -> bool {
    number.is_some_and(|number| (number - expected).abs() < 1e-9)
}

#[test]
fn every_table_has_rows_and_a_number_or_gap_a_column() {
    let seen = |run: Run| Run { extent: Some(extent()), light_box_m: Some([3.0, 2.0, 1.0]), ..run };
    let set = set(everything(costs).into_iter().map(timed_thrice).map(seen).collect());
    let tables = all(&set);
    let ids: Vec<&str> = tables.iter().map(|table| table.id).collect();
    let wanted = [
        "enhuber-scenes",
        "enhuber-sizes",
        "enhuber-variability",
        "enhuber-4.4",
        "enhuber-4.5",
        "enhuber-4.6",
        "enhuber-ratios",
        "enhuber-printed",
    ];
    assert_eq!(ids, wanted);
    for table in &tables {
        let columns: usize = table.groups.iter().map(|(_, columns)| columns.len()).sum();
        for row in &table.rows {
            assert_eq!((row.labels.len(), row.numbers.len()), (table.labels.len(), columns), "{}", table.id);
        }
        assert!(!table.caption.contains("  "), "{}", table.caption);
    }
    assert!(all(&crate::report::testing::set(vec![])).is_empty(), "what is printed alone is no table");
}

fn extent() -> Extent {
    Extent {
        triangles: 7,
        vertices: 9,
        models: 2,
        scene_m: [4.0, 5.0, 6.0],
        model_mean_m: [1.0, 2.0, 3.0],
        model_variance_m2: [0.1, 0.2, 0.3],
        path_m: [0.5, 0.25, 0.125],
        path_frames: 1200,
    }
}

#[test]
fn a_scene_is_told_by_its_sizes() {
    let seen = |run: Run| Run { extent: Some(extent()), ..run };
    let scenes = table("enhuber-scenes", everything(costs).into_iter().map(seen).collect());
    let numbers: Vec<f64> = scenes.rows[0].numbers.iter().flatten().copied().collect();
    let expected = [7.0, 9.0, 4.0, 5.0, 6.0, 2.0, 1.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0.5, 0.25, 0.125, 1200.0];
    assert_eq!((scenes.rows.len(), numbers.as_slice()), (1, &expected[..]));
}

#[test]
fn the_size_that_wins_most_scenes_is_selected_and_ties_go_to_the_least_loss() {
    let size = |method: &str, ms: f64| of(method, 10_000, slower(costs("g"), ms));
    let scenes = |hall: [f64; 2], street: [f64; 2]| {
        let methods = ["g-16", "g-20"];
        let there = methods.into_iter().zip(hall).map(|(method, ms)| elsewhere(size(method, ms)));
        there.chain(methods.into_iter().zip(street).map(|(method, ms)| size(method, ms))).collect::<Vec<_>>()
    };
    let tie = table("enhuber-sizes", scenes([0.0, 5.0], [2.0, 0.0]));
    let hall = row(&tie, &["G", "hall (hall)"]);
    assert_eq!(hall.labels[2..], ["G 16", "G 16"]);
    let street = row(&tie, &["G", "street (bistro)"]);
    assert_eq!(street.labels[2..], ["G 20", "G 16"]);
    assert!(
        close(street.numbers[0], 25.9)
            && close(street.numbers[3], 27.9)
            && close(street.numbers[6], 27.9 / 25.9)
    );
    let both = table("enhuber-sizes", scenes([3.0, 0.0], [2.0, 0.0]));
    assert_eq!(row(&both, &["G", "hall (hall)"]).labels[3], "G 20");
    let all = table("enhuber-sizes", everything(costs));
    let kinds: Vec<&str> = all.rows.iter().map(|row| row.labels[0].as_str()).collect();
    assert_eq!(kinds, ["T-I", "T-E", "DC-I", "DC-E", "SC-I", "SC-E", "G"], "models have no size");
}

#[test]
fn variability_is_told_of_every_method() {
    let spread = table("enhuber-variability", everything(costs));
    let tiles = row(&spread, &["street (bistro)", "T-I 28"]);
    let deviation = 0.5 * 0.8_f64.sqrt();
    assert!(
        close(tiles.numbers[0], 42.9)
            && close(tiles.numbers[3], 42.9 * deviation)
            && close(tiles.numbers[6], deviation)
    );
    assert_eq!(spread.rows.len(), 7);
}

#[test]
fn rankings_are_the_thesis_s_where_the_numbers_are() {
    let ranked = |id: &str, by: &str| -> Vec<String> {
        let table = table(id, everything(costs));
        let rows = table.rows.into_iter().filter(|row| row.labels[0] == by);
        rows.map(|row| row.labels[1].clone()).collect()
    };
    assert_eq!(ranked("enhuber-4.4", "SD, 10000 lights (ms)")[..2], ["SC-E 48 40", "SC-I 48 40"]);
    assert_eq!(ranked("enhuber-4.5", "mean time, 100 lights (ms)")[0], "DC-I 128 64");
    assert_eq!(ranked("enhuber-4.5", "mean time, 1000 lights (ms)")[0], "T-E 28");
    let slopes = ranked("enhuber-4.6", "slope of shading (µs a light)");
    assert_eq!((slopes.len(), slopes[0].as_str(), slopes[6].as_str()), (7, "SC-E 48 40", "M"));
    assert!(ranked("enhuber-4.4", "slope of shading (µs a light)").is_empty());
}

#[test]
fn measured_ratios_and_printed_ones_stand_apart() {
    let measured = table("enhuber-ratios", everything(costs));
    let sparse = row(&measured, &["street (bistro)", "SC-E 48 40"]);
    assert!(close(sparse.numbers[3], (4.7 + 5.3) / 13.5), "{sparse:?}");
    assert!(close(row(&measured, &["street (bistro)", "T-E 28"]).numbers[3], 1.0));
    let printed = table("enhuber-printed", everything(costs));
    let sparse = row(&printed, &["SC-E 48 40"]);
    assert!(close(sparse.numbers[0], 9.75) && close(sparse.numbers[3], 9.75 / 16.0));
    assert!(sparse.setting.starts_with("Not measured here") && sparse.setting.contains("GTX 780"));
    assert!(measured.rows.iter().all(|row| !row.setting.contains("GTX 780")));
    let without_tiles = everything(costs).into_iter().filter(|run| run.method.kind().name != "t-e").collect();
    assert!(all(&set(without_tiles)).iter().all(|table| table.id != "enhuber-printed"));
}
