//! Takes samples of the machine's state.

use super::device::{Device, DeviceState};
use super::load::{self, CpuTimes};
use super::nvml::Nvml;
use super::{Roots, amd, nvml};
use std::path::PathBuf;
use std::time::Instant;

/// Reads the state of a machine, again and again. To sample takes some milliseconds at most.
pub struct Probe {
    roots: Roots,
    gauge: Gauge,
}

/// What tells a device's clocks.
enum Gauge {
    None,
    Nvidia(Nvml),
    Amd(PathBuf),
}

/// The state of a machine at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// When.
    pub(super) at: Instant,
    /// Tasks that ran or waited, over the last minute.
    pub(super) load_average: Option<f64>,
    /// Who has used the CPUs.
    pub(super) cpu: Option<CpuTimes>,
    /// Governors of the CPUs' clocks.
    pub(super) governors: Vec<String>,
    /// For how long a quota has stopped the program, microseconds.
    pub(super) stopped_us: Option<u64>,
    /// How often heat has throttled CPUs.
    pub(super) heat_events: Option<u64>,
    /// What the device says.
    pub(super) device: DeviceState,
}

impl Probe {
    /// A probe of this machine, on which `device` renders.
    pub fn new(device: &Device) -> Self {
        Self::below(Roots::default(), device)
    }

    /// A probe of the machine that `roots` tell of.
    pub fn below(roots: Roots, device: &Device) -> Self {
        let gauge = match (device.vendor_id, &device.pci) {
            (nvml::VENDOR, _) => Nvml::open(device).map(Gauge::Nvidia),
            (amd::VENDOR, Some(pci)) => amd::directory(&roots, pci).map(Gauge::Amd),
            _ => None,
        };
        Self { roots, gauge: gauge.unwrap_or(Gauge::None) }
    }

    /// The state now.
    pub fn sample(&self) -> Sample {
        let roots = &self.roots;
        Sample {
            at: Instant::now(),
            // First, for clocks fall soon after the last frame.
            device: match &self.gauge {
                Gauge::None => DeviceState::default(),
                Gauge::Nvidia(nvml) => nvml.read(),
                Gauge::Amd(directory) => amd::read(directory),
            },
            load_average: load::average(roots),
            cpu: CpuTimes::read(roots),
            governors: load::governors(roots),
            stopped_us: load::stopped_us(roots),
            heat_events: load::heat_events(roots),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::Planted;
    use super::*;

    #[test]
    fn a_sample_tells_what_files_tell() {
        let planted = Planted::new(&[
            ("/proc/loadavg", "0.50 0.77 1.28 1/91 20307\n"),
            ("/proc/stat", "cpu  3 0 0 7 0 0 0 0 0 0\ncpu0 3 0 0 7 0 0 0 0 0 0\n"),
            ("/proc/self/stat", "77 (x) R 1 2 3 4 -1 5 98 0 1 0 2 0 7 7 20 0 1 0 99 1 1\n"),
            ("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n"),
            ("/sys/bus/pci/devices/0000:03:00.0/pp_dpm_sclk", "0: 500Mhz *\n"),
        ]);
        let device = Device { vendor_id: amd::VENDOR, pci: Some("0000:03:00.0".into()), ..Device::default() };
        let sample = Probe::below(planted.roots(), &device).sample();
        assert_eq!(sample.load_average, Some(0.5));
        assert_eq!(sample.cpu, Some(CpuTimes { cpus: 1, all: 10, busy: 3, own: 2 }));
        assert_eq!(sample.governors, ["powersave"]);
        assert_eq!(sample.device.graphics_mhz, Some(500));
        assert_eq!((sample.stopped_us, sample.heat_events), (None, None));
    }

    #[test]
    fn a_system_that_tells_nothing_is_sampled_too() {
        let planted = Planted::new(&[]);
        for vendor_id in [0, amd::VENDOR, nvml::VENDOR] {
            let device =
                Device { vendor_id, pci: Some("none".into()), uuid: "none".into(), ..Device::default() };
            let sample = Probe::below(planted.roots(), &device).sample();
            assert_eq!((sample.cpu, sample.device), (None, DeviceState::default()));
        }
    }
}
