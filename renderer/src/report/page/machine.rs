//! Which machines measured, how they fared, and whose times are doubtful.

use super::text;
use crate::machine::Machine;
use crate::report::format::{readable, significant};
use crate::report::results::{ResultSet, Run};
use crate::text::bytes_text;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A machine with its runs, by device and driver too: those are not the machine's to know.
type Machines<'a> = BTreeMap<(&'a Machine, &'a [String; 3]), Vec<&'a Run>>;

/// Distinct machines with their runs.
pub fn machines(set: &ResultSet) -> Machines<'_> {
    let mut machines = Machines::new();
    for run in &set.runs {
        machines.entry((&run.machine, &run.device)).or_default().push(run);
    }
    machines
}

/// Runs whose times are doubtful.
pub fn doubtful(set: &ResultSet) -> impl Iterator<Item = &Run> {
    set.runs.iter().filter(|run| !run.doubts.is_empty())
}

/// A table a machine, and a list of the runs whose times are doubtful.
pub fn section(body: &mut String, set: &ResultSet) {
    super::section(body, "machine", "Machine");
    let machines = machines(set);
    for ((machine, device), runs) in &machines {
        if machines.len() > 1 {
            // Writing to a string cannot fail, here and below.
            let _ = writeln!(body, "<h3>{} of {} runs</h3>", runs.len(), set.runs.len());
        }
        table(body, &[host(machine), device_rows(machine, device), fared(runs)].concat());
    }
    if doubtful(set).next().is_some() {
        body.push_str("<h3>Doubtful times</h3>\n");
        let rows = doubtful(set).map(|run| [run.name.clone(), run.doubts.join("; ")]);
        table(body, &rows.collect::<Vec<_>>());
    }
    body.push_str("</section>\n");
}

fn table(body: &mut String, rows: &[[String; 2]]) {
    body.push_str("<div class=\"scroll\"><table class=\"facts\">\n");
    for [name, value] in rows.iter().filter(|[_, value]| !value.is_empty()) {
        let _ = writeln!(body, "<tr><th>{}</th><td>{}</td></tr>", text(name), text(value));
    }
    body.push_str("</table></div>\n");
}

fn row(name: &str, value: impl Into<String>) -> [String; 2] {
    [name.into(), value.into()]
}

/// What is known of the host.
fn host(Machine { host, .. }: &Machine) -> Vec<[String; 2]> {
    let count = |number: Option<u32>, what: &str| number.map(|number| format!("{number} {what}"));
    let usable = host.usable_threads.filter(|&usable| host.threads.is_some_and(|threads| usable < threads));
    let parts = [
        host.cpu.clone(),
        count(host.cores, "cores"),
        count(host.threads, "threads"),
        count(usable, "of them usable"),
    ];
    let system = [Some(host.os.clone()), host.kernel.clone(), Some(host.architecture.clone())];
    vec![
        row("CPU", joined(parts)),
        row("Memory", host.memory_bytes.map(bytes_text).unwrap_or_default()),
        row("System", joined(system)),
    ]
}

/// What is known of the device.
fn device_rows(Machine { device, .. }: &Machine, [name, driver, api]: &[String; 3]) -> Vec<[String; 2]> {
    let heap = |local: bool| {
        let sizes = device.heaps.iter().filter(|heap| heap.device_local == local);
        sizes.map(|heap| bytes_text(heap.bytes)).collect::<Vec<_>>().join(" + ")
    };
    let kind = (!device.kind.is_empty()).then(|| device.kind.clone());
    vec![
        row("Device", joined([Some(name.clone()), kind, device.pci.clone()])),
        row("UUID", device.uuid.clone()),
        row("Driver", joined([Some(driver.clone()), Some(device.driver_id.clone())])),
        row("Vulkan", api.clone()),
        row("Device memory", heap(true)),
        row("Other memory it reaches", heap(false)),
    ]
}

/// How the machine fared, over all runs.
fn fared(runs: &[&Run]) -> Vec<[String; 2]> {
    let conditions = || runs.iter().map(|run| &run.conditions);
    let clock = |of: fn(&crate::machine::Conditions) -> Option<[u32; 2]>| {
        let clocks = conditions().filter_map(of).flatten().map(f64::from);
        range(clocks, "MHz")
    };
    let names = |of: fn(&crate::machine::Conditions) -> &[String]| {
        let mut names: Vec<&str> = conditions().flat_map(of).map(String::as_str).collect();
        names.sort_unstable();
        names.dedup();
        names.join(", ")
    };
    let cpus = || conditions().filter_map(|run| run.cpu);
    let most = cpus().map(|cpu| cpu.cpus).max().unwrap_or_default();
    let load = conditions().filter_map(|run| run.load_average).flatten();
    vec![
        row("CPU governor", names(|run| &run.governors)),
        row("CPUs that others kept busy", range(cpus().map(|cpu| cpu.others_cpus()), &format!("of {most}"))),
        row("Load average before and after runs", range(load, "")),
        row("Graphics clock", clock(|run| run.graphics_mhz)),
        row("Memory clock", clock(|run| run.memory_mhz)),
        row("Clocks held back by", names(|run| &run.throttled)),
        row("Performance level", names(|run| &run.levels)),
        row(
            "Times are doubtful of",
            match runs.iter().filter(|run| !run.doubts.is_empty()).count() {
                0 => "no run".into(),
                doubtful => format!("{doubtful} of {} runs, named below", runs.len()),
            },
        ),
    ]
}

/// What is known, side by side.
fn joined(parts: impl IntoIterator<Item = Option<String>>) -> String {
    let known: Vec<String> = parts.into_iter().flatten().filter(|part| !part.is_empty()).collect();
    known.join(", ")
}

/// The least and the greatest value; nothing of none.
fn range(values: impl Iterator<Item = f64>, unit: &str) -> String {
    let Some((least, most)) = values.fold(None, |range: Option<(f64, f64)>, value| {
        let (least, most) = range.unwrap_or((value, value));
        Some((least.min(value), most.max(value)))
    }) else {
        return String::new();
    };
    let shown = |value: f64| {
        if value < 100.0 { significant((value * 100.0).round() / 100.0, 4) } else { readable(value) }
    };
    let text = if least == most { shown(least) } else { format!("{} to {}", shown(least), shown(most)) };
    format!("{text} {unit}").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Conditions, CpuTicks, Device, Heap, Host};
    use crate::report::testing::{assert_well_formed, run, set};

    fn measured(cpu: &str, others: u64, doubts: &[&str]) -> Run {
        let machine = Machine {
            host: Host {
                cpu: Some(cpu.into()),
                threads: Some(8),
                usable_threads: Some(4),
                ..Host::default()
            },
            device: Device {
                uuid: "00112233".into(),
                heaps: vec![Heap { bytes: 3 << 30, device_local: true }],
                ..Device::default()
            },
        };
        let conditions = Conditions {
            cpu: Some(CpuTicks { cpus: 8, all: 800, own: 0, others }),
            graphics_mhz: Some([1200, 1980]),
            ..Conditions::default()
        };
        let doubts = doubts.iter().map(|doubt| (*doubt).to_owned()).collect();
        Run { machine, conditions, doubts, ..run("indi-persp-64", 1, 1000, |_, _| Some(1.0)) }
    }

    fn page(runs: Vec<Run>) -> String {
        let mut body = String::new();
        section(&mut body, &set(runs));
        assert_well_formed(&body);
        body
    }

    #[test]
    fn a_machine_is_one_table() {
        let page = page(vec![measured("A<B", 50, &[]), measured("A<B", 150, &["heat & others"])]);
        for expected in [
            "<tr><th>CPU</th><td>A&lt;B, 8 threads, 4 of them usable</td></tr>",
            "<tr><th>Device</th><td>device</td></tr>",
            "<tr><th>Device memory</th><td>3.0 GiB</td></tr>",
            "<tr><th>CPUs that others kept busy</th><td>0.5 to 1.5 of 8</td></tr>",
            "<td>1 of 2 runs, named below</td>",
            "<tr><th>indi-persp-64_1000</th><td>heat &amp; others</td></tr>",
        ] {
            assert!(page.contains(expected), "{expected} in {page}");
        }
        assert_eq!(page.matches("<table").count(), 2);
        assert!(!page.contains("Memory clock") && !page.contains("governor"), "{page}");
    }

    #[test]
    fn machines_are_kept_apart() {
        let page = page(vec![measured("A", 0, &[]), measured("B", 0, &[]), measured("B", 0, &[])]);
        assert!(page.contains("<h3>1 of 3 runs</h3>") && page.contains("<h3>2 of 3 runs</h3>"), "{page}");
        assert_eq!(page.matches("<td>no run</td>").count(), 2);
        assert!(!page.contains("Doubtful times"), "{page}");
    }

    #[test]
    fn ranges_are_short() {
        assert_eq!(range([0.123, 0.456].into_iter(), ""), "0.12 to 0.46");
        assert_eq!(range([0.0].into_iter(), ""), "0");
        assert_eq!(range(std::iter::empty(), "MHz"), "");
    }
}
