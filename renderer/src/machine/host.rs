//! The host: its CPUs, its memory and its system.

use super::Roots;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fs;
use std::thread::available_parallelism;

/// A host, without its name.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(default)]
pub struct Host {
    /// Model of its CPUs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu: Option<String>,
    /// How many cores they have in all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cores: Option<u32>,
    /// How many threads those run at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<u32>,
    /// How many of these the program may use, by its affinity and its quota.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub usable_threads: Option<u32>,
    /// Main memory.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory_bytes: Option<u64>,
    /// Name and version of the system.
    pub os: String,
    /// Release of its kernel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kernel: Option<String>,
    /// Instruction set that the program was compiled for.
    pub architecture: String,
}

impl Host {
    /// The host that `roots` tell of.
    pub fn read(roots: &Roots) -> Self {
        let cpuinfo = roots.proc("cpuinfo").unwrap_or_default();
        let os = fs::read_to_string(roots.etc.join("os-release")).ok().and_then(|text| pretty_name(&text));
        Self {
            cpu: cpu_model(&cpuinfo),
            cores: cores(&cpuinfo),
            threads: threads(&cpuinfo),
            usable_threads: available_parallelism().ok().and_then(|count| u32::try_from(count.get()).ok()),
            memory_bytes: roots.proc("meminfo").and_then(|text| memory_bytes(&text)),
            os: os.unwrap_or_else(|| std::env::consts::OS.into()),
            kernel: roots.proc("sys/kernel/osrelease").map(|text| text.trim().to_owned()),
            architecture: std::env::consts::ARCH.into(),
        }
    }
}

/// (key, value) of the lines `key : value`.
fn fields(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.lines().filter_map(|line| line.split_once(':')).map(|(key, value)| (key.trim(), value.trim()))
}

/// The first CPU's model. Kernels of ARM and RISC-V machines name none, or only the board.
fn cpu_model(cpuinfo: &str) -> Option<String> {
    let named = |wanted| fields(cpuinfo).find(|(key, value)| *key == wanted && !value.is_empty());
    let (_, model) = ["model name", "cpu model", "Hardware", "Model"].into_iter().find_map(named)?;
    Some(model.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// Distinct pairs of socket and core; kernels of ARM machines name none.
fn cores(cpuinfo: &str) -> Option<u32> {
    let mut socket = "";
    let mut cores = BTreeSet::new();
    for (key, value) in fields(cpuinfo) {
        match key {
            "physical id" => socket = value,
            "core id" => {
                cores.insert((socket, value));
            }
            _ => {}
        }
    }
    some(cores.len())
}

fn threads(cpuinfo: &str) -> Option<u32> {
    some(fields(cpuinfo).filter(|(key, _)| *key == "processor").count())
}

fn some(count: usize) -> Option<u32> {
    u32::try_from(count).ok().filter(|&count| count > 0)
}

fn memory_bytes(meminfo: &str) -> Option<u64> {
    let (_, total) = fields(meminfo).find(|(key, _)| *key == "MemTotal")?;
    total.strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// The system's name for people.
fn pretty_name(os_release: &str) -> Option<String> {
    let value = os_release.lines().find_map(|line| line.strip_prefix("PRETTY_NAME="))?;
    let name = value.trim().trim_matches(['"', '\'']);
    (!name.is_empty()).then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::testing::Planted;
    use super::*;

    /// Two sockets of one core with two threads each.
    const CPUINFO: &str = "processor\t: 0\nmodel name\t: Quick  CPU @ 3.00GHz\nphysical id\t: 0\ncore id\t\t: 0\n\n\
        processor\t: 1\nmodel name\t: Quick  CPU @ 3.00GHz\nphysical id\t: 1\ncore id\t\t: 0\n\n\
        processor\t: 2\nmodel name\t: Quick  CPU @ 3.00GHz\nphysical id\t: 0\ncore id\t\t: 0\n\n\
        processor\t: 3\nmodel name\t: Quick  CPU @ 3.00GHz\nphysical id\t: 1\ncore id\t\t: 0\n";

    #[test]
    fn a_host_is_told_by_its_files() {
        let planted = Planted::new(&[
            ("/proc/cpuinfo", CPUINFO),
            ("/proc/meminfo", "MemTotal:       24684084 kB\nMemFree:         4818624 kB\n"),
            ("/proc/sys/kernel/osrelease", "6.1.0-30-amd64\n"),
            (
                "/etc/os-release",
                "NAME=\"Debian\"\nPRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\nID=debian\n",
            ),
        ]);
        let host = Host::read(&planted.roots());
        assert_eq!(host.cpu.as_deref(), Some("Quick CPU @ 3.00GHz"));
        assert_eq!((host.cores, host.threads), (Some(2), Some(4)));
        assert_eq!(host.memory_bytes, Some(24_684_084 * 1024));
        assert_eq!(host.os, "Debian GNU/Linux 12 (bookworm)");
        assert_eq!(host.kernel.as_deref(), Some("6.1.0-30-amd64"));
    }

    #[test]
    fn what_is_not_told_is_left_out() {
        let host = Host::read(&Planted::new(&[]).roots());
        let known = Host { usable_threads: host.usable_threads, ..Host::default() };
        assert_eq!(Host { os: String::new(), architecture: String::new(), ..host.clone() }, known);
        assert_eq!(host.os, std::env::consts::OS);
        let json = serde_json::to_value(&host).unwrap();
        assert!(json.get("cpu").is_none() && json.get("kernel").is_none(), "{json}");
    }

    #[test]
    fn an_arm_board_is_known_by_its_name() {
        let cpuinfo =
            "processor\t: 0\nCPU part\t: 0xd08\n\nprocessor\t: 1\nCPU part\t: 0xd08\n\nModel\t\t: Board 4\n";
        assert_eq!(cpu_model(cpuinfo).as_deref(), Some("Board 4"));
        assert_eq!((cores(cpuinfo), threads(cpuinfo)), (None, Some(2)));
    }
}
