//! Loader and instance: the part of Vulkan before a device is chosen.

use super::validation::{ValidationLog, messenger_info};
use super::{no_device, vk_error};
use crate::{Error, Result};
use ash::{ext, khr, vk};
use std::ffi::CStr;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// A Vulkan 1.3 instance with, where available, debug utils and drivers of the portability subset, and, where asked for,
/// the validation layers.
pub(super) struct Instance {
    pub handle: ash::Instance,
    pub debug_utils: bool,
    pub log: Arc<ValidationLog>,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
}

impl Instance {
    /// Whether the validation layers are on.
    pub fn validates(&self) -> bool {
        self.messenger.is_some()
    }

    /// Loads the loader and makes the instance.
    ///
    /// # Errors
    /// [`Error::Device`], naming the package to install, when the loader, a Vulkan 1.3 loader or the validation
    /// layers are missing.
    pub fn new(validate: bool) -> Result<Self> {
        let entry = loader()?;
        let layers: &[*const std::ffi::c_char] = if validate { &[VALIDATION_LAYER.as_ptr()] } else { &[] };
        if validate {
            require_validation(entry)?;
        }
        let debug_utils = has_extension(entry, None, ext::debug_utils::NAME)?
            || (validate && has_extension(entry, Some(VALIDATION_LAYER), ext::debug_utils::NAME)?);
        let portability = has_extension(entry, None, khr::portability_enumeration::NAME)?;
        let mut extensions = Vec::new();
        extensions.extend(portability.then_some(khr::portability_enumeration::NAME.as_ptr()));
        extensions.extend(debug_utils.then_some(ext::debug_utils::NAME.as_ptr()));
        extensions.extend(validate.then_some(ext::validation_features::NAME.as_ptr()));

        let application = vk::ApplicationInfo::default()
            .application_name(c"manylight")
            .engine_name(c"manylight")
            .api_version(vk::API_VERSION_1_3);
        let log = Arc::new(ValidationLog::default());
        let mut messenger = messenger_info(&log);
        let synchronization = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&synchronization);
        // Drivers that are Vulkan but for a few features, such as MoltenVK, are hidden from who does not ask for them.
        let every_driver = match portability {
            true => vk::InstanceCreateFlags::ENUMERATE_PORTABILITY_KHR,
            false => vk::InstanceCreateFlags::empty(),
        };
        let mut info = vk::InstanceCreateInfo::default()
            .flags(every_driver)
            .application_info(&application)
            .enabled_layer_names(layers)
            .enabled_extension_names(&extensions);
        if validate {
            info = info.push_next(&mut messenger).push_next(&mut features);
        }
        let making = driver_lock();
        let handle = unsafe { entry.create_instance(&info, None) }.map_err(instance_error)?;
        drop(making);
        let mut instance = Self { handle, debug_utils, log, messenger: None };
        if validate {
            instance.listen(entry)?;
        }
        Ok(instance)
    }

    fn listen(&mut self, entry: &ash::Entry) -> Result<()> {
        let functions = ext::debug_utils::Instance::new(entry, &self.handle);
        let messenger = unsafe { functions.create_debug_utils_messenger(&messenger_info(&self.log), None) }
            .map_err(|e| vk_error("making the validation messenger", e))?;
        self.messenger = Some((functions, messenger));
        Ok(())
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        let _destroying = driver_lock();
        unsafe {
            if let Some((functions, messenger)) = &self.messenger {
                functions.destroy_debug_utils_messenger(*messenger, None);
            }
            self.handle.destroy_instance(None);
        }
    }
}

/// Held while an instance or a device is made or destroyed: Vulkan lets threads do so at the same time, but NVIDIA's
/// driver was seen to crash then (580.159, and in reports of other programs).
pub(super) fn driver_lock() -> MutexGuard<'static, ()> {
    static DRIVER: Mutex<()> = Mutex::new(());
    DRIVER.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// The Vulkan loader of this process. It stays mapped to the end: drivers keep threads and thread-local data of their
/// own, which must not outlive their code.
fn loader() -> Result<&'static ash::Entry> {
    static LOADER: OnceLock<ash::Entry> = OnceLock::new();
    if let Some(entry) = LOADER.get() {
        return Ok(entry);
    }
    let entry = load()?;
    Ok(LOADER.get_or_init(|| entry))
}

fn load() -> Result<ash::Entry> {
    let entry = unsafe { ash::Entry::load() }.map_err(|error| {
        Error::Device(format!(
            "no Vulkan loader ({}): install it and a driver (Debian: apt install libvulkan1 and your GPU's driver, \
             or mesa-vulkan-drivers for the software device lavapipe; macOS: the Vulkan SDK, which has both)",
            error.to_string().lines().next().unwrap_or_default()
        ))
    })?;
    let version = unsafe { entry.try_enumerate_instance_version() }
        .map_err(|e| vk_error("asking for the Vulkan version", e))?
        .unwrap_or(vk::API_VERSION_1_0);
    if version < vk::API_VERSION_1_3 {
        return Err(Error::Device(format!(
            "the Vulkan loader speaks {}.{}, 1.3 is needed: install a newer libvulkan1",
            vk::api_version_major(version),
            vk::api_version_minor(version)
        )));
    }
    Ok(entry)
}

fn require_validation(entry: &ash::Entry) -> Result<()> {
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .map_err(|e| vk_error("listing the Vulkan layers", e))?;
    let found = layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    if !found {
        return Err(Error::Device(
            "the Vulkan validation layers are not installed (Debian: apt install vulkan-validationlayers)"
                .into(),
        ));
    }
    for name in [ext::debug_utils::NAME, ext::validation_features::NAME] {
        if !has_extension(entry, Some(VALIDATION_LAYER), name)? {
            return Err(Error::Device(format!(
                "the Vulkan validation layers lack {}: install another version of vulkan-validationlayers",
                name.to_string_lossy()
            )));
        }
    }
    Ok(())
}

fn has_extension(entry: &ash::Entry, layer: Option<&CStr>, name: &CStr) -> Result<bool> {
    let extensions = unsafe { entry.enumerate_instance_extension_properties(layer) }
        .map_err(|e| vk_error("listing the Vulkan extensions", e))?;
    Ok(extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name)))
}

fn instance_error(result: vk::Result) -> Error {
    match result {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER | vk::Result::ERROR_INITIALIZATION_FAILED => no_device(),
        other => vk_error("making the Vulkan instance", other),
    }
}
