//! The machine that measured, how it fared meanwhile, and whether its times are to be trusted.
//!
//! ```text
//! Vulkan ───────────> Device ─┬─> Machine ────────────────┬─> doubts ─> run.json, report, standard error
//! /proc, /sys, /etc ─> Host ──┘                           │
//! /proc, /sys, NVML ─> Probe ─> Sample x 2 ─> Conditions ─┘
//! ```
//!
//! A sample is taken before and after each temporal run, never within one. What a system does not tell is left out:
//! most of this is known on Linux alone. No name of a host or a user and no path is kept.
//!
//! Rules of doubt ([`doubts()`]). Where the CPU is the device:
//!
//! 1. Other processes took more than [`OTHERS_SHARE`] of the CPUs that the program may run on, over all temporal runs,
//!    and by more than counting ticks may be off, `1 / sqrt(ticks)`. The program's own threads are subtracted: they are
//!    the device at work. Time that a hypervisor gave to another machine counts as others'.
//! 2. A governor other than `performance`: clocks follow the load.
//! 3. The CPUs were throttled for heat, or a quota of the control group stopped the program.
//!
//! Where it is not:
//!
//! 1. Other processes left less than one CPU to the program that feeds the device.
//! 2. The device said at either end of a temporal run that power, heat or another device held its clocks back, or that
//!    power and heat did so for more than [`THROTTLED_SHARE`] of the time.
//! 3. Graphics clocks at the ends of the temporal runs lie further apart than [`CLOCK_SPREAD`] of the highest.
//! 4. The user's choice holds clocks down (AMD's performance levels `low`, `profile_min_sclk`, `profile_min_mclk`).

mod amd;
mod conditions;
mod device;
mod doubts;
mod host;
mod load;
mod nvml;
mod probe;

pub use conditions::{Conditions, CpuTicks};
pub use device::{Device, Heap, uuid_text};
pub use doubts::{CLOCK_SPREAD, OTHERS_SHARE, THROTTLED_SHARE, doubts, stretch};
pub use host::Host;
pub use probe::{Probe, Sample};

use serde::{Deserialize, Serialize};
use std::fs;
use std::path::PathBuf;

/// A host and the device that rendered on it. Equal for all runs of one machine as long as its system is not changed.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(default)]
pub struct Machine {
    /// CPUs, memory and system.
    pub host: Host,
    /// The device.
    pub device: Device,
}

/// Where a system tells of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Roots {
    /// `/proc`
    pub proc: PathBuf,
    /// `/sys`
    pub sys: PathBuf,
    /// `/etc`
    pub etc: PathBuf,
}

impl Default for Roots {
    fn default() -> Self {
        Self { proc: "/proc".into(), sys: "/sys".into(), etc: "/etc".into() }
    }
}

impl Roots {
    fn proc(&self, name: &str) -> Option<String> {
        fs::read_to_string(self.proc.join(name)).ok()
    }

    fn sys(&self, name: &str) -> Option<String> {
        fs::read_to_string(self.sys.join(name)).ok()
    }

    /// Of every CPU the file `name` in its directory, where it has one.
    fn of_cpus(&self, name: &str) -> Vec<String> {
        let Ok(entries) = fs::read_dir(self.sys.join("devices/system/cpu")) else { return vec![] };
        let is_cpu = |file: &str| {
            let number = file.strip_prefix("cpu").unwrap_or_default();
            !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
        };
        let cpus = entries.flatten().filter(|entry| entry.file_name().to_str().is_some_and(is_cpu));
        cpus.filter_map(|entry| fs::read_to_string(entry.path().join(name)).ok()).collect()
    }
}

#[cfg(test)]
mod testing {
    //! Planted systems.

    use super::Roots;
    use std::fs;
    use tempfile::TempDir;

    /// A directory that stands for a whole system.
    pub struct Planted {
        directory: TempDir,
    }

    impl Planted {
        /// One with these files, named from `/`.
        pub fn new(files: &[(&str, &str)]) -> Self {
            let planted = Self { directory: tempfile::tempdir().unwrap() };
            files.iter().for_each(|(name, text)| planted.write(name, text.as_bytes()));
            planted
        }

        /// Writes a file, named from `/`.
        pub fn write(&self, name: &str, bytes: &[u8]) {
            let path = self.directory.path().join(name.trim_start_matches('/'));
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }

        /// Where it tells of itself.
        pub fn roots(&self) -> Roots {
            let [proc, sys, etc] = ["proc", "sys", "etc"].map(|name| self.directory.path().join(name));
            Roots { proc, sys, etc }
        }
    }
}
