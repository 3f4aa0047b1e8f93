//! Reading result sets: which runs there are, and the tables of one run.

use crate::Result;
use crate::config::{Axis, Bearing, Config, Role};
use crate::lights::{GeneratorKind, Lighting};
use crate::machine::stretch;
use crate::output::{self, Age, FrameRow, Manifest, Row, Source, each_row, saved_frames};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What a run was asked to do: comparable, and equal for runs that are to be compared.
pub(super) type Identity = Vec<String>;

/// One run as its manifest describes it.
#[derive(Debug)]
pub(super) struct RunEntry {
    pub identity: Identity,
    /// Its value on each axis that is a way of building lists, empty where its method asks for none: beside the others, these tell the
    /// runs of a sweep apart.
    /// Where they need not, runs are joined across them: so two ways or tests are compared.
    pub way: Vec<String>,
    /// The file of static lights as it was spelled, and its SHA-256, which earlier versions left out.
    pub lights_file: Option<(String, Option<String>)>,
    /// Of runs that were asked to do the same, the greatest is the newest.
    pub age: Age,
    pub directory: PathBuf,
    /// What tells it from other runs, for people.
    pub label: String,
    pub program: String,
    pub device: String,
    /// The factor by which others on the device may have lengthened its times.
    pub stretch: f64,
}

/// All runs under a directory, by path. What stands in a run's own directory is not searched.
pub(super) fn find_runs(directory: &Path) -> Result<Vec<RunEntry>> {
    output::find_runs(directory)?.iter().map(|path| read_entry(path)).collect()
}

fn read_entry(directory: &Path) -> Result<RunEntry> {
    let run = Manifest::read(directory)?;
    let sha256 = run.lights_file.as_ref().map(|input| input.sha256.clone());
    Ok(RunEntry {
        identity: identity(&run)?,
        way: Axis::of_role(Role::Way).map(|axis| axis.value(&run.config)).collect(),
        lights_file: run.config.lights_file.as_ref().map(|path| (path.display().to_string(), sha256)),
        age: output::age(directory, &run.started),
        label: label(&run),
        directory: directory.to_owned(),
        program: format!("manylight {} ({:.12})", run.version, run.git_revision),
        device: format!("{} ({})", run.device.name, run.device.driver),
        stretch: stretch(&run.machine, &run.conditions),
    })
}

impl RunEntry {
    /// Counts the file of static lights among what the run was asked to do: by what it holds, or by how it was spelled.
    pub fn tell_by_lights(&mut self, by_content: bool) {
        let lights = self.lights_file.as_ref();
        self.identity.extend(lights.map(|(path, sha256)| match sha256 {
            Some(sha256) if by_content => sha256.clone(),
            _ => path.clone(),
        }));
    }

    /// Counts the way among what the run was asked to do.
    pub fn tell_by_way(&mut self) {
        self.identity.extend(self.way.clone());
        for value in self.way.iter().filter(|value| !value.is_empty()) {
            self.label = format!("{}, {value}", self.label);
        }
    }
}

/// What decides what a run counts; the rest of its configuration says where results go, or how often and on what they
/// are measured.
fn identity(run: &Manifest) -> Result<Identity> {
    let counts = run.config.settings(|bearing| matches!(bearing, Bearing::Counts | Bearing::Shown))?;
    Ok(vec![
        run.scene.sha256.clone(),
        run.recording.sha256.clone(),
        run.method.clone(),
        run.lighting.map_or_else(String::new, |lighting| lighting.to_string()),
        Value::Object(counts).to_string(),
    ])
}

/// Such as `indi-persp-64, 1000 lights (I 100, I0 0.5, R0 0.1), street, bistro-vive, 320x180, 1 sample`.
fn label(run: &Manifest) -> String {
    let Config { resolution: [width, height], msaa, attenuation, marking, lights_file, .. } = &run.config;
    let lighting = match (run.lighting, &run.lights_file, lights_file) {
        (Some(Lighting { count, cutoff, r0, .. }), ..) => {
            let by = match run.config.light_source {
                GeneratorKind::Rain => String::new(),
                source => format!(" by {source}"),
            };
            let intensity = run.intensity().map_or_else(String::new, |intensity| format!("I {intensity}, "));
            format!("{count} lights{by} ({intensity}I0 {cutoff}, R0 {r0})")
        }
        (None, Some(input), _) => input_name(input),
        (None, None, Some(path)) => path.display().to_string(),
        (None, None, None) => "lights of the scene".to_owned(),
    };
    format!(
        "{}, {lighting}, {}, {}, {width}x{height}, msaa {msaa}, marked from {}, {attenuation}",
        run.method,
        input_name(&run.scene),
        input_name(&run.recording),
        format!("{marking:?}").to_lowercase(),
    )
}

/// A name with the start of the hash: equal names may stand for different contents.
fn input_name(input: &Source) -> String {
    format!("{} ({:.8})", input.name, input.sha256)
}

/// The rows of `frames.csv` by frame.
pub(super) fn counters(directory: &Path) -> Result<BTreeMap<u32, FrameRow>> {
    Ok(saved_frames(directory)?.into_iter().map(|row| (row.frame, row)).collect())
}

/// The rows of a table by frame.
pub(super) fn rows_by_frame<R: Row>(directory: &Path, frame: fn(&R) -> u32) -> Result<BTreeMap<u32, Vec<R>>> {
    let mut frames: BTreeMap<u32, Vec<R>> = BTreeMap::new();
    each_row(directory, |_, row| {
        frames.entry(frame(&row)).or_default().push(row);
        Ok(())
    })?;
    Ok(frames)
}
