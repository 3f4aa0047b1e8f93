//! `manylight bench`.

mod scopes;

use super::{Console, Interrupt};
use crate::assign::Assigner;
use crate::config::{Assign, Config, Layer, Test};
use crate::inputs::Inputs;
use crate::lights::{Lighting, SpotShare};
use crate::output::{prepare_file, write_whole};
use crate::replay::Watch;
use crate::replay::bench::{AssignBench, BenchRow, LIMIT, bench_assign};
use crate::report::assign_bench::{Sample, write_figures};
use crate::{Error, Result};
use clap::Subcommand;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// What to measure.
#[derive(Debug, Subcommand)]
pub enum Bench {
    /// Time light assignment by every way with every test, in turn, and write a CSV
    Assign(Box<Args>),
    /// Time frames with every stage timed and with the frame timed alone, in turn: what measuring costs
    Scopes(Box<scopes::Args>),
}

/// Arguments of `bench assign`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Numbers of falling lights, with commas between; their intensity follows the three lightings of Gelderen's
    /// chapter 6 and keeps the lights a point gets above the largest.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1000,10000,100000")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    lights: Vec<u32>,

    /// Which part of the lights are spots, as in `replay`; tests ask their cones where `--test` says so.
    #[arg(long, value_name = "FRACTION", allow_hyphen_values = true, default_value_t)]
    spots: SpotShare,

    /// Methods, as in `replay`; the flag is repeated for several.
    #[arg(long = "method", value_name = "METHOD", default_value = "indi-persp-64")]
    methods: Vec<String>,

    /// Frames of the recording, with commas between.
    #[arg(long = "frame", value_name = "LIST", value_delimiter = ',', default_value = "300,580")]
    frames: Vec<u32>,

    /// Ways of assignment, with commas between: brute, hierarchy, scatter, rectangles (for the test mm alone).
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "brute,hierarchy,scatter")]
    assign: Vec<Assign>,

    /// Tests of light against cluster, as in `replay`, with commas between; each is timed by every way.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "auto")]
    test: Vec<Test>,

    /// How often each is timed; the least time counts.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    repeats: u32,

    /// Scene, as in `replay`.
    #[arg(long, value_name = "NAME|PATH", default_value = "street")]
    scene: String,

    /// Refuse odd lines of the scene, as in `replay`.
    #[arg(long)]
    strict: bool,

    /// Recording, as in `replay`.
    #[arg(long, value_name = "NAME|PATH", default_value = "bistro")]
    recording: String,

    /// Width and height of each view, pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720")]
    resolution: String,

    /// Device, as in `replay`.
    #[arg(long, value_name = "NAME|INDEX")]
    device: Option<String>,

    /// Shader sources, as in `replay`.
    #[arg(long, value_name = "DIR")]
    shaders: Option<PathBuf>,

    /// The CSV; its figures and the exponents of growth lie beside it.
    #[arg(long, value_name = "FILE.csv", default_value = "out/bench_assign.csv")]
    out: PathBuf,
}

/// Runs the benchmark that is asked for.
pub fn run(bench: Bench, console: &Console) -> Result<()> {
    match bench {
        Bench::Assign(args) => assign(&args, console),
        Bench::Scopes(args) => scopes::run(*args, console),
    }
}

/// Measures, and writes the CSV and its figures once all is measured.
fn assign(args: &Args, console: &Console) -> Result<()> {
    let config = args.config()?;
    let bench = args.bench()?;
    let interrupt = Interrupt::install()?;
    let inputs = Inputs::load(&config)?;
    inputs.notes(&config.methods).for_each(|note| console.note(&note));
    prepare_file(&args.out)?;
    let tests: usize = config.methods.iter().map(|method| bench.tests_of(method).len()).sum();
    let cases = bench.lights.len() * bench.frames.len() * bench.assigners.len() * tests;
    let progress = console.progress(cases as u64 * (u64::from(bench.repeats) + 1));
    let watch = Watch { interrupt: interrupt.flag(), progress: &|| progress.advance() };
    let mut rows: Vec<BenchRow> = vec![];
    bench_assign(&config, &inputs, &bench, &watch, &mut |row| {
        rows.push(row);
        Ok(())
    })?;
    drop(progress);
    write_whole(&args.out, |file| {
        let mut csv = csv::Writer::from_writer(file);
        rows.iter().try_for_each(|row| csv.serialize(row))?;
        csv.flush()
    })?;
    let ways = rows.iter().filter(|row| row.assign != LIMIT);
    let samples = ways.map(sample).collect::<Result<Vec<_>>>()?;
    let figures = write_figures(&args.out, &samples)?;
    console.result(&Rows(rows))?;
    console.note(&format!("results are in {}", args.out.display()));
    figures.iter().for_each(|path| console.note(&format!("and in {}", path.display())));
    Ok(())
}

/// A line a measurement.
#[derive(Serialize)]
#[serde(transparent)]
struct Rows(Vec<BenchRow>);

impl fmt::Display for Rows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|row| {
            let BenchRow { lights, spots, method, assign, test, frame, gpu_ms, over_limit, light_indices, .. } = row;
            writeln!(
                f,
                "{lights} lights, {spots} of them spots, {method}, frame {frame}, {assign}, {test}: {gpu_ms:.3} ms, {over_limit:.1} times the \
                 limit, {light_indices} light indices"
            )
        })
    }
}

/// What figures take of a row.
fn sample(row: &BenchRow) -> Result<Sample> {
    Ok(Sample {
        lights: row.lights,
        method: row.method.parse()?,
        way: format!("{}, {}", row.assign, row.test),
        frame: row.frame,
        visible_clusters: row.visible_clusters,
        gpu_ms: row.gpu_ms,
    })
}

impl Args {
    /// The configuration of a replay that the flags amount to.
    fn config(&self) -> Result<Config> {
        let input = |error: String| Error::Input(error);
        let methods = self.methods.iter().map(|name| name.parse()).collect::<Result<Vec<_>>>()?;
        let layer = Layer {
            scene: Some(self.scene.clone()),
            strict: Some(self.strict),
            recording: Some(self.recording.clone()),
            methods: Some(methods),
            resolution: Some(crate::config::parse_resolution(&self.resolution).map_err(input)?),
            test: Some(self.test.clone()),
            spots: Some(self.spots),
            device: self.device.clone(),
            shaders: self.shaders.clone(),
            ..Layer::default()
        };
        let config = Config::resolve(None, layer)?;
        if let Some(method) = config.methods.iter().find(|method| !method.takes_ways()) {
            return Err(Error::Input(format!(
                "--method {method}: its lists are made in one way alone, so that there is nothing to compare: leave it out"
            )));
        }
        config.cases().iter().try_for_each(Config::check_case).map_err(input)?;
        Ok(config)
    }

    fn bench(&self) -> Result<AssignBench> {
        let fixed = |assign: &Assign| {
            let auto =
                || Error::Input("--assign auto: name the ways to compare, such as brute,hierarchy".into());
            assign.fixed().ok_or_else(auto)
        };
        Ok(AssignBench {
            assigners: self.assign.iter().map(fixed).collect::<Result<Vec<Assigner>>>()?,
            tests: self.test.clone(),
            lights: self.lights.iter().map(|&count| lighting(count)).collect(),
            frames: self.frames.clone(),
            repeats: self.repeats,
        })
    }
}

/// (Lights, intensity) of Gelderen's chapter 6.
const LIGHTINGS: [(f64, f64); 3] = [(1e3, 100.0), (1e4, 20.0), (1e5, 1.0)];

/// Rain of `count` lights: intensities between the three lightings follow power laws; below the first it stays, above
/// the last it falls so that as many lights reach a point.
fn lighting(count: u32) -> Lighting {
    let lights = f64::from(count);
    let (first, last) = (LIGHTINGS[0], LIGHTINGS[2]);
    let between = LIGHTINGS.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&lights));
    let intensity = match between {
        Some(pair) => {
            let exponent = (pair[1].1 / pair[0].1).ln() / (pair[1].0 / pair[0].0).ln();
            pair[0].1 * (lights / pair[0].0).powf(exponent)
        }
        None if lights < first.0 => first.1,
        // R1 is the root of the intensity, and the lights at a point are as their number times R1 cubed.
        None => last.1 * (lights / last.0).powf(-2.0 / 3.0),
    };
    Lighting { intensity: intensity as f32, ..Lighting::with_count(count) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightings_are_those_of_the_thesis_and_keep_their_density_beyond() {
        for (count, intensity) in LIGHTINGS {
            assert!((f64::from(lighting(count as u32).intensity) / intensity - 1.0).abs() < 1e-6);
        }
        assert_eq!(lighting(10).intensity, 100.0);
        let reach = |count: u32| f64::from(count) * f64::from(lighting(count).r1()).powi(3);
        assert!((reach(1_000_000) / reach(100_000) - 1.0).abs() < 1e-5);
    }
}
