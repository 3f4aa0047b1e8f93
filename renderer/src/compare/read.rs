//! Reading result sets: which runs there are, and the tables of one run.

use crate::output::{self, RUN_FORMAT};
use crate::{Error, Result};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The fields of a configuration that decide what a run counts; the others say where results go, or how
/// often and on what they are measured.
const IDENTITY: [&str; 7] =
    ["resolution", "msaa", "attenuation", "marking", "displaced_volume", "lights_file", "scene_lights"];

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
    device: Device,
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
        label: label(&run),
        directory: directory.to_owned(),
        program: format!("manylight {} ({:.12})", run.version, run.git_revision),
        device: format!("{} ({})", run.device.name, run.device.driver),
    })
}

impl RunEntry {
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
        _ => config("lights_file").as_str().unwrap_or("lights of the scene").to_owned(),
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
    pub columns: Vec<String>,
    /// A value a counter.
    pub frames: BTreeMap<u32, Vec<u64>>,
}

/// The counters of `frames.csv`.
pub(super) fn counters(directory: &Path) -> Result<Counters> {
    let path = directory.join("frames.csv");
    let mut table = Counters::default();
    let mut kept = vec![];
    for_each_row(&path, |header, row| {
        if kept.is_empty() {
            kept = (0..header.len()).filter(|&column| is_counter(&header[column])).collect();
            table.columns = kept.iter().map(|&column| header[column].to_owned()).collect();
        }
        let values: Option<Vec<u64>> = kept.iter().map(|&column| row[column].parse().ok()).collect();
        let values = values.ok_or("a counter is no whole number")?;
        table.frames.insert(frame_of(header, row)?, values);
        Ok(())
    })?;
    if table.frames.is_empty() {
        return Err(Error::file(&path, "holds no frames: run it again"));
    }
    Ok(table)
}

fn is_counter(column: &str) -> bool {
    !matches!(column, "frame" | "time_s") && !column.contains("_ms")
}

/// All other cells of a table of counters, a text a frame.
pub(super) fn rows_by_frame(directory: &Path, table: &str) -> Result<BTreeMap<u32, String>> {
    let mut frames: BTreeMap<u32, String> = BTreeMap::new();
    for_each_row(&directory.join(table), |header, row| {
        let text = frames.entry(frame_of(header, row)?).or_default();
        row.iter().for_each(|cell| text.extend([cell, ","]));
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
    for_each_row(&directory.join("timings.csv"), |header, row| {
        let number = |column: &str| cell(header, row, column)?.parse().map_err(|_| "a number is none");
        let gpu_ms: f64 = cell(header, row, "gpu_ms")?.parse().map_err(|_| "a time is no number")?;
        if gpu_ms.is_finite() {
            let stage = cell(header, row, "stage")?;
            each(&TimingRow { run: number("run")?, frame: number("frame")?, stage, gpu_ms });
        }
        Ok(())
    })
}

fn frame_of(header: &csv::StringRecord, row: &csv::StringRecord) -> Result<u32, &'static str> {
    cell(header, row, "frame")?.parse().map_err(|_| "the frame is no whole number")
}

fn cell<'a>(
    header: &csv::StringRecord,
    row: &'a csv::StringRecord,
    column: &str,
) -> Result<&'a str, &'static str> {
    let position = header.iter().position(|name| name == column).ok_or("a column of the table is missing")?;
    Ok(&row[position])
}

fn for_each_row(
    path: &Path,
    mut each: impl FnMut(&csv::StringRecord, &csv::StringRecord) -> Result<(), &'static str>,
) -> Result<()> {
    let failed = |error: csv::Error| match error.into_kind() {
        csv::ErrorKind::Io(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Error::file(path, "is missing beside its run.json: run it again")
        }
        csv::ErrorKind::Io(error) => Error::file(path, format!("cannot be read: {error}")),
        _ => Error::file(path, "is damaged: run it again"),
    };
    let mut reader = csv::Reader::from_path(path).map_err(failed)?;
    let header = reader.headers().map_err(failed)?.clone();
    let mut row = csv::StringRecord::new();
    while reader.read_record(&mut row).map_err(failed)? {
        each(&header, &row).map_err(|message| {
            let line = row.position().map_or(0, csv::Position::line);
            Error::file(path, format!("line {line}: {message}: run it again"))
        })?;
    }
    Ok(())
}
