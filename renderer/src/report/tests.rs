//! Figures, charts and the page, on made-up runs.

use super::chart::{Chart, Heat, Key, Look, Plot, Series, Stack, palette};
use super::results::{Run, metric};
use super::testing::{FRAMES, assert_well_formed, run, set};
use super::{claims, figures, page};

fn measured(name: &str, frame: u32) -> Option<f64> {
    Some(match name {
        metric::FRAME => 10.0,
        metric::CLUSTER => 4.0,
        metric::SHADE => 5.0,
        metric::VISIBILITY => 1.5,
        metric::COUNT | metric::ASSIGN => 1.0,
        _ => 100.0 + f64::from(frame),
    })
}

/// Everything that the figures of chapter 6 need.
fn everything() -> Vec<Run> {
    let mono = [
        "indi-persp-16",
        "indi-persp-64",
        "indi-ortho-4",
        "indi-ortho-16",
        "indi-displ-64-8",
        "indi-displ-64-32",
    ];
    let stereo = ["indi-persp-64", "encl-persp-64", "indi-ortho-4", "encl-ortho-4"];
    let of = |methods: &[&str], views| -> Vec<Run> {
        let pairs = methods.iter().flat_map(|method| [1000, 10_000].map(|lights| (*method, lights)));
        pairs.map(|(method, lights)| run(method, views, lights, measured)).collect()
    };
    [of(&mono, 1), of(&stereo, 2)].concat()
}

fn ids(runs: Vec<Run>, drawn: bool) -> Vec<String> {
    let figures = figures(&set(runs)).unwrap();
    figures.into_iter().filter(|figure| figure.chart.is_some() == drawn).map(|figure| figure.id).collect()
}

#[test]
fn figures_are_drawn_from_what_there_is() {
    let all =
        ["4.7", "6.2", "6.3", "6.4", "6.5", "6.6", "6.7", "6.8", "6.9", "6.10", "A.1", "A.2", "A.3", "A.4"];
    assert_eq!(ids(everything(), true), all);
    assert_eq!(ids(everything(), false), ["4.8", "6.1", "C.1", "C.2", "C.3", "C.4"]);
    let untimed = |name: &str, frame| measured(name, frame).filter(|_| !name.starts_with("gpu_ms"));
    let one = vec![run("indi-persp-64", 1, 1000, untimed)];
    assert_eq!(ids(one, true), ["4.7", "6.6", "6.9", "6.10", "A.1", "A.2", "A.3", "A.4"]);
}

#[test]
fn scenes_go_to_their_chapter() {
    let mut runs = everything();
    for run in &mut runs {
        run.setting.scene = "temple".into();
        run.setting.recording = "suntem".into();
    }
    let drawn = ids(runs, true);
    assert_eq!(drawn[..7], ["4.7", "A.1", "A.2", "A.3", "A.4", "C.3", "C.4"]);
    assert!(drawn.contains(&"C-6.5".to_owned()));
}

#[test]
fn further_settings_get_figures_of_their_own() {
    let mut runs = everything();
    let mut larger = everything();
    larger.iter_mut().for_each(|run| run.setting.resolution = [640, 360]);
    runs.extend(larger);
    assert!(ids(runs, true).contains(&"6.2-2".to_owned()));
}

#[test]
fn sweeps_have_a_column_a_lighting_and_a_line_a_size() {
    let figures = figures(&set(everything())).unwrap();
    let chart = figures.iter().find(|figure| figure.id == "6.4").unwrap().chart.as_ref().unwrap();
    assert_eq!(chart.columns, ["1000 lights", "10000 lights"]);
    assert_eq!(
        chart.rows,
        ["Visible clusters", "Clustering (ms)", "Lighting comp.", "Shading (ms)", "Total (ms)"]
    );
    assert_eq!(
        chart.legend.iter().map(|key| key.label.as_str()).collect::<Vec<_>>(),
        ["Displ 64 8", "Displ 64 32"]
    );
    assert_eq!(chart.legend.iter().map(|key| key.look.bold).collect::<Vec<_>>(), [false, true]);
    let Some(Plot::Lines(series)) = &chart.panels[0] else { panic!("lines") };
    assert_eq!(series[1].points[1], [300.0, 400.0]);
}

#[test]
fn breakdowns_add_up_to_the_whole() {
    let figures = figures(&set(everything())).unwrap();
    for (id, whole, rest) in [("6.7", 10.0, 1.0), ("6.8", 4.0, 0.5)] {
        let chart = figures.iter().find(|figure| figure.id == id).unwrap().chart.as_ref().unwrap();
        let Some(Plot::Stack(Stack { parts, top })) = &chart.panels[0] else { panic!("a stack") };
        assert_eq!(parts.iter().map(|part| part.points[0][1]).sum::<f64>(), whole);
        assert_eq!((parts.last().unwrap().points[0][1], *top), (rest, whole));
    }
}

fn sample() -> Chart {
    let look = Look::plain("blue");
    let points = FRAMES.map(|frame| [f64::from(frame), f64::from(frame) * 2.0]).to_vec();
    let series = |name: &str| Series { name: name.into(), look, points: points.clone() };
    let heat = Heat {
        x: vec![0.0, 10.0],
        counts: vec![vec![1, 0, 7], vec![]],
        rows: 12,
        most: 7,
        mark: Some((8, "8 < 9".into())),
    };
    Chart {
        names: ["row", "column", "series", "frame"],
        columns: vec!["a & b".into(), "c".into()],
        rows: vec!["<r>".into(), "s".into()],
        panels: vec![
            Some(Plot::Lines(vec![series("one"), Series { points: vec![[3.0, 4.0]], ..series("lone") }])),
            None,
            Some(Plot::Stack(Stack { parts: vec![series("low"), series("high")], top: 9000.0 })),
            Some(Plot::Heat(heat)),
        ],
        x_label: "frame".into(),
        legend: vec![Key { label: "\"quoted\"".into(), look }],
        ..Chart::default()
    }
}

#[test]
fn drawings_are_well_formed_and_need_nothing_else() {
    let file = sample().svg_file("id", "a < b");
    assert_well_formed(&file);
    assert!(!file.contains("var(--"), "the colours are in the file");
    assert!(!file.contains("NaN"));
    for (mark, count) in [("mark-line", 2), ("mark-area", 2), ("mark-heat", 1)] {
        assert_eq!(file.matches(mark).count(), count, "{mark}");
    }
}

#[test]
fn the_csv_holds_what_is_drawn() {
    let mut csv = vec![];
    sample().write_csv(&mut csv).unwrap();
    let text = String::from_utf8(csv).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "row,column,series,frame,value");
    assert_eq!(lines[2], "<r>,a & b,one,300,600");
    assert!(lines.contains(&"s,c,2,0,7"));
    assert_eq!(lines.len(), 1 + 5 + 1 + 10 + 2);
}

#[test]
fn colours_go_from_little_to_much() {
    assert_eq!([0, 8].map(|index| palette::ordered(index, 9)), ["q0", "q8"]);
    assert_eq!(palette::ordered(0, 1), "q4");
    assert_eq!(palette::viridis(0.0), [68, 1, 84]);
    assert_eq!(palette::viridis(2.0), [253, 231, 37]);
    assert_eq!([1, 10, 100].map(|count| palette::logarithmic(count, 100)), [0.0, 0.5, 1.0]);
    assert!(!palette::plain_rules().contains("var("));
}

#[test]
fn the_page_is_one_file_without_links_to_others() {
    let mut runs = everything();
    runs[0].setting.scene = "</script><b>".into();
    let set = set(runs);
    let figures = figures(&set).unwrap();
    let claims = claims(&set);
    let content = page::Content { figures: &figures, claims: &claims, ..Default::default() };
    let html = page::html(&set, &content);
    assert!(!html.contains("</script><b>"), "names are escaped");
    for outside in ["src=\"", "@import", "<link rel=\"stylesheet", "href=\"http", "url(http"] {
        assert!(!html.contains(outside), "{outside}");
    }
    for figure in figures {
        assert!(html.contains(&format!("data-figure=\"{}\"", figure.id)), "{}", figure.id);
    }
}

#[test]
fn the_table_of_runs_has_every_metric() {
    let mut csv = vec![];
    page::write_runs_csv(&mut csv, &set(vec![run("indi-ortho-4", 1, 1000, measured)])).unwrap();
    let text = String::from_utf8(csv).unwrap();
    assert_eq!(text.lines().count(), 1 + 12);
    let line = text.lines().find(|line| line.contains("visible_clusters")).unwrap();
    assert!(line.ends_with("visible_clusters,516,660,728,238.461737,,"), "{line}");
}
