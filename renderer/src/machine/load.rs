//! Who used the CPUs, and what kept the program from them: texts of Linux's `/proc` and `/sys`.

use super::Roots;
use std::ops::RangeInclusive;
use std::path::Path;

/// CPU time since the system started, in ticks of its accounting, over the CPUs that the program may run on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CpuTimes {
    /// How many CPUs these are.
    pub cpus: u32,
    /// All of it, idle time too.
    pub all: u64,
    /// Of it, what anyone used, a hypervisor for other machines too.
    pub busy: u64,
    /// Of that, what this process used, all its threads.
    pub own: u64,
}

impl CpuTimes {
    /// As of now.
    pub fn read(roots: &Roots) -> Option<Self> {
        let own = own_ticks(&roots.proc("self/stat")?)?;
        let allowed = roots.proc("self/status").and_then(|text| allowed_cpus(&text));
        let times = system_ticks(&roots.proc("stat")?, allowed.as_deref())?;
        Some(Self { own, ..times })
    }
}

/// `utime` and `stime` of `/proc/self/stat`. The program's name stands before them in brackets and may hold any sign.
fn own_ticks(stat: &str) -> Option<u64> {
    let (_, fields) = stat.rsplit_once(')')?;
    let mut times = fields.split_whitespace().skip(11).map(str::parse::<u64>);
    Some(times.next()?.ok()? + times.next()?.ok()?)
}

/// `Cpus_allowed_list` of `/proc/self/status`: `0-3,8`.
fn allowed_cpus(status: &str) -> Option<Vec<RangeInclusive<u32>>> {
    let list = status.lines().find_map(|line| line.strip_prefix("Cpus_allowed_list:"))?;
    let range = |text: &str| {
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        Some(first.parse().ok()?..=last.parse().ok()?)
    };
    list.trim().split(',').map(range).collect()
}

/// The lines `cpuN` of `/proc/stat` of the CPUs allowed, summed up.
fn system_ticks(stat: &str, allowed: Option<&[RangeInclusive<u32>]>) -> Option<CpuTimes> {
    let mut sum = CpuTimes::default();
    for line in stat.lines() {
        let mut fields = line.split_whitespace();
        let Some(Ok(cpu)) = fields.next().and_then(|name| name.strip_prefix("cpu")).map(str::parse::<u32>)
        else {
            continue;
        };
        if allowed.is_some_and(|ranges| !ranges.iter().any(|range| range.contains(&cpu))) {
            continue;
        }
        // user, nice, system, idle, iowait, irq, softirq, steal. Time of guests, which follows, is in user and nice.
        let ticks: Vec<u64> = fields.take(8).map_while(|field| field.parse().ok()).collect();
        let idle: u64 = ticks.iter().skip(3).take(2).sum();
        let all: u64 = ticks.iter().sum();
        sum = CpuTimes { cpus: sum.cpus + 1, all: sum.all + all, busy: sum.busy + all - idle, own: 0 };
    }
    (sum.cpus > 0).then_some(sum)
}

/// How many tasks ran or waited over the last minute, of `/proc/loadavg`.
pub fn average(roots: &Roots) -> Option<f64> {
    roots.proc("loadavg")?.split_whitespace().next()?.parse().ok()
}

/// Distinct governors of the CPUs' clocks.
pub fn governors(roots: &Roots) -> Vec<String> {
    let mut found = roots.of_cpus("cpufreq/scaling_governor");
    found.iter_mut().for_each(|name| *name = name.trim().to_owned());
    found.sort();
    found.dedup();
    found
}

/// Microseconds for which a quota of the program's control group (version 2) has stopped it. Quotas of groups further
/// up are not seen.
pub fn stopped_us(roots: &Roots) -> Option<u64> {
    let group = roots.proc("self/cgroup")?;
    let group = group.lines().find_map(|line| line.strip_prefix("0::/"))?;
    let stat = roots.sys(Path::new("fs/cgroup").join(group).join("cpu.stat").to_str()?)?;
    stat.lines().find_map(|line| line.strip_prefix("throttled_usec "))?.trim().parse().ok()
}

/// How often heat has throttled CPUs, where the kernel counts it (Intel).
pub fn heat_events(roots: &Roots) -> Option<u64> {
    let counts = ["core", "package"].map(|part| format!("thermal_throttle/{part}_throttle_count"));
    let texts: Vec<String> = counts.iter().flat_map(|name| roots.of_cpus(name)).collect();
    let events: Vec<u64> = texts.iter().filter_map(|text| text.trim().parse().ok()).collect();
    (!events.is_empty()).then(|| events.iter().sum())
}

#[cfg(test)]
mod tests {
    use super::super::testing::Planted;
    use super::*;

    const STAT: &str = "cpu  330 0 30 640 20 4 6 70 9 0\ncpu0 100 0 10 300 10 1 2 0 5 0\n\
        cpu1 200 0 20 200 5 2 3 60 4 0\ncpu10 30 0 0 140 5 1 1 10 0 0\nintr 5 4\n";

    #[test]
    fn own_time_is_found_behind_any_name() {
        let stat = |name| format!("77 ({name}) R 1 2 3 4 -1 5 98 0 1 0 1230 45 7 7 20 0 1 0 99 1 1\n");
        assert_eq!(own_ticks(&stat("manylight")), Some(1275));
        assert_eq!(own_ticks(&stat("a) R 1 2 (b")), Some(1275));
        assert_eq!(own_ticks("77 (cut"), None);
    }

    #[test]
    fn busy_is_what_is_neither_idle_nor_waiting() {
        let all = system_ticks(STAT, None).unwrap();
        assert_eq!(all, CpuTimes { cpus: 3, all: 1100, busy: 440, own: 0 });
        let one = system_ticks(STAT, Some(&[1..=1, 4..=9])).unwrap();
        assert_eq!(one, CpuTimes { cpus: 1, all: 490, busy: 285, own: 0 });
        assert_eq!(system_ticks("intr 5\n", None), None);
    }

    #[test]
    fn cpus_are_those_that_the_program_may_use() {
        let list = |list| allowed_cpus(&format!("Name:\tx\nCpus_allowed_list:\t{list}\nMems_allowed:\t1\n"));
        assert_eq!(list("0-3,8"), Some(vec![0..=3, 8..=8]));
        assert_eq!(list("none"), None);
        assert_eq!(allowed_cpus("Name:\tx\n"), None);
    }

    #[test]
    fn times_are_read_of_one_system() {
        let planted = Planted::new(&[
            ("/proc/stat", STAT),
            ("/proc/self/stat", "77 (x) R 1 2 3 4 -1 5 98 0 1 0 20 3 7 7 20 0 1 0 99 1 1\n"),
            ("/proc/self/status", "Cpus_allowed_list:\t0\n"),
        ]);
        let expected = CpuTimes { cpus: 1, all: 423, busy: 113, own: 23 };
        assert_eq!(CpuTimes::read(&planted.roots()), Some(expected));
        assert_eq!(CpuTimes::read(&Planted::new(&[]).roots()), None);
    }

    #[test]
    fn governors_are_told_once_each() {
        let planted = Planted::new(&[]);
        assert_eq!(governors(&planted.roots()), Vec::<String>::new());
        for (cpu, governor) in [("cpu0", "schedutil\n"), ("cpu1", "performance\n"), ("cpu12", "schedutil\n")]
        {
            let path = format!("/sys/devices/system/cpu/{cpu}/cpufreq/scaling_governor");
            planted.write(&path, governor.as_bytes());
        }
        // No CPU.
        planted.write("/sys/devices/system/cpu/cpufreq/cpufreq/scaling_governor", b"powersave\n");
        assert_eq!(governors(&planted.roots()), ["performance", "schedutil"]);
    }

    #[test]
    fn a_quota_is_that_of_the_own_group() {
        let planted = Planted::new(&[
            ("/proc/self/cgroup", "4:memory:/far\n0::/a/b\n"),
            ("/sys/fs/cgroup/a/b/cpu.stat", "usage_usec 9\nnr_throttled 2\nthrottled_usec 1234\n"),
        ]);
        assert_eq!(stopped_us(&planted.roots()), Some(1234));
        planted.write("/proc/self/cgroup", b"0::/\n");
        assert_eq!(stopped_us(&planted.roots()), None);
        planted.write("/sys/fs/cgroup/cpu.stat", b"throttled_usec 5\n");
        assert_eq!(stopped_us(&planted.roots()), Some(5));
    }

    #[test]
    fn heat_and_load_are_read() {
        let planted = Planted::new(&[("/proc/loadavg", "0.18 0.77 1.28 1/91 20307\n")]);
        assert_eq!((average(&planted.roots()), heat_events(&planted.roots())), (Some(0.18), None));
        for (name, count) in [("cpu0/thermal_throttle/core", "2\n"), ("cpu1/thermal_throttle/package", "3\n")]
        {
            planted.write(&format!("/sys/devices/system/cpu/{name}_throttle_count"), count.as_bytes());
        }
        assert_eq!(heat_events(&planted.roots()), Some(5));
    }
}
