//! What a table says of the run that a row is of.

use crate::config::{AXES, Axis};
use crate::lights::{Generated, GeneratedBox};
use crate::output::Manifest;
use crate::report::Found;
use serde_json::Value;

/// Fields of a run's configuration that are no axes and bear on what it measures; their columns are called as they.
const OPTIONS: [&str; 10] = [
    "light_source",
    "msaa",
    "attenuation",
    "material",
    "marking",
    "displaced_volume",
    "grid_box",
    "culling",
    "multiview",
    "scopes",
];

/// A column with the cell of a run.
type Column = (&'static str, fn(&Manifest) -> String);

/// What else of a run's manifest there is.
const ABOUT: [Column; 17] = [
    ("light_seed", |run| generated(run, |lights| lights.seed.to_string())),
    ("light_motion", |run| generated(run, |lights| lights.motion.clone())),
    ("light_boxes", |run| {
        generated(run, |lights| {
            lights.boxes.iter().map(GeneratedBox::to_string).collect::<Vec<_>>().join("; ")
        })
    }),
    ("intensity", |run| run.intensity().map_or_else(String::new, |intensity| intensity.to_string())),
    ("cutoff", |run| run.lighting.map_or_else(String::new, |lighting| lighting.cutoff.to_string())),
    ("r0", |run| run.lighting.map_or_else(String::new, |lighting| lighting.r0.to_string())),
    ("assigned_by", |run| run.assigned_by.clone()),
    ("width", |run| run.config.resolution[0].to_string()),
    ("height", |run| run.config.resolution[1].to_string()),
    ("device", |run| run.device.name.clone()),
    ("driver", |run| run.device.driver.clone()),
    ("api", |run| run.device.api.clone()),
    ("cpu", |run| run.machine.host.cpu.clone().unwrap_or_default()),
    ("doubts", |run| run.doubts.join("; ")),
    ("version", |run| run.version.clone()),
    ("git_revision", |run| run.git_revision.clone()),
    ("started", |run| run.started.clone()),
];

/// What a run's manifest tells of lights that were made; empty where they were not, or by an earlier version.
fn generated(run: &Manifest, tell: impl Fn(&Generated) -> String) -> String {
    run.generated.as_ref().map_or_else(String::new, tell)
}

/// The columns of every row: where the run lies, its value on each axis, and how it was measured. An axis that is called as
/// one of the columns `measured` has `_axis` behind its name.
pub fn names(measured: &[&str]) -> Vec<String> {
    let axis = |axis: &Axis| match measured.contains(&axis.column) {
        true => format!("{}_axis", axis.column),
        false => axis.column.to_owned(),
    };
    let others = OPTIONS.into_iter().chain(ABOUT.map(|(name, _)| name)).map(str::to_owned);
    ["directory".to_owned()].into_iter().chain(AXES.iter().map(axis)).chain(others).collect()
}

/// The cells of a run below [`names`].
pub fn of(Found { directory, manifest, .. }: &Found) -> Vec<String> {
    let axis = |axis: &Axis| axis.value(&manifest.config);
    // A configuration is written as JSON with every run.
    let config = serde_json::to_value(&manifest.config).unwrap_or_default();
    let option = |name: &str| match &config[name] {
        Value::String(text) => text.clone(),
        value => value.to_string(),
    };
    [directory.display().to_string()]
        .into_iter()
        .chain(AXES.iter().map(axis))
        .chain(OPTIONS.iter().map(|name| option(name)))
        .chain(ABOUT.iter().map(|(_, cell)| cell(manifest)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    #[test]
    fn options_are_fields_of_a_configuration() {
        let config = serde_json::to_value(Config::default()).unwrap();
        assert!(
            OPTIONS.iter().all(|name| config[name].is_string()
                || config[name].is_number()
                || config[name].is_boolean())
        );
    }
}
