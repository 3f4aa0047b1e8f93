//! What all runs of a replay share: device, scene, render targets, frames in flight.

use super::FrameSlot;
use super::requirements::check_device;
use super::targets::make_targets;
use crate::buffers::BufferName;
use crate::clustering::{FRAME_SLOTS, make_buffer};
use crate::config::Config;
use crate::draw_list::Batches;
use crate::drawables::Drawables;
use crate::geometry::views::ViewSet;
use crate::gpu_interface::{DrawCommand, DrawCounts, MAX_VIEWS};
use crate::gpu_scene::GpuScene;
use crate::layouts::{DescriptorSets, Layouts, TARGETS_SET};
use crate::machine::Probe;
use crate::methods::OctreeWay;
use crate::methods::hashed::SceneGeometry;
use crate::pass::FrameTracker;
use crate::passes::{DrawBuffers, ViewTargets};
use crate::pipelines::PipelineStore;
use crate::scene::Scene;
use crate::texture_sets::drawn_sets;
use crate::vk::{Context, DeviceOptions, Memory, ShaderLibrary};
use crate::{Error, Result, buffers, gpu_interface, targets};
use std::sync::Arc;

/// Device, scene, targets and frames in flight of a replay.
pub struct Session {
    /// Room for the frames in flight; before everything that these use, so that they end first.
    pub frame_slots: [FrameSlot; FRAME_SLOTS],
    /// What each view is rendered into.
    pub targets: Vec<ViewTargets>,
    _target_sets: DescriptorSets,
    /// The scene on the device.
    pub scene: GpuScene,
    /// Surfaces of the scene, where some octree is kept where they are alone.
    pub surfaces: Option<SceneGeometry>,
    /// Instances of the scene in drawing order.
    pub batches: Batches,
    /// Everything that is drawn of the scene where the device culls.
    pub drawables: Drawables,
    /// Buffers that stage `cull` fills.
    pub draws: DrawBuffers,
    /// Pipelines made so far.
    pub store: PipelineStore,
    /// Memory of the barrier derivation.
    pub tracker: FrameTracker,
    /// What tells the machine's state.
    pub probe: Probe,
    /// The Vulkan device that the session runs on.
    pub context: Arc<Context>,
}

impl Session {
    /// Opens the device and uploads `scene` for the views of `view_set`.
    pub fn new(config: &Config, scene: &Scene, view_set: ViewSet) -> Result<Self> {
        let (device, validate) = (config.device.clone(), config.validate);
        let options = DeviceOptions { device, validate, ..DeviceOptions::default() };
        Self::on(Context::new(&options)?, config, scene, view_set)
    }

    /// Uploads `scene` to an open device.
    pub fn on(context: Arc<Context>, config: &Config, scene: &Scene, view_set: ViewSet) -> Result<Self> {
        let views = view_set.count;
        check_device(&context, config, view_set)?;
        check_resolution(&context, config.resolution)?;
        check_views(views)?;
        let layouts = Arc::new(Layouts::new(&context)?);
        let shaders = shader_library(config)?;
        let batches = Batches::new(scene);
        let drawables = Drawables::new(&batches);
        let gpu_scene = GpuScene::new(&context, &layouts, scene, (&batches, &drawables))?;
        let target_sets = DescriptorSets::new(&context, "targets", layouts.targets, &TARGETS_SET, views)?;
        Ok(Self {
            frame_slots: [
                FrameSlot::new(&context, views, drawables.counts)?,
                FrameSlot::new(&context, views, drawables.counts)?,
            ],
            targets: make_targets(&context, config, &target_sets.sets)?,
            _target_sets: target_sets,
            scene: gpu_scene,
            surfaces: config.octree.contains(&OctreeWay::Geometry).then(|| SceneGeometry::of(scene)),
            batches,
            draws: draw_buffers(&context, views, drawables.counts)?,
            drawables,
            store: PipelineStore::new(&context, &layouts, shaders, (view_set, drawn_sets(scene))),
            tracker: FrameTracker::default(),
            probe: Probe::new(&context.info.hardware),
            context,
        })
    }
}

fn draw_buffers(context: &Arc<Context>, views: usize, counts: DrawCounts) -> Result<DrawBuffers> {
    let lists = views as u64 + 1;
    let commands = lists * u64::from(counts.surfaces + counts.transparents);
    let instances = lists * u64::from(counts.instances);
    let make = |name, size| make_buffer(context, name, size, Memory::Device);
    Ok(DrawBuffers {
        commands: make(BufferName::DrawCommands, commands * size_of::<DrawCommand>() as u64)?,
        drawn_instances: make(BufferName::DrawnInstances, 4 * instances)?,
    })
}

/// The shader sources that the config chooses.
pub fn shader_library(config: &Config) -> Result<ShaderLibrary> {
    let text = gpu_interface::glsl() + &buffers::glsl() + &targets::glsl();
    ShaderLibrary::new(config.shaders.as_deref(), vec![("generated/gpu_interface.glsl".to_owned(), text)])
}

fn check_views(views: usize) -> Result<()> {
    match views <= MAX_VIEWS as usize {
        true => Ok(()),
        false => {
            Err(Error::Input(format!("{views} views are more than the {MAX_VIEWS} that a frame may have")))
        }
    }
}

fn check_resolution(context: &Context, [width, height]: [u32; 2]) -> Result<()> {
    let most = context.limits.max_image_dimension_2d;
    if width > most || height > most {
        return Err(Error::Device(format!(
            "{} renders at most {most} x {most} pixels, {width} x {height} were asked for: change --resolution",
            context.info.name
        )));
    }
    Ok(())
}
