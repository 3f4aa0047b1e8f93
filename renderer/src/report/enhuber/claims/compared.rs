//! What the claims compare: a number of each of several methods in a scene.

use crate::methods::Method;
use crate::report::analysis::Part;
use crate::report::claim::{Findings, Number, Outcome, mean};
use crate::report::enhuber::evaluation::{Evaluation, Scene, lights, name};
use crate::report::results::{ResultSet, Run, metric};
use crate::stats::{self, Statistics};

/// Said where results hold no run of the thesis's methods, or none that was timed.
const NOTHING: &str = "temporal runs of Enhuber's methods";

/// A number of a method.
#[derive(Debug, Clone, Copy)]
pub struct Of {
    pub method: Method,
    pub value: f64,
}

/// A number of each of several methods.
pub struct Compared {
    numbers: Vec<Of>,
    unit: &'static str,
}

/// A scene of an evaluation.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    pub evaluation: &'a Evaluation<'a>,
    pub scene: &'a Scene<'a>,
}

/// What `judge` finds in every scene of every evaluation.
pub fn in_every_scene(set: &ResultSet, mut judge: impl FnMut(Place<'_>, &mut Findings)) -> Findings {
    in_every_evaluation(set, |evaluation, findings| {
        for scene in &evaluation.scenes {
            judge(Place { evaluation, scene }, findings);
        }
    })
}

/// What `judge` finds in every evaluation.
pub fn in_every_evaluation(
    set: &ResultSet,
    mut judge: impl FnMut(&Evaluation<'_>, &mut Findings),
) -> Findings {
    let mut findings = Findings::default();
    for evaluation in &Evaluation::all(set) {
        judge(evaluation, &mut findings);
    }
    if findings.evidence.is_empty() && findings.missing.is_empty() {
        findings.lack(NOTHING);
    }
    findings
}

impl<'a> Place<'a> {
    /// The run of the method that stands for a kind under so many lights.
    pub fn run(&self, kind: &str, count: u32) -> Option<&'a Run> {
        self.scene.run(self.evaluation.chosen(kind)?, count)
    }

    /// A number of the run of each kind under so many lights; what is missing is said, and makes it `None`.
    pub fn under(
        &self,
        kinds: &[&str],
        count: u32,
        of: fn(&Run) -> Option<f64>,
        findings: &mut Findings,
    ) -> Option<Vec<Of>> {
        let number = |kind: &&str| {
            let found =
                self.run(kind, count).and_then(|run| Some(Of { method: run.method, value: of(run)? }));
            if found.is_none() {
                let kind = title(kind);
                findings.lack(format!(
                    "temporal runs of {kind} under {} in {}",
                    lights(count),
                    self.scene.name()
                ));
            }
            found
        };
        let found: Vec<Option<Of>> = kinds.iter().map(number).collect();
        found.into_iter().collect()
    }

    /// As [`Self::under`] the lights that are many.
    pub fn under_many(
        &self,
        kinds: &[&str],
        of: fn(&Run) -> Option<f64>,
        findings: &mut Findings,
    ) -> Option<(Vec<Of>, String)> {
        let many = self.evaluation.many()?;
        Some((self.under(kinds, many, of, findings)?, lights(many)))
    }

    /// A number of the line over lights of each kind.
    pub fn lines(&self, kinds: &[&str], part: Part, findings: &mut Findings) -> Option<Vec<(Method, Line)>> {
        let line = |kind: &&str| {
            let found = self
                .evaluation
                .chosen(kind)
                .and_then(|method| Some((method, line(self.scene, method, part)?)));
            if found.is_none() {
                let kind = title(kind);
                findings.lack(format!(
                    "temporal runs of {kind} under three numbers of lights or more in {}",
                    self.scene.name()
                ));
            }
            found
        };
        let found: Vec<Option<(Method, Line)>> = kinds.iter().map(line).collect();
        found.into_iter().collect()
    }

    /// The setting, for people.
    pub fn name(&self) -> String {
        self.scene.setting.to_string()
    }
}

impl Compared {
    /// Numbers with a unit.
    pub fn new(numbers: Vec<Of>, unit: &'static str) -> Self {
        Self { numbers, unit }
    }

    /// Every number by its method.
    pub fn told(&self) -> Vec<Number> {
        let number = |of: &Of| Number { name: name(of.method), value: of.value, unit: self.unit };
        self.numbers.iter().map(number).collect()
    }

    /// Of the claim that these kinds are below all others.
    pub fn lowest(&self, kinds: &[&str]) -> Outcome {
        let [these, others] = self.split(kinds);
        Outcome::above(others.fold(f64::INFINITY, f64::min), these.fold(f64::NEG_INFINITY, f64::max))
    }

    /// Of the claim that these kinds are above all others.
    pub fn highest(&self, kinds: &[&str]) -> Outcome {
        let [these, others] = self.split(kinds);
        Outcome::above(these.fold(f64::INFINITY, f64::min), others.fold(f64::NEG_INFINITY, f64::max))
    }

    /// The numbers of some kinds alone.
    pub fn without(&self, kinds: &[&str]) -> Self {
        let kept = self.numbers.iter().filter(|of| !kinds.contains(&of.method.kind().name));
        Self { numbers: kept.copied().collect(), unit: self.unit }
    }

    fn split(&self, kinds: &[&str]) -> [std::vec::IntoIter<f64>; 2] {
        let values = |wanted: bool| {
            let of_kinds = self.numbers.iter().filter(|of| kinds.contains(&of.method.kind().name) == wanted);
            of_kinds.map(|of| of.value).collect::<Vec<f64>>().into_iter()
        };
        [values(true), values(false)]
    }
}

/// The least-squares line of a part's mean time over the number of lights.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Microseconds a light.
    pub slope: f64,
    /// Milliseconds.
    pub offset: f64,
    /// How far the times lie off it, root mean square, milliseconds.
    pub off: f64,
    /// The mean of the times, milliseconds.
    pub mean: f64,
}

/// `None` where there are fewer than three numbers of lights with times.
fn line(scene: &Scene<'_>, method: Method, part: Part) -> Option<Line> {
    let point = |run: &&Run| Some((f64::from(run.lighting.count?), part_mean(run, part)?));
    let points: Vec<(f64, f64)> = scene.counts(method).iter().filter_map(point).collect();
    let slope = stats::slope(&points).filter(|_| points.len() > 2)?;
    let [lights, mean] =
        [0, 1].map(|place| stats::mean(points.iter().map(|point| [point.0, point.1][place])));
    let (lights, mean) = (lights?, mean?);
    let offset = mean - slope * lights;
    let square = |(lights, time): &(f64, f64)| (time - offset - slope * lights).powi(2);
    let off = stats::mean(points.iter().map(square))?.sqrt();
    Some(Line { slope: 1000.0 * slope, offset, off, mean })
}

/// A part's mean time over the frames, milliseconds.
fn part_mean(run: &Run, part: Part) -> Option<f64> {
    let [all, shading] = [metric::FRAME, metric::SHADE].map(|metric| mean(run, metric));
    match part {
        Part::Assignment => Some(all? - shading?),
        Part::Shading => shading,
        Part::All => all,
    }
}

/// Mean frame time, milliseconds.
pub fn frame_time(run: &Run) -> Option<f64> {
    part_mean(run, Part::All)
}

/// Standard deviation of the frame time over the frames, milliseconds; one frame always is steady.
pub fn deviation(run: &Run) -> Option<f64> {
    let times: Vec<f64> = run.frames.values(metric::FRAME).collect();
    if times.len() < 2 { None } else { Statistics::of(times).map(|times| times.deviation) }
}

/// The same over the mean.
pub fn relative(run: &Run) -> Option<f64> {
    Some(deviation(run)? / frame_time(run)?)
}

/// A kind as figures name it.
pub fn title(kind: &str) -> &str {
    crate::methods::KINDS.iter().find(|known| known.name == kind).map_or(kind, |kind| kind.title)
}
