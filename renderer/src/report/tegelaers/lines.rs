//! Which methods a figure compares, and how each looks in all of them.

use super::evaluation::{CLUSTERED, Evaluation, NAIVE, Pipeline, TILED, name};
use crate::methods::Method;
use crate::report::chart::{Key, Look, palette};

/// A method in a pipeline.
#[derive(Debug, Clone)]
pub struct Line {
    pub of: (Method, Pipeline),
    pub key: Key,
}

/// Colours of hashed methods, smallest nodes first.
const HASHED_COLORS: [&str; 5] = ["green", "sky", "purple", "vermillion", "yellow"];

fn line(method: Method, pipeline: Pipeline, look: Look) -> Line {
    Line { of: (method, pipeline), key: Key { label: name(method), look } }
}

fn naive(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    let found = evaluation.chosen(NAIVE);
    found.map(|method| line(method, pipeline, Look::plain("black"))).into_iter().collect()
}

/// The size that stands for a kind.
fn chosen(evaluation: &Evaluation<'_>, kind: &str, pipeline: Pipeline) -> Vec<Line> {
    let color = if kind == TILED { "orange" } else { "blue" };
    let found = evaluation.chosen(kind);
    found.map(|method| line(method, pipeline, Look::plain(color))).into_iter().collect()
}

/// Every size of a kind.
fn sizes(evaluation: &Evaluation<'_>, kind: &str, pipeline: Pipeline) -> Vec<Line> {
    ordered(evaluation.methods(kind), pipeline)
}

fn ordered(methods: Vec<Method>, pipeline: Pipeline) -> Vec<Line> {
    let count = methods.len();
    let look = |place| Look::plain(palette::ordered(place, count));
    methods.into_iter().enumerate().map(|(place, method)| line(method, pipeline, look(place))).collect()
}

fn hashed(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    let colored = evaluation.hashed().into_iter().zip(HASHED_COLORS);
    colored.map(|(method, color)| line(method, pipeline, Look::plain(color))).collect()
}

/// The naive method in both pipelines.
pub fn pipelines(evaluation: &Evaluation<'_>) -> Vec<Line> {
    let of = |pipeline: Pipeline| {
        let dashed = pipeline == Pipeline::Deferred;
        naive(evaluation, pipeline).into_iter().map(move |line| Line {
            key: Key {
                label: format!("{}, {}", line.key.label, pipeline.name()),
                look: Look { dashed, ..line.key.look },
            },
            ..line
        })
    };
    Pipeline::BOTH.into_iter().flat_map(of).collect()
}

/// The naive method, and tiles of the size that stands for all.
pub fn naive_and_tiled(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    [naive(evaluation, pipeline), chosen(evaluation, TILED, pipeline)].concat()
}

/// The naive method, and tiles of every size.
pub fn tile_sizes(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    [naive(evaluation, pipeline), sizes(evaluation, TILED, pipeline)].concat()
}

/// Tiles of every size.
pub fn tiles(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    sizes(evaluation, TILED, pipeline)
}

/// The naive method, tiles of one size, clusters of every size.
pub fn cluster_sizes(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    [naive_and_tiled(evaluation, pipeline), sizes(evaluation, CLUSTERED, pipeline)].concat()
}

/// Hashed methods by the size of their nodes.
pub fn nodes(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    ordered(evaluation.nodes(), pipeline)
}

/// The naive method, tiles, and hashed ones with nodes no larger than a radius.
pub fn all_but_clusters(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    [naive_and_tiled(evaluation, pipeline), hashed(evaluation, pipeline)].concat()
}

/// These, and clusters.
pub fn all(evaluation: &Evaluation<'_>, pipeline: Pipeline) -> Vec<Line> {
    let clusters = chosen(evaluation, CLUSTERED, pipeline);
    [naive_and_tiled(evaluation, pipeline), clusters, hashed(evaluation, pipeline)].concat()
}
