//! Runs of raster methods as the paper asks them: by grid, slice law and lights.

use crate::assign::Assigner;
use crate::methods::{Method, Sharing};
use crate::report::claim::mean;
use crate::report::format::grouped;
use crate::report::results::{ResultSet, Run, Setting, metric};
use crate::report::way::Way;

/// The parts of assignment that the paper times, in its order.
pub const PARTS: [(&str, &str); 4] = [
    ("point shell", "shell_points"),
    ("point fill", "fill_points"),
    ("spot shell", "shell_spots"),
    ("spot fill", "fill_spots"),
];

/// What takes lights to lists beside the parts: placing meshes, emptying lists, and, of lists that are not linked, counting, summing and
/// writing; sorting of those that are.
const OTHERS: [&str; 6] =
    ["mesh_frames", "clear_lists", "count_lights", "light_offsets", "write_lists", "sort_lists"];

/// Structures that the paper counts as memory (figure 5.5): heads of lists, nodes, shells.
pub const MEMORY: [(&str, &str); 3] =
    [("heads", "list_offsets"), ("list", "light_indices"), ("shells", "shell_ranges")];

/// Whether the paper measures a method.
pub fn measures(method: Method) -> bool {
    method.is_rasterised()
}

/// A run that keeps shells, of each view.
#[derive(Clone, Copy)]
pub struct Case<'a> {
    /// The run.
    pub run: &'a Run,
    /// Columns, rows, slices.
    pub grid: [u32; 3],
    /// Whether slices are of equal depth.
    pub linear: bool,
    /// Number of lights.
    pub lights: u32,
}

impl<'a> Case<'a> {
    fn of(run: &'a Run) -> Option<Self> {
        let of_views = run.method.kind().sharing == Sharing::Indi;
        let is_shell = of_views && run.method.rasterising() == Some(Assigner::Raster);
        let (grid, lights) = (run.grid?, run.lighting.count?);
        is_shell.then(|| Self { run, grid, linear: run.method.to_string().ends_with("-l"), lights })
    }

    /// Number of tiles.
    pub fn tiles(&self) -> u32 {
        self.grid[0] * self.grid[1]
    }

    /// Number of clusters.
    pub fn clusters(&self) -> u32 {
        self.tiles() * self.grid[2]
    }

    /// What it is called: `24x12x32-E`.
    pub fn name(&self) -> String {
        let [columns, rows, slices] = self.grid;
        format!("{columns}x{rows}x{slices}-{}", if self.linear { 'L' } else { 'E' })
    }

    /// `400 lights`.
    pub fn lights_name(&self) -> String {
        format!("{} lights", grouped(self.lights.into()))
    }

    /// A stage's time, milliseconds; `None` where it was not timed.
    pub fn stage(&self, stage: &str) -> Option<f64> {
        self.run.stages.get(stage).copied()
    }

    /// Shells and fills and all beside them, from lights to lists, milliseconds.
    pub fn assignment(&self) -> Option<f64> {
        let parts = PARTS.map(|(_, stage)| self.stage(stage));
        // Without spots there are no stages of spots.
        let [point_shell, point_fill, ..] = parts;
        point_shell.and(point_fill)?;
        let others = OTHERS.map(|stage| self.stage(stage));
        Some(parts.into_iter().chain(others).flatten().sum())
    }

    /// Shading, milliseconds.
    pub fn shading(&self) -> Option<f64> {
        mean(self.run, metric::SHADE)
    }

    /// Assignment and shading, milliseconds.
    pub fn total(&self) -> Option<f64> {
        Some(self.assignment()? + self.shading()?)
    }

    /// Entries of the lists.
    pub fn nodes(&self) -> Option<f64> {
        mean(self.run, metric::INDICES)
    }

    /// What a structure takes, bytes.
    pub fn bytes(&self, structure: &str) -> Option<f64> {
        Some(self.run.memory.iter().find(|row| row.structure == structure)?.allocated as f64)
    }

    /// Heads, nodes and shells, bytes.
    pub fn memory(&self) -> Option<f64> {
        MEMORY.iter().map(|(_, structure)| self.bytes(structure)).sum()
    }

    /// How lists are kept.
    pub fn lists(&self) -> String {
        self.run.setting.way.value("lists", self.run.method)
    }
}

/// The runs of one setting, but for how they work, with shells, by lights, grid and law.
pub struct Evaluation<'a> {
    /// What they share.
    pub setting: Setting,
    /// By ascending lights, then grids, exponential before linear.
    pub cases: Vec<Case<'a>>,
}

impl<'a> Evaluation<'a> {
    /// An evaluation for each setting and way of keeping lists and rasterising.
    pub fn all(set: &'a ResultSet) -> Vec<Self> {
        let mut cases: Vec<Case> = set.runs.iter().filter_map(Case::of).collect();
        cases.sort_by_key(|case| (case.run.setting.clone(), case.lights, case.grid, case.linear));
        let of = |block: &[Case<'a>]| Self { setting: block[0].run.setting.clone(), cases: block.to_vec() };
        cases.chunk_by(|a, b| a.run.setting == b.run.setting).map(of).collect()
    }

    /// Numbers of lights, ascending.
    pub fn lights(&self) -> Vec<u32> {
        let mut lights: Vec<u32> = self.cases.iter().map(|case| case.lights).collect();
        lights.dedup();
        lights
    }

    /// The cases of so many lights.
    pub fn of_lights(&self, lights: u32) -> impl Iterator<Item = &Case<'a>> {
        self.cases.iter().filter(move |case| case.lights == lights)
    }

    /// A case.
    pub fn case(&self, lights: u32, grid: [u32; 3], linear: bool) -> Option<&Case<'a>> {
        self.of_lights(lights).find(|case| (case.grid, case.linear) == (grid, linear))
    }

    /// Pairs of cases that differ in what `changes` says alone, the smaller first: both have the same lights and law.
    pub fn pairs(&self, changes: impl Fn(&Case, &Case) -> bool) -> Vec<[&Case<'a>; 2]> {
        let alike = |a: &Case, b: &Case| (a.lights, a.linear) == (b.lights, b.linear);
        let with = |a| self.cases.iter().filter(move |b| alike(a, b)).map(move |b| [a, b]);
        self.cases.iter().flat_map(with).filter(|[a, b]| changes(a, b)).collect()
    }
}

/// All results at once: the claims compare ways of working with each other.
pub fn judged(set: &ResultSet) -> Vec<(Way, ResultSet)> {
    vec![(Way::default(), set.clone())]
}
