//! The claims of Gelderen chapter 6, checked on whatever data there are.
//!
//! A claim is a handful of comparisons, each with the numbers behind it. It holds where every comparison that could be
//! made holds and all it needs were made; it does not hold where one fails. Criteria are fixed here, before any data.
//! Runs by different ways of assignment are never compared with each other: the verdict is of the thesis's own way, or
//! else the first there is, and claims that others bear on have theirs beside it.

mod far;
mod limits;
mod stereo;

#[cfg(test)]
mod tests;

use super::results::{ResultSet, Run};
use super::stats;
use super::way::Way;
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
    /// None fails, and some could not be made.
    #[serde(rename = "not enough data")]
    NotEnoughData,
}

/// A claim with what was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// Number, from 1, in the order of the chapter.
    pub number: u32,
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
    /// Whether it holds.
    pub holds: bool,
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
struct Findings {
    evidence: Vec<Evidence>,
    missing: Vec<String>,
}

impl Findings {
    fn compare(&mut self, run: &Run, comparison: String, numbers: Vec<Number>, holds: bool) {
        self.evidence.push(Evidence { setting: run.setting.to_string(), comparison, numbers, holds });
    }

    fn lack(&mut self, what: impl Into<String>) {
        let what = what.into();
        if !self.missing.contains(&what) {
            self.missing.push(what);
        }
    }

    fn verdict(&self) -> Verdict {
        if self.evidence.iter().any(|evidence| !evidence.holds) {
            Verdict::DoesNotHold
        } else if self.evidence.is_empty() || !self.missing.is_empty() {
            Verdict::NotEnoughData
        } else {
            Verdict::Holds
        }
    }
}

/// A claim: number, words, criterion, and what checks it.
type Checked = (u32, &'static str, &'static str, fn(&ResultSet) -> Findings);

const CLAIMS: [Checked; 8] = [
    (
        1,
        "Encl about halves the total of visible clusters.",
        "In stereo, for Persp 64, Ortho 4 and Displ 64 32 where measured, under every lighting: the mean of visible \
         clusters by Encl is 0.4 to 0.6 of that by Indi.",
        stereo::visible_clusters,
    ),
    (
        2,
        "Encl lowers clustering time, most at 100 000 lights and for Ortho with far geometry.",
        "In stereo: the mean clustering time by Encl is below that by Indi for each tuned size under every lighting; the \
         time saved is greatest at 100 000 lights; for Ortho 4 it is greater at frames 530 to 630 of the street's \
         recording than at the others.",
        stereo::clustering_time,
    ),
    (
        3,
        "Encl Persp needs fewer lighting computations than Indi Persp.",
        "In stereo, Persp 64, under every lighting: the mean of lighting computations by Encl is below that by Indi.",
        stereo::lighting_computations,
    ),
    (
        4,
        "Far geometry, Persp: few visible clusters, more lights per cluster, shading dearer.",
        "Indi Persp 64 at frames 530 to 630 of the street's recording against the others, under every lighting: the mean \
         of visible clusters is lower, of light indices a visible cluster higher, of shading time higher.",
        far::persp,
    ),
    (
        5,
        "Far geometry, Ortho: most visible clusters, clustering dearest.",
        "Indi Ortho 4, under every lighting: the frame with the most visible clusters and the frame with the dearest \
         clustering both lie in 530 to 630 of the street's recording.",
        far::ortho,
    ),
    (
        6,
        "Displ 64 32 has a steadier frame time than Persp 64 and Ortho 4.",
        "Indi, under every lighting: the standard deviation of the frame's time over the replay is lower by Displ 64 32 \
         than by Persp 64 and than by Ortho 4.",
        limits::steadiness,
    ),
    (
        7,
        "Persp 64 never has more than 4096 fragments per cluster at one sample a pixel.",
        "No cluster of any frame of any run of Indi Persp 64 at one sample a pixel has more than 4096 fragments. \
         Fragments of transparent surfaces count too.",
        limits::fragments,
    ),
    (
        8,
        "Brute-force assignment grows linearly with the lights.",
        "For each Indi tuned size with two numbers of lights or more: the slope of the logarithm of intersection tests \
         over that of the lights lies in 0.99 to 1.01, and that of the time to count and assign lights in 0.8 to 1.2.",
        limits::growth,
    ),
];

/// Checks every claim.
pub fn check(set: &ResultSet) -> Vec<Claim> {
    let mut sets: Vec<(Way, ResultSet)> =
        set.ways().into_iter().map(|way| (way.clone(), set.by_way(way))).collect();
    if sets.is_empty() {
        sets.push(Default::default());
    }
    CLAIMS.into_iter().map(|checked| check_one(checked, &sets)).collect()
}

/// Claims that ways of assignment bear on: those of stereo, and of growth.
const OF_WAYS: [u32; 4] = [1, 2, 3, 8];

fn check_one((number, claim, criterion, find): Checked, sets: &[(Way, ResultSet)]) -> Claim {
    let by_way = |(way, set): &(Way, ResultSet)| {
        let findings = find(set);
        let verdict = findings.verdict();
        let Findings { evidence, missing } = findings;
        ByWay { way: way.to_string(), verdict, evidence, missing }
    };
    let ByWay { way, verdict, evidence, missing } = by_way(&sets[0]);
    let others = sets[1..].iter().filter(|_| OF_WAYS.contains(&number)).map(by_way);
    let other_ways = others.filter(|found| !found.evidence.is_empty()).collect();
    Claim { number, claim, criterion, verdict, evidence, missing, way, other_ways }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Holds => "holds",
            Self::DoesNotHold => "does not hold",
            Self::NotEnoughData => "not enough data",
        })
    }
}

fn number(name: impl Into<String>, value: f64) -> Number {
    Number { name: name.into(), value, unit: "" }
}

fn milliseconds(name: impl Into<String>, value: f64) -> Number {
    Number { name: name.into(), value, unit: "ms" }
}

/// A metric's mean over the frames that `include` takes; `None` where there is none.
fn mean_where(run: &Run, metric: &str, include: impl Fn(u32) -> bool) -> Option<f64> {
    let points = run.frames.points(metric);
    stats::mean(points.iter().filter(|point| include(point[0] as u32)).map(|point| point[1]))
}

fn mean(run: &Run, metric: &str) -> Option<f64> {
    mean_where(run, metric, |_| true)
}

/// Frames of the street's recording that look at far geometry (Gelderen figures 6.2 and 6.3: around frame 580).
fn is_far(frame: u32) -> bool {
    (530..=630).contains(&frame)
}
