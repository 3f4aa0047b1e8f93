//! The state of an AMD device, from files of Linux's `amdgpu` driver (kernel documentation, GPU Power/Thermal Controls).

use super::Roots;
use super::device::DeviceState;
use std::fs;
use std::path::{Path, PathBuf};

/// PCI's number of AMD.
pub const VENDOR: u32 = 0x1002;

/// Size, format and content revision that the head of `gpu_metrics` 1.3 names, and where it has its throttle status.
const METRICS_HEAD: [u8; 4] = [120, 0, 1, 3];
const THROTTLE_STATUS: usize = 112;

/// Bits of the throttle status, by what holds clocks back.
const THROTTLES: [(u64, &str); 3] =
    [(0xffff, "power"), (0xffff_0000, "current"), (0x00ff_ffff_0000_0000, "heat")];

/// The directory of the device at a PCI address, where the driver is there.
pub fn directory(roots: &Roots, pci: &str) -> Option<PathBuf> {
    let directory = roots.sys.join("bus/pci/devices").join(pci);
    directory.join("pp_dpm_sclk").is_file().then_some(directory)
}

/// What its files tell now.
pub fn read(directory: &Path) -> DeviceState {
    let text = |name: &str| fs::read_to_string(directory.join(name)).ok();
    let clock = |name| text(name).and_then(|levels| current_mhz(&levels));
    let metrics = fs::read(directory.join("gpu_metrics")).unwrap_or_default();
    DeviceState {
        graphics_mhz: clock("pp_dpm_sclk"),
        memory_mhz: clock("pp_dpm_mclk"),
        throttled: throttles(&metrics),
        throttled_ns: None,
        level: text("power_dpm_force_performance_level").map(|level| level.trim().to_owned()),
    }
}

/// The level with the star: `1: 2103Mhz *`.
fn current_mhz(levels: &str) -> Option<u32> {
    let line = levels.lines().find(|line| line.trim_end().ends_with('*'))?;
    let (_, clock) = line.split_once(':')?;
    let digits = clock.trim_start();
    digits[..digits.find(|c: char| !c.is_ascii_digit())?].parse().ok()
}

/// What holds clocks back; nothing is known of other formats.
fn throttles(metrics: &[u8]) -> Vec<&'static str> {
    let status = metrics.get(THROTTLE_STATUS..).and_then(|rest| rest.first_chunk());
    let Some(status) = status.filter(|_| metrics.starts_with(&METRICS_HEAD)) else { return vec![] };
    let status = u64::from_le_bytes(*status);
    // Where a device tells nothing, all bits are set.
    let known = status != u64::MAX;
    THROTTLES.iter().filter(|(bits, _)| known && status & bits != 0).map(|(_, name)| *name).collect()
}

#[cfg(test)]
mod tests {
    use super::super::testing::Planted;
    use super::*;

    fn metrics(head: [u8; 4], status: u64) -> Vec<u8> {
        let mut bytes = vec![7; THROTTLE_STATUS];
        bytes[..4].copy_from_slice(&head);
        bytes.extend(status.to_le_bytes());
        bytes
    }

    #[test]
    fn files_tell_the_state() {
        let planted = Planted::new(&[]);
        let at = "0000:03:00.0";
        assert_eq!(directory(&planted.roots(), at), None);
        let write = |name: &str, bytes: &[u8]| {
            planted.write(&format!("/sys/bus/pci/devices/{at}/{name}"), bytes);
        };
        write("pp_dpm_sclk", b"0: 500Mhz \n1: 2103Mhz *\n2: 2525Mhz \n");
        write("pp_dpm_mclk", b"0: 96Mhz *\n1: 1000Mhz\n");
        write("power_dpm_force_performance_level", b"auto\n");
        write("gpu_metrics", &metrics(METRICS_HEAD, 1 << 32 | 1 << 3));
        let state = read(&directory(&planted.roots(), at).unwrap());
        let expected = DeviceState {
            graphics_mhz: Some(2103),
            memory_mhz: Some(96),
            throttled: vec!["power", "heat"],
            throttled_ns: None,
            level: Some("auto".into()),
        };
        assert_eq!(state, expected);
    }

    #[test]
    fn formats_that_are_not_known_tell_nothing() {
        assert_eq!(throttles(&metrics(METRICS_HEAD, 1 << 16)), ["current"]);
        assert_eq!(throttles(&metrics(METRICS_HEAD, 1 << 56)), [""; 0]);
        assert_eq!(throttles(&metrics(METRICS_HEAD, u64::MAX)), [""; 0]);
        assert_eq!(throttles(&metrics([120, 0, 2, 2], 1 << 16)), [""; 0]);
        assert_eq!(throttles(&metrics(METRICS_HEAD, 1)[..118]), [""; 0]);
    }

    #[test]
    fn a_clock_that_no_star_marks_is_not_known() {
        assert_eq!(current_mhz("0: 500Mhz\n"), None);
        assert_eq!(current_mhz("S: 19Mhz *\n1: 500Mhz\n"), Some(19));
        assert_eq!(current_mhz("0: *\n"), None);
    }
}
