//! Stills: one frame of one method, looked at from any camera, with what explains it drawn over it (Gelderen figures
//! 1.1, 4.8 and 5.1).
//!
//! The frame is rendered and counted as in a replay, from the recording's own views. The camera of the still comes
//! after that and only looks: it finds clusters by world position in the grids as they are.
//!
//! ```text
//! frame (as replayed) ─> counts
//!    └─> camera: depth, clay, pixel_clusters[c], overlay, (gbuffer) ─> compose ─> PNG, EXR
//! ```

pub(crate) mod camera;
mod compose;
mod hash_tables;
mod look;
mod onlooker;
mod record;
mod shapes;

pub use camera::{Placed, Viewpoint};
pub use hash_tables::TablePicture;
pub use look::Look;
pub(crate) use look::look;

use crate::config::Config;
use crate::culling::Culling;
use crate::engine::{Engine, LargestGrid, Mode, Session, count_frame, plan_frames};
use crate::inputs::Inputs;
use crate::lights::LightTally;
use crate::measure::{FrameCounts, ViewPixels};
use crate::methods::{Groups, Method, Scenery};
use crate::output::PlannedRun;
use crate::shading::ShadingPipeline;
use crate::{Error, Result};
use camera::Camera;
use clap::ValueEnum;
use image::RgbImage;
use onlooker::{Onlooker, Seen};

/// One thing that a still can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Item {
    /// Clusters in three colours, by the sum of their three indices modulo 3; dim where no cluster is visible.
    Clusters,
    /// Slices in eight colours, by the three low bits of their index as red, green and blue; dim where no cluster is visible.
    Slices,
    /// Frusta of the views (green) and of the clusterings, or their boxes (red).
    Frusta,
    /// Influence volumes of the lights.
    Lights,
    /// Lights in each pixel's cluster, from black (none) to white (most).
    LightCount,
    /// Fragments in each pixel's cluster, from black (none) to white (most).
    FragmentCount,
    /// Magenta where no visible cluster exists.
    Missing,
    /// Leaves of the octree that hold lights, of each depth in its own colour.
    Octree,
    /// Beside the picture, one of the hash tables of each depth of the octree: slots that are taken, offsets as colours.
    Hash,
    /// What the G-buffer of deferred shading holds, side by side: base colours, normals (their axes as red, green and blue) and
    /// depth (white nearest).
    Gbuffer,
}

/// What the surfaces of a still show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Base {
    /// What was shaded; surfaces as under a lamp where the camera is none of the recording's.
    #[default]
    Picture,
    /// Clusters in three colours.
    Clusters,
    /// Slices in eight colours.
    Slices,
    /// A heat map of lights.
    LightCount,
    /// A heat map of fragments.
    FragmentCount,
    /// What a G-buffer holds, side by side.
    Gbuffer,
}

/// All that a still shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Show {
    /// What surfaces show.
    pub base: Base,
    /// Lines of frusta and boxes.
    pub frusta: bool,
    /// Whether volumes of lights are shown.
    pub lights: bool,
    /// Magenta where there is no cluster.
    pub missing: bool,
    /// Lines of the octree's leaves.
    pub octree: bool,
    /// Whether the octree's tables are pictured too.
    pub hash: bool,
}

impl Show {
    /// Puts items together.
    ///
    /// # Errors
    /// Items that exclude each other.
    pub fn from_items(items: &[Item]) -> Result<Self> {
        let mut show = Self::default();
        for item in items {
            let base = match item {
                Item::Clusters => Base::Clusters,
                Item::Slices => Base::Slices,
                Item::LightCount => Base::LightCount,
                Item::FragmentCount => Base::FragmentCount,
                Item::Gbuffer => Base::Gbuffer,
                Item::Frusta => {
                    show.frusta = true;
                    continue;
                }
                Item::Lights => {
                    show.lights = true;
                    continue;
                }
                Item::Missing => {
                    show.missing = true;
                    continue;
                }
                Item::Octree => {
                    show.octree = true;
                    continue;
                }
                Item::Hash => {
                    show.hash = true;
                    continue;
                }
            };
            if show.base != Base::Picture && show.base != base {
                return Err(Error::input(
                    "show: clusters, slices, light-count, fragment-count and gbuffer exclude each other: choose one of them",
                ));
            }
            show.base = base;
        }
        if show.base == Base::Gbuffer && (show.frusta || show.lights || show.missing) {
            return Err(Error::input("show: gbuffer is shown by itself: leave the others out"));
        }
        Ok(show)
    }

    /// Refuses what a method without clusters, or without an octree, or a pipeline without a G-buffer, cannot show.
    fn check(&self, method: &Method, pipeline: ShadingPipeline) -> Result<()> {
        if self.base == Base::Gbuffer && pipeline == ShadingPipeline::Forward {
            return Err(Error::input(
                "show: forward shading has no G-buffer: add --pipeline deferred, or leave gbuffer out",
            ));
        }
        let of_groups = !matches!(self.base, Base::Picture | Base::Gbuffer) || self.missing;
        let of_cells = matches!(self.base, Base::Clusters | Base::Slices) || self.missing;
        match method.kind().groups {
            Groups::Nothing if of_groups => Err(Error::input(format!(
                "show: {method} has no clusters: choose a clustered method, or show frusta and lights alone"
            ))),
            Groups::Leaves if of_cells => Err(Error::input(format!(
                "show: {method} has leaves of an octree, not clusters: choose a clustered method, or show octree, light-count or \
                 fragment-count"
            ))),
            Groups::Nothing | Groups::Cells(_) if self.octree || self.hash => Err(Error::input(format!(
                "show: {method} has no octree: choose a method such as hashed-0.5-3, or leave octree and hash out"
            ))),
            _ => Ok(()),
        }
    }
}

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
}

/// Renders the first frame of `run` and looks at it from `viewpoint`.
///
/// # Errors
/// Bad input, a camera that is not known, something that the method cannot show, and whatever fails on the device.
pub fn render(inputs: &Inputs, run: &PlannedRun, viewpoint: Viewpoint, show: &Show) -> Result<Still> {
    show.check(&run.method, run.config.pipeline[0])?;
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
    let mut no_lists = |_| Ok(());
    let frame = count_frame(&mut engine, session, (plan, lights), about, &mut no_lists)?;
    let Seen { image, pixels } = onlooker.look(session, &mut engine, &mode, frame.pixels)?;
    let tables = engine.octree().filter(|_| onlooker.show.hash).map_or_else(Vec::new, hash_tables::pictures);
    Ok(Still { view: pixels.name.clone(), image, pixels, counts: frame.counts, tables })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_add_up_unless_they_exclude_each_other() {
        let show = Show::from_items(&[Item::Clusters, Item::Frusta, Item::Missing]).unwrap();
        assert_eq!(show, Show { base: Base::Clusters, frusta: true, missing: true, ..Show::default() });
        assert!(Show::from_items(&[Item::Clusters, Item::LightCount]).is_err());
        assert!(Show::from_items(&[Item::Clusters, Item::Slices]).is_err());
        let forward = ShadingPipeline::Forward;
        assert!(show.check(&Method::AllLights, forward).is_err());
        let hashed: Method = "hashed-0.5-3".parse().unwrap();
        let leaves = Show::from_items(&[Item::LightCount, Item::Octree, Item::Hash]).unwrap();
        assert!(leaves.check(&hashed, forward).is_ok() && show.check(&hashed, forward).is_err());
        assert!(leaves.check(&"indi-persp-64".parse().unwrap(), forward).is_err());
        assert!(Show::from_items(&[Item::Octree]).unwrap().check(&Method::AllLights, forward).is_err());
        assert!(
            Show::from_items(&[Item::Frusta, Item::Lights])
                .unwrap()
                .check(&Method::AllLights, forward)
                .is_ok()
        );
        let check = |show: &Show, pipeline| show.check(&Method::AllLights, pipeline).is_ok();
        assert!(!check(&show, ShadingPipeline::Deferred));
        let lights = Show::from_items(&[Item::Frusta, Item::Lights]).unwrap();
        assert!(check(&lights, ShadingPipeline::Forward));
        let gbuffer = Show::from_items(&[Item::Gbuffer]).unwrap();
        assert!(check(&gbuffer, ShadingPipeline::Deferred) && !check(&gbuffer, ShadingPipeline::Forward));
        assert!(Show::from_items(&[Item::Lights, Item::Gbuffer]).is_err());
    }
}
