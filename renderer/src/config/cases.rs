//! What the configuration of one run says, where a method's name may say it too: the test, which clusters get lists, bounds,
//! slices; and the way of assignment.

use super::{Assign, Config, LightsFrom};
use crate::assign::{Bounds, Clusters, Compaction, Marking, check_links, check_one_pass};
use crate::geometry::{CellShape, SliceLaw, SphereTest, VolumeTest};
use crate::methods::Method;
use crate::nearest;
use crate::shading::ShadingPipeline;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// What a run does, or `auto`: what is its method's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice<T> {
    /// The method's own.
    Auto,
    /// This, whatever the method.
    Named(T),
}

/// What decides whether a light gets onto a cluster's list.
pub type Test = Choice<VolumeTest>;

/// What every method has of its own.
pub trait Own: Copy {
    /// What `method` has where nothing else is said.
    fn own(method: &Method) -> Self;

    /// Whether `method` asks for it at all.
    fn applies(method: &Method) -> bool {
        method.assigns()
    }
}

impl Own for VolumeTest {
    fn own(method: &Method) -> Self {
        method.own_test().into()
    }

    fn applies(method: &Method) -> bool {
        method.takes_ways()
    }
}

impl Own for Clusters {
    fn own(method: &Method) -> Self {
        method.own_clusters()
    }

    fn applies(method: &Method) -> bool {
        method.assigns() && !method.is_apart_from_views()
    }
}

impl Own for Bounds {
    fn own(method: &Method) -> Self {
        method.own_bounds()
    }

    fn applies(method: &Method) -> bool {
        method.takes_ways() && !method.is_apart_from_views()
    }
}

impl Own for SliceLaw {
    fn own(method: &Method) -> Self {
        method.own_slices()
    }

    fn applies(method: &Method) -> bool {
        method.has_slices()
    }
}

impl<T: Own> Choice<T> {
    /// What runs of `method` do.
    pub fn of(self, method: &Method) -> T {
        match self {
            Self::Named(named) => named,
            Self::Auto => T::own(method),
        }
    }

    /// The same by its name for `method`; of a method that does not ask for it, `auto`.
    pub fn resolved(self, method: &Method) -> Self {
        if T::applies(method) { Self::Named(self.of(method)) } else { Self::Auto }
    }
}

impl From<SphereTest> for Test {
    fn from(test: SphereTest) -> Self {
        Self::Named(test.into())
    }
}

impl<T> From<T> for Choice<T> {
    fn from(named: T) -> Self {
        Self::Named(named)
    }
}

/// Whether the method's clusters are axis-aligned boxes, or can be tested as such.
fn has_boxes(method: &Method) -> bool {
    matches!(method.kind().cells(), Some(CellShape::Box | CellShape::BoxedFrustum))
}

/// Whether the method's clusters are pieces of a frustum, seen from its apex as rectangles.
fn has_rectangles(method: &Method) -> bool {
    matches!(method.kind().cells(), None | Some(CellShape::Frustum | CellShape::BoxedFrustum))
}

/// Whether the method's groups are models.
fn has_models(method: &Method) -> bool {
    method.kind().cells() == Some(CellShape::Model)
}

impl Config {
    /// Refuses a run whose test cannot serve its method's clusters, whose fragments may lie off their models or samples, or whose
    /// visible clusters cannot take their places in any order.
    ///
    /// # Errors
    /// Names both.
    pub fn check_case(&self) -> Result<(), String> {
        self.check_compaction()?;
        self.check_lists()?;
        self.check_samples()?;
        self.check_assign()?;
        self.check_cones()?;
        let (Some(method), Some(Test::Named(test))) = (self.methods.first(), self.test.first()) else {
            return Ok(());
        };
        match test.sphere {
            sphere if has_models(method) && sphere != SphereTest::Exact => Err(format!(
                "test: {method} tests lights against the boxes of models, by `exact` alone: leave `{test}` out, or exclude the run"
            )),
            SphereTest::Box if !has_boxes(method) => Err(format!(
                "test: the clusters of {method} are no boxes: test them with `exact`, or exclude the run"
            )),
            SphereTest::Projected if !has_rectangles(method) => Err(format!(
                "test: the clusters of {method} are no pieces of a frustum, whose rectangles `mm` asks: use `exact`, or exclude the \
                 run"
            )),
            _ => Ok(()),
        }
    }

    /// Refuses fragments of several samples where each sample must lie on what it is shaded as.
    fn check_samples(&self) -> Result<(), String> {
        if self.msaa == 1 || self.marking == Marking::Depth {
            return Ok(());
        }
        let why = match self.methods.first() {
            Some(method) if has_models(method) => {
                format!("which may lie off the model whose lights {method} looks up")
            }
            _ if self.pipeline.contains(&ShadingPipeline::Deferred) => {
                "where no sample need lie that a G-buffer keeps for deferred shading".to_owned()
            }
            _ => return Ok(()),
        };
        Err(format!(
            "marking: from geometry, fragments of {} samples are shaded at the centre of their pixel, {why}: use depth",
            self.msaa
        ))
    }

    /// Cones of normals are gathered where samples are measured.
    fn check_cones(&self) -> Result<(), String> {
        let asked = self.normal_cones.first().is_some_and(|cones| cones.are_on());
        let Some(method) = self.methods.first().filter(|method| asked && method.has_lists()) else {
            return Ok(());
        };
        let mend = match <Bounds as Own>::applies(method) {
            true if self.bounds[0].of(method) == Bounds::Measured => return Ok(()),
            true => "use --bounds measured",
            false => "which can be of clusters of views alone: use 0",
        };
        Err(format!(
            "normal-cones: they are of samples, which are measured with the bounds of their group, and those of {method} are not: \
             {mend}, or exclude the run"
        ))
    }

    /// A way of assignment that finds lights by one test needs it.
    fn check_assign(&self) -> Result<(), String> {
        let with_lists = self.methods.first().filter(|method| method.takes_ways());
        let (Some(method), Some(assigner)) = (with_lists, self.assign.first().and_then(|way| way.fixed()))
        else {
            return Ok(());
        };
        let test = self.test[0].of(method);
        if assigner.serves(test.sphere) {
            return Ok(());
        }
        Err(format!(
            "assign: {assigner} take lights to the tiles in which they are seen, as the test `mm` does, and {method} tests by `{test}`: \
             use --test mm, or exclude the run"
        ))
    }

    fn check_lists(&self) -> Result<(), String> {
        let with_lists = self.methods.first().filter(|method| method.assigns());
        let (Some(method), Some(&lists)) = (with_lists, self.lists.first()) else { return Ok(()) };
        let lights = self.lights_of_run().lighting().map_or(0, |lighting| lighting.count);
        check_links(lists, method, lights)?;
        match method.takes_ways() && self.assign.first() == Some(&Assign::Brute) {
            true => check_one_pass(lists, lights),
            false => Ok(()),
        }
    }

    fn check_compaction(&self) -> Result<(), String> {
        let marks = |method: &&Method| <Clusters as Own>::applies(method);
        let (Some(method), Some(&compaction)) = (self.methods.first().filter(marks), self.compaction.first())
        else {
            return Ok(());
        };
        let all_listed = self.clusters.first().is_some_and(|clusters| clusters.of(method) == Clusters::All);
        match compaction {
            Compaction::Ranks => Ok(()),
            Compaction::Atomic | Compaction::Sort if all_listed => Err(format!(
                "compaction: all clusters of {method} have lists, at places that nothing has to find: use ranks, or exclude \
                 the run"
            )),
            Compaction::Atomic => self.check_counter(),
            Compaction::Sort => self.check_sort(method),
        }
    }

    /// Samples are sorted where whole pixels of a view are its tiles.
    fn check_sort(&self, method: &Method) -> Result<(), String> {
        if self.marking == Marking::Geometry {
            return Err(
                "compaction: sort takes visible clusters from the depth of samples: use --marking depth, or ranks".into()
            );
        }
        match method.tile_pixels(self.resolution) {
            Some(pixels) if pixels.fract() == 0.0 => Ok(()),
            Some(pixels) => Err(format!(
                "compaction: sort takes tiles of whole pixels, and those of {method} have {pixels}: use a whole size, or exclude the \
                 run"
            )),
            None => Err(format!(
                "compaction: sort goes through the tiles of a view's screen, and the clusters of {method} do not lie in such: use \
                 ranks, or exclude the run"
            )),
        }
    }

    /// A counter leaves clusters in any order.
    fn check_counter(&self) -> Result<(), String> {
        match self.assign.first() {
            Some(way @ (Assign::Scatter | Assign::Auto)) => Err(format!(
                "compaction: atomic leaves no neighbours together, whose groups `{way}` takes lights to: use --assign brute or \
                 hierarchy, or exclude the run"
            )),
            _ => Ok(()),
        }
    }

    /// Where the lights of a run's configuration come from.
    pub fn lights_of_run(&self) -> LightsFrom {
        self.lights_from().into_iter().next().unwrap_or(LightsFrom::Scene)
    }
}

impl<T: fmt::Display> fmt::Display for Choice<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Named(named) => named.fmt(f),
        }
    }
}

impl<T: FromStr> FromStr for Choice<T> {
    type Err = T::Err;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, T::Err> {
        if text == "auto" { Ok(Self::Auto) } else { text.parse().map(Self::Named) }
    }
}

impl fmt::Display for Assign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Brute => "brute",
            Self::Hierarchy => "hierarchy",
            Self::Scatter => "scatter",
            Self::Rectangles => "rectangles",
            Self::Auto => "auto",
        })
    }
}

impl FromStr for Assign {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        nearest::named(text, Self::value_variants(), "way of assignment")
    }
}

#[cfg(test)]
mod tests;
