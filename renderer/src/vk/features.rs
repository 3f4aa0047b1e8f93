//! The device features that the renderer needs, and those it takes where they are.

use ash::vk;

/// Feature structures chained for a query or for device creation.
#[derive(Default)]
pub(super) struct Features {
    core: vk::PhysicalDeviceFeatures,
    v11: vk::PhysicalDeviceVulkan11Features<'static>,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    v13: vk::PhysicalDeviceVulkan13Features<'static>,
}

impl Features {
    /// What `physical`, a Vulkan 1.3 device, offers.
    pub fn query(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Self {
        let mut offered = Self::default();
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
        let mut enabled = Self::default();
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

    /// `info` with these features, which must outlive it.
    pub fn attach<'a>(&'a mut self, info: vk::DeviceCreateInfo<'a>) -> vk::DeviceCreateInfo<'a> {
        info.enabled_features(&self.core)
            .push_next(&mut self.v11)
            .push_next(&mut self.v12)
            .push_next(&mut self.v13)
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
}
