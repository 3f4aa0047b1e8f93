//! What tells one device from others like it, and the state that it says it is in.

use serde::{Deserialize, Serialize};

/// A device, as its Vulkan driver describes it. Not part of what a run is known by: two cards of one name are one
/// device there.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(default)]
pub struct Device {
    /// `discrete`, `integrated`, `virtual`, `cpu` or `other`.
    pub kind: String,
    /// Vulkan's `deviceUUID`, as [`uuid_text`].
    pub uuid: String,
    /// Vulkan's name of the driver's maker and kind, such as `MESA_RADV`.
    pub driver_id: String,
    /// PCI vendor, or Vulkan's number of who has none.
    pub vendor_id: u32,
    /// The vendor's number of the model.
    pub device_id: u32,
    /// `domain:bus:device.function`, where the driver tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pci: Option<String>,
    /// Its memory.
    pub heaps: Vec<Heap>,
}

/// A memory heap of a device.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Heap {
    /// Size.
    pub bytes: u64,
    /// Whether it is the device's own.
    pub device_local: bool,
}

impl Device {
    /// Whether the host's CPUs render.
    pub fn is_cpu(&self) -> bool {
        self.kind == "cpu"
    }
}

/// A UUID as it is usually written: `00112233-4455-6677-8899-aabbccddeeff`.
pub fn uuid_text(bytes: [u8; 16]) -> String {
    let mut text = String::with_capacity(36);
    for (index, byte) in bytes.iter().enumerate() {
        if matches!(index, 4 | 6 | 8 | 10) {
            text.push('-');
        }
        text += &format!("{byte:02x}");
    }
    text
}

/// What a device says of itself at one moment.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct DeviceState {
    /// Clock of its shader cores, MHz.
    pub graphics_mhz: Option<u32>,
    /// Clock of its memory, MHz.
    pub memory_mhz: Option<u32>,
    /// What holds its clocks back against the user's wish.
    pub throttled: Vec<&'static str>,
    /// Nanoseconds for which power and heat have held them back, since the driver was loaded.
    pub throttled_ns: Option<u64>,
    /// How the user lets it choose clocks.
    pub level: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uuid_is_written_as_usual() {
        let bytes = std::array::from_fn(|index| (index * 17) as u8);
        assert_eq!(uuid_text(bytes), "00112233-4455-6677-8899-aabbccddeeff");
    }
}
