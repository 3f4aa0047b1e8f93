//! `manylight still`.

use super::Console;
use crate::config::{Config, ExrFrames, FrameRange, Layer};
use crate::inputs::Inputs;
use crate::output::{planned_runs, prepare_output, write_exr, write_png};
use crate::replay::shape_note;
use crate::still::camera::BIRDSEYE;
use crate::still::{Item, Placed, Show, ShownLight, Still, TablePicture, Viewpoint, render};
use crate::{Error, Result};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Arguments of `still`: what to look at, and the flags of `replay`.
#[derive(Debug, clap::Args)]
#[command(args_override_self = true)]
pub struct Args {
    /// The frame.
    #[arg(long, value_name = "N")]
    frame: u32,

    /// The camera: a view of the recording (mono, left, right, ...), or birdseye, which looks from above and does
    /// not touch the clustering [default: the first view].
    #[arg(long, value_name = "NAME")]
    view: Option<String>,

    /// A camera of its own instead: where it is, world space in metres. Like birdseye it does not touch the clustering.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    #[arg(requires = "target", conflicts_with = "view")]
    eye: Option<[f64; 3]>,

    /// What that camera looks at, world space in metres.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, requires = "eye")]
    target: Option<[f64; 3]>,

    /// Its field of view along the longer side of the image, radians [default: 1.2].
    #[arg(long, value_name = "RADIANS", allow_hyphen_values = true, requires = "eye")]
    fov: Option<f64>,

    /// What to show, with commas between.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "ITEMS")]
    show: Vec<Item>,

    /// The light that light-clusters and light-mesh are of: its number, from 0 on.
    #[arg(long, value_name = "N")]
    light: Option<u32>,

    /// JSON configuration over the built-in defaults; flags go over it.
    #[arg(long, value_name = "FILE.json")]
    config: Option<PathBuf>,

    #[command(flatten)]
    layer: Layer,
}

/// Renders the still and writes it as PNG and EXR.
pub fn run(args: Args, console: &Console) -> Result<()> {
    let show = Show::from_items(&args.show, args.light)?;
    let viewpoint = viewpoint(&args)?;
    let config = configuration(&args)?;
    let run = planned_runs(&config).remove(0);
    run.check()?;
    let inputs = Inputs::load(&config)?;
    inputs.notes(&config.methods).for_each(|note| console.note(&note));
    prepare_output(&config.out)?;
    let still = render(&inputs, &run, viewpoint, &show)?;
    if still.view != BIRDSEYE {
        let shape = shape_note(&inputs.recording, args.frame, config.resolution)?;
        shape.into_iter().for_each(|note| console.note(&note));
    }
    let stem = format!("{:06}_{}_{}", args.frame, run.method, still.view);
    let [png, exr] = ["png", "exr"].map(|extension| config.out.join(format!("{stem}.{extension}")));
    write_png(&png, &still.image)?;
    write_exr(&exr, std::slice::from_ref(&still.pixels), config.exr_layout)?;
    for TablePicture { depth, image } in &still.tables {
        write_png(&config.out.join(format!("{stem}_hash-{depth}.png")), image)?;
    }
    console.result(&Written::new(&still, run.method.to_string(), [png, exr]))
}

/// Reads `X,Y,Z`.
fn place(text: &str) -> std::result::Result<[f64; 3], String> {
    let wrong = || format!("`{text}` is no place X,Y,Z such as -9,1.8,9");
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| wrong()))
        .collect::<std::result::Result<_, _>>()?;
    numbers.try_into().map_err(|_| wrong())
}

/// The camera that the flags ask for.
fn viewpoint(args: &Args) -> Result<Viewpoint<'_>> {
    match (args.eye, args.target) {
        (Some(eye), Some(target)) => Placed::new(eye, target, args.fov).map(Viewpoint::Placed),
        _ => Ok(Viewpoint::Named(args.view.as_deref())),
    }
}

/// One frame, one method, one lighting, nothing timed.
fn configuration(args: &Args) -> Result<Config> {
    let Layer { frames, runs, exr, trace, scopes, methods, lights, test, scenes, resolutions, .. } =
        &args.layer;
    let of_replay = [
        ("frames", frames.is_some()),
        ("runs", runs.is_some()),
        ("exr", exr.is_some()),
        ("trace", trace.is_some()),
        ("scopes", scopes.is_some()),
    ];
    if let Some((flag, _)) = of_replay.iter().find(|(_, given)| *given) {
        return Err(Error::input(format!("a still is one frame that is not timed: leave --{flag} out")));
    }
    let several = |count: Option<usize>| count.is_some_and(|count| count > 1);
    let axes = [
        scenes.as_ref().map(Vec::len),
        resolutions.as_ref().map(Vec::len),
        methods.as_ref().map(Vec::len),
        lights.as_ref().map(Vec::len),
        test.as_ref().map(Vec::len),
    ];
    if axes.into_iter().any(several) {
        return Err(Error::input(
            "a still shows one scene in one resolution, one method under one lighting with one test: give --scene, \
             --resolution, --method, --lights and --test once",
        ));
    }
    // Of what a file has several of, the first.
    let mut config = Config::resolve(args.config.as_deref(), args.layer.clone())?.by_scene().swap_remove(0);
    config.methods.truncate(1);
    config.lights.truncate(1);
    config.assign.truncate(1);
    config.test.truncate(1);
    config.frames = FrameRange { first: args.frame, end: args.frame.checked_add(1), step: 1 };
    config.exr = ExrFrames::List(vec![]);
    config.trace = ExrFrames::List(vec![]);
    Ok(config)
}

/// What was written, with what heat maps are scaled by.
#[derive(Serialize)]
struct Written {
    png: PathBuf,
    exr: PathBuf,
    method: String,
    frame: u32,
    view: String,
    visible_clusters: u64,
    light_indices: u64,
    most_lights: u32,
    most_fragments: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<ShownLight>,
}

impl Written {
    fn new(still: &Still, method: String, [png, exr]: [PathBuf; 2]) -> Self {
        let most = |counts: &[u32]| counts.iter().copied().max().unwrap_or(0);
        Self {
            png,
            exr,
            method,
            frame: still.counts.frame,
            view: still.view.clone(),
            visible_clusters: still.counts.visible_clusters(),
            light_indices: still.counts.light_indices(),
            most_lights: most(&still.pixels.light_count),
            most_fragments: most(&still.pixels.fragment_count),
            light: still.light.clone(),
        }
    }
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { png, exr, method, frame, view, visible_clusters, light_indices, .. } = self;
        writeln!(f, "{}\n{}", png.display(), exr.display())?;
        write!(
            f,
            "{method}, frame {frame}, seen from {view}: {visible_clusters} visible clusters, {light_indices} light \
             indices; in a pixel's cluster at most {} lights and {} fragments",
            self.most_lights, self.most_fragments
        )?;
        self.light.iter().try_for_each(|light| write!(f, "\n{}", described(light)))
    }
}

fn described(light: &ShownLight) -> String {
    let ShownLight { number, position: [x, y, z], direction, radius, clusters } = light;
    let kind = direction
        .map_or_else(|| "a point".to_owned(), |[x, y, z]| format!("a spot towards ({x:.2}, {y:.2}, {z:.2})"));
    format!(
        "light {number}: {kind} at ({x:.2}, {y:.2}, {z:.2}) m that reaches {radius:.2} m; clusters that have it: {clusters}"
    )
}
