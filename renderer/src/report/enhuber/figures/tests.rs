//! What is drawn of results, and what is said where there are none.

use super::all;
use crate::output::write_png;
use crate::report::chart::{Chart, Plot};
use crate::report::enhuber::testing::{costs, elsewhere, everything};
use crate::report::figure::Figure;
use crate::report::results::{Picture, Run, metric};
use crate::report::testing::{FRAMES, assert_well_formed, set, timed};
use image::RgbImage;
use std::path::Path;

/// Everything in two scenes, timed three times, with one picture for all frames.
fn results(directory: &Path) -> Vec<Run> {
    let image = directory.join("frame.png");
    write_png(&image, &RgbImage::from_pixel(32, 18, image::Rgb([1, 2, 3]))).unwrap();
    let shown = |picture: Picture| Picture { image: image.clone(), heat: Some(image.clone()), ..picture };
    let made = |mut run: Run| {
        run.pictures = run.pictures.into_iter().map(shown).collect();
        let factors = [1.0, 1.01, 1.02];
        timed(timed(run, metric::FRAME, factors), metric::SHADE, factors)
    };
    let street: Vec<Run> = everything(costs).into_iter().map(made).collect();
    let hall = street.clone().into_iter().map(elsewhere);
    hall.chain(street.clone()).collect()
}

fn all_figures() -> Vec<Figure> {
    let directory = tempfile::tempdir().unwrap();
    all(&set(results(directory.path()))).unwrap()
}

fn figure(id: &str) -> Figure {
    all_figures().into_iter().find(|figure| figure.id == id).unwrap()
}

fn chart(id: &str) -> Chart {
    figure(id).chart.unwrap_or_else(|| panic!("{id} is not drawn"))
}

fn bars(plot: Option<&Option<Plot>>) -> Vec<(String, f64)> {
    let Some(Some(Plot::Bars(bars))) = plot else { panic!("bars") };
    bars.iter().map(|bar| (bar.label.clone(), bar.parts.iter().map(|part| part.1).sum())).collect()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn every_figure_is_drawn_from_an_evaluation() {
    let figures = all_figures();
    let ids: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
    let wanted = [
        "E4.1",
        "E4.2",
        "E4.3",
        "E4.4",
        "E4.5",
        "E4.6",
        "E4.7",
        "E4.8",
        "E4.9",
        "E4.9-2",
        "E4.10",
        "E4.10-2",
        "E4.11",
        "E4.11-2",
        "E4.12",
        "E4.12-2",
        "E4.13",
        "E4.13-2",
        "E4.13-fit",
        "E4.13-fit-2",
    ];
    assert_eq!(ids, wanted);
    for figure in &figures {
        assert!(!figure.caption.contains("  "), "{}", figure.caption);
        let absent = figure.id == "E4.4";
        assert_eq!(figure.chart.is_none(), absent, "{}: sparse clusters have one size alone", figure.id);
        let Some(chart) = &figure.chart else { continue };
        let svg = chart.svg_file(&figure.id, &figure.title);
        assert_well_formed(&svg);
        assert!(
            svg.contains("class=\"mark-") && !svg.contains("NaN") && !svg.contains("inf"),
            "{}",
            figure.id
        );
    }
    assert_eq!(
        figure("E4.2").setting,
        "hall and street, recording hall and bistro, mono, 320 × 180, light source gamma"
    );
}

#[test]
fn without_results_all_but_what_is_computed_say_what_they_need() {
    let figures = all(&set(vec![])).unwrap();
    assert_eq!(figures.iter().filter(|figure| figure.chart.is_some()).count(), 1, "the density");
    for figure in figures.iter().skip(1) {
        assert!(figure.caption.starts_with("Not enough data: needs "), "{}", figure.caption);
    }
}

#[test]
fn sizes_are_bars_of_assignment_and_shading_a_row_a_scene() {
    let tiles = chart("E4.2");
    assert_eq!(
        (&tiles.rows[..], &tiles.columns[..]),
        (&["hall (hall)".into(), "street (bistro)".into()][..], &["T-I".into(), "T-E".into()][..])
    );
    let of_tiles = bars(tiles.panels.last());
    assert_eq!(of_tiles.iter().map(|bar| bar.0.as_str()).collect::<Vec<_>>(), ["T-E 16", "T-E 28"]);
    assert!(close(of_tiles[0].1, 14.0) && close(of_tiles[1].1, 13.5), "{of_tiles:?}");
    assert_eq!(
        bars(chart("E4.5").panels.first()).iter().map(|bar| bar.0.as_str()).collect::<Vec<_>>(),
        ["G 16", "G 20"]
    );
}

#[test]
fn clusters_are_lines_over_slices_a_line_a_tile() {
    let dense = chart("E4.3");
    let labels: Vec<&str> = dense.legend.iter().map(|key| key.label.as_str()).collect();
    assert_eq!(labels, ["48 px", "64 px", "128 px"]);
    let Some(Plot::Lines(series)) = &dense.panels[0] else { panic!("lines") };
    assert_eq!(series.iter().map(|series| series.name.as_str()).collect::<Vec<_>>(), ["48 px", "128 px"]);
    let points = &series[0].points;
    assert!(points[0][0] == 40.0 && points[1][0] == 64.0 && close(points[0][1], 26.3), "{points:?}");
    assert!(dense.panels[1].is_none(), "DC-E has one size");
    assert!(dense.notes[0][0].label.starts_with("DC-I 128 64: 25.8"), "{:?}", dense.notes[0]);
}

#[test]
fn tests_are_bars_in_the_order_of_the_thesis() {
    for id in ["E4.6", "E4.7"] {
        let tests = chart(id);
        assert_eq!(tests.columns.len(), 2);
        let bars = bars(tests.panels.first());
        assert_eq!(bars.len(), 18, "{id}");
        assert_eq!([&bars[0].0, &bars[1].0, &bars[17].0], ["hs", "hs+sat-n", "hs+sat-epv"]);
        assert!(bars.iter().all(|bar| bar.1 >= bars[1].1), "{bars:?}");
    }
}

#[test]
fn frames_are_lines_a_method_and_models_stand_apart() {
    let frames = chart("E4.8");
    assert_eq!(frames.columns, ["frame time (ms)", "M, frame time (ms)"]);
    let lines = |panel: usize| {
        let Some(Plot::Lines(series)) = &frames.panels[panel] else { panic!("lines") };
        series.clone()
    };
    assert_eq!((lines(0).len(), lines(1).len(), frames.legend.len()), (6, 1, 7));
    let tiles = &lines(0)[0];
    assert_eq!(tiles.name, "T-I 28");
    assert!(
        close(tiles.points[1][1], 42.9 * 1.5) && tiles.points[1][0] == f64::from(FRAMES[1]),
        "{:?}",
        tiles.points
    );
}

#[test]
fn few_and_many_lights_are_panels_and_lines_of_the_seven() {
    let counts = chart("E4.12");
    assert_eq!(counts.columns, ["100 lights", "1000 lights", "10000 lights"]);
    let methods: Vec<String> = bars(counts.panels.first()).into_iter().map(|bar| bar.0).collect();
    assert_eq!(methods, ["T-I 28", "T-E 28", "DC-I 128 64", "SC-I 48 40", "SC-E 48 40", "G 20", "M"]);
    let fit = chart("E4.13-fit");
    let slopes = bars(fit.panels.get(1));
    assert!(slopes[0].0 == "T-I 28" && close(slopes[0].1, 4.0), "{slopes:?}");
    assert!(figure("E4.12").caption.contains("any number of views"));
}

#[test]
fn views_differ_in_discontinuity_and_so_do_the_lights_of_groups() {
    assert_eq!(chart("E4.9").columns, ["frame 300 (least)", "frame 580 (most)"]);
    let sparse = chart("E4.10");
    let rows = [
        "T-E 28, frame 300 (least)",
        "T-E 28, frame 580 (most)",
        "SC-E 48 40, frame 300 (least)",
        "SC-E 48 40, frame 580 (most)",
    ];
    assert_eq!(sparse.rows, rows);
    let columns = |chart: &Chart, row: usize| {
        let Some(Plot::Columns(columns)) = &chart.panels[2 * row + 1] else { panic!("columns") };
        columns.iter().map(|column| (column.label.clone(), column.count)).collect::<Vec<_>>()
    };
    assert_eq!(
        [0, 1].map(|row| columns(&sparse, row)),
        [vec![("0-25".into(), 4)], vec![("26-50".into(), 4)]]
    );
    let world = chart("E4.11");
    assert_eq!((&world.rows[0][..], &world.rows[3][..]), ("G 20, frame 300 (least)", "M, frame 580 (most)"));
    assert_eq!(columns(&world, 0), columns(&world, 1));
}
