//! Room for one frame in flight, which frames take in turn.

use crate::buffers::BufferName;
use crate::clustering::make_buffer;
use crate::draw_list::DrawList;
use crate::drawables::DrawableOrder;
use crate::gpu_interface::{DrawCounts, MAX_VIEWS, ViewData};
use crate::pass::Timestamps;
use crate::passes::readback::STATE_BYTES;
use crate::vk::{Buffer, Context, Memory};
use crate::{Error, Result};
use ash::vk;
use std::sync::Arc;

/// Room for one frame in flight: commands, fence, queries and what the host writes and reads.
pub struct FrameSlot {
    context: Arc<Context>,
    pool: vk::CommandPool,
    /// Command buffer, recorded anew each frame.
    pub commands: vk::CommandBuffer,
    /// Signalled when the frame has ended.
    pub fence: vk::Fence,
    /// Times of the scopes of the frame.
    pub timestamps: Timestamps,
    /// [`ViewData`] of all views, mapped.
    pub views: Buffer,
    /// Whether each view sees the world in a mirror.
    pub mirrored: Vec<bool>,
    /// State of each clustering, mapped.
    pub states: Buffer,
    /// What each view draws, and all at once, where the host culls.
    pub draw_lists: Vec<DrawList>,
    /// In which order each view draws, and all at once, where the device culls.
    pub drawable_orders: Vec<DrawableOrder>,
    /// [`DrawCounts`] and the transparent drawables of all views in their order, mapped.
    pub draw_order: Buffer,
}

impl FrameSlot {
    /// Room for a frame of `views` views of a scene that draws as much as `counts` says.
    ///
    /// # Errors
    /// The device is out of memory.
    pub(super) fn new(context: &Arc<Context>, views: usize, counts: DrawCounts) -> Result<Self> {
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
            drawable_orders: vec![DrawableOrder::default(); views + 1],
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

impl Drop for FrameSlot {
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

/// Counts, and room for the order of every view's transparent drawables.
fn draw_order(context: &Arc<Context>, views: usize, counts: DrawCounts) -> Result<Buffer> {
    let size = size_of::<DrawCounts>() + 4 * views * counts.transparents as usize;
    let buffer = make_buffer(context, BufferName::DrawOrder, size as u64, Memory::Upload)?;
    buffer.write(0, &[counts]);
    Ok(buffer)
}
