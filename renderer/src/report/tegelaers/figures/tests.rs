//! What is drawn of results, and what is said where there are none.

use super::all;
use crate::methods::Method;
use crate::output::write_png;
use crate::report::chart::{Chart, Plot, Series};
use crate::report::figure::Figure;
use crate::report::results::{Picture, Run};
use crate::report::tegelaers::evaluation::Pipeline;
use crate::report::tegelaers::testing::{SIDES, costs, elsewhere, everything};
use crate::report::testing::{assert_well_formed, set};
use image::RgbImage;
use std::path::Path;

/// Everything in two scenes, with one frame for all runs, heat maps by method, and looks from runs of brute force.
fn results(directory: &Path) -> Vec<Run> {
    let written = |name: &str| {
        let path = directory.join(name);
        if !path.is_file() {
            write_png(&path, &RgbImage::from_pixel(16, 16, image::Rgb([1, 2, 3]))).unwrap();
        }
        path
    };
    let mut street = everything(costs);
    for run in &mut street {
        let ([side, _], lights) = (run.setting.resolution, run.lighting.count.unwrap());
        let [naive, deferred] = [run.method == Method::AllLights, Pipeline::of(run) == Pipeline::Deferred];
        run.pictures = [300, 580]
            .map(|frame| Picture {
                frame,
                image: written(&format!("{frame}_{lights}_{side}.png")),
                share: Some(written(&format!("{frame}_{}_{side}_share.png", run.method))),
                plan: naive.then(|| written("plan.png")),
                gbuffer: (naive && deferred).then(|| written("gbuffer.png")),
                ..Picture::default()
            })
            .into();
    }
    let hall = street.clone().into_iter().map(elsewhere);
    hall.chain(street.clone()).collect()
}

fn all_figures() -> Vec<Figure> {
    let directory = tempfile::tempdir().unwrap();
    all(&set(results(directory.path()))).unwrap()
}

fn chart(figures: &[Figure], id: &str) -> Chart {
    let figure = figures.iter().find(|figure| figure.id == id).unwrap_or_else(|| panic!("no {id}"));
    figure.chart.clone().unwrap_or_else(|| panic!("{id} is not drawn: {}", figure.caption))
}

fn lines(chart: &Chart, panel: usize) -> Vec<Series> {
    let Some(Plot::Lines(series)) = &chart.panels[panel] else { panic!("lines") };
    series.clone()
}

fn labels(chart: &Chart) -> Vec<&str> {
    chart.legend.iter().map(|key| key.label.as_str()).collect()
}

fn note(chart: &Chart, panel: usize) -> &str {
    &chart.notes[panel][0].label
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6 * b.abs()
}

#[test]
fn every_figure_is_drawn_from_an_evaluation() {
    let figures = all_figures();
    assert!(figures.windows(2).all(|pair| number(&pair[0]) < number(&pair[1])), "in the thesis's order");
    for figure in &figures {
        assert!(!figure.caption.contains("  ") && !figure.title.contains("  "), "{}", figure.caption);
        let svg = chart(&figures, &figure.id).svg_file(&figure.id, &figure.title);
        assert_well_formed(&svg);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", figure.id);
        assert!(svg.contains("class=\"mark-") || svg.contains("<image"), "{}", figure.id);
    }
    let tiles = figures.iter().find(|figure| figure.id == "T5.9").unwrap();
    assert_eq!(tiles.setting, "hall and street, recording hall and bistro, mono, several resolutions");
}

/// Chapter and number.
fn number(figure: &Figure) -> [u32; 2] {
    let (chapter, rest) = figure.id.strip_prefix('T').unwrap().split_once('.').unwrap();
    [chapter, rest].map(|text| text.parse().unwrap())
}

#[test]
fn without_results_all_but_what_is_computed_say_what_they_need() {
    let figures = all(&set(vec![])).unwrap();
    let drawn: Vec<&str> =
        figures.iter().filter(|figure| figure.chart.is_some()).map(|figure| figure.id.as_str()).collect();
    assert_eq!(drawn, ["T2.12", "T3.1", "T3.5"]);
    for figure in figures.iter().filter(|figure| figure.chart.is_none()) {
        assert!(figure.caption.starts_with("Not enough data: needs "), "{}", figure.caption);
    }
    let forward = figures.iter().find(|figure| figure.id == "T7.37").unwrap();
    assert_eq!(
        forward.caption,
        "Not enough data: needs temporal runs of all-lights, tiled-mm and hashed with pipeline forward, under two numbers of lights at \
         least."
    );
}

#[test]
fn frames_are_drawn_in_two_corners() {
    let frames = chart(&all_figures(), "T5.5");
    assert_eq!(frames.columns, ["hall (hall)", "street (bistro)"]);
    assert_eq!(frames.rows, ["few lights and pixels", "many lights and pixels"]);
    assert_eq!([note(&frames, 0), note(&frames, 3)], ["60 lights, 160 × 160", "1200 lights, 640 × 640"]);
    assert_eq!(labels(&frames), ["Naive", "Tiled MM 32"]);
    let tiled = &lines(&frames, 3)[1];
    let ms = 0.3 + 0.4096 * (0.5 + 4.0 * 1200.0);
    assert!(close(tiled.points[1][1], ms * 1.6) && tiled.points[1][0] == 300.0, "{tiled:?}");
}

/// Names of the files of a chart's pictures, row by row.
fn files(chart: &Chart) -> Vec<String> {
    let name = |panel: &Option<Plot>| match panel {
        Some(Plot::Picture(picture)) => {
            Path::new(&picture.file).file_name().unwrap().to_str().unwrap().to_owned()
        }
        other => panic!("a picture, not {other:?}"),
    };
    chart.panels.iter().map(name).collect()
}

#[test]
fn scenes_are_shown_with_plans_and_gbuffers() {
    let figures = all_figures();
    let scenes = chart(&figures, "T3.2");
    assert_eq!(scenes.rows, ["hall (hall)", "street (bistro)"]);
    assert_eq!(scenes.columns, ["first", "last", "lights from above"]);
    assert_eq!(files(&scenes), ["300_60_640.png", "580_60_640.png", "plan.png"].repeat(2));
    assert_eq!(files(&chart(&figures, "T4.3")), ["gbuffer.png"; 2]);
}

#[test]
fn columns_that_no_scene_has_are_left_out() {
    let directory = tempfile::tempdir().unwrap();
    let mut runs = results(directory.path());
    runs.iter_mut().flat_map(|run| &mut run.pictures).for_each(|picture| picture.plan = None);
    let scenes = chart(&all(&set(runs.clone())).unwrap(), "T3.2");
    assert_eq!(files(&scenes), ["300_60_640.png", "580_60_640.png"].repeat(2));
    runs.iter_mut().for_each(|run| run.pictures.truncate(1));
    let scenes = chart(&all(&set(runs)).unwrap(), "T3.2");
    assert_eq!(scenes.columns, ["first"]);
    assert_eq!(files(&scenes), ["300_60_640.png"; 2]);
}

#[test]
fn heat_maps_are_of_each_method_with_the_most_lights_and_pixels() {
    let directory = tempfile::tempdir().unwrap();
    let mut runs = results(directory.path());
    // The largest images are of too few methods.
    let is_tile = |run: &Run| run.method.to_string().starts_with("tiled-mm-");
    for run in runs.iter_mut().filter(|run| run.setting.resolution[0] == SIDES[2] && is_tile(run)) {
        run.pictures.clear();
    }
    let figures = all(&set(runs)).unwrap();
    let tiles = chart(&figures, "T5.8");
    assert_eq!(tiles.columns, ["frame", "Tiled MM 8", "Tiled MM 16", "Tiled MM 32"]);
    let shown = ["300_60_640.png", "300_tiled-mm-8_320_share.png", "300_tiled-mm-16_320_share.png"];
    assert_eq!(files(&tiles)[..3], shown);
    let clusters = chart(&figures, "T6.10");
    assert_eq!(clusters.columns, ["frame", "Tiled MM 32", "Clustered MM 16", "Clustered MM 32"]);
    assert_eq!(files(&clusters)[3], "300_clustered-mm-32_320_share.png");
    let nodes = chart(&figures, "T7.29");
    assert_eq!(nodes.columns[1..], [0.25, 0.5, 1.0, 2.0, 3.0].map(|radii| format!("Hashed {radii} 3")));
    assert_eq!(files(&nodes)[1], "300_hashed-0.25-3_640_share.png");
    let Some(Plot::Picture(picture)) = &nodes.panels[1] else { panic!("a picture") };
    assert!(picture.alt.ends_with("by hashed-0.25-3, 1200 lights, 640 × 640"), "{}", picture.alt);
}

#[test]
fn pipelines_are_drawn_together() {
    let over_lights = chart(&all_figures(), "T4.7");
    assert_eq!(labels(&over_lights), ["Naive, forward", "Naive, deferred"]);
    assert_eq!(note(&over_lights, 0), "640 × 640");
    let [forward, deferred] = &lines(&over_lights, 0)[..] else { panic!("two") };
    assert!(deferred.look.dashed && !forward.look.dashed);
    let xs = |series: &Series| series.points.iter().map(|point| point[0]).collect::<Vec<_>>();
    assert_eq!(xs(forward), [60.0, 300.0, 1200.0]);
    assert!(close(forward.points[2][1], 0.3 + 0.4096 * (0.5 + 16.0 * 1200.0)), "{forward:?}");
}

#[test]
fn means_over_pixels_are_under_most_lights_and_a_row_a_pipeline() {
    let over_pixels = chart(&all_figures(), "T5.12");
    assert_eq!(over_pixels.rows, ["frame ms (forward)", "frame ms (deferred)"]);
    assert_eq!(labels(&over_pixels), ["Naive", "Tiled MM 8", "Tiled MM 16", "Tiled MM 32"]);
    assert_eq!(note(&over_pixels, 0), "1200 lights");
    let xs: Vec<f64> = lines(&over_pixels, 2)[3].points.iter().map(|point| point[0]).collect();
    assert_eq!(xs, [25_600.0, 102_400.0, 409_600.0]);
    let counted = chart(&all_figures(), "T7.42");
    assert_eq!(counted.rows, ["computations (deferred)"]);
    let all = ["Naive", "Tiled MM 32", "Clustered MM 32", "Hashed 0.25 3", "Hashed 0.5 3", "Hashed 1 3"];
    assert_eq!(labels(&counted), all);
}

#[test]
fn without_a_deferred_pipeline_computations_are_the_forward_ones() {
    let forward: Vec<Run> =
        everything(costs).into_iter().filter(|run| run.setting.way == Default::default()).collect();
    let figures =
        all(&set(forward.into_iter().map(|run| Run { pictures: vec![], ..run }).collect())).unwrap();
    assert_eq!(chart(&figures, "T5.10").rows, ["computations (forward)"]);
    let frames = figures.iter().find(|figure| figure.id == "T5.7").unwrap();
    assert!(frames.caption.ends_with("Pipeline: forward."), "{}", frames.caption);
    assert!(figures.iter().any(|figure| figure.id == "T5.6" && figure.chart.is_none()));
}

#[test]
fn fragments_are_told_over_pixels() {
    let overdraw = chart(&all_figures(), "T4.1");
    assert!(lines(&overdraw, 0)[0].points.iter().all(|point| close(point[1], 2.5)));
    assert_eq!(note(&overdraw, 0), "60 lights, 640 × 640");
}

#[test]
fn parts_of_a_frame_make_the_whole() {
    let parts = chart(&all_figures(), "T6.8");
    let Some(Plot::Stack(stack)) = &parts.panels[0] else { panic!("stack") };
    let whole: f64 = stack.parts.iter().map(|part| part.points[1][1]).sum();
    assert!(close(whole, (0.3 + 0.4096 * (0.5 + 1200.0)) * 1.1), "{whole}");
    assert_eq!(stack.parts.len(), 5);
}

#[test]
fn nodes_are_lines_a_set_of_lights_or_a_starting_depth() {
    let figures = all_figures();
    let by_lights = chart(&figures, "T7.28");
    assert_eq!(labels(&by_lights), ["fewest lights", "set 2", "most lights"]);
    let most = &lines(&by_lights, 0)[2];
    assert_eq!(most.name, "1200 lights");
    let sizes: Vec<f64> = most.points.iter().map(|point| point[0]).collect();
    assert_eq!(sizes, [0.25, 0.5, 1.0, 2.0, 3.0]);
    assert!(close(most.points[0][1], 640.0 * 640.0 * (9.0 + 0.125 * 1200.0)), "{most:?}");
    let by_depth = chart(&figures, "T7.33");
    assert_eq!(labels(&by_depth), ["depth 1", "depth 3"]);
    let points = |line: usize| lines(&by_depth, 0)[line].points.len();
    assert_eq!([points(0), points(1)], [2, 5]);
}

#[test]
fn nodes_are_drawn_with_the_pixels_that_most_sizes_were_measured_with() {
    let mut runs = everything(costs);
    let is_usual = |run: &Run| ["hashed-0.25-3", "hashed-0.5-3"].contains(&&*run.method.to_string());
    runs.retain(|run| run.setting.resolution[0] != SIDES[2] || is_usual(run));
    runs.iter_mut().for_each(|run| run.pictures.clear());
    let figure = chart(&all(&set(runs)).unwrap(), "T7.28");
    assert_eq!(note(&figure, 0), "320 × 320");
    let sizes: Vec<f64> = lines(&figure, 0)[2].points.iter().map(|point| point[0]).collect();
    assert_eq!(sizes, [0.25, 0.5, 1.0, 2.0, 3.0]);
}

#[test]
fn octrees_are_drawn_by_node_step_layer_and_seed() {
    let figures = all_figures();
    let building = chart(&figures, "T7.18");
    let most = &lines(&building, 0)[2].points;
    assert!(most[0] == [0.25, 4.0 * 64.0 * 1200.0] && most[2] == [1.0, 4.0 * 1200.0], "{most:?}");
    let steps = chart(&figures, "T7.19");
    assert_eq!((labels(&steps), steps.rows.len()), (vec!["hash layers", "light octrees"], 2));
    assert_eq!([note(&steps, 0), note(&steps, 2)], ["60 lights", "1200 lights"]);
    let sides = chart(&figures, "T7.22");
    assert_eq!(sides.rows, ["m of structure", "r of structure", "m of data", "r of data"]);
    let data = lines(&sides, 4);
    let deepest = data.last().unwrap();
    assert_eq!((deepest.name.as_str(), deepest.points[0]), ("depth 10", [0.25, 400.0]));
    assert_eq!(lines(&chart(&figures, "T7.17"), 0)[0].points[0], [0.25, 10.0]);
    let seeds = chart(&figures, "T7.15");
    assert_eq!(lines(&seeds, 0)[0].points.iter().map(|point| point[0]).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
    assert_eq!(labels(&chart(&figures, "T7.16")), ["depth  7", "depth  8", "depth  9"]);
}
