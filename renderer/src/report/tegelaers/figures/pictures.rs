//! Frames of the scenes (3.2 to 3.4).

use crate::Result;
use crate::report::chart::Chart;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::pictures::{Kind, shown};
use crate::report::results::Run;
use crate::report::tegelaers::evaluation::{Evaluation, Scene};

const SCENES: Wanted<'static> = Wanted {
    id: "T3.2",
    title: "Scenes",
    caption: "The first and the last of the frames that were rendered to files, tone-mapped, under the most lights.",
    missing: "needs rendered frames: replay with --exr and frame numbers",
};

/// A figure an evaluation: a row a scene.
///
/// # Errors
/// A picture cannot be read.
pub fn scenes(evaluations: &[Evaluation<'_>]) -> Result<Vec<Figure>> {
    let mut drawn = vec![];
    for evaluation in evaluations {
        let mut chart = Chart {
            names: ["scene", "frame", "picture", "number"],
            columns: ["first", "last"].map(str::to_owned).into(),
            ..Chart::default()
        };
        for scene in &evaluation.scenes {
            let Some(run) = pictured(scene) else { continue };
            chart.rows.push(scene.name());
            for picture in [run.pictures.first(), run.pictures.last()].into_iter().flatten() {
                let alt = format!("Frame {} of {}", picture.frame, scene.setting.scene);
                chart.panels.push(Some(shown(&picture.image, picture.frame, alt, Kind::Photo)?));
            }
        }
        if !chart.rows.is_empty() {
            drawn.push(Drawn { setting: &evaluation.setting, chart, remark: String::new() });
        }
    }
    Ok(figures(&SCENES, drawn))
}

/// Of the runs with pictures that of the most pixels and lights, for all methods give the same.
fn pictured<'a>(scene: &Scene<'a>) -> Option<&'a Run> {
    let pictured = scene.cases.iter().filter(|case| !case.run.pictures.is_empty());
    pictured.max_by_key(|case| (case.pixels, case.lights)).map(|case| case.run)
}
