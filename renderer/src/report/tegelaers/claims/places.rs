//! Where claims are judged, and what is said where something is missing.

use crate::methods::Method;
use crate::report::claim::{Findings, Number, Outcome, mean, number};
use crate::report::results::{ResultSet, Run, metric};
use crate::report::tegelaers::evaluation::{Case, Corner, Evaluation, Pipeline, Scene, name};
use crate::report::tegelaers::ratios::{Ratio, Told, Who};
use crate::stats::Statistics;

/// Said where results hold no run of the thesis's methods.
const NOTHING: &str = "runs of Tegelaers' methods";

/// A scene of an evaluation.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    pub evaluation: &'a Evaluation<'a>,
    pub scene: &'a Scene<'a>,
}

/// What `judge` finds in every scene of every evaluation.
pub fn in_every_scene(set: &ResultSet, mut judge: impl FnMut(Place<'_>, &mut Findings)) -> Findings {
    let mut findings = Findings::default();
    for evaluation in &Evaluation::all(set) {
        for scene in &evaluation.scenes {
            judge(Place { evaluation, scene }, &mut findings);
        }
    }
    if findings.evidence.is_empty() && findings.missing.is_empty() {
        findings.lack(NOTHING);
    }
    findings
}

impl<'a> Place<'a> {
    /// The setting, for people.
    pub fn name(&self) -> String {
        self.scene.setting.to_string()
    }

    /// A ratio, judged by its bounds.
    pub fn judge(&self, ratio: &Ratio, bounds: [f64; 2], findings: &mut Findings) {
        let pipeline = ratio.within.pipeline(self.evaluation);
        let Some(told) = ratio.told(self.evaluation, self.scene) else {
            return self.lack(&[ratio.of, ratio.to], pipeline, findings);
        };
        let comparison = self.comparison(ratio.what(), &told);
        let unit = if ratio.metric == metric::FRAME { "ms" } else { "" };
        let names = told.names().into_iter().zip(told.values);
        let mut numbers: Vec<Number> = names.map(|(name, value)| Number { name, value, unit }).collect();
        numbers.push(number("ratio", told.value()));
        findings.compare_in(self.name(), comparison, numbers, Outcome::within(told.value(), bounds));
    }

    fn comparison(&self, what: &str, told: &Told<'_>) -> String {
        let [of, to] = told.names();
        format!("{what}, {of} over {to}, {}, {}", told.pipeline.name(), told.case.size())
    }

    /// Says which runs are missing here.
    pub fn lack(&self, who: &[Who], pipeline: Pipeline, findings: &mut Findings) {
        let patterns: Vec<String> = who.iter().map(|who| who.pattern()).collect();
        let patterns = patterns.join(" and ");
        findings.lack(format!("runs of {patterns}, {}, in {}", pipeline.name(), self.scene.name()));
    }

    /// The run of a method in a corner of what was measured of all of several.
    pub fn case(
        &self,
        of: (Method, Pipeline),
        among: &[(Method, Pipeline)],
        corner: Corner,
    ) -> Option<&'a Case<'a>> {
        let at = self.scene.corner(among, corner)?;
        self.scene.of(of.0, of.1).find(|case| (case.pixels, case.lights) == at)
    }

    /// A metric's mean for each of several methods in a corner, and where that is; `None` where one has none.
    pub fn means(
        &self,
        methods: &[(Method, Pipeline)],
        metric: &str,
        corner: Corner,
    ) -> Option<(Vec<(Method, f64)>, String)> {
        let cases = methods.iter().map(|&of| self.case(of, methods, corner));
        let cases: Vec<&Case<'a>> = cases.collect::<Option<_>>()?;
        let mean = |case: &&Case<'a>| Some((case.run.method, mean(case.run, metric)?));
        let size = cases.first()?.size();
        Some((cases.iter().map(mean).collect::<Option<_>>()?, size))
    }
}

/// Standard deviation of a metric over the frames, over its mean; one frame always is steady.
pub fn relative(run: &Run, metric: &str) -> Option<f64> {
    let values: Vec<f64> = run.frames.values(metric).collect();
    let all = Statistics::of(values.iter().copied()).filter(|_| values.len() > 1)?;
    (all.mean > 0.0).then(|| all.deviation / all.mean)
}

/// The method of a run, for people.
pub fn called(case: &Case<'_>) -> String {
    name(case.run.method)
}

/// Numbers of methods, by name.
pub fn told(numbers: &[(Method, f64)], unit: &'static str) -> Vec<Number> {
    numbers.iter().map(|&(method, value)| Number { name: name(method), value, unit }).collect()
}

/// The most of several numbers over the least.
pub fn spread(numbers: &[(Method, f64)]) -> f64 {
    let values = || numbers.iter().map(|(_, value)| *value);
    values().fold(0.0, f64::max) / values().fold(f64::INFINITY, f64::min)
}
