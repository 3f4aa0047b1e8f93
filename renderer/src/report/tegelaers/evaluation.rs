//! What results hold of the evaluation: scenes, and in each the runs of the thesis's methods in both pipelines.
//!
//! ```text
//! ResultSet ──> runs of the four kinds ──> Evaluation: made alike but for scene, lights, image, method, pipeline
//!                                             └─> Scene ──> Case: a run, its pipeline, its lights, its pixels
//!                                                    └──> Corner: the fewest or the most lights and pixels of several methods
//! ```

use crate::methods::{Method, Unit};
use crate::report::claim::by_way;
use crate::report::format::grouped;
use crate::report::results::{ResultSet, Run, Setting, method_name};
use crate::report::way::Way;
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// Every light for every fragment.
pub const NAIVE: &str = "all-lights";
/// Tiles, each with the lights whose rectangles touch it.
pub const TILED: &str = "tiled-mm";
/// Clusters of such tiles.
pub const CLUSTERED: &str = "clustered-mm";
/// Leaves of an octree, found by hashes.
pub const HASHED: &str = "hashed";

/// The starting depth of the thesis's comparisons.
const USUAL_DEPTH: f64 = 3.0;

/// Whether a method is one of the thesis's own; the naive one is everybody's.
pub fn measures(method: Method) -> bool {
    [TILED, CLUSTERED, HASHED].contains(&method.kind().name)
}

/// Who evaluates lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pipeline {
    /// Fragments, as they are drawn.
    Forward,
    /// A pass over all pixels, by a G-buffer.
    Deferred,
}

/// Whether the fewest lights and pixels or the most of what several methods were measured with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    Few,
    Many,
}

/// A run, with what runs of a scene differ by.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    pub run: &'a Run,
    pub pipeline: Pipeline,
    /// How many there are.
    pub lights: u32,
    /// Of each view.
    pub pixels: u64,
}

/// Results that were made alike but for scene, lights, resolution, method and pipeline.
pub struct Evaluation<'a> {
    /// What all scenes share.
    pub setting: Setting,
    /// By setting.
    pub scenes: Vec<Scene<'a>>,
}

/// What was measured in one scene.
pub struct Scene<'a> {
    /// The setting, without pipeline and, of several, resolution.
    pub setting: Setting,
    /// Kind by kind, smallest sizes first, fewest pixels, fewest lights.
    pub cases: Vec<Case<'a>>,
    /// The same of hashes by other seeds, each with its seed.
    pub seeds: Vec<(u64, Case<'a>)>,
}

/// The results of each way, told apart by all but the pipelines, which the thesis compares. The way that was measured with
/// hidden fragments shaded, as the thesis's forward pipeline did, comes first.
pub fn judged(set: &ResultSet) -> Vec<(Way, ResultSet)> {
    let mut own = set.clone();
    own.runs.retain(|run| is_of_the_four(run.method));
    let mut ways: Vec<(Way, ResultSet)> = vec![];
    for (way, found) in by_way(&own) {
        let way = compared(&way);
        match ways.iter_mut().find(|(known, _)| *known == way) {
            Some((_, known)) => known.runs.extend(found.runs),
            None => ways.push((way, found)),
        }
    }
    ways.sort_by_key(|(way, _)| way.other("shading") != Some("overdraw"));
    ways
}

/// A way without what the thesis compares: pipelines, and seeds of hashes.
fn compared(way: &Way) -> Way {
    let way = way.without("pipeline");
    if seed(&way).is_some() { way.without("octree") } else { way }
}

/// The seed of the hashes, where it is not the usual one.
fn seed(way: &Way) -> Option<u64> {
    way.other("octree")?.strip_prefix("seed-")?.parse().ok()
}

fn is_of_the_four(method: Method) -> bool {
    measures(method) || method.kind().name == NAIVE
}

impl Pipeline {
    pub const BOTH: [Self; 2] = [Self::Forward, Self::Deferred];

    /// That of a run.
    pub fn of(run: &Run) -> Self {
        match run.setting.way.other("pipeline") {
            Some("deferred") => Self::Deferred,
            _ => Self::Forward,
        }
    }

    /// As figures name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Deferred => "deferred",
        }
    }
}

impl<'a> Evaluation<'a> {
    /// Every evaluation that the results hold something of.
    pub fn all(set: &'a ResultSet) -> Vec<Self> {
        let mut groups: Vec<(Setting, Vec<Case<'a>>)> = vec![];
        for case in set.runs.iter().filter_map(Case::of) {
            let key = anywhere(&case.run.setting);
            match groups.iter_mut().find(|(known, _)| *known == key) {
                Some((_, cases)) => cases.push(case),
                None => groups.push((key, vec![case])),
            }
        }
        groups.into_iter().map(|(_, cases)| Self::new(cases)).collect()
    }

    fn new(mut cases: Vec<Case<'a>>) -> Self {
        cases.sort_by(order);
        let keys: BTreeSet<Setting> = cases.iter().map(|case| in_scene(&case.run.setting)).collect();
        let scene = |key: &Setting| {
            let of_scene = cases.iter().copied().filter(|case| in_scene(&case.run.setting) == *key);
            let all: Vec<Case<'a>> = of_scene.collect();
            let seed = |case: &Case<'a>| seed(&case.run.setting.way);
            let seeds = all.iter().filter_map(|case| Some((seed(case)?, *case))).collect();
            let cases = all.iter().copied().filter(|case| seed(case).is_none()).collect();
            Scene { setting: shared(key, &all), cases, seeds }
        };
        let scenes: Vec<Scene<'a>> = keys.iter().map(scene).collect();
        Self { setting: Setting::together(scenes.iter().map(|scene| &scene.setting)), scenes }
    }

    /// Every method of a kind that was measured, smallest sizes first.
    pub fn methods(&self, kind: &str) -> Vec<Method> {
        let of_kind = self.cases().filter(|case| case.run.method.kind().name == kind);
        let mut methods: Vec<Method> = of_kind.map(|case| case.run.method).collect();
        methods.sort_by(|a, b| by_size(*a, *b));
        methods.dedup();
        methods
    }

    /// The method that stands for a kind of one size: the one with the most runs; of several the one of the usual size, or else
    /// the first.
    pub fn chosen(&self, kind: &str) -> Option<Method> {
        let runs = |method: Method| self.cases().filter(|case| case.run.method == method).count();
        let methods = self.methods(kind).into_iter().rev();
        methods.max_by_key(|&method| (runs(method), method == method.kind().tuned()))
    }

    /// The hashed methods that differ in the size of nodes alone: by the starting depth of most sizes, of several the usual one.
    pub fn nodes(&self) -> Vec<Method> {
        let methods = self.methods(HASHED);
        let sizes = |depth: f64| methods.iter().filter(|method| start_depth(**method) == depth).count();
        let depths = methods.iter().map(|method| start_depth(*method));
        let depth = depths.rev().max_by_key(|&depth| (sizes(depth), depth == USUAL_DEPTH));
        methods.iter().copied().filter(|method| Some(start_depth(*method)) == depth).collect()
    }

    /// Those with nodes no larger than a light's radius, which the thesis compares with other methods.
    pub fn hashed(&self) -> Vec<Method> {
        self.nodes().into_iter().filter(|method| node(*method).is_some_and(|radii| radii <= 1.0)).collect()
    }

    /// The pipeline in which the thesis counts: the deferred one, where there are runs of it.
    pub fn counting(&self) -> Pipeline {
        self.cases().map(|case| case.pipeline).max().unwrap_or(Pipeline::Forward)
    }

    fn cases(&self) -> impl Iterator<Item = &Case<'a>> {
        self.scenes.iter().flat_map(|scene| &scene.cases)
    }
}

impl<'a> Scene<'a> {
    /// Scene and recording.
    pub fn name(&self) -> String {
        format!("{} ({})", self.setting.scene, self.setting.recording)
    }

    /// The runs of a method in a pipeline, fewest pixels first, of as many fewest lights.
    pub fn of(&self, method: Method, pipeline: Pipeline) -> impl Iterator<Item = &Case<'a>> {
        self.cases.iter().filter(move |case| case.run.method == method && case.pipeline == pipeline)
    }

    /// The run of a method in a pipeline where pixels and lights are so many.
    pub fn run(
        &self,
        (method, pipeline): (Method, Pipeline),
        (pixels, lights): (u64, u32),
    ) -> Option<&'a Run> {
        let found = self.of(method, pipeline).find(|case| (case.pixels, case.lights) == (pixels, lights));
        found.map(|case| case.run)
    }

    /// The runs of two methods in a corner of what was measured of both; `None` where nothing was.
    pub fn both(&self, methods: [(Method, Pipeline); 2], corner: Corner) -> Option<[&Case<'a>; 2]> {
        let at = self.corner(&methods, corner)?;
        let [first, second] = methods.map(|(method, pipeline)| {
            self.of(method, pipeline).find(|case| (case.pixels, case.lights) == at)
        });
        Some([first?, second?])
    }

    /// How many pixels, and then lights, there are in a corner of what was measured of all of several methods. Methods of which there
    /// is nothing do not count.
    pub fn corner(&self, methods: &[(Method, Pipeline)], corner: Corner) -> Option<(u64, u32)> {
        let of = |&(method, pipeline): &(Method, Pipeline)| -> BTreeSet<(u64, u32)> {
            self.of(method, pipeline).map(|case| (case.pixels, case.lights)).collect()
        };
        let measured = methods.iter().map(of).filter(|found| !found.is_empty());
        let shared = measured.reduce(|a, b| &a & &b)?;
        match corner {
            Corner::Few => shared.first().copied(),
            Corner::Many => shared.last().copied(),
        }
    }
}

impl<'a> Case<'a> {
    /// `None` of other methods and where nobody knows how many lights there are.
    fn of(run: &'a Run) -> Option<Self> {
        let lights = run.lighting.count.filter(|_| is_of_the_four(run.method))?;
        let [width, height] = run.setting.resolution.map(u64::from);
        Some(Self { run, pipeline: Pipeline::of(run), lights, pixels: width * height })
    }

    /// Its lights and pixels, for people.
    pub fn size(&self) -> String {
        let [width, height] = self.run.setting.resolution;
        format!("{}, {width} × {height}", lights(self.lights))
    }
}

/// A number of lights, for people.
pub fn lights(count: u32) -> String {
    format!("{} lights", grouped(u64::from(count)))
}

/// A method as the evaluation names it.
pub fn name(method: Method) -> String {
    if method.kind().name == NAIVE { "Naive".into() } else { method_name(method, true) }
}

/// Edge of the smallest nodes of a hashed method, in radii of the smallest light; `None` where it is in metres.
pub fn node(method: Method) -> Option<f64> {
    method.sizes().first().filter(|size| size.unit == Unit::Own).map(|size| size.number)
}

/// The depth from which a hashed method looks nodes up.
pub fn start_depth(method: Method) -> f64 {
    method.sizes().get(1).map_or(0.0, |depth| depth.number)
}

/// The setting without what an evaluation compares.
fn anywhere(setting: &Setting) -> Setting {
    let mut key = crate::report::analysis::anywhere(&in_scene(setting));
    // Lights belong to the scene: where they stand, and how far they reach.
    key.options.retain(|option| !option.starts_with("light"));
    key
}

/// The setting without what tells runs of a scene apart.
fn in_scene(setting: &Setting) -> Setting {
    let mut key = Setting { resolution: Setting::SEVERAL, way: compared(&setting.way), ..setting.clone() };
    // It follows from the number of lights.
    key.options.retain(|option| !option.starts_with("light set"));
    key
}

/// A scene's setting, with the resolution that all its runs have.
fn shared(key: &Setting, cases: &[Case<'_>]) -> Setting {
    let mut resolutions: Vec<[u32; 2]> = cases.iter().map(|case| case.run.setting.resolution).collect();
    resolutions.dedup();
    match resolutions[..] {
        [resolution] => Setting { resolution, ..key.clone() },
        _ => key.clone(),
    }
}

/// By kind, size, pixels, lights.
fn order(a: &Case<'_>, b: &Case<'_>) -> Ordering {
    let rest = |case: &Case<'_>| (case.pixels, case.lights, case.pipeline);
    by_size(a.run.method, b.run.method).then_with(|| rest(a).cmp(&rest(b)))
}

fn by_size(a: Method, b: Method) -> Ordering {
    let place = |method: Method| {
        [NAIVE, TILED, CLUSTERED, HASHED].iter().position(|kind| *kind == method.kind().name)
    };
    let sizes = || a.sizes().partial_cmp(&b.sizes()).unwrap_or(Ordering::Equal);
    place(a).cmp(&place(b)).then_with(sizes)
}
