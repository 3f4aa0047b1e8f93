//! Stills: one frame of one method, looked at from any camera, with what explains it drawn over it (Gelderen figures
//! 1.1, 4.8 and 5.1).
//!
//! The frame is rendered and counted as in a replay, from the recording's own views. The camera of the still comes
//! after that and only looks: it finds clusters by world position in the grids as they are.
//!
//! ```text
//! frame (as replayed) ─> counts
//!    └─> camera: depth, clay, pixel_clusters[c], overlay ─> compose ─> PNG, EXR
//! ```

pub mod camera;
mod compose;
mod record;
mod shapes;

use crate::assign::Assigner;
use crate::clustering::view_data;
use crate::config::{Config, Culling};
use crate::gpu_interface::PixelData;
use crate::measure::{Capacities, FrameCounts, ViewPixels};
use crate::methods::MethodSpec;
use crate::output::PlannedRun;
use crate::passes::pixel_maps;
use crate::pipelines::DebugPipelines;
use crate::replay::atemporal::{self, SLOT};
use crate::replay::engine::{self, Engine};
use crate::replay::session::Session;
use crate::replay::{FramePlan, Inputs, RunResult, RunSink, plan_frames};
use crate::views::View;
use crate::vk::{Buffer, Memory};
use crate::{Error, Result};
use ash::vk;
use camera::Camera;
use clap::ValueEnum;
use compose::Layers;
use half::f16;
use image::RgbImage;
use record::{Drawing, Outputs};

/// One thing that a still can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Item {
    /// Clusters in three colours, by the sum of their three indices modulo 3; dim where no cluster is visible.
    Clusters,
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
}

/// What the surfaces of a still show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Base {
    /// What was shaded; surfaces as under a lamp where the camera is none of the recording's.
    #[default]
    Picture,
    /// Clusters in three colours.
    Clusters,
    /// A heat map of lights.
    LightCount,
    /// A heat map of fragments.
    FragmentCount,
}

/// All that a still shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Show {
    /// On surfaces.
    pub base: Base,
    /// Lines of frusta and boxes.
    pub frusta: bool,
    /// Volumes of lights.
    pub lights: bool,
    /// Magenta where there is no cluster.
    pub missing: bool,
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
                Item::LightCount => Base::LightCount,
                Item::FragmentCount => Base::FragmentCount,
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
            };
            if show.base != Base::Picture && show.base != base {
                return Err(Error::input(
                    "show: clusters, light-count and fragment-count exclude each other: choose one of them",
                ));
            }
            show.base = base;
        }
        Ok(show)
    }

    /// Refuses what a method without clusters cannot show.
    fn check(&self, method: &MethodSpec) -> Result<()> {
        if *method == MethodSpec::AllLights && (self.base != Base::Picture || self.missing) {
            return Err(Error::input(format!(
                "show: {method} has no clusters: choose a clustered method, or show frusta and lights alone"
            )));
        }
        Ok(())
    }
}

/// A finished still.
pub struct Still {
    /// Name of the camera.
    pub view: String,
    /// As a display shows it.
    pub image: RgbImage,
    /// Colour in linear light, and everything known of the pixels.
    pub pixels: ViewPixels,
    /// The frame's counters: those of a replay.
    pub counts: FrameCounts,
}

/// Renders the first frame of `config` by `run` and looks at it from the camera called `view` (`None`: the first view).
///
/// # Errors
/// Bad input, a camera that is not known, something that the method cannot show, and whatever fails on the device.
pub fn render(
    config: &Config,
    inputs: &Inputs,
    run: &PlannedRun,
    view: Option<&str>,
    show: &Show,
) -> Result<Still> {
    show.check(&run.method)?;
    // What is seen is the same wherever it is culled and however it is drawn, and a camera of the still's own needs a list
    // and a pass of its own.
    let config = &Config { culling: Culling::Cpu, multiview: false, ..config.clone() };
    let plans = plan_frames(config, &inputs.recording, &run.method)?;
    let plan = &plans[0];
    let names = inputs.recording.view_names();
    let camera = Camera::by_name(view, &names)?;
    let mut session = Session::new(config, &inputs.scene, names.len())?;
    let still = Painter { config, inputs, plan, camera, show }.paint(&mut session, run)?;
    session.context.check_validation()?;
    let log = session.context.validation_log();
    drop(session);
    log.check()?;
    Ok(still)
}

struct Painter<'a> {
    config: &'a Config,
    inputs: &'a Inputs,
    plan: &'a FramePlan,
    camera: Camera,
    show: &'a Show,
}

impl Painter<'_> {
    fn paint(self, session: &mut Session, run: &PlannedRun) -> Result<Still> {
        let mut lights = self.inputs.light_source(&run.lights)?;
        let light_count = lights.at_frame(self.plan.frame).len() as u32;
        let capacities = Capacities {
            visible_clusters: self.config.visible_cluster_capacity,
            light_indices: self.config.light_index_capacity,
        };
        let plans = std::slice::from_ref(self.plan);
        // The picture is of the lists, which are the same however they are built.
        let mode = engine::Mode {
            lights: light_count,
            capacities,
            assigner: Assigner::Brute,
            test: run.test.of(&run.method),
            counting: true,
        };
        let mut engine = Engine::new(session, self.config, run.method, plans, mode)?;
        let pipelines = session.store.debug(&engine::variant(self.config, run.method, &mode))?;
        let names: Vec<String> = self.inputs.recording.view_names().into_iter().map(str::to_owned).collect();
        let mut shaded = Shaded::default();
        let time = self.inputs.recording.time(self.plan.frame);
        let about = (time, Some(names.as_slice()));
        let counts =
            atemporal::count_frame(&mut engine, session, self.plan, &mut lights, about, &mut shaded)?;
        let eye = self.eye(&shaded)?;
        let layers = self.look(&mut engine, session, (&pipelines, &eye), shaded)?;
        let empty = self.empty_pixels(&eye);
        let (image, pixels) = compose::compose(self.show, &layers, &self.plan.grids, empty);
        Ok(Still { view: pixels.name.clone(), image, pixels, counts })
    }

    /// Where the camera is.
    fn eye(&self, shaded: &Shaded) -> Result<View> {
        let views = &self.plan.views;
        match self.camera {
            Camera::View(view) => Ok(views[view]),
            Camera::BirdsEye => {
                let far = views.iter().map(|view| view.frustum.far()).fold(0.0, f64::max);
                let distances = shaded.views.iter().flat_map(|view| view.depth.iter().copied());
                camera::birdseye(views, self.config.resolution, camera::reach(far, distances))
            }
        }
    }

    /// Draws what the camera sees. The frame has ended: what its views were is overwritten for an onlooker.
    fn look(
        &self,
        engine: &mut Engine,
        session: &mut Session,
        (pipelines, eye): (&DebugPipelines, &View),
        mut shaded: Shaded,
    ) -> Result<Layers> {
        let clustered = !self.plan.grids.is_empty();
        let all: Vec<usize> = (0..self.plan.grids.len().max(1)).collect();
        let (view, lookup, clusterings) = match self.camera {
            Camera::View(view) => (view, 0, vec![if all.len() > 1 { view } else { 0 }]),
            Camera::BirdsEye => {
                let slot = &mut session.slots[SLOT];
                slot.views.write(0, &[view_data(eye, None, self.config.resolution, session.reach)]);
                slot.draw_lists[0].update(&session.batches, std::slice::from_ref(eye));
                (0, 1, all)
            }
        };
        let lines =
            if self.show.frusta { shapes::frusta(&self.plan.views, &self.plan.grids) } else { vec![] };
        let line_buffer = (!lines.is_empty())
            .then(|| {
                Buffer::with_data(&session.context, "lines", vk::BufferUsageFlags::VERTEX_BUFFER, &lines)
            })
            .transpose()?;
        let [color_bytes, pixel_bytes] = pixel_maps::view_bytes(self.config.resolution);
        let readback = |size| {
            let usage = vk::BufferUsageFlags::TRANSFER_DST;
            Buffer::new(&session.context, "still readback", size, usage, Memory::Readback)
        };
        let (clay, overlay) = (readback(color_bytes)?, readback(color_bytes)?);
        let known: Vec<Buffer> = clusterings.iter().map(|_| readback(pixel_bytes)).collect::<Result<_>>()?;
        let drawing = Drawing {
            pipelines,
            view,
            lookup: clustered.then_some(lookup),
            clusterings,
            lines: line_buffer.as_ref().map(|buffer| (buffer, lines.len() as u32)),
            spheres: self.show.lights,
        };
        let outputs = Outputs { clay: &clay, overlay: &overlay, clusterings: &known };
        engine.follow_up(session, SLOT, |r, frame| record::record(r, frame, &drawing, &outputs))?;
        let pixels = self.pixel_count();
        let color = |buffer: &Buffer| {
            buffer.read::<[u16; 4]>(0, pixels).into_iter().map(|t| t.map(f16::from_bits)).collect()
        };
        let mut clusterings: Vec<Vec<PixelData>> =
            known.iter().map(|buffer| buffer.read(0, pixels)).collect();
        let distance = clusterings[0].iter().map(|pixel| pixel.distance).collect();
        if !clustered {
            clusterings.clear();
        }
        let shaded = match self.camera {
            Camera::View(view) => Some(shaded.views.swap_remove(view).color),
            Camera::BirdsEye => None,
        };
        Ok(Layers { shaded, clay: color(&clay), overlay: color(&overlay), clusterings, distance })
    }

    fn pixel_count(&self) -> usize {
        self.config.resolution.map(|side| side as usize).into_iter().product()
    }

    /// The camera's name, size and matrices.
    fn empty_pixels(&self, eye: &View) -> ViewPixels {
        let [width, height] = self.config.resolution;
        ViewPixels {
            name: self.camera.name(&self.inputs.recording.view_names()),
            width,
            height,
            color: vec![],
            depth: vec![],
            light_count: vec![],
            fragment_count: vec![],
            cluster_index: vec![],
            world_from_view: eye.world_from_view(),
            clip_from_view: eye.clip_from_view(),
        }
    }
}

/// Keeps the views as the method shaded them.
#[derive(Default)]
struct Shaded {
    views: Vec<ViewPixels>,
}

impl RunSink for Shaded {
    fn begin(&mut self, _: &PlannedRun) -> Result<()> {
        Ok(())
    }

    fn images(&mut self, _: u32, views: &[ViewPixels]) -> Result<()> {
        self.views = views.to_vec();
        Ok(())
    }

    fn finish(&mut self, _: &PlannedRun, _: RunResult) -> Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_add_up_unless_they_exclude_each_other() {
        let show = Show::from_items(&[Item::Clusters, Item::Frusta, Item::Missing]).unwrap();
        assert_eq!(show, Show { base: Base::Clusters, frusta: true, lights: false, missing: true });
        assert!(Show::from_items(&[Item::Clusters, Item::LightCount]).is_err());
        assert!(show.check(&MethodSpec::AllLights).is_err());
        assert!(
            Show::from_items(&[Item::Frusta, Item::Lights]).unwrap().check(&MethodSpec::AllLights).is_ok()
        );
    }
}
