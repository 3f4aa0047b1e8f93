//! What a device is called and what it can hold.

use super::features::{offers, portability_subset};
use crate::machine::{Device, Heap, uuid_text};
use ash::{ext, vk};
use serde::Serialize;
use std::ffi::CStr;

/// Name and driver of a device, as recorded with every run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DeviceInfo {
    /// Name of the device as the driver gives it.
    pub name: String,
    /// Name of the driver.
    pub driver: String,
    /// The driver's own version text, or its packed number where it gives none.
    pub driver_version: String,
    /// Highest Vulkan version that the device has, `major.minor.patch`.
    pub api_version: String,
    /// What tells the device from others of its name.
    #[serde(flatten)]
    pub hardware: Device,
}

/// The limits and optional features that passes plan with. Optional features listed here are enabled where present.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Limits {
    /// Nanoseconds per timestamp tick.
    pub timestamp_period_ns: f64,
    /// Meaningful low bits of a timestamp on the queue used; 0 without timestamps.
    pub timestamp_valid_bits: u32,
    /// Largest range of a storage buffer binding, bytes.
    pub max_storage_buffer_range: u64,
    /// Texels that a buffer may be viewed as.
    pub max_texel_buffer_elements: u64,
    /// Largest buffer, bytes.
    pub max_buffer_size: u64,
    /// Largest single allocation, bytes.
    pub max_memory_allocation_size: u64,
    /// Alignment of storage buffer binding offsets, bytes.
    pub min_storage_buffer_offset_alignment: u64,
    /// Alignment of uniform buffer binding offsets, bytes.
    pub min_uniform_buffer_offset_alignment: u64,
    /// Largest range of a uniform buffer binding, bytes.
    pub max_uniform_buffer_range: u64,
    /// Bytes of push constants.
    pub max_push_constants_size: u32,
    /// Workgroups of one dispatch, per axis.
    pub max_compute_work_group_count: [u32; 3],
    /// Invocations of a workgroup, per axis.
    pub max_compute_work_group_size: [u32; 3],
    /// Invocations of a workgroup.
    pub max_compute_work_group_invocations: u32,
    /// Bytes of shared memory of a workgroup.
    pub max_compute_shared_memory: u32,
    /// Storage buffers that one shader stage may bind.
    pub max_per_stage_storage_buffers: u32,
    /// Sampled images that one shader stage may bind.
    pub max_per_stage_sampled_images: u32,
    /// Descriptor sets of one pipeline layout.
    pub max_bound_descriptor_sets: u32,
    /// Draws of one indirect draw call (1 without `multiDrawIndirect`).
    pub max_draw_indirect_count: u32,
    /// Whether an indirect draw may have a first instance other than 0.
    pub draw_indirect_first_instance: bool,
    /// Width and height of the largest image and frame, texels.
    pub max_image_dimension_2d: u32,
    /// Sample counts that colour and depth attachments, also when sampled, all have; ascending.
    pub sample_counts: Vec<u32>,
    /// Whether multi-sampled samples lie at the standard positions.
    pub standard_sample_locations: bool,
    /// Whether fragment shaders may run once per sample.
    pub sample_rate_shading: bool,
    /// Highest anisotropy of a sampler; 0 where anisotropic filtering is missing.
    pub max_sampler_anisotropy: f32,
    /// Invocations of a subgroup, for information: nothing may assume it.
    pub subgroup_size: u32,
    /// Device-local memory, bytes over all heaps.
    pub device_local_bytes: u64,
    /// Layers of the largest array image and frame.
    pub max_layers: u32,
    /// Whether vertex shaders may choose the layer.
    pub shader_output_layer: bool,
    /// Whether vertex shaders may clip.
    pub shader_clip_distance: bool,
    /// Whether multi-sampled images may have several layers: devices of the portability subset may lack it.
    pub multisample_array_images: bool,
    /// Whether one pass may draw several views.
    pub multiview: bool,
    /// Views of one multiview pass.
    pub max_multiview_views: u32,
    /// Whether all pixels that a triangle may touch can be drawn (VK_EXT_conservative_rasterization).
    pub conservative_rasterization: bool,
    /// Whether queries can be reset from the host.
    pub host_query_reset: bool,
    /// Whether vertex shaders have `gl_DrawID`, `gl_BaseVertex` and `gl_BaseInstance`.
    pub shader_draw_parameters: bool,
    /// Whether shaders have 64-bit integers.
    pub shader_int64: bool,
}

impl Limits {
    /// These with no more layers of images than so many.
    pub(super) fn with_layers(self, most: Option<u32>) -> Self {
        Self { max_layers: most.map_or(self.max_layers, |most| most.min(self.max_layers)), ..self }
    }
}

/// Reads the name and driver of `physical`.
pub(super) fn read_info(instance: &ash::Instance, physical: vk::PhysicalDevice) -> DeviceInfo {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut ids = vk::PhysicalDeviceIDProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut ids);
    let modern =
        unsafe { instance.get_physical_device_properties(physical) }.api_version >= vk::API_VERSION_1_2;
    if modern {
        properties = properties.push_next(&mut driver);
    }
    unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
    let base = properties.properties;
    let text = |field: Result<&CStr, _>| field.map(|t| t.to_string_lossy().into_owned()).unwrap_or_default();
    let given = text(driver.driver_info_as_c_str());
    DeviceInfo {
        name: text(base.device_name_as_c_str()),
        driver: text(driver.driver_name_as_c_str()),
        driver_version: if given.is_empty() { version_text(base.driver_version) } else { given },
        api_version: version_text(base.api_version),
        hardware: Device {
            kind: kind_name(base.device_type).into(),
            uuid: uuid_text(ids.device_uuid),
            driver_id: if modern { format!("{:?}", driver.driver_id) } else { String::new() },
            vendor_id: base.vendor_id,
            device_id: base.device_id,
            pci: pci_address(instance, physical),
            heaps: heaps(instance, physical),
        },
    }
}

/// `domain:bus:device.function`; `None` where the device is on no such bus, or its driver does not tell.
fn pci_address(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Option<String> {
    let offered = unsafe { instance.enumerate_device_extension_properties(physical) }.ok()?;
    let tells =
        |offer: &vk::ExtensionProperties| offer.extension_name_as_c_str() == Ok(ext::pci_bus_info::NAME);
    offered.iter().any(tells).then(|| {
        let mut pci = vk::PhysicalDevicePCIBusInfoPropertiesEXT::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut pci);
        unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
        format!("{:04x}:{:02x}:{:02x}.{:x}", pci.pci_domain, pci.pci_bus, pci.pci_device, pci.pci_function)
    })
}

fn heaps(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Vec<Heap> {
    let memory = unsafe { instance.get_physical_device_memory_properties(physical) };
    let heap = |heap: &vk::MemoryHeap| Heap {
        bytes: heap.size,
        device_local: heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL),
    };
    memory.memory_heaps_as_slice().iter().map(heap).collect()
}

/// `major.minor.patch` of a packed Vulkan version.
pub(super) fn version_text(version: u32) -> String {
    let (major, minor) = (vk::api_version_major(version), vk::api_version_minor(version));
    format!("{major}.{minor}.{}", vk::api_version_patch(version))
}

fn kind_name(kind: vk::PhysicalDeviceType) -> &'static str {
    match kind {
        vk::PhysicalDeviceType::DISCRETE_GPU => "discrete",
        vk::PhysicalDeviceType::INTEGRATED_GPU => "integrated",
        vk::PhysicalDeviceType::VIRTUAL_GPU => "virtual",
        vk::PhysicalDeviceType::CPU => "cpu",
        _ => "other",
    }
}

/// Reads the limits of a Vulkan 1.3 device, with the timestamps of queue family `family`.
pub(super) fn read_limits(instance: &ash::Instance, physical: vk::PhysicalDevice, family: u32) -> Limits {
    let mut v11 = vk::PhysicalDeviceVulkan11Properties::default();
    let mut v13 = vk::PhysicalDeviceVulkan13Properties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut v11).push_next(&mut v13);
    unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
    let base = properties.properties.limits;

    let mut f11 = vk::PhysicalDeviceVulkan11Features::default();
    let mut f12 = vk::PhysicalDeviceVulkan12Features::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut f11).push_next(&mut f12);
    unsafe { instance.get_physical_device_features2(physical, &mut features) };
    let core = features.features;

    let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
    Limits {
        timestamp_period_ns: f64::from(base.timestamp_period),
        timestamp_valid_bits: families.get(family as usize).map_or(0, |f| f.timestamp_valid_bits),
        max_storage_buffer_range: base.max_storage_buffer_range.into(),
        max_texel_buffer_elements: base.max_texel_buffer_elements.into(),
        max_buffer_size: v13.max_buffer_size,
        max_memory_allocation_size: v11.max_memory_allocation_size,
        min_storage_buffer_offset_alignment: base.min_storage_buffer_offset_alignment,
        min_uniform_buffer_offset_alignment: base.min_uniform_buffer_offset_alignment,
        max_uniform_buffer_range: base.max_uniform_buffer_range.into(),
        max_push_constants_size: base.max_push_constants_size,
        max_compute_work_group_count: base.max_compute_work_group_count,
        max_compute_work_group_size: base.max_compute_work_group_size,
        max_compute_work_group_invocations: base.max_compute_work_group_invocations,
        max_compute_shared_memory: base.max_compute_shared_memory_size,
        max_per_stage_storage_buffers: base.max_per_stage_descriptor_storage_buffers,
        max_per_stage_sampled_images: base.max_per_stage_descriptor_sampled_images,
        max_bound_descriptor_sets: base.max_bound_descriptor_sets,
        max_draw_indirect_count: if core.multi_draw_indirect == vk::TRUE {
            base.max_draw_indirect_count
        } else {
            1
        },
        draw_indirect_first_instance: core.draw_indirect_first_instance == vk::TRUE,
        max_image_dimension_2d: max_dimension(&base),
        max_layers: base.max_image_array_layers.min(base.max_framebuffer_layers),
        sample_counts: sample_counts(&base),
        standard_sample_locations: base.standard_sample_locations == vk::TRUE,
        sample_rate_shading: core.sample_rate_shading == vk::TRUE,
        max_sampler_anisotropy: if core.sampler_anisotropy == vk::TRUE {
            base.max_sampler_anisotropy
        } else {
            0.0
        },
        subgroup_size: v11.subgroup_size,
        device_local_bytes: heaps(instance, physical)
            .iter()
            .filter(|heap| heap.device_local)
            .map(|heap| heap.bytes)
            .sum(),
        shader_output_layer: f12.shader_output_layer == vk::TRUE,
        shader_clip_distance: core.shader_clip_distance == vk::TRUE,
        multisample_array_images: portability_subset(instance, physical)
            .is_none_or(|subset| subset.multisample_array_image == vk::TRUE),
        multiview: f11.multiview == vk::TRUE,
        max_multiview_views: v11.max_multiview_view_count,
        conservative_rasterization: offers(instance, physical, ext::conservative_rasterization::NAME),
        host_query_reset: f12.host_query_reset == vk::TRUE,
        shader_draw_parameters: f11.shader_draw_parameters == vk::TRUE,
        shader_int64: core.shader_int64 == vk::TRUE,
    }
}

/// The smallest of the image, framebuffer and viewport limits, so that whatever can be made can be drawn to.
fn max_dimension(limits: &vk::PhysicalDeviceLimits) -> u32 {
    let framebuffer = limits.max_framebuffer_width.min(limits.max_framebuffer_height);
    let viewport = limits.max_viewport_dimensions[0].min(limits.max_viewport_dimensions[1]);
    limits.max_image_dimension2_d.min(framebuffer).min(viewport)
}

fn sample_counts(limits: &vk::PhysicalDeviceLimits) -> Vec<u32> {
    let common = limits.framebuffer_color_sample_counts
        & limits.framebuffer_depth_sample_counts
        & limits.sampled_image_color_sample_counts
        & limits.sampled_image_depth_sample_counts;
    (0..7).map(|bit| 1 << bit).filter(|&count| common.as_raw() & count != 0).collect()
}
