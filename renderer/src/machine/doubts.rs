//! When times are doubtful: the rules of the module above, each a function.

use super::Machine;
use super::conditions::{Conditions, CpuTicks};

/// Part of the CPUs' time that others may take where the CPUs are the device.
pub const OTHERS_SHARE: f64 = 0.05;

/// Part of the time for which power and heat may hold a device's clocks back.
pub const THROTTLED_SHARE: f64 = 0.01;

/// Part of the highest graphics clock by which the lowest may be lower.
pub const CLOCK_SPREAD: f64 = 0.05;

/// AMD's performance levels that hold clocks down.
const SLOW_LEVELS: [&str; 3] = ["low", "profile_min_sclk", "profile_min_mclk"];

/// Why the times of a run are doubtful, a sentence each without its full stop; none where nothing was timed.
pub fn doubts(machine: &Machine, conditions: &Conditions) -> Vec<String> {
    if conditions.timed_s == 0.0 {
        return vec![];
    }
    let Machine { device, .. } = machine;
    let cpu_is_device = device.is_cpu();
    let load = conditions.cpu.as_ref().and_then(|cpu| if cpu_is_device { shared(cpu) } else { starved(cpu) });
    let rest = match cpu_is_device {
        true => [governor(conditions), stopped(conditions), heated(conditions)],
        false => [throttled(conditions), spread(conditions), slow_level(conditions)],
    };
    load.into_iter().chain(rest.into_iter().flatten()).collect()
}

/// The factor by which others may have lengthened times: where the CPUs are the device, what others took of them was missing,
/// beyond what sampling may be off. 1 on other devices, and where nothing is known.
pub fn stretch(machine: &Machine, conditions: &Conditions) -> f64 {
    let cpu = conditions.cpu.as_ref().filter(|_| machine.device.is_cpu());
    cpu.map_or(1.0, |cpu| {
        let taken = (cpu.others_share() - cpu.error()).max(0.0);
        1.0 / (1.0 - taken).max(f64::MIN_POSITIVE)
    })
}

/// Others run on the device.
fn shared(cpu: &CpuTicks) -> Option<String> {
    (cpu.others_share() > OTHERS_SHARE + cpu.error()).then(|| {
        format!(
            "other processes kept {:.2} of {} CPUs busy, which are the device",
            cpu.others_cpus(),
            cpu.cpus
        )
    })
}

/// Nobody feeds the device.
fn starved(cpu: &CpuTicks) -> Option<String> {
    let free = 1.0 - cpu.others_share();
    (free < 1.0 / f64::from(cpu.cpus) - cpu.error()).then(|| {
        format!(
            "other processes kept {:.2} of {} CPUs busy: less than one was left",
            cpu.others_cpus(),
            cpu.cpus
        )
    })
}

fn governor(conditions: &Conditions) -> Option<String> {
    let others: Vec<&str> =
        conditions.governors.iter().map(String::as_str).filter(|name| *name != "performance").collect();
    (!others.is_empty()).then(|| {
        format!("the CPUs' governor is {}, not performance: clocks follow the load", others.join(", "))
    })
}

fn stopped(conditions: &Conditions) -> Option<String> {
    let seconds = conditions.stopped_s.filter(|&seconds| seconds > 0.0)?;
    Some(format!("a CPU quota stopped the program for {seconds:.2} of {:.2} s", conditions.timed_s))
}

fn heated(conditions: &Conditions) -> Option<String> {
    let events = conditions.heat_events.filter(|&events| events > 0)?;
    Some(format!("CPUs counted {events} throttlings for heat"))
}

fn throttled(conditions: &Conditions) -> Option<String> {
    let share = conditions.throttled_s.unwrap_or(0.0) / conditions.timed_s;
    let reasons = match conditions.throttled.is_empty() {
        true if share <= THROTTLED_SHARE => return None,
        true => "power or heat".to_owned(),
        false => conditions.throttled.join(", "),
    };
    let when = match share > 0.0 {
        true => format!(" for {:.0} % of the time", (100.0 * share).min(100.0)),
        false => String::new(),
    };
    Some(format!("the device's clocks were held back{when}: {reasons}"))
}

fn spread(conditions: &Conditions) -> Option<String> {
    let [least, most] = conditions.graphics_mhz?;
    let apart = f64::from(most - least) > CLOCK_SPREAD * f64::from(most);
    apart.then(|| {
        format!("the device's graphics clock was {least} MHz after one temporal run and {most} after another")
    })
}

fn slow_level(conditions: &Conditions) -> Option<String> {
    let slow = conditions.levels.iter().find(|level| SLOW_LEVELS.contains(&level.as_str()))?;
    Some(format!("the device's performance level is {slow}"))
}

#[cfg(test)]
mod tests {
    use super::super::Device;
    use super::*;

    fn on(kind: &str, conditions: &Conditions) -> Vec<String> {
        let device = Device { kind: kind.into(), ..Device::default() };
        doubts(&Machine { device, ..Machine::default() }, &Conditions { timed_s: 2.0, ..conditions.clone() })
    }

    fn others(cpus: u32, all: u64, others: u64) -> Conditions {
        Conditions { cpu: Some(CpuTicks { cpus, all, own: 0, others }), ..Conditions::default() }
    }

    #[test]
    fn a_quiet_machine_raises_no_doubt() {
        let quiet = Conditions {
            load_average: Some([2.0, 2.0]),
            governors: vec!["performance".into()],
            stopped_s: Some(0.0),
            heat_events: Some(0),
            graphics_mhz: Some([1980, 2000]),
            throttled_s: Some(0.001),
            levels: vec!["auto".into()],
            ..others(2, 10_000, 20)
        };
        for kind in ["cpu", "discrete"] {
            assert_eq!(on(kind, &quiet), [""; 0]);
        }
    }

    #[test]
    fn others_on_the_cpus_count_where_they_are_the_device() {
        assert_eq!(
            on("cpu", &others(2, 10_000, 1000)),
            ["other processes kept 0.20 of 2 CPUs busy, which are the device"]
        );
        assert_eq!(on("discrete", &others(2, 10_000, 1000)), [""; 0]);
        // Ten of a hundred ticks may be chance.
        assert_eq!(on("cpu", &others(2, 100, 10)), [""; 0]);
        assert_eq!(on("cpu", &others(2, 100, 16)).len(), 1);
    }

    #[test]
    fn what_others_took_of_a_device_that_is_the_cpus_may_have_lengthened_times() {
        let of = |kind: &str, conditions: &Conditions| {
            let device = Device { kind: kind.into(), ..Device::default() };
            stretch(&Machine { device, ..Machine::default() }, conditions)
        };
        assert!((of("cpu", &others(2, 10_000, 5100)) - 2.0).abs() < 1e-9);
        assert_eq!(of("cpu", &others(2, 10_000, 90)), 1.0);
        assert_eq!([of("discrete", &others(2, 10_000, 5100)), of("cpu", &Conditions::default())], [1.0, 1.0]);
    }

    #[test]
    fn a_device_must_be_fed() {
        let [busy, free] = [7500, 4900].map(|ticks| on("integrated", &others(2, 10_000, ticks)));
        assert_eq!(busy, ["other processes kept 1.50 of 2 CPUs busy: less than one was left"]);
        assert_eq!(free, [""; 0]);
    }

    #[test]
    fn what_slows_cpus_counts_where_they_are_the_device() {
        let slow = Conditions {
            governors: vec!["performance".into(), "schedutil".into()],
            stopped_s: Some(0.5),
            heat_events: Some(3),
            ..Conditions::default()
        };
        assert_eq!(
            on("cpu", &slow),
            [
                "the CPUs' governor is schedutil, not performance: clocks follow the load",
                "a CPU quota stopped the program for 0.50 of 2.00 s",
                "CPUs counted 3 throttlings for heat"
            ]
        );
        assert_eq!(on("discrete", &slow), [""; 0]);
    }

    #[test]
    fn what_slows_a_device_is_told() {
        let slow = Conditions {
            graphics_mhz: Some([1200, 1980]),
            throttled: vec!["power".into(), "heat".into()],
            throttled_s: Some(0.5),
            levels: vec!["profile_min_sclk".into()],
            ..Conditions::default()
        };
        assert_eq!(
            on("discrete", &slow),
            [
                "the device's clocks were held back for 25 % of the time: power, heat",
                "the device's graphics clock was 1200 MHz after one temporal run and 1980 after another",
                "the device's performance level is profile_min_sclk"
            ]
        );
        let unseen = Conditions { throttled_s: Some(0.5), ..Conditions::default() };
        assert_eq!(
            on("discrete", &unseen),
            ["the device's clocks were held back for 25 % of the time: power or heat"]
        );
        let at_an_end = Conditions { throttled: vec!["heat".into()], ..Conditions::default() };
        assert_eq!(on("discrete", &at_an_end), ["the device's clocks were held back: heat"]);
    }

    #[test]
    fn where_nothing_was_timed_nothing_is_doubtful() {
        let untimed = Conditions { governors: vec!["powersave".into()], ..Conditions::default() };
        let device = Device { kind: "cpu".into(), ..Device::default() };
        assert_eq!(doubts(&Machine { device, ..Machine::default() }, &untimed), [""; 0]);
    }
}
