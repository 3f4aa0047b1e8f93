//! Stills: one frame of one method, looked at from any camera, with what explains it drawn over it (Gelderen figures
//! 1.1, 4.8 and 5.1; Örtegren figures 4.10 to 4.12, 5.7, 5.12 and 5.13).
//!
//! The frame is rendered and counted as in a replay, from the recording's own views. The camera of the still comes
//! after that and only looks: it finds clusters by world position in the grids as they are.
//!
//! ```text
//! frame (as replayed) ─> counts, lists
//!    ├─> lines ────────────────────────────┐
//!    └─> camera: depth, clay, pixel_clusters[c], overlay, (gbuffer) ─> compose ─> PNG, EXR
//! ```

pub(crate) mod camera;
mod cells;
mod compose;
mod hash_tables;
mod lines;
mod look;
mod meshes;
mod onlooker;
mod record;
mod shapes;
mod show;

pub use camera::{Placed, Viewpoint};
pub use hash_tables::TablePicture;
pub use look::Look;
pub(crate) use look::look;
pub use show::{Base, Item, Show};

use crate::Result;
use crate::config::Config;
use crate::culling::Culling;
use crate::engine::{Engine, LargestGrid, Mode, Session, count_frame, plan_frames};
use crate::inputs::Inputs;
use crate::lights::{Light, LightTally};
use crate::measure::{ClusterLists, FrameCounts, ViewPixels};
use crate::methods::Scenery;
use crate::output::PlannedRun;
use camera::Camera;
use image::RgbImage;
use lines::{Drawn, Listed};
use onlooker::{Onlooker, Seen};
use serde::Serialize;

/// A finished still.
pub struct Still {
    /// Name of the camera.
    pub view: String,
    /// Picture as a display shows it; of a G-buffer three pictures side by side.
    pub image: RgbImage,
    /// Colour in linear light, and everything known of the pixels.
    pub pixels: ViewPixels,
    /// The frame's counters: those of a replay.
    pub counts: FrameCounts,
    /// Pictures of the octree's tables, by depth, where they are shown.
    pub tables: Vec<TablePicture>,
    /// The light that clusters or mesh are shown of.
    pub light: Option<ShownLight>,
}

/// A light, and where it is listed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShownLight {
    /// Its number among the frame's lights, from 0.
    pub number: u32,
    /// Place of the light in the world, metres.
    pub position: [f32; 3],
    /// Where a spot light shines, a unit vector.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f32; 3]>,
    /// How far it reaches, metres.
    pub radius: f32,
    /// How many clusters have it, of all clusterings.
    pub clusters: u64,
}

impl ShownLight {
    fn new(number: u32, lights: &[Light], listed: &[Listed]) -> Self {
        let Light { position, r1: radius, spot, .. } = lights[number as usize];
        let clusters = listed.iter().map(|listed| listed.with(number).len() as u64).sum();
        Self { number, position, direction: spot.map(|spot| spot.direction), radius, clusters }
    }
}

/// Renders the first frame of `run` and looks at it from `viewpoint`.
///
/// # Errors
/// Bad input, a camera that is not known, something that the method cannot show, and whatever fails on the device.
pub fn render(inputs: &Inputs, run: &PlannedRun, viewpoint: Viewpoint, show: &Show) -> Result<Still> {
    show.check(&run.method, run.config.pipeline[0])?;
    show.check_light(inputs.light_tally(&run.lights)?.count)?;
    let config = &drawn_plainly(&run.config);
    let plans = plan_frames(config, &inputs.recording)?;
    let plan = &plans[0];
    let names = inputs.recording.view_names();
    let camera = Camera::new(viewpoint, &names)?;
    let mut session = Session::new(config, &inputs.scene, inputs.recording.view_set())?;
    let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
    let onlooker = Onlooker { run: config, names: &names, plan, camera, show: *show };
    let still = paint(&onlooker, inputs, &mut session, run)?;
    session.context.check_validation()?;
    let log = session.context.validation_log();
    drop(session);
    log.check()?;
    Ok(still)
}

/// What is seen is the same wherever it is culled and however it is drawn, and a camera of the still's own needs a list
/// and a pass of its own.
fn drawn_plainly(config: &Config) -> Config {
    Config { culling: Culling::Cpu, multiview: false, ..config.clone() }
}

fn paint(onlooker: &Onlooker, inputs: &Inputs, session: &mut Session, run: &PlannedRun) -> Result<Still> {
    let Onlooker { run: config, names, plan, .. } = *onlooker;
    let mut source = inputs.light_source(&run.lights)?;
    let lights = source.at_frame(plan.frame);
    // The picture is of the lists, which are the same however they are built.
    let mode = Mode::counting(config, LightTally::of(lights.list));
    let around = Scenery {
        lights: lights.list,
        scene: session.scene.bounds,
        models: session.scene.models(),
        grid_box: config.grid_box,
    };
    let plan = &plan.settled(run.method, &around);
    let onlooker = Onlooker { plan, ..*onlooker };
    let mut engine = Engine::new(session, config, LargestGrid::of(std::slice::from_ref(plan)), mode)?;
    let about = (inputs.recording.time(plan.frame), Some(names));
    let (mut lists, wanted) = (vec![], onlooker.show.needs_lists());
    let mut keep = |of_clustering: ClusterLists| {
        lists.extend(wanted.then_some(of_clustering));
        Ok(())
    };
    let frame = count_frame(&mut engine, session, (plan, lights), about, &mut keep)?;
    let eye = onlooker.eye(&frame.pixels, &session.scene)?;
    let listed = Listed::of(&frame.counts.clusterings, &lists);
    let drawn = Drawn {
        method: run.method,
        eye: eye.eye(),
        plan,
        lights: lights.list,
        detail: config.mesh_detail[0],
        listed: &listed,
        octree: engine.octree(),
        scene: (&inputs.scene, &session.batches),
    };
    let lines = drawn.lines(&onlooker.show)?;
    let light = onlooker.show.light.map(|light| ShownLight::new(light, lights.list, &listed));
    let Seen { image, pixels } =
        onlooker.look(session, &mut engine, (&mode, &eye), (frame.pixels, &lines))?;
    let tables = engine.octree().filter(|_| onlooker.show.hash).map_or_else(Vec::new, hash_tables::pictures);
    Ok(Still { view: pixels.name.clone(), image, pixels, counts: frame.counts, tables, light })
}
