//! Methods ranked, with the places where the ranking is told apart by measuring (Enhuber, tables 4.4 to 4.6).
//!
//! ```text
//! settings that differ in scene alone ──> criteria ──> entries (method, scene, number)
//!                                                         └─> worst scene of each method ──> ascending ──> classes
//! ```

use super::{Part, cells, growth, spread};
use crate::methods::Method;
use crate::report::results::{LightingName, ResultSet, Run, Setting, lightings, method_name};
use crate::report::tables::{Row, Table};
use crate::stats::Measured;

/// A number of a method in a scene.
struct Entry<'a> {
    method: Method,
    setting: &'a Setting,
    number: Measured,
}

/// What methods are ranked by: least first.
struct Criterion<'a> {
    name: String,
    /// Of every method and scene that has it.
    entries: Vec<Entry<'a>>,
}

/// Rows of every criterion by which two methods or more can be ranked.
pub fn table(set: &ResultSet) -> Table {
    let mut rows = vec![];
    for group in groups(set) {
        let name = Setting::together(group.iter().copied()).to_string();
        for Criterion { name: by, entries } in criteria(set, &group) {
            let ranked = worst(entries);
            if ranked.len() > 1 {
                rows.extend(ranking(&name, &by, &ranked));
            }
        }
    }
    Table {
        id: "analysis-classes",
        title: "Methods ranked",
        caption: "Least first. Of several scenes the worst decides, of methods that were measured in all of them. Methods share a class \
                  where the 95 % interval of what one is above its neighbour in the ranking holds 0, paired by frame and temporal run. Where \
                  runs cannot be paired, their own intervals must not touch; where nothing is known of noise, nothing is \
                  told apart. Each pair of neighbours is judged by itself. SD and RSD are of the frame time under most lights.",
        labels: &["ranked by", "method", "worst scene"],
        groups: vec![
            ("class", &[""]),
            ("number", &["", "low", "high"]),
            ("above the one before", &["", "low", "high"]),
        ],
        rows,
    }
}

/// Settings that differ in scene and recording alone.
fn groups(set: &ResultSet) -> Vec<Vec<&Setting>> {
    let mut groups: Vec<Vec<&Setting>> = vec![];
    for setting in set.settings() {
        match groups.iter_mut().find(|group| anywhere(group[0]) == anywhere(setting)) {
            Some(group) => group.push(setting),
            None => groups.push(vec![setting]),
        }
    }
    groups
}

/// The setting without what tells scenes apart.
pub fn anywhere(setting: &Setting) -> Setting {
    Setting { scene: String::new(), recording: String::new(), hashes: Default::default(), ..setting.clone() }
}

fn criteria<'a>(set: &'a ResultSet, group: &[&'a Setting]) -> Vec<Criterion<'a>> {
    let runs = || group.iter().flat_map(|setting| set.of(setting));
    let lightings = lightings(runs());
    let by = |name: String, lighting: &LightingName, of: fn(&Run) -> Option<Measured>| {
        let entry =
            |run: &'a Run| Some(Entry { method: run.method, setting: &run.setting, number: of(run)? });
        Criterion {
            name,
            entries: runs().filter(|run| run.lighting == *lighting).filter_map(entry).collect(),
        }
    };
    let mut found = vec![];
    if let Some(most) = lightings.iter().max_by_key(|lighting| lighting.count) {
        found.push(by(format!("SD, {} (ms)", most.label), most, spread::deviation));
        found.push(by(format!("RSD, {}", most.label), most, spread::relative));
    }
    for lighting in &lightings {
        found.push(by(format!("mean time, {} (ms)", lighting.label), lighting, |run| Part::All.mean(run)));
    }
    found.extend(lines(set, group));
    found
}

/// Slopes and offsets.
fn lines<'a>(set: &ResultSet, group: &[&'a Setting]) -> Vec<Criterion<'a>> {
    let fits: Vec<(&Setting, growth::Fit)> = group
        .iter()
        .flat_map(|&setting| growth::fits(set, setting).into_iter().map(move |fit| (setting, fit)))
        .collect();
    let by = |name: String, part: Part, of: fn(&growth::Fit) -> Measured| {
        let fits = fits.iter().filter(|(_, fit)| fit.part == part);
        let entry = |(setting, fit): &(&'a Setting, growth::Fit)| Entry {
            method: fit.method,
            setting,
            number: of(fit),
        };
        Criterion { name, entries: fits.map(entry).collect() }
    };
    let slopes = Part::EVERY
        .map(|part| by(format!("slope of {} (µs a light)", part.name()), part, growth::Fit::slope));
    let offsets =
        Part::EVERY.map(|part| by(format!("offset of {} (ms)", part.name()), part, growth::Fit::offset));
    slopes.into_iter().chain(offsets).collect()
}

/// The greatest number of each method that has one in every scene, ascending.
fn worst(entries: Vec<Entry<'_>>) -> Vec<Entry<'_>> {
    let mut scenes: Vec<&Setting> = entries.iter().map(|entry| entry.setting).collect();
    scenes.sort();
    scenes.dedup();
    let mut methods: Vec<(Entry<'_>, usize)> = vec![];
    for entry in entries {
        match methods.iter_mut().find(|(worst, _)| worst.method == entry.method) {
            Some((worst, found)) => {
                *found += 1;
                if entry.number.value > worst.number.value {
                    *worst = entry;
                }
            }
            None => methods.push((entry, 1)),
        }
    }
    let everywhere = methods.into_iter().filter(|(_, found)| *found == scenes.len());
    let mut ranked: Vec<Entry<'_>> = everywhere.map(|(worst, _)| worst).collect();
    ranked.sort_by(|a, b| a.number.value.total_cmp(&b.number.value));
    ranked
}

fn ranking(setting: &str, by: &str, ranked: &[Entry<'_>]) -> Vec<Row> {
    let mut class = 1.0;
    let mut rows = vec![];
    for (place, entry) in ranked.iter().enumerate() {
        let before = place.checked_sub(1).map(|before| &ranked[before].number);
        let above = before.map(|before| Measured::combine([&entry.number, before], |[a, b]| a - b));
        if before.is_some_and(|before| separated(before, &entry.number)) {
            class += 1.0;
        }
        let above = above.map_or([None; 3], |above| cells(&above));
        rows.push(Row {
            setting: setting.to_owned(),
            labels: vec![
                by.to_owned(),
                method_name(entry.method, entry.setting.is_stereo()),
                format!("{} ({})", entry.setting.scene, entry.setting.recording),
            ],
            numbers: [Some(class)].into_iter().chain(cells(&entry.number)).chain(above).collect(),
        });
    }
    rows
}

/// Whether noise leaves no doubt that the second number is the greater one.
fn separated(less: &Measured, more: &Measured) -> bool {
    let above = Measured::combine([more, less], |[more, less]| more - less);
    match (above.interval(), less.interval(), more.interval()) {
        (Some(above), ..) => above.low > 0.0,
        (None, Some(less), Some(more)) => less.high < more.low,
        _ => false,
    }
}
