//! How a machine fared while the temporal runs of one run were made.

use super::probe::Sample;
use serde::{Deserialize, Serialize};

/// What samples before and after each temporal run tell. All sums, ranges and sets are over the temporal runs alone.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Conditions {
    /// How long the temporal runs took, seconds.
    pub timed_s: f64,
    /// Tasks that ran or waited over the last minute, before the first temporal run and after the last; the program's
    /// own count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_average: Option<[f64; 2]>,
    /// Who used the CPUs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu: Option<CpuTicks>,
    /// Governors of the CPUs' clocks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub governors: Vec<String>,
    /// For how long a quota stopped the program, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_s: Option<f64>,
    /// How often heat throttled CPUs: the counts of all of them, so what throttles all at once counts for each.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heat_events: Option<u64>,
    /// Lowest and highest clock of the device's shader cores at the ends of temporal runs, MHz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub graphics_mhz: Option<[u32; 2]>,
    /// Lowest and highest clock of its memory, MHz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub memory_mhz: Option<[u32; 2]>,
    /// What held its clocks back at either end of a temporal run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub throttled: Vec<String>,
    /// For how long power and heat did, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub throttled_s: Option<f64>,
    /// How the user lets the device choose clocks, where its driver tells.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<String>,
}

/// CPU time in ticks of the system's accounting, over the CPUs that the program may run on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CpuTicks {
    /// How many CPUs these are.
    pub cpus: u32,
    /// All of it.
    pub all: u64,
    /// Of it, what this program used.
    pub own: u64,
    /// Of it, what others used. Ticks are sampled, so this is off by a few.
    pub others: u64,
}

impl CpuTicks {
    /// The part that others used, 0 to 1.
    pub fn others_share(&self) -> f64 {
        self.others as f64 / self.all.max(1) as f64
    }

    /// How many CPUs others kept busy in the mean.
    pub fn others_cpus(&self) -> f64 {
        self.others_share() * f64::from(self.cpus)
    }

    /// By how much the share may be off, for ticks are sampled: two standard deviations of as many throws of a coin.
    pub fn error(&self) -> f64 {
        1.0 / (self.all.max(1) as f64).sqrt()
    }
}

impl Conditions {
    /// Adds a temporal run, from the samples at its ends.
    pub fn add(&mut self, before: &Sample, after: &Sample) {
        self.timed_s += after.at.saturating_duration_since(before.at).as_secs_f64();
        if let (Some(first), Some(last)) = (before.load_average, after.load_average) {
            self.load_average = Some([self.load_average.map_or(first, |[first, _]| first), last]);
        }
        self.add_cpu(before, after);
        let stopped = passed(before.stopped_us, after.stopped_us);
        add(&mut self.stopped_s, stopped.map(|us| us as f64 / 1e6));
        if let Some(events) = passed(before.heat_events, after.heat_events) {
            *self.heat_events.get_or_insert(0) += events;
        }
        widen(&mut self.graphics_mhz, after.device.graphics_mhz);
        widen(&mut self.memory_mhz, after.device.memory_mhz);
        let throttled = passed(before.device.throttled_ns, after.device.throttled_ns);
        add(&mut self.throttled_s, throttled.map(|ns| ns as f64 / 1e9));
        for end in [before, after] {
            unite(&mut self.governors, &end.governors);
            unite(&mut self.throttled, &end.device.throttled);
            unite(&mut self.levels, end.device.level.as_slice());
        }
    }

    fn add_cpu(&mut self, before: &Sample, after: &Sample) {
        let (Some(before), Some(after)) = (before.cpu, after.cpu) else { return };
        let passed = |of: fn(&super::load::CpuTimes) -> u64| of(&after).saturating_sub(of(&before));
        let (all, busy, own) = (passed(|t| t.all), passed(|t| t.busy), passed(|t| t.own));
        let sum = self.cpu.get_or_insert_default();
        sum.cpus = after.cpus;
        sum.all += all;
        sum.own += own;
        sum.others += busy.saturating_sub(own);
    }
}

/// By how much a count that never falls has grown.
fn passed(before: Option<u64>, after: Option<u64>) -> Option<u64> {
    Some(after?.saturating_sub(before?))
}

fn add(sum: &mut Option<f64>, more: Option<f64>) {
    if let Some(more) = more {
        *sum.get_or_insert(0.0) += more;
    }
}

fn widen(range: &mut Option<[u32; 2]>, value: Option<u32>) {
    if let Some(value) = value {
        let [least, most] = range.unwrap_or([value; 2]);
        *range = Some([least.min(value), most.max(value)]);
    }
}

/// Adds what is not there yet, in the order in which it comes.
fn unite(set: &mut Vec<String>, more: &[impl AsRef<str>]) {
    for name in more.iter().map(AsRef::as_ref) {
        if !set.iter().any(|known| known == name) {
            set.push(name.to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::device::DeviceState;
    use super::super::load::CpuTimes;
    use super::*;
    use std::time::{Duration, Instant};

    /// A sample so many seconds after `start`, at which counts that grow have grown by the second.
    fn sample(start: Instant, seconds: u64) -> Sample {
        Sample {
            at: start + Duration::from_secs(seconds),
            load_average: Some(seconds as f64),
            cpu: Some(CpuTimes { cpus: 2, all: 200 * seconds, busy: 150 * seconds, own: 120 * seconds }),
            governors: vec!["schedutil".into()],
            stopped_us: Some(500_000 * seconds),
            heat_events: Some(3 * seconds),
            device: DeviceState {
                graphics_mhz: Some(1000 + 10 * seconds as u32),
                memory_mhz: None,
                throttled: if seconds > 5 { vec!["power"] } else { vec![] },
                throttled_ns: Some(250_000_000 * seconds),
                level: Some("auto".into()),
            },
        }
    }

    #[test]
    fn temporal_runs_add_up_and_what_lies_between_does_not_count() {
        let start = Instant::now();
        let at = |seconds| sample(start, seconds);
        let mut conditions = Conditions::default();
        conditions.add(&at(1), &at(2));
        conditions.add(&at(7), &at(10));
        let expected = Conditions {
            timed_s: 4.0,
            load_average: Some([1.0, 10.0]),
            cpu: Some(CpuTicks { cpus: 2, all: 800, own: 480, others: 120 }),
            governors: vec!["schedutil".into()],
            stopped_s: Some(2.0),
            heat_events: Some(12),
            graphics_mhz: Some([1020, 1100]),
            memory_mhz: None,
            throttled: vec!["power".into()],
            throttled_s: Some(1.0),
            levels: vec!["auto".into()],
        };
        assert_eq!(conditions, expected);
        let cpu = conditions.cpu.unwrap();
        assert_eq!((cpu.others_share(), cpu.others_cpus()), (0.15, 0.3));
    }

    #[test]
    fn what_is_not_known_at_both_ends_is_left_out() {
        let start = Instant::now();
        let mut before = sample(start, 1);
        before.cpu = None;
        before.stopped_us = None;
        before.device.throttled_ns = None;
        let mut conditions = Conditions::default();
        conditions.add(&before, &sample(start, 2));
        assert_eq!((conditions.cpu, conditions.stopped_s, conditions.throttled_s), (None, None, None));
        let json = serde_json::to_value(Conditions::default()).unwrap();
        assert_eq!(json, serde_json::json!({ "timed_s": 0.0 }));
        assert_eq!(serde_json::from_value::<Conditions>(json).unwrap(), Conditions::default());
    }

    #[test]
    fn ticks_that_were_sampled_to_the_programs_advantage_are_none() {
        let start = Instant::now();
        let mut after = sample(start, 2);
        after.cpu = Some(CpuTimes { cpus: 2, all: 400, busy: 160, own: 260 });
        let mut conditions = Conditions::default();
        conditions.add(&sample(start, 1), &after);
        assert_eq!(conditions.cpu.unwrap().others, 0);
    }
}
