//! What a report asks of `run.json`.

use crate::assign::Clusters;
use crate::lights::Lighting;
use crate::methods::Method;
use crate::output::{MANIFEST, Manifest, Source};
use crate::report::format::grouped;
use crate::report::results::{LightingName, Setting};
use crate::report::way::Way;
use crate::{Error, Result};
use std::path::Path;

/// Version and revision of the program that measured.
pub fn built(run: &Manifest) -> String {
    format!("manylight {} ({})", run.version, run.git_revision)
}

/// The method of the run in `directory`.
pub fn method(run: &Manifest, directory: &Path) -> Result<Method> {
    run.method.parse().map_err(|error| Error::file(directory.join(MANIFEST), format!("method: {error}")))
}

/// What it shares with runs that are drawn in one figure.
pub fn setting(run: &Manifest, views: u32, method: Method) -> Result<Setting> {
    Ok(Setting {
        scene: run.scene.name.clone(),
        recording: run.recording.name.clone(),
        views,
        resolution: run.config.resolution,
        msaa: run.config.msaa,
        // The defaults are the thesis's, which go without saying.
        options: run.config.unusual()?,
        hashes: [run.scene.sha256.clone(), run.recording.sha256.clone()],
        way: Way::new(&run.config, method),
    })
}

/// Whether all groups of a run of `method` have lists, not those alone that hold a fragment.
pub fn lists_all(run: &Manifest, method: Method) -> bool {
    run.config.clusters.first().is_some_and(|choice| method.listed(choice.of(&method)) == Clusters::All)
}

/// Where its light came from.
pub fn lighting(run: &Manifest) -> LightingName {
    if let Some(Lighting { count, cutoff, r0, .. }) = run.lighting {
        let mut label = format!("{} lights", grouped(u64::from(count)));
        // The thesis's intensity of each count goes without saying.
        let usual =
            |intensity: f32| matches!((count, intensity), (1000, 100.0) | (10_000, 20.0) | (100_000, 1.0));
        if let Some(intensity) = run.intensity().filter(|intensity| !usual(*intensity)) {
            label += &format!(", I {intensity}");
        }
        for (name, value, usual) in [("I₀", cutoff, 0.5), ("R₀", r0, 0.1)] {
            if value != usual {
                label += &format!(", {name} {value}");
            }
        }
        return LightingName { count: Some(count), label, sha256: None };
    }
    if let Some(Source { name, sha256 }) = &run.lights_file {
        let label = format!("{name} ({sha256:.8})");
        return LightingName { count: None, label, sha256: Some(sha256.clone()) };
    }
    let file = run.config.lights_file.as_ref().map(|path| path.display().to_string());
    LightingName { count: None, label: file.unwrap_or_else(|| "the scene's lights".into()), sha256: None }
}

/// Size of the box around the lights that were made, metres.
pub fn light_box(run: &Manifest) -> Option<[f64; 3]> {
    let boxes = &run.generated.as_ref()?.boxes;
    let corners =
        boxes.iter().map(|one| one.turn.is_none().then_some(one.corners)).collect::<Option<Vec<_>>>()?;
    let around = |axis: usize| {
        let low = corners.iter().map(|one| one.min[axis]).fold(f32::INFINITY, f32::min);
        let high = corners.iter().map(|one| one.max[axis]).fold(f32::NEG_INFINITY, f32::max);
        f64::from(high - low)
    };
    (!corners.is_empty()).then(|| [0, 1, 2].map(around))
}

/// What tells its lights from those of others.
pub fn lights_key(run: &Manifest) -> String {
    let LightingName { label, sha256, .. } = lighting(run);
    sha256.unwrap_or(label)
}
