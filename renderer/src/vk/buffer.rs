//! Buffers that free themselves.

use super::context::Context;
use super::{bytes_text, vk_error};
use crate::{Error, Result};
use ash::vk;
use bytemuck::Pod;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::cell::Cell;
use std::marker::PhantomData;
use std::sync::Arc;

/// Where a buffer lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Memory {
    /// On the device, out of the host's reach.
    Device,
    /// Written by the host, read by the device.
    Upload,
    /// Written by the device, read by the host.
    Readback,
}

/// A buffer with its memory; host memory is mapped and coherent.
pub struct Buffer {
    /// Vulkan handle, for commands and descriptors.
    pub handle: vk::Buffer,
    /// Size in bytes, at least 16.
    pub size: u64,
    name: String,
    allocation: Option<Allocation>,
    context: Arc<Context>,
    /// Writing through `&self` is sound because no two threads share a buffer.
    _not_sync: PhantomData<Cell<()>>,
}

impl Buffer {
    /// A buffer of `size` bytes, with undefined contents. A size of 0 is allowed and rounded up to a texel, for Vulkan
    /// knows no empty buffers and an empty list should need no special case.
    ///
    /// # Errors
    /// [`Error::Device`] when the size is over a limit of the device or the memory is out.
    pub fn new(
        context: &Arc<Context>,
        name: &str,
        size: u64,
        usage: vk::BufferUsageFlags,
        memory: Memory,
    ) -> Result<Self> {
        let size = size.max(16);
        check_size(context, name, size, usage)?;
        let info =
            vk::BufferCreateInfo::default().size(size).usage(usage).sharing_mode(vk::SharingMode::EXCLUSIVE);
        let handle = unsafe { context.device.create_buffer(&info, None) }
            .map_err(|e| vk_error(&format!("{name}: making a buffer of {}", bytes_text(size)), e))?;
        context.name(handle, name);
        let mut buffer = Self {
            handle,
            size,
            name: name.to_owned(),
            allocation: None,
            context: context.clone(),
            _not_sync: PhantomData,
        };
        buffer.bind(memory)?;
        Ok(buffer)
    }

    /// A device-local buffer holding `data`; `usage` is completed with TRANSFER_DST.
    ///
    /// # Errors
    /// As [`Buffer::new`].
    pub fn with_data<T: Pod>(
        context: &Arc<Context>,
        name: &str,
        usage: vk::BufferUsageFlags,
        data: &[T],
    ) -> Result<Self> {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let usage = usage | vk::BufferUsageFlags::TRANSFER_DST;
        let buffer = Self::new(context, name, bytes.len() as u64, usage, Memory::Device)?;
        buffer.fill(bytes)?;
        Ok(buffer)
    }

    /// Writes `data` to the start of a buffer made by [`Buffer::with_data`], and waits. No work that reads it may be running.
    ///
    /// # Errors
    /// [`Error::Device`] when the memory is out or the device fails.
    pub fn fill<T: Pod>(&self, data: &[T]) -> Result<()> {
        let (context, bytes): (_, &[u8]) = (&self.context, bytemuck::cast_slice(data));
        let chunk = STAGING_BYTES.min(bytes.len());
        if chunk == 0 {
            return Ok(());
        }
        let (name, transfer) = (format!("{} staging", self.name), vk::BufferUsageFlags::TRANSFER_SRC);
        let staging = Self::new(context, &name, chunk as u64, transfer, Memory::Upload)?;
        for (index, part) in bytes.chunks(chunk).enumerate() {
            staging.write(0, part);
            let region = vk::BufferCopy::default().dst_offset((index * chunk) as u64).size(part.len() as u64);
            context.submit_and_wait(|cmd| unsafe {
                context.device.cmd_copy_buffer(cmd, staging.handle, self.handle, &[region]);
                // The next chunk, or the first frame, comes in a later submission: make the copy visible to it.
                full_barrier(context, cmd);
            })?;
        }
        Ok(())
    }

    /// Name that the buffer was made with, for messages.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Copies `data` to byte `offset`. The device sees it in work submitted afterwards.
    ///
    /// # Panics
    /// When the data do not fit or the buffer is [`Memory::Device`]: faults of the program.
    pub fn write<T: Pod>(&self, offset: u64, data: &[T]) {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let target = self.mapped(offset, bytes.len());
        // SAFETY: `mapped` checked the range; no other thread reaches this memory (see `_not_sync`).
        unsafe { std::ptr::copy_nonoverlapping(bytes.as_ptr(), target, bytes.len()) };
    }

    /// Copies `count` values out from byte `offset`. The device's work must be done, with a barrier to the host.
    ///
    /// # Panics
    /// When the range is outside the buffer or the buffer is [`Memory::Device`]: faults of the program.
    pub fn read<T: Pod>(&self, offset: u64, count: usize) -> Vec<T> {
        let mut values = vec![T::zeroed(); count];
        self.read_into(offset, &mut values);
        values
    }

    /// [`Self::read`] into memory that is already there.
    ///
    /// # Panics
    /// As [`Self::read`].
    pub fn read_into<T: Pod>(&self, offset: u64, values: &mut [T]) {
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(values);
        let source = self.mapped(offset, bytes.len());
        // SAFETY: as in `write`.
        unsafe { std::ptr::copy_nonoverlapping(source, bytes.as_mut_ptr(), bytes.len()) };
    }

    fn mapped(&self, offset: u64, length: usize) -> *mut u8 {
        let fits = offset.checked_add(length as u64).is_some_and(|end| end <= self.size);
        assert!(fits, "{}: {length} bytes at {offset} of {}", self.name, self.size);
        let pointer = self.allocation.as_ref().and_then(Allocation::mapped_ptr);
        let pointer =
            pointer.unwrap_or_else(|| panic!("{}: device memory is out of the host's reach", self.name));
        // SAFETY: in the mapped range, which is at least `size` bytes.
        unsafe { pointer.as_ptr().cast::<u8>().add(offset as usize) }
    }

    fn bind(&mut self, memory: Memory) -> Result<()> {
        let device = &self.context.device;
        let allocation = self.context.allocate(&AllocationCreateDesc {
            name: &self.name,
            requirements: unsafe { device.get_buffer_memory_requirements(self.handle) },
            location: match memory {
                Memory::Device => MemoryLocation::GpuOnly,
                Memory::Upload => MemoryLocation::CpuToGpu,
                Memory::Readback => MemoryLocation::GpuToCpu,
            },
            linear: true,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        })?;
        let bound =
            unsafe { device.bind_buffer_memory(self.handle, allocation.memory(), allocation.offset()) };
        self.allocation = Some(allocation);
        bound.map_err(|e| vk_error(&format!("{}: binding memory", self.name), e))
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        unsafe { self.context.device.destroy_buffer(self.handle, None) };
        if let Some(allocation) = self.allocation.take() {
            self.context.free(allocation);
        }
    }
}

/// The most that one upload stages at a time, bytes.
pub(super) const STAGING_BYTES: usize = 64 << 20;

/// Records a barrier that makes everything before visible to everything after.
pub(super) fn full_barrier(context: &Context, cmd: vk::CommandBuffer) {
    let all = [vk::MemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)];
    unsafe {
        context.device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().memory_barriers(&all))
    };
}

/// A uniform buffer may be longer than what is bound of it at a time, such as the data of all materials.
fn check_size(context: &Context, name: &str, size: u64, usage: vk::BufferUsageFlags) -> Result<()> {
    let limits = &context.limits;
    let mut limit = limits.max_buffer_size.min(limits.max_memory_allocation_size);
    if usage.contains(vk::BufferUsageFlags::STORAGE_BUFFER) {
        limit = limit.min(limits.max_storage_buffer_range);
    }
    match size <= limit {
        true => Ok(()),
        false => Err(Error::Device(format!(
            "{name}: {} ({size} bytes) is more than the {} that a buffer of this kind may hold on {}",
            bytes_text(size),
            bytes_text(limit),
            context.info.name
        ))),
    }
}
