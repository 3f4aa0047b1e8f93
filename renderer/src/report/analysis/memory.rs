//! What the structures of each method take on the device: what groups and their lists take, which is what shading reads, and what
//! else building them takes.

use super::{by_lighting, methods};
use crate::measure::Purpose;
use crate::output::MemoryRow;
use crate::report::chart::palette::Color;
use crate::report::chart::{Bar, Chart, Key, Look};
use crate::report::figure::{self, Drawn, Figure, Wanted};
use crate::report::format::readable;
use crate::report::results::{ResultSet, Run, Setting, lightings, method_name};
use crate::report::tables::{Row, Table};

/// Bytes in a KiB.
const KIB: f64 = 1024.0;

/// What shading reads of a method.
const DRAWN: [Purpose; 2] = [Purpose::Grouping, Purpose::Lists];

const WANTED: Wanted<'static> = Wanted {
    id: "analysis-memory",
    title: "Memory of groups and lists",
    caption: "KiB that a frame needs, mean over frames and over all clusterings, each panel with its own axis: to know which groups \
              there are and to find a fragment's (grouping), and for the lists of lights (lists).",
    missing: "needs a method with groups",
};

/// A figure a setting: a panel a lighting, a bar a method.
pub fn figures(set: &ResultSet) -> Vec<Figure> {
    let settings = set.settings().into_iter();
    let drawn = settings
        .filter_map(|setting| Some(Drawn { setting, chart: chart(set, setting)?, remark: String::new() }));
    figure::figures(&WANTED, drawn.collect())
}

/// A purpose's structures of a run, by a number of each, KiB; `None` where it has none.
fn kib(run: &Run, purpose: Purpose, of: fn(&MemoryRow) -> u64) -> Option<f64> {
    let mut rows = run.memory.iter().filter(|row| row.purpose == purpose.name()).peekable();
    rows.peek()?;
    Some(rows.map(of).sum::<u64>() as f64 / KIB)
}

fn used(run: &Run, purpose: Purpose) -> Option<f64> {
    kib(run, purpose, |row| row.used)
}

fn color(purpose: Purpose) -> Color {
    match purpose {
        Purpose::Grouping => "green",
        Purpose::Lists => "purple",
        Purpose::Lights => "yellow",
        Purpose::Building => "grey",
    }
}

fn key(purpose: Purpose) -> Key {
    Key { label: purpose.to_string(), look: Look::plain(color(purpose)) }
}

fn chart(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    let grouped =
        || set.of(setting).filter(|run| run.method.has_lists() && used(run, Purpose::Lists).is_some());
    let bar = |run: &Run| {
        let parts: Vec<(Key, f64)> =
            DRAWN.iter().filter_map(|&purpose| Some((key(purpose), used(run, purpose)?))).collect();
        Bar {
            label: method_name(run.method, setting.is_stereo()),
            told: format!("{} KiB", readable(parts.iter().map(|(_, kib)| kib).sum())),
            parts,
            interval: None,
        }
    };
    by_lighting(&lightings(grouped()), ("KiB", DRAWN.map(key).to_vec()), |lighting| {
        let run = |method| grouped().find(|run| run.method == method && run.lighting == *lighting);
        methods(set, setting).into_iter().filter_map(|method| run(method).map(bar)).collect()
    })
}

/// A row a method, lighting and setting.
pub fn table(set: &ResultSet) -> Table {
    const NUMBERS: [fn(&MemoryRow) -> u64; 3] = [|row| row.used, |row| row.most, |row| row.allocated];
    const HEADINGS: &[&str] = &["used", "most", "allocated"];
    let row = |run: &Run| Row {
        setting: run.setting.to_string(),
        labels: vec![method_name(run.method, run.setting.is_stereo()), run.lighting.label.clone()],
        numbers: Purpose::ALL.iter().flat_map(|&purpose| NUMBERS.map(|of| kib(run, purpose, of))).collect(),
    };
    Table {
        id: "analysis-memory",
        title: "Memory on the device",
        caption: "KiB, over all clusterings: what a frame needs, mean over frames (used) and of the frame that needs most, and what was \
                  allocated, with every frame in flight and spare room. Grouping: which groups there are and how a fragment finds its own; \
                  lists: lengths and entries of the lists of lights; lights: the lights; building: all else that building lists takes. A \
                  frame needs what its buffers would take were they made for it alone. Buffers of scene, views and drawing are the same \
                  for all methods and left out.",
        labels: &["method", "lighting"],
        groups: vec![
            ("grouping KiB", HEADINGS),
            ("lists KiB", HEADINGS),
            ("lights KiB", HEADINGS),
            ("building KiB", HEADINGS),
        ],
        rows: set.runs.iter().filter(|run| !run.memory.is_empty()).map(row).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::Plot;
    use crate::report::testing::{assert_well_formed, run, set};

    fn with_memory(method: &str, rows: &[(&str, Purpose, [u64; 3])]) -> Run {
        let row = |&(structure, purpose, [allocated, used, most]): &(&str, Purpose, [u64; 3])| MemoryRow {
            structure: structure.into(),
            purpose: purpose.to_string(),
            allocated,
            used,
            most,
        };
        Run { memory: rows.iter().map(row).collect(), ..run(method, 1, 1000, |_, _| None) }
    }

    fn runs() -> ResultSet {
        let clusters = ("visible_clusters", Purpose::Grouping, [8192, 1024, 2048]);
        let bits = ("cluster_bits", Purpose::Grouping, [1024, 1024, 1024]);
        let lists = ("light_indices", Purpose::Lists, [4096, 2048, 3072]);
        let lights = ("lights", Purpose::Lights, [512, 512, 512]);
        set(vec![
            with_memory("sc-e-48-40", &[clusters, bits, lists, lights]),
            with_memory("all-lights", &[lights]),
            run("tiled-16", 1, 1000, |_, _| None),
        ])
    }

    #[test]
    fn structures_of_a_purpose_are_summed() {
        let table = table(&runs());
        assert_eq!(table.rows.len(), 2, "a run that tells no memory has no row");
        let numbers = &table.rows[0].numbers;
        assert_eq!(numbers[..6], [2.0, 3.0, 9.0, 2.0, 3.0, 4.0].map(Some));
        assert_eq!(numbers[6..], [Some(0.5), Some(0.5), Some(0.5), None, None, None]);
        assert_eq!(table.rows[1].numbers[..6], [None; 6]);
    }

    #[test]
    fn a_bar_is_what_shading_reads_of_a_method_that_groups() {
        let figures = figures(&runs());
        let chart = figures[0].chart.as_ref().unwrap();
        let Some(Plot::Bars(bars)) = &chart.panels[0] else { panic!("bars") };
        let told: Vec<(&str, f64, f64)> =
            bars.iter().map(|bar| (bar.told.as_str(), bar.parts[0].1, bar.parts[1].1)).collect();
        assert_eq!(told, [("4 KiB", 2.0, 2.0)]);
        assert_well_formed(&chart.svg_file("id", "title"));
        let nothing = super::figures(&set(vec![with_memory("all-lights", &[])]));
        assert!(nothing[0].chart.is_none());
    }
}
