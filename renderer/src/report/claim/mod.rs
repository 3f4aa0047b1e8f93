//! Claims of papers, checked on whatever data there are.
//!
//! A claim is a handful of comparisons, each with the numbers behind it. It holds where every comparison that could be
//! made holds and all it needs were made; it does not hold where one fails. Criteria are fixed before any data.
//! How far a comparison is from failing is its margin. Times have noise, so the margin has an interval ([`repeats`]), and
//! where that straddles 0 the comparison is undecided. Counts repeat exactly.
//! Runs by different ways of assignment are never compared with each other, but where a paper compares them ([`by_way`] or
//! its own rule): the verdict is of the paper's own way, or else the first there is, and claims that others bear on have
//! theirs beside it.

mod repeats;

use super::results::{ResultSet, Run};
use super::way::Way;
use crate::stats::{self, Interval};
use serde::Serialize;

/// What the data say of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// Every comparison it needs was made, and holds.
    #[serde(rename = "holds")]
    Holds,
    /// A comparison fails.
    #[serde(rename = "does not hold")]
    DoesNotHold,
    /// None fails, and noise leaves open whether one does: more temporal runs may tell.
    #[serde(rename = "undecided")]
    Undecided,
    /// None fails or is open, and some could not be made.
    #[serde(rename = "not enough data")]
    NotEnoughData,
}

/// A claim with what was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// The paper's initial and a number, in the paper's order: `G1`.
    pub id: &'static str,
    /// What is claimed.
    pub claim: &'static str,
    /// When it counts as holding.
    pub criterion: &'static str,
    /// What the data say.
    pub verdict: Verdict,
    /// The comparisons made.
    pub evidence: Vec<Evidence>,
    /// Runs that would be needed and are not there.
    pub missing: Vec<String>,
    /// How light lists were built in what it was judged by.
    pub way: String,
    /// The same by other ways.
    pub other_ways: Vec<ByWay>,
}

/// What one further way of assignment says of a claim.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ByWay {
    /// How light lists were built.
    pub way: String,
    /// What the data say.
    pub verdict: Verdict,
    /// The comparisons made.
    pub evidence: Vec<Evidence>,
    /// Runs that would be needed and are not there.
    pub missing: Vec<String>,
}

/// One comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Evidence {
    /// Scene, recording, resolution.
    pub setting: String,
    /// What was compared, under which lighting.
    pub comparison: String,
    /// The numbers, by name.
    pub numbers: Vec<Number>,
    /// Whether it holds by the numbers as they are.
    pub holds: bool,
    /// How far it is from failing, or, negative, from holding: the distance of what is compared to its bound.
    pub margin: f64,
    /// From where to where the margin lies in 95 % of repetitions. `None` of counts, and where a run was timed fewer than
    /// twice.
    pub interval: Option<Interval>,
    /// Whether the margin lies on one side of 0 as far as noise tells.
    pub decided: bool,
}

/// What a comparison comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// Whether it holds.
    pub holds: bool,
    /// How far it is from changing that: positive where it holds.
    pub margin: f64,
}

impl Outcome {
    /// Of the claim that a number is above another.
    pub fn above(value: f64, bound: f64) -> Self {
        Self { holds: value > bound, margin: value - bound }
    }

    /// Of the claim that a number lies in a range, its ends included.
    pub fn within(value: f64, [low, high]: [f64; 2]) -> Self {
        Self { holds: low <= value && value <= high, margin: (value - low).min(high - value) }
    }

    /// Of the claim that both hold.
    pub fn and(self, other: Self) -> Self {
        Self { holds: self.holds && other.holds, margin: self.margin.min(other.margin) }
    }
}

/// A named number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Number {
    /// What it is.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// `ms` or empty.
    pub unit: &'static str,
}

/// What checking finds: comparisons and gaps.
#[derive(Debug, Default)]
pub struct Findings {
    /// The comparisons made.
    pub evidence: Vec<Evidence>,
    /// Runs that would be needed and are not there.
    pub missing: Vec<String>,
}

impl Findings {
    /// Takes a comparison that `run` was part of.
    pub fn compare(&mut self, run: &Run, comparison: String, numbers: Vec<Number>, outcome: Outcome) {
        self.compare_in(run.setting.to_string(), comparison, numbers, outcome);
    }

    /// Takes a comparison in a setting, or over several, by its name.
    pub fn compare_in(
        &mut self,
        setting: String,
        comparison: String,
        numbers: Vec<Number>,
        outcome: Outcome,
    ) {
        let Outcome { holds, margin } = outcome;
        let (interval, decided) = (None, true);
        self.evidence.push(Evidence { setting, comparison, numbers, holds, margin, interval, decided });
    }

    /// Takes a gap, once.
    pub fn lack(&mut self, what: impl Into<String>) {
        let what = what.into();
        if !self.missing.contains(&what) {
            self.missing.push(what);
        }
    }

    fn by_way(self, way: &Way) -> ByWay {
        let verdict = self.verdict();
        let Self { evidence, missing } = self;
        ByWay { way: way.to_string(), verdict, evidence, missing }
    }

    fn verdict(&self) -> Verdict {
        if self.evidence.iter().any(|evidence| evidence.decided && !evidence.holds) {
            Verdict::DoesNotHold
        } else if self.evidence.iter().any(|evidence| !evidence.decided) {
            Verdict::Undecided
        } else if self.evidence.is_empty() || !self.missing.is_empty() {
            Verdict::NotEnoughData
        } else {
            Verdict::Holds
        }
    }
}

/// A claim as its paper makes it.
pub struct Stated {
    /// The paper's initial and a number, in the paper's order: `G1`.
    pub id: &'static str,
    /// What is claimed.
    pub claim: &'static str,
    /// When it counts as holding.
    pub criterion: &'static str,
    /// Whether ways of assignment bear on it.
    pub of_ways: bool,
    /// What checks it.
    pub find: fn(&ResultSet) -> Findings,
}

/// The runs of each way, the thesis's own way first.
pub fn by_way(set: &ResultSet) -> Vec<(Way, ResultSet)> {
    set.ways().into_iter().map(|way| (way.clone(), set.by_way(way))).collect()
}

/// Checks claims, in their order, on each set apart; the first decides.
pub fn check<'a>(
    stated: impl IntoIterator<Item = &'a Stated>,
    mut sets: Vec<(Way, ResultSet)>,
) -> Vec<Claim> {
    if sets.is_empty() {
        sets.push(Default::default());
    }
    let stated: Vec<&Stated> = stated.into_iter().collect();
    let judge = |(way, set): &(Way, ResultSet)| -> Vec<ByWay> {
        repeats::findings(&stated, set).into_iter().map(|findings| findings.by_way(way)).collect()
    };
    let judged: Vec<Vec<ByWay>> = sets.iter().map(judge).collect();
    let claim = |(place, stated): (usize, &&Stated)| {
        stated.as_claim(judged.iter().map(|claims| claims[place].clone()).collect())
    };
    stated.iter().enumerate().map(claim).collect()
}

impl Stated {
    /// By what each way says of it, the first of which decides.
    fn as_claim(&self, mut ways: Vec<ByWay>) -> Claim {
        let others = ways.split_off(1).into_iter();
        let other_ways = others.filter(|found| self.of_ways && !found.evidence.is_empty()).collect();
        let ByWay { way, verdict, evidence, missing } = ways.remove(0);
        let Self { id, claim, criterion, .. } = *self;
        Claim { id, claim, criterion, verdict, evidence, missing, way, other_ways }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Holds => "holds",
            Self::DoesNotHold => "does not hold",
            Self::Undecided => "undecided",
            Self::NotEnoughData => "not enough data",
        })
    }
}

/// A count.
pub fn number(name: impl Into<String>, value: f64) -> Number {
    Number { name: name.into(), value, unit: "" }
}

/// A time.
pub fn milliseconds(name: impl Into<String>, value: f64) -> Number {
    Number { name: name.into(), value, unit: "ms" }
}

/// A metric's mean over the frames that `include` takes; `None` where there is none.
pub fn mean_where(run: &Run, metric: &str, include: impl Fn(u32) -> bool) -> Option<f64> {
    let points = run.frames.points(metric);
    stats::mean(points.iter().filter(|point| include(point[0] as u32)).map(|point| point[1]))
}

/// A metric's mean over all frames.
pub fn mean(run: &Run, metric: &str) -> Option<f64> {
    mean_where(run, metric, |_| true)
}
