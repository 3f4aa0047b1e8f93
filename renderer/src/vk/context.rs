//! The chosen device with its queue, allocator and diagnostics.

use super::device::{FoundDevice, choose, found_devices};
use super::features::Features;
use super::instance::{Instance, driver_lock};
use super::limits::{DeviceInfo, Limits};
use super::validation::ValidationLog;
use super::{bytes_text, vk_error};
use crate::{Error, Result};
use ash::{ext, vk};
use gpu_allocator::AllocationError;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, Allocator, AllocatorCreateDesc};
use std::ffi::{CStr, CString};
use std::sync::{Arc, Mutex, MutexGuard};

/// How to open a device.
#[derive(Debug, Clone, Default)]
pub struct DeviceOptions {
    /// Index in the listing, or part of a name (any case); `None` picks discrete, else integrated, else any.
    pub device: Option<String>,
    /// Turns the validation layers with synchronization validation on.
    pub validate: bool,
    /// Has the device do with fewer layers of images than it offers, so that tests see what needs several batches then.
    pub most_layers: Option<u32>,
}

/// An open device. Everything made from it holds it by [`Arc`], so it is destroyed last.
pub struct Context {
    /// Functions of the device.
    pub device: ash::Device,
    /// The one queue, for graphics, compute and transfer. [`Context::submit`] takes its lock.
    pub queue: vk::Queue,
    /// Queue family of [`Context::queue`].
    pub queue_family: u32,
    /// What the device can hold.
    pub limits: Limits,
    /// Name, driver and hardware of the device.
    pub info: DeviceInfo,
    physical: vk::PhysicalDevice,
    debug: Option<ext::debug_utils::Device>,
    allocator: Mutex<Option<Allocator>>,
    one_off_pool: Mutex<vk::CommandPool>,
    queue_lock: Mutex<()>,
    /// Last, for fields drop in order and the instance outlives the device.
    instance: Instance,
}

impl Context {
    /// Opens the device that `options` name.
    ///
    /// # Errors
    /// [`Error::Device`] in one line when the loader, the validation layers, a device or a feature is missing;
    /// [`Error::Input`] when no device has the name or index.
    pub fn new(options: &DeviceOptions) -> Result<Arc<Self>> {
        let instance = Instance::new(options.validate)?;
        let chosen = choose(found_devices(&instance)?, options.device.as_deref())?;
        let device = create_device(&instance.handle, &chosen)?;
        let mut context = Self {
            queue: unsafe { device.get_device_queue(chosen.queue_family, 0) },
            queue_family: chosen.queue_family,
            limits: chosen.limits.with_layers(options.most_layers),
            info: chosen.info,
            physical: chosen.physical,
            debug: instance.debug_utils.then(|| ext::debug_utils::Device::new(&instance.handle, &device)),
            allocator: Mutex::new(None),
            one_off_pool: Mutex::new(vk::CommandPool::null()),
            queue_lock: Mutex::new(()),
            device,
            instance,
        };
        context.fill()?;
        tracing::debug!(
            "device {} ({}), driver {}",
            context.info.name,
            context.info.hardware.kind,
            context.info.driver
        );
        Ok(Arc::new(context))
    }

    /// Makes the parts whose failure must not leak the device.
    fn fill(&mut self) -> Result<()> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: self.instance.handle.clone(),
            device: self.device.clone(),
            physical_device: self.physical,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: Default::default(),
        })
        .map_err(|error| Error::Internal(format!("making the device memory allocator: {error}")))?;
        self.allocator = Mutex::new(Some(allocator));

        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(self.queue_family);
        let pool = unsafe { self.device.create_command_pool(&info, None) }
            .map_err(|e| vk_error("making a command pool", e))?;
        self.name(pool, "one-off commands");
        self.name(self.queue, "main queue");
        self.one_off_pool = Mutex::new(pool);
        Ok(())
    }

    /// Names `handle` in validation messages and captures; does nothing without VK_EXT_debug_utils.
    pub fn name<H: vk::Handle>(&self, handle: H, name: &str) {
        let Some(debug) = &self.debug else { return };
        let name = c_string(name);
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // A name that cannot be stored costs a label, not the run.
        let _ = unsafe { debug.set_debug_utils_object_name(&info) };
    }

    /// Opens a labelled region of `cmd`; does nothing without VK_EXT_debug_utils.
    pub fn begin_label(&self, cmd: vk::CommandBuffer, name: &CStr) {
        let Some(debug) = &self.debug else { return };
        let label = vk::DebugUtilsLabelEXT::default().label_name(name);
        unsafe { debug.cmd_begin_debug_utils_label(cmd, &label) };
    }

    /// Closes the innermost labelled region of `cmd`.
    pub fn end_label(&self, cmd: vk::CommandBuffer) {
        if let Some(debug) = &self.debug {
            unsafe { debug.cmd_end_debug_utils_label(cmd) };
        }
    }

    /// Whether the validation layers are on.
    pub fn validates(&self) -> bool {
        self.instance.validates()
    }

    /// [`Error::Internal`] with the first validation message and the number of all, if any arrived.
    pub fn check_validation(&self) -> Result<()> {
        self.instance.log.check()
    }

    /// The messages of the validation layers; outlives the context, so that what its destruction says can be read.
    pub fn validation_log(&self) -> Arc<ValidationLog> {
        self.instance.log.clone()
    }

    /// Waits until the device has nothing to do.
    pub fn wait_idle(&self) -> Result<()> {
        let _queue = lock(&self.queue_lock);
        unsafe { self.device.device_wait_idle() }.map_err(|e| vk_error("waiting for the GPU", e))
    }

    /// Refuses a device on which nothing can be timed.
    ///
    /// # Errors
    /// The queue has no timestamps.
    pub fn require_timestamps(&self) -> Result<()> {
        if self.limits.timestamp_valid_bits > 0 {
            return Ok(());
        }
        Err(Error::Device(format!(
            "{} has no timestamps, so nothing can be timed on it: choose another --device",
            self.info.name
        )))
    }

    /// Submits one recorded command buffer; `fence` (or null) signals when it is done.
    pub fn submit(&self, cmd: vk::CommandBuffer, fence: vk::Fence) -> Result<()> {
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(cmd)];
        let submits = [vk::SubmitInfo2::default().command_buffer_infos(&commands)];
        let _queue = lock(&self.queue_lock);
        unsafe { self.device.queue_submit2(self.queue, &submits, fence) }
            .map_err(|e| vk_error("submitting work to the GPU", e))
    }

    /// Records, submits and waits for one command buffer: for uploads and tests, not for frames.
    pub fn submit_and_wait(&self, record: impl FnOnce(vk::CommandBuffer)) -> Result<()> {
        let pool = lock(&self.one_off_pool);
        let info = vk::CommandBufferAllocateInfo::default().command_pool(*pool).command_buffer_count(1);
        let buffers = unsafe { self.device.allocate_command_buffers(&info) }
            .map_err(|e| vk_error("allocating a command buffer", e))?;
        let cmd = buffers[0];
        self.name(cmd, "one-off commands");
        let done = self.record_and_wait(cmd, record);
        unsafe { self.device.free_command_buffers(*pool, &buffers) };
        done
    }

    fn record_and_wait(&self, cmd: vk::CommandBuffer, record: impl FnOnce(vk::CommandBuffer)) -> Result<()> {
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        unsafe { self.device.begin_command_buffer(cmd, &begin) }
            .map_err(|e| vk_error("recording commands", e))?;
        record(cmd);
        unsafe { self.device.end_command_buffer(cmd) }.map_err(|e| vk_error("recording commands", e))?;
        let fence = unsafe { self.device.create_fence(&vk::FenceCreateInfo::default(), None) }
            .map_err(|e| vk_error("making a fence", e))?;
        self.name(fence, "one-off commands");
        let done = self.submit(cmd, fence).and_then(|()| {
            unsafe { self.device.wait_for_fences(&[fence], true, u64::MAX) }
                .map_err(|e| vk_error("waiting for the GPU", e))
        });
        unsafe { self.device.destroy_fence(fence, None) };
        done
    }

    /// The largest optimally tiled 2D image of `format` for `usage`.
    pub(super) fn image_format_properties(
        &self,
        format: vk::Format,
        usage: vk::ImageUsageFlags,
    ) -> ash::prelude::VkResult<vk::ImageFormatProperties> {
        let (kind, tiling) = (vk::ImageType::TYPE_2D, vk::ImageTiling::OPTIMAL);
        let none = vk::ImageCreateFlags::empty();
        let instance = &self.instance.handle;
        unsafe {
            instance.get_physical_device_image_format_properties(
                self.physical,
                format,
                kind,
                tiling,
                usage,
                none,
            )
        }
    }

    /// Device memory for the resource that `desc` names.
    pub(super) fn allocate(&self, desc: &AllocationCreateDesc<'_>) -> Result<Allocation> {
        let mut allocator = lock(&self.allocator);
        let allocator = allocator.as_mut().expect("the allocator lives until the context drops");
        allocator.allocate(desc).map_err(|error| {
            let (name, size) = (desc.name, bytes_text(desc.requirements.size));
            match error {
                AllocationError::OutOfMemory => Error::Device(format!(
                    "{name}: out of device memory, {size} do not fit ({} in all on {})",
                    bytes_text(self.limits.device_local_bytes),
                    self.info.name
                )),
                other => Error::Device(format!("{name}: no device memory of {size}: {other}")),
            }
        })
    }

    /// Gives back what [`Context::allocate`] gave.
    pub(super) fn free(&self, allocation: Allocation) {
        if let Some(allocator) = lock(&self.allocator).as_mut()
            && let Err(error) = allocator.free(allocation)
        {
            tracing::error!("freeing device memory: {error}");
        }
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        unsafe {
            // After a lost device there is nothing to wait for, and all must still be destroyed.
            let _ = self.device.device_wait_idle();
            self.device.destroy_command_pool(*lock(&self.one_off_pool), None);
            drop(lock(&self.allocator).take());
            let _destroying = driver_lock();
            self.device.destroy_device(None);
        }
    }
}

fn create_device(instance: &ash::Instance, chosen: &FoundDevice) -> Result<ash::Device> {
    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(chosen.queue_family)
        .queue_priorities(&[1.0])];
    let mut features = Features::query(instance, chosen.physical).enabled();
    let info = features.attach(vk::DeviceCreateInfo::default().queue_create_infos(&queues));
    let _making = driver_lock();
    unsafe { instance.create_device(chosen.physical, &info, None) }
        .map_err(|e| vk_error(&format!("opening {}", chosen.info.name), e))
}

/// A panic while a lock was held has already ended the run; the data behind these locks is whole at every step.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// `text` up to its first NUL, for names that Vulkan is told.
pub fn c_string(text: &str) -> CString {
    let text = text.split('\0').next().unwrap_or_default();
    CString::new(text).unwrap_or_default()
}
