//! Which device runs: listing and choice.

use super::features::Features;
use super::instance::Instance;
use super::limits::{DeviceInfo, Limits, read_info, read_limits, version_text};
use super::{bytes_text, no_device, vk_error};
use crate::{Error, Result};
use ash::vk;
use serde::Serialize;
use std::fmt;

/// A physical device with what is known of it.
pub(super) struct FoundDevice {
    pub physical: vk::PhysicalDevice,
    pub info: DeviceInfo,
    pub limits: Limits,
    pub queue_family: u32,
    /// Why it cannot run the renderer.
    pub unusable: Option<String>,
}

/// All devices of `instance`, in the loader's order.
///
/// # Errors
/// [`Error::Device`] when there is none.
pub(super) fn found_devices(instance: &Instance) -> Result<Vec<FoundDevice>> {
    let physical_devices = unsafe { instance.handle.enumerate_physical_devices() }.map_err(|e| match e {
        // So the loader says that of the installed drivers none finds a device it can serve.
        vk::Result::ERROR_INITIALIZATION_FAILED | vk::Result::ERROR_INCOMPATIBLE_DRIVER => no_device(),
        other => vk_error("listing the Vulkan devices", other),
    })?;
    if physical_devices.is_empty() {
        return Err(no_device());
    }
    Ok(physical_devices.into_iter().map(|physical| found_device(&instance.handle, physical)).collect())
}

fn found_device(instance: &ash::Instance, physical: vk::PhysicalDevice) -> FoundDevice {
    let info = read_info(instance, physical);
    let version = unsafe { instance.get_physical_device_properties(physical) }.api_version;
    let family = queue_family(instance, physical);
    let unusable = if version < vk::API_VERSION_1_3 {
        Some(format!("it speaks Vulkan {}, 1.3 is needed: install a newer driver", version_text(version)))
    } else if family.is_none() {
        Some("it has no queue for graphics and compute".into())
    } else {
        let missing = Features::query(instance, physical).missing();
        (!missing.is_empty()).then(|| format!("it lacks {}", missing.join(", ")))
    };
    let queue_family = family.unwrap_or(0);
    FoundDevice {
        physical,
        info,
        limits: read_limits(instance, physical, queue_family),
        queue_family,
        unusable,
    }
}

/// The first family with graphics and compute, on which transfers are always allowed.
fn queue_family(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Option<u32> {
    let wanted = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
    families.iter().position(|family| family.queue_flags.contains(wanted)).map(|index| index as u32)
}

/// The device that `wanted` (an index, or a part of a name in any case) means, or else the best usable one: discrete
/// before integrated before the rest, in the loader's order.
///
/// # Errors
/// [`Error::Input`] when `wanted` fits no device, [`Error::Device`] when there is none or none is usable.
pub(super) fn choose(mut found_devices: Vec<FoundDevice>, wanted: Option<&str>) -> Result<FoundDevice> {
    let names: Vec<_> = found_devices.iter().map(|c| (c.info.clone(), c.unusable.clone())).collect();
    let index = match wanted {
        Some(wanted) => find(&names, wanted)?,
        None => best(&names)?,
    };
    let chosen = found_devices.swap_remove(index);
    match chosen.unusable {
        Some(reason) => {
            Err(Error::Device(format!("device {index} ({}) cannot be used: {reason}", chosen.info.name)))
        }
        None => Ok(chosen),
    }
}

type Named = (DeviceInfo, Option<String>);

fn find(devices: &[Named], wanted: &str) -> Result<usize> {
    let lower = wanted.to_lowercase();
    let by_index = wanted.parse().ok().filter(|&index: &usize| index < devices.len());
    let by_name = || {
        let matching = |(_, (info, _)): &(usize, &Named)| info.name.to_lowercase().contains(&lower);
        let mut found = devices.iter().enumerate().filter(matching);
        let first = found.next();
        // A usable device wins over one of the same name that is not.
        first
            .into_iter()
            .chain(found)
            .min_by_key(|(_, (_, unusable))| unusable.is_some())
            .map(|(index, _)| index)
    };
    by_index.or_else(by_name).ok_or_else(|| {
        Error::input(format!(
            "no Vulkan device is called or numbered {wanted:?}; there are: {}",
            roll(devices)
        ))
    })
}

fn best(devices: &[Named]) -> Result<usize> {
    let rank = |info: &DeviceInfo| match info.hardware.kind.as_str() {
        "discrete" => 0,
        "integrated" => 1,
        "virtual" => 2,
        _ => 3,
    };
    let usable = devices.iter().enumerate().filter(|(_, (_, unusable))| unusable.is_none());
    usable
        .min_by_key(|(_, (info, _))| rank(info))
        .map(|(index, _)| index)
        .ok_or_else(|| Error::Device(format!("no usable Vulkan device: {}", roll(devices))))
}

fn roll(devices: &[Named]) -> String {
    let entry = |(index, (info, unusable)): (usize, &Named)| match unusable {
        Some(reason) => format!("{index} {} (unusable: {reason})", info.name),
        None => format!("{index} {}", info.name),
    };
    devices.iter().enumerate().map(entry).collect::<Vec<_>>().join("; ")
}

/// One line of a [`DeviceListing`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListedDevice {
    /// Index that `--device` takes.
    pub index: usize,
    /// Name and driver of the device.
    #[serde(flatten)]
    pub info: DeviceInfo,
    /// Why it cannot run the renderer, if so.
    pub unusable: Option<String>,
    /// Limits of what the device can hold.
    pub limits: Limits,
}

/// All devices, for people ([`fmt::Display`]) and machines ([`Serialize`], as a list).
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct DeviceListing {
    /// Devices in the loader's order, which `--device INDEX` counts by.
    pub devices: Vec<ListedDevice>,
}

impl DeviceListing {
    /// Lists the devices; fails as [`list_devices`] does.
    pub fn new() -> Result<Self> {
        let listed = |(index, (info, limits, unusable))| ListedDevice { index, info, unusable, limits };
        let devices: Vec<_> = list_devices()?.into_iter().enumerate().map(listed).collect();
        Ok(Self { devices })
    }
}

impl fmt::Display for DeviceListing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.devices.iter().try_for_each(|device| device.fmt(f))
    }
}

impl fmt::Display for ListedDevice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { index, info, limits, unusable } = self;
        writeln!(f, "{index}  {} ({})", info.name, info.hardware.kind)?;
        if let Some(reason) = unusable {
            writeln!(f, "   unusable: {reason}")?;
        }
        let mut row = |label: &str, value: String| writeln!(f, "   {label:<16} {value}");
        let [x, y, z] = limits.max_compute_work_group_count;
        let samples: Vec<_> = limits.sample_counts.iter().map(u32::to_string).collect();
        let yes = |present: bool| if present { "yes" } else { "no" };
        row("driver", format!("{} {}", info.driver, info.driver_version))?;
        row("Vulkan", info.api_version.clone())?;
        row("UUID", info.hardware.uuid.clone())?;
        if let Some(pci) = &info.hardware.pci {
            row("PCI address", pci.clone())?;
        }
        row("device memory", bytes_text(limits.device_local_bytes))?;
        row(
            "storage buffer",
            format!(
                "{} at most, {} a stage",
                bytes_text(limits.max_storage_buffer_range),
                limits.max_per_stage_storage_buffers
            ),
        )?;
        row("texel buffer", format!("{} texels", limits.max_texel_buffer_elements))?;
        row(
            "work groups",
            format!("{x} x {y} x {z} of {} invocations", limits.max_compute_work_group_invocations),
        )?;
        row("shared memory", bytes_text(limits.max_compute_shared_memory.into()))?;
        row("image side", format!("{} texels", limits.max_image_dimension_2d))?;
        row("image layers", limits.max_layers.to_string())?;
        row(
            "MSAA",
            format!(
                "{} samples, per-sample shading: {}",
                samples.join(", "),
                yes(limits.sample_rate_shading)
            ),
        )?;
        row("anisotropy", format!("{}", limits.max_sampler_anisotropy))?;
        row("subgroup", limits.subgroup_size.to_string())?;
        row("conservative rasterisation", yes(limits.conservative_rasterization).to_string())?;
        row("multiview", format!("{} views", if limits.multiview { limits.max_multiview_views } else { 1 }))?;
        row(
            "timestamps",
            format!("{} bits of {} ns", limits.timestamp_valid_bits, limits.timestamp_period_ns),
        )
    }
}

/// Every device with its limits and, where it cannot run the renderer, why.
///
/// # Errors
/// [`Error::Device`] when the Vulkan loader, every driver or every device is missing.
pub fn list_devices() -> Result<Vec<(DeviceInfo, Limits, Option<String>)>> {
    let instance = Instance::new(false)?;
    Ok(found_devices(&instance)?.into_iter().map(|c| (c.info, c.limits, c.unusable)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Device;

    fn devices(list: &[(&str, &str, bool)]) -> Vec<Named> {
        let named = |&(name, kind, usable): &(&str, &str, bool)| {
            let [driver, driver_version, api_version] = [const { String::new() }; 3];
            let hardware = Device { kind: kind.into(), ..Device::default() };
            let info = DeviceInfo { name: name.into(), driver, driver_version, api_version, hardware };
            (info, (!usable).then(|| "it lacks dynamicRendering".to_string()))
        };
        list.iter().map(named).collect()
    }

    #[test]
    fn a_discrete_device_wins_over_integrated_over_cpu() {
        let all =
            devices(&[("llvmpipe", "cpu", true), ("Iris", "integrated", true), ("RTX", "discrete", true)]);
        assert_eq!(best(&all).unwrap(), 2);
        assert_eq!(best(&all[..2]).unwrap(), 1);
        assert_eq!(best(&all[..1]).unwrap(), 0);
        let broken = devices(&[("RTX", "discrete", false), ("llvmpipe", "cpu", true)]);
        assert_eq!(best(&broken).unwrap(), 1);
    }

    #[test]
    fn no_usable_device_is_an_error_that_says_why() {
        let error = best(&devices(&[("Old", "discrete", false)])).unwrap_err().to_string();
        assert!(error.contains("0 Old (unusable: it lacks dynamicRendering)"), "{error}");
    }

    #[test]
    fn a_device_is_found_by_index_and_by_part_of_its_name() {
        let all = devices(&[("NVIDIA RTX 4090", "discrete", true), ("llvmpipe (LLVM 15)", "cpu", true)]);
        assert_eq!(find(&all, "1").unwrap(), 1);
        assert_eq!(find(&all, "LLVMPIPE").unwrap(), 1);
        assert_eq!(find(&all, "4090").unwrap(), 0);
        let error = find(&all, "radeon").unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("0 NVIDIA RTX 4090; 1 llvmpipe (LLVM 15)"), "{error}");
    }

    #[test]
    fn of_two_devices_of_one_name_the_usable_one_is_found() {
        let all = devices(&[("RTX", "discrete", false), ("RTX", "discrete", true)]);
        assert_eq!(find(&all, "rtx").unwrap(), 1);
    }

    #[test]
    fn the_listing_shows_every_device_to_people_and_machines() {
        let listing = DeviceListing::new().unwrap();
        let text = listing.to_string();
        let json = serde_json::to_value(&listing).unwrap();
        for device in &listing.devices {
            assert!(text.contains(&format!("{}  {}", device.index, device.info.name)));
            assert_eq!(json[device.index]["name"], device.info.name.as_str());
            let hardware = &device.info.hardware;
            assert_eq!(json[device.index]["uuid"], hardware.uuid.as_str());
            assert!(text.contains(&hardware.uuid) && hardware.uuid.len() == 36, "{text}");
            let own: u64 = hardware.heaps.iter().filter(|h| h.device_local).map(|h| h.bytes).sum();
            assert_eq!(own, device.limits.device_local_bytes);
        }
    }
}
