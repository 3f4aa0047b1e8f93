//! Bars, lines and rankings of made-up runs.

use super::{figures, tables};
use crate::report::chart::Plot;
use crate::report::results::{ResultSet, Run, metric};
use crate::report::tables::Table;
use crate::report::testing::{FRAMES, assert_well_formed, run, set, timed};

/// A run whose frame takes `offset` + `slope` a light, of which shading is all but 2 ms; every second frame 1 ms more.
fn growing(method: &str, lights: u32, [offset, slope]: [f64; 2]) -> Run {
    let time = offset + slope * f64::from(lights);
    let value = move |name: &str, frame: u32| {
        let more = if FRAMES.iter().position(|&one| one == frame).unwrap() % 2 == 1 { 1.0 } else { 0.0 };
        Some(if name == metric::FRAME { time + more } else { time - 2.0 })
    };
    let factors = [1.0, 1.01, 1.02];
    timed(timed(run(method, 1, lights, value), metric::FRAME, factors), metric::SHADE, factors)
}

fn three_counts(method: &str, line: [f64; 2]) -> Vec<Run> {
    [100, 1000, 4000].map(|lights| growing(method, lights, line)).to_vec()
}

fn everything() -> ResultSet {
    set([three_counts("indi-persp-64", [5.0, 0.01]), three_counts("tiled-16", [4.0, 0.03])].concat())
}

fn table(set: &ResultSet, id: &str) -> Table {
    tables(set).into_iter().find(|table| table.id == id).unwrap()
}

/// The first number of a group in the row of these labels.
fn cell(table: &Table, group: &str, labels: &[&str]) -> f64 {
    let row = table
        .rows
        .iter()
        .find(|row| row.labels.starts_with(&labels.iter().map(|&l| l.to_owned()).collect::<Vec<_>>()));
    let place: usize =
        table.groups.iter().take_while(|(name, _)| *name != group).map(|(_, columns)| columns.len()).sum();
    row.unwrap().numbers[place].unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn the_frame_less_shading_is_assignment_and_frames_deviate_as_a_population() {
    let times = table(&everything(), "analysis-times");
    let at = |group| cell(&times, group, &["Persp 64", "1000 lights"]);
    assert!(close(at("all ms"), 15.4) && close(at("shading ms"), 13.0) && close(at("assignment ms"), 2.4));
    assert!(close(at("all SD ms"), 0.24_f64.sqrt()) && close(at("all RSD"), 0.24_f64.sqrt() / 15.4));
    assert!(
        times.rows.iter().all(|row| row.numbers.iter().all(Option::is_some)),
        "every number has an interval"
    );
}

#[test]
fn slopes_and_offsets_are_those_the_times_were_made_of() {
    let lines = table(&everything(), "analysis-lines");
    let at = |group, part| cell(&lines, group, &["Tiled 16", part]);
    assert!(close(at("slope µs a light", "all"), 30.0) && close(at("offset ms", "all"), 4.4));
    assert!(close(at("slope µs a light", "shading"), 30.0) && close(at("offset ms", "shading"), 2.0));
    assert!(at("slope µs a light", "assignment").abs() < 1e-9 && close(at("offset ms", "assignment"), 2.4));
    assert!(at("off the line ms", "all").abs() < 1e-9);
    let two = set(["indi-persp-64", "tiled-16"].map(|method| growing(method, 100, [5.0, 0.01])).to_vec());
    assert!(tables(&two).iter().all(|table| table.id != "analysis-lines"), "one count makes no line");
}

#[test]
fn figures_have_a_bar_a_method_and_a_line_below_its_dots() {
    let figures = figures(&everything()).unwrap();
    let ids: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
    assert_eq!(
        ids,
        ["analysis-times", "analysis-lines", "analysis-slopes", "analysis-memory", "analysis-groups"]
    );
    let charts: Vec<_> = figures.iter().filter_map(|figure| figure.chart.as_ref()).collect();
    assert_eq!(charts.len(), 3, "neither memory nor pictures");
    let Some(Plot::Bars(bars)) = &charts[0].panels[1] else { panic!("bars") };
    assert_eq!(bars.iter().map(|bar| bar.label.as_str()).collect::<Vec<_>>(), ["Persp 64", "Tiled 16"]);
    assert!(close(bars[0].parts[0].1, 2.4) && close(bars[0].parts[1].1, 13.0) && bars[0].interval.is_some());
    let Some(Plot::Lines(series)) = &charts[1].panels[2] else { panic!("lines") };
    assert_eq!(series.iter().map(|series| series.look.dots).collect::<Vec<_>>(), [true, true, false, false]);
    assert!(series[0].points.iter().zip(&series[2].points).all(|(dot, line)| close(dot[1], line[1])));
    for (figure, marks) in figures.iter().zip([12, 3 * 2 * 4, 12]) {
        let svg = figure.chart.as_ref().unwrap().svg_file(&figure.id, &figure.title);
        assert_well_formed(&svg);
        assert_eq!(svg.matches("class=\"mark-").count(), marks, "{}", figure.id);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", figure.id);
    }
}

#[test]
fn a_line_is_drawn_from_where_it_is_above_zero() {
    let bent = |lights, time| growing("tiled-16", lights, [time, 0.0]);
    let set = set(vec![bent(100, 3.0), bent(1000, 5.0), bent(4000, 100.0)]);
    let figures = figures(&set).unwrap();
    let Some(Plot::Lines(series)) = &figures[1].chart.as_ref().unwrap().panels[2] else { panic!("lines") };
    let points = &series[1].points;
    assert!(points.iter().all(|point| point[1] >= 0.0) && points[0][0] > 100.0 && points[0][1] == 0.0);
}

/// (method, class) of a ranking.
fn classes<'a>(table: &'a Table, by: &str) -> Vec<(&'a str, f64)> {
    let rows = table.rows.iter().filter(|row| row.labels[0] == by);
    rows.map(|row| (row.labels[1].as_str(), row.numbers[0].unwrap())).collect()
}

#[test]
fn what_measuring_cannot_tell_apart_shares_a_class() {
    let with_noise = |method: &str, time: f64, factors| {
        timed(run(method, 1, 1000, move |_, _| Some(time)), metric::FRAME, factors)
    };
    let set = set(vec![
        with_noise("tiled-16", 10.0, [1.0, 1.001, 1.002]),
        with_noise("indi-persp-64", 10.2, [1.3, 1.0, 1.1]),
        with_noise("indi-ortho-4", 90.0, [1.0, 1.001, 1.002]),
    ]);
    let ranked = table(&set, "analysis-classes");
    assert_eq!(
        classes(&ranked, "mean time, 1000 lights (ms)"),
        [("Tiled 16", 1.0), ("Persp 64", 1.0), ("Ortho 4", 2.0)]
    );
}

#[test]
fn the_worst_scene_decides_among_methods_that_were_everywhere() {
    let elsewhere = |mut run: Run| {
        run.setting.scene = "temple".into();
        run
    };
    let at = |method, time| growing(method, 1000, [time, 0.0]);
    let set = set(vec![
        at("tiled-16", 5.0),
        at("indi-persp-64", 8.0),
        at("indi-ortho-4", 1.0),
        elsewhere(at("tiled-16", 20.0)),
        elsewhere(at("indi-persp-64", 9.0)),
    ]);
    let ranked = table(&set, "analysis-classes");
    let by = "mean time, 1000 lights (ms)";
    assert_eq!(classes(&ranked, by), [("Persp 64", 1.0), ("Tiled 16", 2.0)]);
    assert!(
        ranked.rows.iter().filter(|row| row.labels[0] == by).all(|row| row.labels[2] == "temple (bistro)")
    );
    assert!(
        ranked.rows[0].setting.starts_with("street and temple, recording bistro"),
        "{}",
        ranked.rows[0].setting
    );
}

#[test]
fn runs_without_times_have_no_analysis() {
    let untimed = set(vec![run("tiled-16", 1, 1000, |name, _| (!name.starts_with("gpu_ms")).then_some(1.0))]);
    assert!(tables(&untimed).is_empty());
    assert!(figures(&untimed).unwrap().iter().all(|figure| figure.chart.is_none()));
}
