//! How clusters lie (4.8): what the camera sees, and the same from above.

use crate::Result;
use crate::report::chart::{Chart, Plot};
use crate::report::pictures::{Kind, nearest, order, shown};
use crate::report::results::{Picture, ResultSet, Run, Setting, is_tuned, method_name};

/// Two columns a frame, a row a tuned method; `None` where nothing was drawn from above. Clusters do not depend on lights.
pub fn clusters(set: &ResultSet, setting: &Setting, wanted: &[u32]) -> Result<Option<Chart>> {
    let is_seen = |run: &&Run| is_tuned(run.method) && run.pictures.iter().any(|p| p.birdseye.is_some());
    let mut runs: Vec<&Run> = set.of(setting).filter(is_seen).collect();
    runs.sort_by_key(|run| order(run.method));
    runs.dedup_by_key(|run| run.method);
    let frames = nearest(wanted, &runs);
    if frames.is_empty() {
        return Ok(None);
    }
    let heading = |frame: &u32| [format!("Frame {frame}"), format!("Frame {frame} from above")];
    let mut chart = Chart {
        names: ["method", "seen", "picture", "number"],
        columns: frames.iter().flat_map(heading).collect(),
        ..Chart::default()
    };
    for run in runs {
        chart.rows.push(method_name(run.method, setting.is_stereo()));
        for &frame in &frames {
            chart.panels.extend(pair(run, frame)?);
        }
    }
    Ok(Some(chart))
}

/// A frame's clusters from the camera and from above.
fn pair(run: &Run, frame: u32) -> Result<[Option<Plot>; 2]> {
    let picture = run.pictures.iter().find(|picture| picture.frame == frame);
    let plot = |path: fn(&Picture) -> Option<&std::path::PathBuf>, seen: &str| {
        let Some(path) = picture.and_then(path) else { return Ok(None) };
        shown(path, frame, format!("Clusters of frame {frame} by {}, {seen}", run.method), Kind::Drawing)
            .map(Some)
    };
    Ok([
        plot(|picture| picture.clusters.as_ref(), "as the camera sees them")?,
        plot(|picture| picture.birdseye.as_ref(), "from above")?,
    ])
}
