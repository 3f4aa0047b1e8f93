//! What results hold of the evaluation: scenes, and in each the runs of the thesis's methods.
//!
//! ```text
//! ResultSet ──> runs of the eight kinds ──> Evaluation: made alike but for scene, lights, method, test
//!                                              └─> Scene ──> runs by the evaluation's test    (all but figures 4.6, 4.7)
//!                                                       └──> runs by every test               (figures 4.6, 4.7)
//! ```

use crate::geometry::CellShape;
use crate::methods::Method;
use crate::report::analysis::anywhere;
use crate::report::claim::by_way;
use crate::report::format::grouped;
use crate::report::results::{ResultSet, Run, Setting, method_name};
use crate::report::way::Way;
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// The kinds of methods whose sizes are searched (figures 4.2 to 4.5, table 4.3), and models.
pub const EIGHT: [&str; 8] = ["t-i", "t-e", "dc-i", "dc-e", "sc-i", "sc-e", "g", "m"];
/// The kinds that are compared from figure 4.8 on.
pub const SEVEN: [&str; 7] = ["t-i", "t-e", "dc-i", "sc-i", "sc-e", "g", "m"];
/// The test that the thesis uses for pieces of frusta where it does not compare tests.
pub const USUAL_TEST: &str = "hs+sat-n";
/// The tests that the thesis compares: half spaces or normals or both, with and without edges, with the nearest vertex, all
/// vertices or none (section 4.3.2).
pub const TESTS: [&str; 18] = [
    "hs",
    "hs+sat-n",
    "hs+sat-v",
    "hs+sat-e",
    "hs+sat-en",
    "hs+sat-ev",
    "sat-p",
    "sat-np",
    "sat-pv",
    "sat-ep",
    "sat-enp",
    "sat-epv",
    "hs+sat-p",
    "hs+sat-np",
    "hs+sat-pv",
    "hs+sat-ep",
    "hs+sat-enp",
    "hs+sat-epv",
];
/// The number of lights that sizes, tests and frames are compared under.
const MANY: u32 = 10_000;

/// Whether a method is one of the thesis's.
pub fn measures(method: Method) -> bool {
    EIGHT.contains(&method.kind().name)
}

/// Results that were made alike but for scene, number of lights, method and test.
pub struct Evaluation<'a> {
    /// What all scenes share.
    pub setting: Setting,
    /// By setting.
    pub scenes: Vec<Scene<'a>>,
    /// The test of pieces of frusta in all but the comparison of tests.
    pub test: String,
}

/// What was measured in one scene.
pub struct Scene<'a> {
    /// The setting, in which each method has the evaluation's test.
    pub setting: Setting,
    /// Runs by that test: methods in the thesis's order, fewest lights first.
    pub runs: Vec<&'a Run>,
    /// Runs by any test.
    pub by_test: Vec<&'a Run>,
}

/// The results of each way, told apart by all but the tests, which the thesis compares. The way that was measured with
/// hidden fragments shaded, as the thesis did, comes first.
pub fn judged(set: &ResultSet) -> Vec<(Way, ResultSet)> {
    let mut any_test = set.clone();
    any_test.runs.retain(|run| measures(run.method));
    let mut ways: Vec<(Way, ResultSet)> = vec![];
    for (way, found) in by_way(&any_test) {
        let way = way.without("test");
        match ways.iter_mut().find(|(known, _)| *known == way) {
            Some((_, known)) => known.runs.extend(found.runs),
            None => ways.push((way, found)),
        }
    }
    ways.sort_by_key(|(way, _)| way.value("shading", Method::Models) != "overdraw");
    ways
}

impl<'a> Evaluation<'a> {
    /// Every evaluation that the results hold something of.
    pub fn all(set: &'a ResultSet) -> Vec<Self> {
        let mut groups: Vec<(Setting, Vec<&'a Run>)> = vec![];
        let is_counted = |run: &&Run| measures(run.method) && run.lighting.count.is_some();
        for run in set.runs.iter().filter(is_counted) {
            let key = anywhere(&of_any_test(run));
            match groups.iter_mut().find(|(known, _)| *known == key) {
                Some((_, runs)) => runs.push(run),
                None => groups.push((key, vec![run])),
            }
        }
        groups.into_iter().map(|(_, runs)| Self::of(runs)).collect()
    }

    fn of(mut runs: Vec<&'a Run>) -> Self {
        runs.sort_by(|a, b| order(a, b));
        let mut frusta = runs.iter().copied().filter(has_frusta);
        let test = match frusta.clone().find(|run| test(run) == USUAL_TEST).or_else(|| frusta.next()) {
            Some(run) => test(run),
            None => USUAL_TEST.to_owned(),
        };
        let settings: BTreeSet<Setting> = runs.iter().map(|run| of_any_test(run)).collect();
        let scene = |setting: Setting| {
            let by_test: Vec<&Run> = runs.iter().copied().filter(|run| of_any_test(run) == setting).collect();
            let runs = by_test.iter().copied().filter(|run| is_usual(run, &test)).collect();
            Scene { setting, runs, by_test }
        };
        let setting = Setting::together(settings.iter());
        Self { setting, scenes: settings.into_iter().map(scene).collect(), test: test.clone() }
    }

    /// The method that stands for a kind: of its sizes that which was measured under the most numbers of lights, in all scenes
    /// together; of several the one that the thesis selects, or else the first.
    pub fn chosen(&self, kind: &str) -> Option<Method> {
        let methods = self.methods(kind);
        let counts =
            |method: Method| -> usize { self.scenes.iter().map(|scene| scene.counts(method).len()).sum() };
        methods.into_iter().rev().max_by_key(|&method| (counts(method), method == method.kind().tuned()))
    }

    /// The methods that stand for kinds, as far as there are any.
    pub fn chosen_of(&self, kinds: &[&str]) -> Vec<Method> {
        kinds.iter().filter_map(|kind| self.chosen(kind)).collect()
    }

    /// Every size of a kind that was measured.
    pub fn methods(&self, kind: &str) -> Vec<Method> {
        let of_kind = |run: &&&Run| run.method.kind().name == kind;
        let mut methods: Vec<Method> =
            self.scenes.iter().flat_map(|scene| &scene.runs).filter(of_kind).map(|run| run.method).collect();
        methods.sort_by(|a, b| sizes(*a, *b));
        methods.dedup();
        methods
    }

    /// The number of lights for what is compared under one: 10 000, or else the most there are.
    pub fn many(&self) -> Option<u32> {
        let counts = || self.scenes.iter().flat_map(|scene| &scene.runs).filter_map(|run| run.lighting.count);
        counts().find(|&count| count == MANY).or_else(|| counts().max())
    }

    /// The runs by every test of the method that stands for a kind, under the lights that tests are compared by.
    pub fn tests_of(&self, scene: &Scene<'a>, kind: &str) -> Vec<&'a Run> {
        let (Some(method), Some(lights)) = (self.chosen(kind), self.many()) else { return vec![] };
        let is_of = |run: &&Run| run.method == method && run.lighting.count == Some(lights);
        scene.by_test.iter().copied().filter(is_of).collect()
    }

    /// The runs of some methods by the evaluation's test, as results of one way.
    pub fn results(&self, set: &ResultSet, is_wanted: impl Fn(&Run) -> bool) -> ResultSet {
        let of_scene = |scene: &Scene<'a>| {
            let wanted = scene.runs.iter().filter(|run| is_wanted(run));
            wanted.map(|run| Run { setting: scene.setting.clone(), ..(*run).clone() }).collect::<Vec<_>>()
        };
        let runs = self.scenes.iter().flat_map(of_scene).collect();
        ResultSet { runs, older: vec![], ..set.clone() }
    }

    /// What a caption says of the tests behind its numbers.
    pub fn tests(&self) -> String {
        format!(
            " Pieces of frusta are tested by {}, cells of the world by the nearest point, models exactly.",
            self.test
        )
    }
}

impl<'a> Scene<'a> {
    /// Scene and recording.
    pub fn name(&self) -> String {
        format!("{} ({})", self.setting.scene, self.setting.recording)
    }

    /// The run of a method under so many lights.
    pub fn run(&self, method: Method, lights: u32) -> Option<&'a Run> {
        self.runs.iter().copied().find(|run| run.method == method && run.lighting.count == Some(lights))
    }

    /// A run for each number of lights that a method was measured under.
    pub fn counts(&self, method: Method) -> Vec<&'a Run> {
        let mut runs: Vec<&Run> = self.runs.iter().copied().filter(|run| run.method == method).collect();
        runs.dedup_by_key(|run| run.lighting.count);
        runs
    }
}

/// The test by which a run tests lights.
pub fn test(run: &Run) -> String {
    run.setting.way.value("test", run.method)
}

/// A method as the evaluation names it.
pub fn name(method: Method) -> String {
    method_name(method, true)
}

/// A number of lights, for people.
pub fn lights(count: u32) -> String {
    format!("{} lights", grouped(u64::from(count)))
}

/// Whether the groups of a run's method are pieces of frusta.
fn has_frusta(run: &&Run) -> bool {
    run.method.kind().cells() == Some(CellShape::Frustum)
}

/// Whether a run is by the test of pieces of frusta, or by the one that its boxes have.
fn is_usual(run: &&Run, usual: &str) -> bool {
    if has_frusta(run) { test(run) == usual } else { test(run) == Way::default().value("test", run.method) }
}

fn of_any_test(run: &Run) -> Setting {
    run.setting.by(&run.setting.way.without("test"))
}

/// By kind as the thesis has them, size, lights.
fn order(a: &Run, b: &Run) -> Ordering {
    sizes(a.method, b.method).then(a.lighting.cmp(&b.lighting))
}

fn sizes(a: Method, b: Method) -> Ordering {
    let place = |method: Method| EIGHT.iter().position(|kind| *kind == method.kind().name);
    let sizes = || a.sizes().partial_cmp(&b.sizes()).unwrap_or(Ordering::Equal);
    place(a).cmp(&place(b)).then_with(sizes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SphereTest;
    use crate::report::testing::{by_test, run, set};

    fn flat(method: &str, lights: u32) -> Run {
        by_test(run(method, 1, lights, |_, _| Some(1.0)), USUAL_TEST)
    }

    fn elsewhere(mut run: Run) -> Run {
        run.setting.scene = "hall".into();
        run
    }

    #[test]
    fn the_tests_are_those_that_the_thesis_compares() {
        let separators = |test: &str| {
            (test.starts_with("hs"), ['p', 'e', 'n', 'v'].map(|axis| test.replace("hs", "").contains(axis)))
        };
        let distinct: BTreeSet<_> = TESTS.iter().map(|test| separators(&test.replace("sat", ""))).collect();
        assert_eq!(distinct.len(), 18);
        for test in TESTS {
            assert_eq!(test.parse::<SphereTest>().unwrap().to_string(), test, "the program's own name");
            let (half_spaces, [normals, _, nearest, all]) = separators(&test.replace("sat", ""));
            assert!((half_spaces || normals) && !(nearest && all), "{test}");
        }
    }

    #[test]
    fn methods_of_all_tests_of_their_own_are_evaluated_together() {
        let grid = by_test(flat("sc-e-48-40", 1000), "hs");
        let runs = vec![
            flat("sc-e-48-40", 1000),
            flat("g-20", 1000),
            flat("m", 1000),
            grid,
            flat("indi-persp-64", 1000),
        ];
        let set = set(runs);
        let all = Evaluation::all(&set);
        assert_eq!((all.len(), all[0].scenes.len(), all[0].test.as_str()), (1, 1, USUAL_TEST));
        let names: Vec<String> = all[0].scenes[0].runs.iter().map(|run| name(run.method)).collect();
        assert_eq!(names, ["SC-E 48 40", "G 20", "M"]);
        assert_eq!(all[0].scenes[0].by_test.len(), 4);
        assert_eq!(all[0].setting.way, Way::default());
        let judged = judged(&set);
        assert_eq!((judged.len(), judged[0].1.runs.len(), &judged[0].0), (1, 4, &Way::default()));
    }

    #[test]
    fn without_the_usual_test_the_one_there_is_counts() {
        let set = set(vec![run("t-e-28", 1, 1000, |_, _| Some(1.0)), run("m", 1, 1000, |_, _| Some(1.0))]);
        let all = Evaluation::all(&set);
        assert_eq!((all[0].test.as_str(), all[0].scenes[0].runs.len()), ("hs", 2));
    }

    #[test]
    fn the_size_with_the_most_numbers_of_lights_stands_for_its_kind() {
        let sizes = [
            ("t-e-16", 100),
            ("t-e-16", 1000),
            ("t-e-28", 1000),
            ("t-i-28", 1000),
            ("t-i-16", 1000),
            ("g-8", 100),
            ("g-9", 100),
        ];
        let all = sizes.map(|(method, lights)| flat(method, lights));
        let chosen = |runs: Vec<Run>, kind| {
            let set = set(runs);
            Evaluation::all(&set)[0].chosen(kind).map(|method| method.to_string())
        };
        assert_eq!(chosen(all.to_vec(), "t-e").as_deref(), Some("t-e-16"));
        assert_eq!(
            chosen(all.to_vec(), "t-i").as_deref(),
            Some("t-i-28"),
            "the thesis's, of those measured alike"
        );
        assert_eq!(chosen(all.to_vec(), "g").as_deref(), Some("g-8"), "the first");
        assert_eq!(chosen(all.to_vec(), "dc-e"), None);
        let more =
            [all.to_vec(), vec![elsewhere(flat("t-e-28", 100)), elsewhere(flat("t-e-28", 1000))]].concat();
        assert_eq!(chosen(more, "t-e").as_deref(), Some("t-e-28"), "over all scenes");
    }

    #[test]
    fn ten_thousand_lights_are_many_or_else_the_most() {
        let many = |counts: &[u32]| {
            let set = set(counts.iter().map(|&lights| flat("m", lights)).collect());
            Evaluation::all(&set)[0].many()
        };
        assert_eq!((many(&[100, 10_000, 50_000]), many(&[100, 4000])), (Some(10_000), Some(4000)));
    }
}
