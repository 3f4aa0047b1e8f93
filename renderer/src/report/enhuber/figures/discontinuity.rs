//! A view of little and one of much depth discontinuity (4.9), and how many lights their groups hold (4.10, 4.11).

use crate::Result;
use crate::report::analysis::groups;
use crate::report::chart::{Chart, Plot};
use crate::report::enhuber::evaluation::{Evaluation, Scene, name};
use crate::report::pictures::{Kind, shown};
use crate::report::results::Run;

/// What the first and the second of two frames are.
const OF_TWO: [&str; 2] = ["least", "most"];

/// The frames of least and most discontinuity; `None` where nothing was rendered to files.
///
/// # Errors
/// A picture cannot be read.
pub fn views(evaluation: &Evaluation<'_>, scene: &Scene<'_>) -> Result<Option<Chart>> {
    let pictured = ["t-e", "sc-e", "g", "m"].iter().find_map(|kind| pictured(evaluation, scene, kind));
    let Some(run) = pictured else { return Ok(None) };
    let mut chart =
        Chart { names: ["row", "view", "picture", "number"], rows: vec![String::new()], ..Chart::default() };
    for (frame, heading) in headings(run) {
        let picture = run.pictures.iter().find(|picture| picture.frame == frame);
        let alt = format!("Frame {frame} of {}", scene.setting.scene);
        let plot = picture.map(|picture| shown(&picture.image, frame, alt, Kind::Photo)).transpose()?;
        chart.columns.push(heading);
        chart.panels.push(plot);
    }
    Ok(Some(chart))
}

/// Lights of each pixel's group, and groups by lights: two rows a kind; `None` where nothing is known of them.
///
/// # Errors
/// A picture cannot be read.
pub fn lights(evaluation: &Evaluation<'_>, scene: &Scene<'_>, kinds: [&str; 2]) -> Result<Option<Chart>> {
    let mut chart = Chart {
        names: ["view", "shown", "lights", "from"],
        columns: vec!["Lights of each pixel's group".into(), "Groups by lights".into()],
        x_label: "lights".into(),
        ..Chart::default()
    };
    for run in kinds.iter().filter_map(|kind| pictured(evaluation, scene, kind)) {
        for (frame, heading) in headings(run) {
            let panels: [Option<Plot>; 2] = groups::panels(run, frame)?;
            if panels.iter().any(Option::is_some) {
                chart.rows.push(format!("{}, {heading}", name(run.method)));
                chart.panels.extend(panels);
            }
        }
    }
    Ok((!chart.rows.is_empty()).then_some(chart))
}

/// The run of a kind under many lights, where frames of it were rendered to files.
fn pictured<'a>(evaluation: &Evaluation<'a>, scene: &Scene<'a>, kind: &str) -> Option<&'a Run> {
    let run = scene.run(evaluation.chosen(kind)?, evaluation.many()?)?;
    (!run.pictures.is_empty()).then_some(run)
}

/// The frames of least and most discontinuity, with what they are called.
fn headings(run: &Run) -> Vec<(u32, String)> {
    let frames = run.extremes();
    let what = |place: usize| if frames.len() > 1 { format!(" ({})", OF_TWO[place]) } else { String::new() };
    frames
        .iter()
        .enumerate()
        .map(|(place, &frame)| (frame, format!("frame {frame}{}", what(place))))
        .collect()
}
