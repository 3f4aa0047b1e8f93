//! The device features that the renderer needs, and those it takes where they are.

use ash::{ext, khr, vk};
use std::ffi::{CStr, c_char};

/// What a device of the portability subset has of what others must have.
type PortabilitySubset = vk::PhysicalDevicePortabilitySubsetFeaturesKHR<'static>;

/// Whether a device offers an extension.
pub(super) fn offers(instance: &ash::Instance, physical: vk::PhysicalDevice, name: &CStr) -> bool {
    let extensions = unsafe { instance.enumerate_device_extension_properties(physical) }.unwrap_or_default();
    extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name))
}

/// What `physical` has of the features that only devices of the portability subset (VK_KHR_portability_subset) may lack;
/// `None` for a device that lacks none.
pub(super) fn portability_subset(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
) -> Option<PortabilitySubset> {
    if !offers(instance, physical, khr::portability_subset::NAME) {
        return None;
    }
    let mut subset = PortabilitySubset::default();
    let mut query = vk::PhysicalDeviceFeatures2::default().push_next(&mut subset);
    unsafe { instance.get_physical_device_features2(physical, &mut query) };
    Some(subset)
}

/// Feature structures chained for a query or for device creation.
#[derive(Default)]
pub(super) struct Features {
    core: vk::PhysicalDeviceFeatures,
    v11: vk::PhysicalDeviceVulkan11Features<'static>,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    v13: vk::PhysicalDeviceVulkan13Features<'static>,
    portability: Option<PortabilitySubset>,
    conservative: bool,
    /// The extensions that the device is opened with.
    names: Vec<*const c_char>,
}

impl Features {
    /// What `physical`, a Vulkan 1.3 device, offers.
    pub fn query(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Self {
        let mut offered = Self {
            portability: portability_subset(instance, physical),
            conservative: offers(instance, physical, ext::conservative_rasterization::NAME),
            ..Self::default()
        };
        let mut query = vk::PhysicalDeviceFeatures2::default()
            .push_next(&mut offered.v11)
            .push_next(&mut offered.v12)
            .push_next(&mut offered.v13);
        unsafe { instance.get_physical_device_features2(physical, &mut query) };
        offered.core = query.features;
        offered
    }

    /// The names of the required features that are not offered, in specification spelling.
    ///
    /// `maintenance4` (workgroup sizes by specialization constant) and `shaderTerminateInvocation` (`discard`) are
    /// what SPIR-V 1.6 from GLSL uses.
    pub fn missing(&self) -> Vec<&'static str> {
        let required = [
            (self.core.fragment_stores_and_atomics, "fragmentStoresAndAtomics"),
            (self.v12.scalar_block_layout, "scalarBlockLayout"),
            (self.v13.dynamic_rendering, "dynamicRendering"),
            (self.v13.synchronization2, "synchronization2"),
            (self.v13.maintenance4, "maintenance4"),
            (self.v13.shader_terminate_invocation, "shaderTerminateInvocation"),
            (self.v13.shader_demote_to_helper_invocation, "shaderDemoteToHelperInvocation"),
        ];
        required.into_iter().filter(|(offered, _)| *offered != vk::TRUE).map(|(_, name)| name).collect()
    }

    /// What to enable on a device that misses nothing: all required features, and of the optional ones those offered.
    pub fn enabled(&self) -> Self {
        let mut enabled =
            Self { portability: self.portability, conservative: self.conservative, ..Self::default() };
        enabled.core = vk::PhysicalDeviceFeatures::default()
            .fragment_stores_and_atomics(true)
            .sample_rate_shading(self.core.sample_rate_shading == vk::TRUE)
            .sampler_anisotropy(self.core.sampler_anisotropy == vk::TRUE)
            .multi_draw_indirect(self.core.multi_draw_indirect == vk::TRUE)
            .draw_indirect_first_instance(self.core.draw_indirect_first_instance == vk::TRUE)
            .shader_clip_distance(self.core.shader_clip_distance == vk::TRUE)
            .shader_int64(self.core.shader_int64 == vk::TRUE);
        enabled.v11 = enabled
            .v11
            .multiview(self.v11.multiview == vk::TRUE)
            .shader_draw_parameters(self.v11.shader_draw_parameters == vk::TRUE);
        enabled.v12 = enabled
            .v12
            .scalar_block_layout(true)
            .shader_output_layer(self.v12.shader_output_layer == vk::TRUE)
            .host_query_reset(self.v12.host_query_reset == vk::TRUE);
        enabled.v13 = enabled
            .v13
            .dynamic_rendering(true)
            .synchronization2(true)
            .maintenance4(true)
            .shader_terminate_invocation(true)
            .shader_demote_to_helper_invocation(true);
        enabled
    }

    /// `info` with these features, which must outlive it, and their extensions: also that which a device of the portability subset
    /// must be opened with.
    pub fn attach<'a>(&'a mut self, info: vk::DeviceCreateInfo<'a>) -> vk::DeviceCreateInfo<'a> {
        let subset = self.portability.map(|_| khr::portability_subset::NAME.as_ptr());
        let conservative = self.conservative.then_some(ext::conservative_rasterization::NAME.as_ptr());
        self.names = subset.into_iter().chain(conservative).collect();
        let info = info
            .enabled_extension_names(&self.names)
            .enabled_features(&self.core)
            .push_next(&mut self.v11)
            .push_next(&mut self.v12)
            .push_next(&mut self.v13);
        match &mut self.portability {
            Some(subset) => info.push_next(subset),
            None => info,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_missing_feature_is_named() {
        let mut offered = Features::default();
        assert_eq!(offered.missing().len(), 7);
        offered = offered.enabled();
        assert!(offered.missing().is_empty());
        offered.v12.scalar_block_layout = vk::FALSE;
        assert_eq!(offered.missing(), ["scalarBlockLayout"]);
    }

    #[test]
    fn a_device_of_the_portability_subset_is_opened_as_one() {
        let extensions =
            |mut features: Features| features.attach(vk::DeviceCreateInfo::default()).enabled_extension_count;
        let subset = PortabilitySubset::default().multisample_array_image(true);
        let offered = Features { portability: Some(subset), conservative: true, ..Features::default() };
        let enabled = offered.enabled();
        assert!(enabled.portability.is_some_and(|subset| subset.multisample_array_image == vk::TRUE));
        assert_eq!((extensions(enabled), extensions(Features::default())), (2, 0));
    }
}
