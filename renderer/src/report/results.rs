//! What result directories hold, as types that figures and claims ask.

use super::way::Way;
use crate::extent::Extent;
use crate::machine::{Conditions, Machine};
use crate::methods::{Method, Sharing, Space};
use crate::output::{ColumnTimes, FrameRow, MemoryRow, OctreeRow, Older};
use crate::stats::{Measured, Samples};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Metrics of `frames.csv` that figures and claims name.
pub mod metric {
    /// Visible clusters, over clusterings.
    pub const VISIBLE: &str = "visible_clusters";
    /// Light indices, over clusterings.
    pub const INDICES: &str = "light_indices";
    /// Lighting computations.
    pub const COMPUTATIONS: &str = "lighting_computations";
    /// Sphere against cluster tests, over clusterings.
    pub const TESTS: &str = "intersection_tests";
    /// Invocations of the shading pass, hidden ones too.
    pub const FRAGMENTS: &str = "fragments_shaded";
    /// How much the depth of the first view jumps from pixel to pixel.
    pub const DISCONTINUITY: &str = "depth_discontinuity";
    /// GPU time of the frame, milliseconds.
    pub const FRAME: &str = "gpu_ms_frame";
    /// GPU time of clustering, milliseconds.
    pub const CLUSTER: &str = "gpu_ms_cluster";
    /// GPU time of depth pass and marking, milliseconds.
    pub const VISIBILITY: &str = "gpu_ms_visibility";
    /// GPU time of counting lights, milliseconds.
    pub const COUNT: &str = "gpu_ms_count_lights";
    /// GPU time of writing light lists, milliseconds.
    pub const ASSIGN: &str = "gpu_ms_assign_lights";
    /// GPU time of shading, milliseconds.
    pub const SHADE: &str = "gpu_ms_shade";
}

/// Every run of the given directories, of one version of the program.
#[derive(Debug, Clone, Default)]
pub struct ResultSet {
    /// By setting, lighting, method.
    pub runs: Vec<Run>,
    /// Runs that are left out, for there are newer ones that were asked to do the same.
    pub older: Vec<Older>,
    /// Version of the program that measured.
    pub version: String,
    /// Its git revision.
    pub git_revision: String,
}

/// What runs must share for their numbers to be drawn in one figure.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Setting {
    /// Scene by name.
    pub scene: String,
    /// Recording by name.
    pub recording: String,
    /// Rendering cameras.
    pub views: u32,
    /// Width and height of each view, pixels; [`Setting::SEVERAL`] of runs that differ in it.
    pub resolution: [u32; 2],
    /// Samples a pixel.
    pub msaa: u32,
    /// What else tells settings apart: attenuation, marking, volume that sizes Displ.
    pub options: Vec<String>,
    /// Hexadecimal SHA-256 of scene and recording.
    pub hashes: [String; 2],
    /// How light lists were built.
    pub way: Way,
}

/// Where a run's light came from.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct LightingName {
    /// How many lights, where the rain made them.
    pub count: Option<u32>,
    /// For people: `10 000 lights`.
    pub label: String,
    /// Hexadecimal SHA-256 of the file of lights, where one made them.
    pub sha256: Option<String>,
}

/// One run directory.
#[derive(Debug, Clone)]
pub struct Run {
    /// Its path below the directory given.
    pub name: String,
    /// What it shares with others.
    pub setting: Setting,
    /// How large what it saw is.
    pub extent: Option<Extent>,
    /// Size of the box around the lights that were made, metres; `None` of turned boxes and of other lights.
    pub light_box_m: Option<[f64; 3]>,
    /// How lights were found.
    pub method: Method,
    /// Where they came from.
    pub lighting: LightingName,
    /// Device, driver and Vulkan version.
    pub device: [String; 3],
    /// The machine it ran on.
    pub machine: Machine,
    /// How the machine fared in the temporal runs.
    pub conditions: Conditions,
    /// Why its times are doubtful.
    pub doubts: Vec<String>,
    /// When it started, RFC 3339.
    pub started: String,
    /// How long it took, seconds.
    pub duration_s: f64,
    /// How many temporal runs the minima are over.
    pub temporal_runs: u32,
    /// Grid of the first clustering of the first frame.
    pub grid: Option<[u32; 3]>,
    /// `frames.csv`.
    pub frames: Frames,
    /// The times among them, of every temporal run.
    pub times: ColumnTimes,
    /// GPU time of each stage of clustering by its name, milliseconds: mean over frames of the least of all temporal runs; loaded of methods
    /// alone that rasterise meshes.
    pub stages: BTreeMap<String, f64>,
    /// Clusters by light count and by fragment count; loaded of tuned methods alone.
    pub distributions: BTreeMap<Distribution, Vec<Vec<u64>>>,
    /// The most fragments of any cluster of any frame; known of tuned methods alone.
    pub most_fragments: Option<u64>,
    /// `memory.csv`.
    pub memory: Vec<MemoryRow>,
    /// The octree that it built first; `None` of other methods.
    pub octree: Option<BuiltOctree>,
    /// Rendered frames.
    pub pictures: Vec<Picture>,
    /// Whether all groups have lists, not those alone that hold a fragment.
    pub lists_all: bool,
    /// Groups by lights, of the frames that have pictures.
    pub groups: Vec<FrameGroups>,
}

/// An octree over the lights of a frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BuiltOctree {
    /// Its tables by depth.
    pub tables: Vec<OctreeRow>,
    /// What the host took for each step of building, in order, milliseconds: the least over all builds, in frames that were timed or beside
    /// them.
    pub steps: Vec<(String, f64)>,
}

/// Groups of one frame that have lists, by how many lights these hold.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FrameGroups {
    /// Frame number.
    pub frame: u32,
    /// Of each clustering (lights, groups) by ascending lights, groups above 0.
    pub clusterings: Vec<Vec<(u32, u64)>>,
}

/// What clusters are counted by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distribution {
    /// Length of the light list.
    Lights,
    /// Fragments.
    Fragments,
}

/// `frames.csv` by column.
#[derive(Debug, Clone, Default)]
pub struct Frames {
    /// Frame numbers, ascending.
    pub numbers: Vec<u32>,
    /// Metrics in the file's order; `None` where a cell is empty.
    pub metrics: Vec<(String, Vec<Option<f64>>)>,
}

/// Images of one frame.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Picture {
    /// Frame number.
    pub frame: u32,
    /// As a display shows it.
    pub image: PathBuf,
    /// Lights per cluster as colour.
    pub lights: Option<PathBuf>,
    /// The same as a part of all lights.
    pub share: Option<PathBuf>,
    /// The same by one scale for all frames, blended with the image.
    pub heat: Option<PathBuf>,
    /// Clusters as colour.
    pub clusters: Option<PathBuf>,
    /// Slices as colour, of grids that have several.
    pub slices: Option<PathBuf>,
    /// Clusters seen from above, with frusta.
    pub birdseye: Option<PathBuf>,
    /// Volumes of lights seen from above, with frusta.
    pub plan: Option<PathBuf>,
    /// What the G-buffer holds.
    pub gbuffer: Option<PathBuf>,
}

impl ResultSet {
    /// Distinct settings, ascending.
    pub fn settings(&self) -> Vec<&Setting> {
        let mut settings: Vec<&Setting> = self.runs.iter().map(|run| &run.setting).collect();
        settings.sort();
        settings.dedup();
        settings
    }

    /// Distinct settings, ascending, each with one way alone: for what is the same by all ways.
    pub fn settings_once(&self) -> Vec<&Setting> {
        let mut settings = self.settings();
        settings.dedup_by_key(|setting| setting.by(&Way::default()));
        settings
    }

    /// Distinct ways by which light lists were built, the thesis's own first.
    pub fn ways(&self) -> Vec<&Way> {
        let mut ways: Vec<&Way> = self.runs.iter().map(|run| &run.setting.way).collect();
        ways.sort();
        ways.dedup();
        ways
    }

    /// The runs of one way alone.
    pub fn by_way(&self, way: &Way) -> Self {
        let runs = self.runs.iter().filter(|run| run.setting.way == *way).cloned().collect();
        let [version, git_revision] = [&self.version, &self.git_revision].map(String::clone);
        Self { runs, older: self.older.clone(), version, git_revision }
    }

    /// The runs of a setting.
    pub fn of<'a>(&'a self, setting: &'a Setting) -> impl Iterator<Item = &'a Run> + Clone {
        self.runs.iter().filter(move |run| run.setting == *setting)
    }

    /// A method's runs in a setting, by lighting.
    pub fn of_method<'a>(&'a self, setting: &'a Setting, method: Method) -> Vec<&'a Run> {
        self.of(setting).filter(|run| run.method == method).collect()
    }
}

/// Distinct lightings of runs, fewest lights first.
pub fn lightings<'a>(runs: impl IntoIterator<Item = &'a Run>) -> Vec<LightingName> {
    let mut lightings: Vec<LightingName> = runs.into_iter().map(|run| run.lighting.clone()).collect();
    lightings.sort();
    lightings.dedup();
    lightings
}

impl Setting {
    /// In the place of a resolution, where runs differ in it.
    pub const SEVERAL: [u32; 2] = [0, 0];

    /// Settings that differ in scene, recording, resolution and options, as one, with the options that all have; that of nothing where
    /// there are none.
    pub fn together<'a>(settings: impl Iterator<Item = &'a Self> + Clone) -> Self {
        let joined = |of: fn(&Self) -> &str| {
            let mut names: Vec<&str> = settings.clone().map(of).collect();
            names.dedup();
            names.join(" and ")
        };
        let (scene, recording) = (joined(|setting| &setting.scene), joined(|setting| &setting.recording));
        let Some(first) = settings.clone().next() else { return Self::default() };
        let is_shared = settings.clone().all(|setting| setting.resolution == first.resolution);
        let resolution = if is_shared { first.resolution } else { Self::SEVERAL };
        let mut together = Self { scene, recording, resolution, ..first.clone() };
        together.options.retain(|option| settings.clone().all(|setting| setting.options.contains(option)));
        together
    }

    /// The same setting by another way.
    pub fn by(&self, way: &Way) -> Self {
        Self { way: way.clone(), ..self.clone() }
    }

    /// Whether a frame is seen by two cameras or more.
    pub fn is_stereo(&self) -> bool {
        self.views > 1
    }
}

impl std::fmt::Display for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let views = match self.views {
            1 => "mono".to_owned(),
            2 => "stereo".to_owned(),
            views => format!("{views} views"),
        };
        write!(f, "{}, recording {}, {views}, ", self.scene, self.recording)?;
        match self.resolution {
            Self::SEVERAL => f.write_str("several resolutions")?,
            [width, height] => write!(f, "{width} × {height}")?,
        }
        if self.is_stereo() {
            f.write_str(" a view")?;
        }
        if self.msaa > 1 {
            write!(f, ", {} samples a pixel", self.msaa)?;
        }
        self.options.iter().try_for_each(|option| write!(f, ", {option}"))?;
        if self.way == Way::default() { Ok(()) } else { write!(f, ", lights assigned by {}", self.way) }
    }
}

impl Frames {
    /// The rows' counters and times, by column.
    pub fn of(rows: &[FrameRow]) -> Self {
        let mut metrics: Vec<(String, Vec<Option<f64>>)> = vec![];
        for (place, row) in rows.iter().enumerate() {
            let counters = row.counters().map(|(name, count)| (name, Some(count as f64)));
            // How many views there are is not measured.
            let cells = counters.filter(|(name, _)| *name != "views").chain(row.times());
            for (index, (name, cell)) in cells.enumerate() {
                if place == 0 {
                    metrics.push((name.to_owned(), Vec::with_capacity(rows.len())));
                }
                metrics[index].1.push(cell);
            }
        }
        Self { numbers: rows.iter().map(|row| row.frame).collect(), metrics }
    }

    /// A metric's cells; empty where the file has no such column.
    pub fn metric(&self, name: &str) -> &[Option<f64>] {
        self.metrics.iter().find(|(known, _)| known == name).map_or(&[], |(_, cells)| cells)
    }

    /// Puts other values, a frame each, in the place of a metric's.
    pub fn replace(&mut self, name: &str, values: Vec<f64>) {
        if let Some((_, cells)) = self.metrics.iter_mut().find(|(known, _)| known == name) {
            *cells = values.into_iter().map(Some).collect();
        }
    }

    /// (frame, value) wherever there is a value.
    pub fn points(&self, name: &str) -> Vec<[f64; 2]> {
        let cells = self.metric(name).iter();
        self.numbers
            .iter()
            .zip(cells)
            .filter_map(|(&frame, cell)| Some([f64::from(frame), (*cell)?]))
            .collect()
    }

    /// The values that are there.
    pub fn values(&self, name: &str) -> impl Iterator<Item = f64> {
        self.metric(name).iter().filter_map(|cell| *cell)
    }
}

impl Run {
    /// A time's mean over frames with its noise; `None` of what is no time, or was not timed.
    pub fn measured(&self, metric: &str) -> Option<Measured> {
        self.times.get(metric).map(Samples::measure)
    }

    /// Of the frames that have pictures, the one of least and the one of most depth discontinuity; where that is not known, the
    /// first and the last. One where they are the same.
    pub fn extremes(&self) -> Vec<u32> {
        let cells = self.frames.metric(metric::DISCONTINUITY);
        let discontinuity = |frame: &u32| {
            let place = self.frames.numbers.binary_search(frame).ok();
            place.and_then(|place| *cells.get(place)?).unwrap_or(0.0)
        };
        let by = |a: &u32, b: &u32| discontinuity(a).total_cmp(&discontinuity(b));
        let frames = || self.pictures.iter().map(|picture| picture.frame);
        let mut ends: Vec<u32> = frames().min_by(by).into_iter().chain(frames().max_by(by)).collect();
        ends.dedup();
        ends
    }
}

/// A method as figures name it: `Indi Persp 64`, without `Indi` where `sharing` is not told.
pub fn method_name(method: Method, with_sharing: bool) -> String {
    let title = method.kind().title;
    let short = title.strip_prefix("Indi ").or(title.strip_prefix("Encl "));
    let title = if with_sharing { title } else { short.unwrap_or(title) };
    let sizes = method.sizes().into_iter().map(|size| format!(" {size}"));
    [title.to_owned()].into_iter().chain(sizes).collect()
}

/// The sizes that Gelderen chapter 6 finds best.
pub const TUNED: [Space; 3] = [
    Space::Persp { pixels: 64.0 },
    Space::Ortho { metres: 4.0 },
    Space::Displ { pixels: 64.0, displacement: 32.0 },
];

/// Whether a method has one of the tuned sizes.
pub fn is_tuned(method: Method) -> bool {
    matches!(method, Method::Grid(grid) if TUNED.contains(&grid.space))
}

/// The method of one clustering a view.
pub const fn indi(space: Space) -> Method {
    Method::grid(Sharing::Indi, space)
}

/// The method of one clustering for all views.
pub const fn encl(space: Space) -> Method {
    Method::grid(Sharing::Encl, space)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metrics_are_columns_of_frames_csv() {
        let frames = Frames::of(&[FrameRow::default()]);
        for name in [
            metric::VISIBLE,
            metric::INDICES,
            metric::COMPUTATIONS,
            metric::TESTS,
            metric::FRAGMENTS,
            metric::DISCONTINUITY,
            metric::FRAME,
            metric::CLUSTER,
            metric::VISIBILITY,
            metric::COUNT,
            metric::ASSIGN,
            metric::SHADE,
        ] {
            assert_eq!(frames.metric(name).len(), 1, "{name}");
        }
    }
}
