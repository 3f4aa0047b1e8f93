//! What all runs of a replay share: device, scene, render targets, frames in flight.

use super::requirements::check_device;
use crate::buffers::BufferName;
use crate::clustering::{SLOTS, make_buffer};
use crate::config::Config;
use crate::draw_list::{Batches, DrawList};
use crate::draw_slots::{DrawSlots, SlotOrder};
use crate::frame::{DrawBuffers, Layer, ViewTargets};
use crate::geometry::views::ViewSet;
use crate::gpu_interface::{DrawCommand, DrawCounts, MAX_VIEWS, ViewData};
use crate::gpu_scene::GpuScene;
use crate::layouts::{DEPTH_SET, DescriptorSets, Layouts};
use crate::machine::Probe;
use crate::pass::{FrameTracker, Timestamps};
use crate::passes::readback::STATE_BYTES;
use crate::pipelines::{COLOR_FORMAT, DEPTH_FORMAT, PipelineStore};
use crate::scene::Scene;
use crate::texture_sets::drawn_sets;
use crate::vk::{Buffer, Context, DeviceOptions, Image, ImageDesc, Memory, ShaderLibrary};
use crate::{Error, Result, buffers, gpu_interface};
use ash::vk;
use std::sync::Arc;

/// One frame in flight: commands, fence, queries and what the host writes and reads.
pub struct Slot {
    context: Arc<Context>,
    pool: vk::CommandPool,
    /// Recorded anew each frame.
    pub commands: vk::CommandBuffer,
    /// Signalled when the frame has ended.
    pub fence: vk::Fence,
    /// Its scopes' times.
    pub timestamps: Timestamps,
    /// [`ViewData`] of all views, mapped.
    pub views: Buffer,
    /// Of each view, whether it sees the world in a mirror.
    pub mirrored: Vec<bool>,
    /// Each clustering's state, mapped.
    pub states: Buffer,
    /// What each view draws, and all at once, where the host culls.
    pub draw_lists: Vec<DrawList>,
    /// In which order each view draws, and all at once, where the device culls.
    pub slot_orders: Vec<SlotOrder>,
    /// [`DrawCounts`] and the transparent slots of all views in their order, mapped.
    pub draw_order: Buffer,
}

impl Slot {
    fn new(context: &Arc<Context>, views: usize, counts: DrawCounts) -> Result<Self> {
        let failed = |e: vk::Result| Error::Device(format!("cannot make a frame in flight: {e}"));
        let device = &context.device;
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(context.queue_family)
            .flags(vk::CommandPoolCreateFlags::TRANSIENT);
        let pool = unsafe { device.create_command_pool(&info, None) }.map_err(failed)?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let commands = unsafe { device.allocate_command_buffers(&info) }.map_err(failed)?[0];
        let fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }.map_err(failed)?;
        context.name(pool, "frame");
        context.name(commands, "frame");
        context.name(fence, "frame");
        Ok(Self {
            context: context.clone(),
            pool,
            commands,
            fence,
            timestamps: Timestamps::new(context, views)?,
            views: make_buffer(
                context,
                BufferName::Views,
                u64::from(MAX_VIEWS) * size_of::<ViewData>() as u64,
                Memory::Upload,
            )?,
            mirrored: vec![],
            states: Buffer::new(
                context,
                "states",
                views as u64 * STATE_BYTES,
                vk::BufferUsageFlags::TRANSFER_DST,
                Memory::Readback,
            )?,
            draw_lists: vec![DrawList::default(); views + 1],
            slot_orders: vec![SlotOrder::default(); views + 1],
            draw_order: draw_order(context, views, counts)?,
        })
    }

    /// Opens the command buffer for recording; its last frame must have ended.
    pub fn begin(&self) -> Result<()> {
        let device = &self.context.device;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        unsafe {
            device
                .reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
                .and_then(|()| device.begin_command_buffer(self.commands, &info))
        }
        .map_err(|e| Error::Internal(format!("cannot begin recording a frame: {e}")))
    }

    /// Closes the command buffer and hands it to the device.
    pub fn submit(&self) -> Result<()> {
        unsafe { self.context.device.end_command_buffer(self.commands) }
            .map_err(|e| Error::Internal(format!("cannot end recording a frame: {e}")))?;
        self.context.submit(self.commands, self.fence)
    }

    /// Waits until the submitted frame has ended.
    pub fn wait(&self) -> Result<()> {
        let device = &self.context.device;
        unsafe {
            device
                .wait_for_fences(&[self.fence], true, u64::MAX)
                .and_then(|()| device.reset_fences(&[self.fence]))
        }
        .map_err(|e| Error::Internal(format!("the device failed while rendering a frame: {e}")))
    }
}

impl Drop for Slot {
    fn drop(&mut self) {
        let device = &self.context.device;
        unsafe {
            // A frame may still be running when an error unwinds.
            let _ = device.device_wait_idle();
            device.destroy_fence(self.fence, None);
            device.destroy_command_pool(self.pool, None);
        }
    }
}

/// Device, scene, targets and frames in flight of a replay.
pub struct Session {
    /// Frames in flight; before everything they use, so that they end first.
    pub slots: [Slot; SLOTS],
    /// What each view is rendered into.
    pub targets: Vec<ViewTargets>,
    _depth_sets: DescriptorSets,
    /// The scene on the device.
    pub scene: GpuScene,
    /// Its instances in drawing order.
    pub batches: Batches,
    /// What is drawn of them where the device culls.
    pub draw_slots: DrawSlots,
    /// What stage `cull` fills.
    pub draws: DrawBuffers,
    /// Pipelines made so far.
    pub store: PipelineStore,
    /// Memory of the barrier derivation.
    pub tracker: FrameTracker,
    /// What tells the machine's state.
    pub probe: Probe,
    /// The device.
    pub context: Arc<Context>,
}

impl Session {
    /// Opens the device and uploads `scene` for the views of `view_set`.
    pub fn new(config: &Config, scene: &Scene, view_set: ViewSet) -> Result<Self> {
        let views = view_set.count;
        let options = DeviceOptions { device: config.device.clone(), validate: config.validate };
        let context = Context::new(&options)?;
        check_device(&context, config, view_set)?;
        check_resolution(&context, config.resolution)?;
        check_views(views)?;
        let layouts = Arc::new(Layouts::new(&context)?);
        let shaders = shader_library(config)?;
        let batches = Batches::new(scene);
        let draw_slots = DrawSlots::new(&batches);
        let gpu_scene = GpuScene::new(&context, &layouts, scene, (&batches, &draw_slots))?;
        let depth_sets = DescriptorSets::new(&context, "depth", layouts.depth, &DEPTH_SET, views)?;
        let targets = targets(&context, config, &depth_sets.sets)?;
        Ok(Self {
            slots: [
                Slot::new(&context, views, draw_slots.counts)?,
                Slot::new(&context, views, draw_slots.counts)?,
            ],
            targets,
            _depth_sets: depth_sets,
            scene: gpu_scene,
            batches,
            draws: draw_buffers(&context, views, draw_slots.counts)?,
            draw_slots,
            store: PipelineStore::new(&context, &layouts, shaders, (view_set, drawn_sets(scene))),
            tracker: FrameTracker::default(),
            probe: Probe::new(&context.info.hardware),
            context,
        })
    }
}

/// Counts, and room for the order of every view's transparent slots.
fn draw_order(context: &Arc<Context>, views: usize, counts: DrawCounts) -> Result<Buffer> {
    let size = size_of::<DrawCounts>() + 4 * views * counts.transparents as usize;
    let buffer = make_buffer(context, BufferName::DrawOrder, size as u64, Memory::Upload)?;
    buffer.write(0, &[counts]);
    Ok(buffer)
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
    let text = gpu_interface::glsl() + &buffers::glsl();
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

/// A target for each view, which `depth_sets` name: images of its own, or with multiview layers of shared ones.
fn targets(
    context: &Arc<Context>,
    config: &Config,
    depth_sets: &[vk::DescriptorSet],
) -> Result<Vec<ViewTargets>> {
    if config.multiview {
        return layered_targets(context, config, "", depth_sets);
    }
    let sets = depth_sets.chunks(1).enumerate();
    let own = sets.map(|(view, set)| layered_targets(context, config, &format!("[{view}]"), set));
    Ok(own.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}

/// Targets that are the layers of one image each of depth, colour and resolved colour.
fn layered_targets(
    context: &Arc<Context>,
    config: &Config,
    suffix: &str,
    depth_sets: &[vk::DescriptorSet],
) -> Result<Vec<ViewTargets>> {
    use vk::ImageUsageFlags as U;
    let [width, height] = config.resolution;
    let image = |name: &str, format, samples: u32, usage, aspect| {
        let (layers, samples) = (depth_sets.len() as u32, vk::SampleCountFlags::from_raw(samples));
        let desc = ImageDesc { width, height, mip_levels: 1, layers, format, samples, usage, aspect };
        Image::new(context, &format!("{name}{suffix}"), desc).map(Arc::new)
    };
    let depth_usage = U::DEPTH_STENCIL_ATTACHMENT | U::SAMPLED;
    let depth = image("depth", DEPTH_FORMAT, config.msaa, depth_usage, vk::ImageAspectFlags::DEPTH)?;
    let color_usage = U::COLOR_ATTACHMENT | U::TRANSFER_SRC;
    let color = image("color", COLOR_FORMAT, config.msaa, color_usage, vk::ImageAspectFlags::COLOR)?;
    // An image view needs a use that may have one.
    let resolved_usage = U::TRANSFER_SRC | U::TRANSFER_DST | U::SAMPLED;
    let resolved = (config.msaa > 1)
        .then(|| image("resolved", COLOR_FORMAT, 1, resolved_usage, vk::ImageAspectFlags::COLOR))
        .transpose()?;
    let layer = |image: &Arc<Image>, index: usize| Layer {
        image: image.clone(),
        index: index as u32,
        view: image.layer_views[index],
    };
    let target = |(index, &depth_set): (usize, &vk::DescriptorSet)| {
        let depth = layer(&depth, index);
        write_depth_set(context, depth_set, depth.view);
        let resolved = resolved.as_ref().map(|image| layer(image, index));
        ViewTargets { depth, color: layer(&color, index), resolved, depth_set }
    };
    Ok(depth_sets.iter().enumerate().map(target).collect())
}

fn write_depth_set(context: &Context, set: vk::DescriptorSet, view: vk::ImageView) {
    let info = [vk::DescriptorImageInfo::default()
        .image_view(view)
        .image_layout(vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL)];
    let write = vk::WriteDescriptorSet::default()
        .dst_set(set)
        .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
        .image_info(&info);
    unsafe { context.device.update_descriptor_sets(&[write], &[]) };
}
