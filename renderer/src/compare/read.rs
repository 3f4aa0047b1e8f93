//! Reading result sets: which runs there are, and the tables of one run.

use crate::output::{self, Age, FRAMES, RUN_FORMAT, TIMINGS, each_row};
use crate::{Error, Result};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The fields of a configuration that decide what a run counts; the others say where results go, or how
/// often and on what they are measured.
const IDENTITY: [&str; 6] =
    ["resolution", "msaa", "attenuation", "marking", "displaced_volume", "scene_lights"];

/// How lists were built, and what decided who is on them: beside the others, these tell the runs of a sweep apart. Where
/// they need not, runs are joined across them: so two ways or tests are compared.
const WAY: [&str; 2] = ["assign", "test"];

/// What a run was asked to do: comparable, and equal for runs that are to be compared.
pub(super) type Identity = Vec<String>;

/// One run as its manifest describes it.
#[derive(Debug)]
pub(super) struct RunEntry {
    pub identity: Identity,
    /// By which of [`WAY`].
    pub way: [String; 2],
    /// The file of static lights as it was spelled, and its SHA-256, which earlier versions left out.
    pub lights_file: Option<(String, Option<String>)>,
    /// Of runs that were asked to do the same, the greatest is the newest.
    pub age: Age,
    pub directory: PathBuf,
    /// What tells it from other runs, for people.
    pub label: String,
    pub program: String,
    pub device: String,
}

#[derive(Deserialize)]
struct RunFile {
    version: String,
    git_revision: String,
    method: String,
    lighting: Value,
    config: Map<String, Value>,
    scene: NamedInput,
    recording: NamedInput,
    lights_file: Option<NamedInput>,
    device: Device,
    #[serde(default)]
    started: String,
}

#[derive(Deserialize)]
struct NamedInput {
    name: String,
    sha256: String,
}

#[derive(Deserialize)]
struct Device {
    name: String,
    driver: String,
}

/// All runs under a directory, by path. What stands in a run's own directory is not searched.
pub(super) fn find_runs(directory: &Path) -> Result<Vec<RunEntry>> {
    output::find_runs(directory)?.iter().map(|path| read_entry(path)).collect()
}

fn read_entry(directory: &Path) -> Result<RunEntry> {
    let path = directory.join("run.json");
    let text =
        fs::read_to_string(&path).map_err(|error| Error::file(&path, format!("cannot be read: {error}")))?;
    let value: Value = serde_json::from_str(&text)
        .map_err(|error| Error::file(&path, format!("is no JSON: {error}: run it again")))?;
    if value["format"] != RUN_FORMAT {
        let message =
            format!("has format {}, this program reads {RUN_FORMAT}: run it again", value["format"]);
        return Err(Error::file(&path, message));
    }
    let run: RunFile = serde_json::from_value(value)
        .map_err(|error| Error::file(&path, format!("is no manifest of a run: {error}: run it again")))?;
    Ok(RunEntry {
        identity: identity(&run),
        way: WAY.map(|field| run.config.get(field).and_then(Value::as_str).unwrap_or("?").to_owned()),
        lights_file: run
            .config
            .get("lights_file")
            .and_then(Value::as_str)
            .map(|path| (path.to_owned(), run.lights_file.as_ref().map(|input| input.sha256.clone()))),
        age: output::age(directory, &run.started),
        label: label(&run),
        directory: directory.to_owned(),
        program: format!("manylight {} ({:.12})", run.version, run.git_revision),
        device: format!("{} ({})", run.device.name, run.device.driver),
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
        self.label = format!("{}, {}", self.label, self.way.join(", "));
    }
}

fn identity(run: &RunFile) -> Identity {
    let config = IDENTITY.iter().map(|field| run.config.get(*field).unwrap_or(&Value::Null).to_string());
    [run.scene.sha256.clone(), run.recording.sha256.clone(), run.method.clone(), run.lighting.to_string()]
        .into_iter()
        .chain(config)
        .collect()
}

/// Such as `indi-persp-64, 1000 lights (I 100, I0 0.5, R0 0.1), street, bistro-vive, 320x180, 1 sample`.
fn label(run: &RunFile) -> String {
    let config = |field: &str| run.config.get(field).unwrap_or(&Value::Null);
    let lighting = match &run.lighting {
        Value::Object(rain) => {
            let part = |name: &str| rain.get(name).unwrap_or(&Value::Null);
            let (count, intensity) = (part("count"), part("intensity"));
            format!("{count} lights (I {intensity}, I0 {}, R0 {})", part("cutoff"), part("r0"))
        }
        _ => match &run.lights_file {
            Some(input) => input_name(input),
            None => config("lights_file").as_str().unwrap_or("lights of the scene").to_owned(),
        },
    };
    let size: Vec<String> =
        config("resolution").as_array().into_iter().flatten().map(Value::to_string).collect();
    let samples = config("msaa");
    let plain = |field: &str| config(field).as_str().unwrap_or("?").to_owned();
    format!(
        "{}, {lighting}, {}, {}, {}, msaa {samples}, marked from {}, {}",
        run.method,
        input_name(&run.scene),
        input_name(&run.recording),
        size.join("x"),
        plain("marking"),
        plain("attenuation"),
    )
}

/// A name with the start of the hash: equal names may stand for different contents.
fn input_name(input: &NamedInput) -> String {
    format!("{} ({:.8})", input.name, input.sha256)
}

/// A table's rows by frame.
#[derive(Debug, Default)]
pub(super) struct Counters {
    /// Names of the counters.
    pub columns: Vec<&'static str>,
    /// A value a counter.
    pub frames: BTreeMap<u32, Vec<u64>>,
}

/// The counters of `frames.csv`.
pub(super) fn counters(directory: &Path) -> Result<Counters> {
    let columns = FRAMES.into_iter().filter(|column| is_counter(column));
    let mut table = Counters { columns: columns.collect(), ..Counters::default() };
    each_row(&directory.join("frames.csv"), &FRAMES, |row| {
        let values = table.columns.iter().map(|column| row.whole(column)).collect::<Result<_>>()?;
        table.frames.insert(row.whole("frame")?, values);
        Ok(())
    })?;
    Ok(table)
}

fn is_counter(column: &str) -> bool {
    !matches!(column, "frame" | "time_s") && !column.contains("_ms")
}

/// The cells of a table of counters (its name, its columns), a text a frame.
pub(super) fn rows_by_frame(
    directory: &Path,
    (name, columns): (&str, &[&'static str]),
) -> Result<BTreeMap<u32, String>> {
    let mut frames: BTreeMap<u32, String> = BTreeMap::new();
    each_row(&directory.join(name), columns, |row| {
        let text = frames.entry(row.whole("frame")?).or_default();
        columns.iter().for_each(|column| text.extend([row.text(column), ","]));
        text.push('\n');
        Ok(())
    })?;
    Ok(frames)
}

/// One row of `timings.csv`.
pub(super) struct TimingRow<'a> {
    pub run: u32,
    pub frame: u32,
    pub stage: &'a str,
    pub gpu_ms: f64,
}

/// Goes through `timings.csv`; stages without a GPU time are left out.
pub(super) fn timings(directory: &Path, mut each: impl FnMut(&TimingRow)) -> Result<()> {
    each_row(&directory.join("timings.csv"), &TIMINGS, |row| {
        if let Some(gpu_ms) = row.optional("gpu_ms")? {
            let (run, frame) = (row.whole("run")?, row.whole("frame")?);
            each(&TimingRow { run, frame, stage: row.text("stage"), gpu_ms });
        }
        Ok(())
    })
}
