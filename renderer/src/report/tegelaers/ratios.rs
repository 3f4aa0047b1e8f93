//! What the thesis tells as ratios of one method to another, and the same here.
//!
//! ```text
//! Ratio (two methods, what of them, where) ──> Evaluation, Scene ──> Told: both numbers ──┬─> claims H1 to H3, H7, H8
//!                                                                                        └─> table of ratios
//! ```

use super::evaluation::{CLUSTERED, Case, Corner, Evaluation, NAIVE, Pipeline, Scene, TILED, name, node};
use crate::methods::Method;
use crate::report::claim::mean;
use crate::report::results::metric;

/// How far the size of nodes may lie off that which is asked for, as a part of it: the thesis's own do, for trees have whole depths.
const OFF: f64 = 0.1;

/// One of the methods compared.
#[derive(Debug, Clone, Copy)]
pub enum Who {
    Naive,
    Tiled,
    Clustered,
    /// With nodes of so many radii.
    Hashed(f64),
}

/// Pipelines in which a ratio is told.
#[derive(Debug, Clone, Copy)]
pub enum Within {
    One(Pipeline),
    /// That in which the thesis counts.
    Counting,
}

/// A number of one method over that of another.
#[derive(Debug, Clone, Copy)]
pub struct Ratio {
    pub of: Who,
    pub to: Who,
    pub metric: &'static str,
    pub within: Within,
    pub corner: Corner,
    /// From where to where the thesis has it.
    pub printed: [f64; 2],
}

/// A ratio in a scene.
pub struct Told<'a> {
    pub methods: [Method; 2],
    pub pipeline: Pipeline,
    /// Where both were measured.
    pub case: Case<'a>,
    /// Of both.
    pub values: [f64; 2],
}

const QUARTER: Who = Who::Hashed(0.25);
const HALF: Who = Who::Hashed(0.5);
const TIME_BY_NAIVE: Ratio = Ratio {
    of: Who::Naive,
    to: Who::Tiled,
    metric: metric::FRAME,
    within: Within::Counting,
    corner: Corner::Many,
    printed: [4.0, 4.0],
};

/// Hashed over tiled: about half of the computations.
pub const HASHED_COMPUTATIONS: Ratio =
    Ratio { of: HALF, metric: metric::COMPUTATIONS, printed: [0.5, 0.5], ..TIME_BY_NAIVE };
/// Tiled over hashed, forward: twice the time.
pub const FORWARD_TIME: Ratio = Ratio {
    of: Who::Tiled,
    to: HALF,
    within: Within::One(Pipeline::Forward),
    printed: [2.0, 2.0],
    ..TIME_BY_NAIVE
};
/// Tiled over hashed, deferred: the same time.
pub const DEFERRED_TIME: Ratio =
    Ratio { within: Within::One(Pipeline::Deferred), printed: [1.0, 1.0], ..FORWARD_TIME };
/// Hashed over clustered: nearly as many computations.
pub const QUARTER_COMPUTATIONS: Ratio =
    Ratio { of: QUARTER, to: Who::Clustered, printed: [1.0, 1.0], ..HASHED_COMPUTATIONS };
/// Naive over tiled: three to four times the computations under many lights.
pub const NAIVE_COMPUTATIONS: Ratio = Ratio { of: Who::Naive, printed: [3.0, 4.0], ..HASHED_COMPUTATIONS };
/// The same under few.
pub const FEW_COMPUTATIONS: Ratio = Ratio { corner: Corner::Few, printed: [1.5, 2.0], ..NAIVE_COMPUTATIONS };
/// Clustered over tiled: nearly half of the computations.
pub const CLUSTERED_COMPUTATIONS: Ratio =
    Ratio { of: Who::Clustered, printed: [0.5, 0.5], ..HASHED_COMPUTATIONS };

/// Every ratio that he tells.
pub const ALL: [Ratio; 9] = [
    FEW_COMPUTATIONS,
    NAIVE_COMPUTATIONS,
    Ratio { corner: Corner::Few, printed: [1.5, 2.0], ..TIME_BY_NAIVE },
    TIME_BY_NAIVE,
    CLUSTERED_COMPUTATIONS,
    HASHED_COMPUTATIONS,
    QUARTER_COMPUTATIONS,
    FORWARD_TIME,
    DEFERRED_TIME,
];

impl Who {
    /// The method, where there are runs of it.
    pub fn method(self, evaluation: &Evaluation<'_>) -> Option<Method> {
        let near = |wanted: f64| {
            move |method: &Method| node(*method).is_some_and(|node| (node / wanted - 1.0).abs() <= OFF)
        };
        match self {
            Self::Naive => evaluation.chosen(NAIVE),
            Self::Tiled => evaluation.chosen(TILED),
            Self::Clustered => evaluation.chosen(CLUSTERED),
            Self::Hashed(radii) => evaluation.nodes().into_iter().find(near(radii)),
        }
    }

    /// What must be run for there to be one.
    pub fn pattern(self) -> String {
        match self {
            Self::Naive => NAIVE.into(),
            Self::Tiled => format!("{TILED}-32"),
            Self::Clustered => format!("{CLUSTERED}-32"),
            Self::Hashed(radii) => format!("hashed-{radii}-3"),
        }
    }
}

impl Within {
    pub fn pipeline(self, evaluation: &Evaluation<'_>) -> Pipeline {
        match self {
            Self::One(pipeline) => pipeline,
            Self::Counting => evaluation.counting(),
        }
    }
}

impl Ratio {
    /// The ratio in a scene; `None` where the two methods do not have the number with the same lights and pixels.
    pub fn told<'a>(&self, evaluation: &Evaluation<'a>, scene: &Scene<'a>) -> Option<Told<'a>> {
        let pipeline = self.within.pipeline(evaluation);
        let methods = [self.of.method(evaluation)?, self.to.method(evaluation)?];
        let cases = scene.both(methods.map(|method| (method, pipeline)), self.corner)?;
        let [of, to] = cases.map(|case| mean(case.run, self.metric));
        Some(Told { methods, pipeline, case: *cases[0], values: [of?, to?] })
    }

    /// What it is of, whatever it is.
    pub fn what(&self) -> &'static str {
        if self.metric == metric::FRAME { "frame time" } else { "lighting computations" }
    }
}

impl Told<'_> {
    /// The one over the other.
    pub fn value(&self) -> f64 {
        self.values[0] / self.values[1]
    }

    /// The two by name.
    pub fn names(&self) -> [String; 2] {
        self.methods.map(name)
    }
}
