//! The self-test: whether a device and its driver are fit to be measured. Each check is a function from a context to a
//! verdict: what was measured, or what is wrong; [`CHECKS`] says what that means for results.
//!
//! ```text
//! Options ──> Context ─┬─ workbench (single passes on small grids) ─┬─> CHECKS ──> Verdict each ──> SelfTest
//!                      └─ frames of the street, by every method ────┘
//! ```

pub(crate) mod cases;
mod context;
mod counters;
mod fragments;
mod frames;
mod golden;
pub(crate) mod lists;
mod log2;
mod loops;
mod pictures;
mod report;
mod samples;
mod scan;
mod shells;
mod sort;
mod timestamps;
mod touching;

pub use context::{Context, Options};
pub use frames::METHODS;
pub use golden::{GOLDEN_COLUMNS, GOLDEN_METHODS, golden_row};
pub use pictures::{count_fault, difference, picture_fault};
pub use report::{Outcome, SelfTest, Verdict};

#[cfg(test)]
pub(crate) use {
    scan::{compaction_fault, offsets_fault},
    sort::sorted_items,
    timestamps::tenfold,
    touching::touching_lights,
};

use crate::nearest;
use crate::replay::Watch;
use crate::{Error, Result};
use std::time::Instant;

/// One check.
pub struct Check {
    /// As the report and `--check` call it.
    pub name: &'static str,
    /// What it means for results where something is wrong, or worth a note.
    means: &'static str,
    run: fn(&mut Context) -> Result<Verdict>,
}

/// All checks, in the order in which they run.
pub static CHECKS: [Check; 14] = [
    Check {
        name: "timestamps",
        means: "a stage's time holds other stages' work, or not all of its own: times of stages are void",
        run: timestamps::bracket,
    },
    Check {
        name: "clock",
        means: "GPU times are not in milliseconds: all times are void, ratios of them perhaps not",
        run: timestamps::clock,
    },
    Check {
        name: "scan",
        means: "prefix sums are wrong: visible clusters and lists are misplaced, counts and pictures void",
        run: scan::check,
    },
    Check {
        name: "sort",
        means: "the order of lights is wrong: what --assign hierarchy counts and times is void",
        run: sort::check,
    },
    Check {
        name: "lists",
        means: "light lists are not what the method defines: counts, times and pictures of these ways are void",
        run: lists::check,
    },
    Check {
        name: "shells",
        means: "meshes around lights are rasterised to other clusters: what raster methods count, time and shade in that way is void",
        run: shells::check,
    },
    Check {
        name: "touching",
        means: "rounding loses lights at the sides of clusters: pictures lack light, counts are too low",
        run: touching::check,
    },
    Check {
        name: "log2",
        means: "depths round to other slices than lights are tested against: lights may be lost",
        run: log2::check,
    },
    Check {
        name: "samples",
        means: "samples lie elsewhere than clusters are looked up at: with --msaa 4 lights may be lost",
        run: samples::check,
    },
    Check {
        name: "pictures",
        means: "methods do not shade alike: what they count and cost cannot be compared",
        run: pictures::check,
    },
    Check {
        name: "fragments",
        means: "marking and shading disagree: fragments are shaded without their lights",
        run: fragments::check,
    },
    Check {
        name: "counters",
        means: "what is counted depends on chance, or on what is timed: passes do not wait for each other",
        run: counters::check,
    },
    Check {
        name: "loops",
        means: "the driver ends long loops early; manylight keeps its own shorter, other shaders must too",
        run: loops::check,
    },
    Check {
        name: "golden",
        means: "counts are not those of lavapipe's rasteriser: compare counts of one device alone",
        run: golden::check,
    },
];

/// The checks that `options` name, or all.
fn chosen(options: &Options) -> Result<Vec<&'static Check>> {
    let names: Vec<&str> = CHECKS.iter().map(|check| check.name).collect();
    if let Some(unknown) = options.checks.iter().find(|wanted| !names.contains(&wanted.as_str())) {
        let hint = nearest::hint(unknown, &names);
        return Err(Error::Input(format!("check: there is no check {unknown:?}{hint}")));
    }
    let wanted = |check: &&Check| options.checks.is_empty() || options.checks.iter().any(|n| n == check.name);
    Ok(CHECKS.iter().filter(wanted).collect())
}

/// How many checks `options` ask for.
///
/// # Errors
/// A name that no check has.
pub fn check_count(options: &Options) -> Result<usize> {
    Ok(chosen(options)?.len())
}

/// Runs the checks. What fails on the device is what a check found; `begun` hears of each before it runs.
///
/// # Errors
/// A name that no check has; no device that can render at all; an interruption.
pub fn self_test(context: &mut Context, watch: &Watch, begun: &dyn Fn(&str)) -> Result<SelfTest> {
    let checks = chosen(context.options())?;
    let device = context.device()?;
    let mut outcomes = vec![];
    for check in checks {
        watch.check()?;
        begun(check.name);
        let start = Instant::now();
        let verdict = match (check.run)(context) {
            Err(error @ (Error::Input(_) | Error::File { .. } | Error::Interrupted(_))) => return Err(error),
            found => found.unwrap_or_else(|error| Verdict::Failed(error.to_string())),
        };
        let seconds = start.elapsed().as_secs_f64();
        outcomes.push(Outcome::new(check.name, check.means, verdict, seconds));
        watch.step();
    }
    Ok(SelfTest { device, checks: outcomes })
}

#[cfg(test)]
mod tests;
