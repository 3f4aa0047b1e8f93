//! Frames of the scenes with plans of their lights (3.2 to 3.4), and what G-buffers hold (4.3).

use crate::Result;
use crate::report::chart::Chart;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::pictures::{Kind, shown};
use crate::report::results::{Picture, Run};
use crate::report::tegelaers::evaluation::{Evaluation, Scene};
use std::cmp::Reverse;
use std::path::Path;

const SCENES: Wanted<'static> = Wanted {
    id: "T3.2",
    title: "Scenes",
    caption: "The first and the last of the frames that were rendered to files, tone-mapped, under the fewest lights; and the \
              volumes of these from above, with the camera's frustum in green.",
    missing: "needs rendered frames: replay with --exr and frame numbers",
};

const GBUFFERS: Wanted<'static> = Wanted {
    id: "T4.3",
    title: "G-buffers",
    caption: "What the deferred pipeline shades from: base colours, normals (their axes as red, green and blue), and depth, where what is \
              nearest is white.",
    missing: "needs rendered frames of all-lights with pipeline deferred: replay with --exr and frame numbers",
};

/// A column of a figure: what it is called, whether it is a photo, and its picture among those of a run.
type Column = (&'static str, Kind, fn(&Run) -> Option<(&Picture, &Path)>);

/// A figure an evaluation: a row a scene.
///
/// # Errors
/// A picture cannot be read.
pub fn scenes(evaluations: &[Evaluation<'_>]) -> Result<Vec<Figure>> {
    let columns: [Column; 3] = [
        ("first", Kind::Photo, |run| run.pictures.first().map(|picture| (picture, picture.image.as_path()))),
        ("last", Kind::Photo, |run| {
            let last = run.pictures.last().filter(|_| run.pictures.len() > 1);
            last.map(|picture| (picture, picture.image.as_path()))
        }),
        ("lights from above", Kind::Photo, |run| {
            let picture = run.pictures.first()?;
            Some((picture, picture.plan.as_deref()?))
        }),
    ];
    by_scene(evaluations, &SCENES, &columns)
}

/// A figure an evaluation: a row a scene.
///
/// # Errors
/// A picture cannot be read.
pub fn gbuffers(evaluations: &[Evaluation<'_>]) -> Result<Vec<Figure>> {
    let column: Column = ("base colours, normals, depth", Kind::Drawing, |run| {
        let picture = run.pictures.first()?;
        Some((picture, picture.gbuffer.as_deref()?))
    });
    by_scene(evaluations, &GBUFFERS, &[column])
}

fn by_scene(evaluations: &[Evaluation<'_>], wanted: &Wanted<'_>, columns: &[Column]) -> Result<Vec<Figure>> {
    let mut drawn = vec![];
    for evaluation in evaluations {
        let of_scene = |scene: &Scene<'_>, (_, kind, of): &Column| {
            let found = pictured(scene, *of);
            let plot = found.map(|(picture, path)| {
                let alt = format!("Frame {} of {}", picture.frame, scene.setting.scene);
                shown(path, picture.frame, alt, *kind)
            });
            plot.transpose()
        };
        let row = |scene: &Scene<'_>| columns.iter().map(|column| of_scene(scene, column)).collect();
        let rows: Vec<Vec<_>> = evaluation.scenes.iter().map(row).collect::<Result<_>>()?;
        // A column that no scene has is none.
        let has = |column: usize| rows.iter().any(|row| row[column].is_some());
        let kept: Vec<usize> = (0..columns.len()).filter(|&column| has(column)).collect();
        let named = evaluation.scenes.iter().map(Scene::name).zip(rows);
        let (names, rows): (Vec<String>, Vec<Vec<_>>) =
            named.filter(|(_, row)| row.iter().any(Option::is_some)).unzip();
        if names.is_empty() {
            continue;
        }
        let chart = Chart {
            names: ["scene", "frame", "picture", "number"],
            columns: kept.iter().map(|&column| columns[column].0.to_owned()).collect(),
            rows: names,
            panels: rows.iter().flat_map(|row| kept.iter().map(|&column| row[column].clone())).collect(),
            ..Chart::default()
        };
        drawn.push(Drawn { setting: &evaluation.setting, chart, remark: String::new() });
    }
    Ok(figures(wanted, drawn))
}

/// Of the runs that have a picture that of the fewest lights, for many are too bright for a display, and of the most pixels; all
/// methods give the same.
pub fn pictured<'a, T>(scene: &Scene<'a>, of: impl Fn(&'a Run) -> Option<T>) -> Option<T> {
    let pictured = scene.cases.iter().filter_map(|case| Some((case, of(case.run)?)));
    pictured.max_by_key(|(case, _)| (Reverse(case.lights), case.pixels)).map(|(_, found)| found)
}
