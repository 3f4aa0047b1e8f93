//! What the configuration of one run says, where a method's name may say it too: the test, which clusters get lists, bounds,
//! slices; and the way of assignment.

use super::{Assign, Config, LightsFrom};
use crate::assign::{Bounds, Clusters, Compaction, Marking, check_one_pass};
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
        method.assigns() && !method.is_rasterised()
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
        method.assigns() && !method.is_apart_from_views() && !method.is_rasterised()
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
        let with_lists = self.methods.first().filter(|method| method.assigns() && !method.is_rasterised());
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
        let brute =
            self.assign.first() == Some(&Assign::Brute) && self.methods.first().is_some_and(Method::assigns);
        match (self.lists.first(), self.lights_of_run().lighting()) {
            (Some(&lists), Some(lighting)) if brute => check_one_pass(lists, lighting.count),
            _ => Ok(()),
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
mod tests {
    use super::*;
    use crate::lights::Lighting;

    fn config(methods: &[&str], tests: &[&str]) -> Config {
        Config {
            methods: methods.iter().map(|name| name.parse().unwrap()).collect(),
            test: tests.iter().map(|name| name.parse().unwrap()).collect(),
            ..Config::default()
        }
    }

    fn ways(config: &Config) -> Vec<String> {
        let way = |run: &Config| format!("{} {} {}", run.methods[0], run.assign[0], run.test[0]);
        config.cases().iter().map(way).collect()
    }

    #[test]
    fn cases_are_the_product_with_equal_ones_once() {
        let mut config = config(&["indi-persp-64", "indi-ortho-4"], &["auto", "hs", "exact"]);
        let expected = [
            "indi-persp-64 brute hs",
            "indi-persp-64 brute exact",
            "indi-ortho-4 brute box",
            "indi-ortho-4 brute hs",
            "indi-ortho-4 brute exact",
        ];
        assert_eq!(ways(&config), expected);
        config.assign = vec![Assign::Scatter, Assign::Auto];
        config.lights = vec![Lighting::with_count(1), Lighting::with_count(2)];
        assert_eq!(config.cases().len(), 4 * expected.len());
        assert_eq!(ways(&config)[1], "indi-persp-64 scatter exact");
        assert_eq!(ways(&config)[2], "indi-persp-64 auto hs");
    }

    #[test]
    fn a_method_without_clusters_knows_no_ways() {
        let config = Config {
            assign: vec![Assign::Hierarchy, Assign::Brute],
            ..config(&["all-lights"], &["hs", "exact"])
        };
        assert_eq!(ways(&config), ["all-lights hierarchy auto"]);
    }

    #[test]
    fn fragments_lie_on_their_models() {
        let refused = |method: &str, msaa, marking| {
            let config = Config { msaa, marking, ..config(&[method], &["auto"]) };
            config.cases()[0].check_case().err()
        };
        assert!(refused("m", 4, Marking::Geometry).unwrap().contains("use depth"));
        for (method, msaa, marking) in
            [("m", 4, Marking::Depth), ("m", 1, Marking::Geometry), ("g-20", 4, Marking::Geometry)]
        {
            assert_eq!(refused(method, msaa, marking), None, "{method} {msaa} {marking:?}");
        }
    }

    #[test]
    fn deferred_samples_lie_where_they_are_marked() {
        let refused = |msaa, marking| {
            let pipeline = vec![ShadingPipeline::Deferred];
            let config = Config { msaa, marking, pipeline, ..config(&["g-20"], &["auto"]) };
            config.cases()[0].check_case().err()
        };
        assert!(refused(4, Marking::Geometry).unwrap().contains("G-buffer"));
        assert_eq!((refused(4, Marking::Depth), refused(1, Marking::Geometry)), (None, None));
    }

    #[test]
    fn a_counter_gives_places_where_clusters_are_marked_and_neighbours_do_not_matter() {
        let refused = |method: &str, assign, clusters: &str| {
            let config = Config {
                assign: vec![assign],
                clusters: vec![clusters.parse().unwrap()],
                compaction: vec![Compaction::Atomic],
                ..config(&[method], &["auto"])
            };
            config.cases()[0].check_case().err()
        };
        for (method, assign) in [
            ("sc-i-48-40", Assign::Brute),
            ("encl-ortho-4", Assign::Hierarchy),
            ("g-20", Assign::Scatter),
            ("all-lights", Assign::Auto),
        ] {
            assert_eq!(refused(method, assign, "auto"), None, "{method}");
        }
        for assign in [Assign::Scatter, Assign::Auto] {
            assert!(refused("sc-i-48-40", assign, "auto").unwrap().contains("no neighbours"), "{assign}");
        }
        for (method, clusters) in [("dc-i-128-64", "auto"), ("sc-i-48-40", "all")] {
            let refused = refused(method, Assign::Brute, clusters).unwrap();
            assert!(refused.contains("all clusters of"), "{refused}");
        }
        assert_eq!(refused("dc-i-128-64", Assign::Brute, "visible"), None);
    }

    #[test]
    fn samples_are_sorted_in_tiles_of_whole_pixels() {
        let refused = |method: &str, marking| {
            let config =
                Config { marking, compaction: vec![Compaction::Sort], ..config(&[method], &["auto"]) };
            config.cases()[0].check_case().err()
        };
        let by_depth = |method| refused(method, Marking::Depth);
        for method in [
            "clustered-mm-32",
            "indi-persp-64",
            "tiled-16",
            "sc-e-48-40",
            "ortiz-16-9-24",
            "g-20",
            "all-lights",
        ] {
            assert_eq!(by_depth(method), None, "{method}");
        }
        for (method, told) in [
            ("encl-persp-64", "do not lie in such"),
            ("indi-ortho-4", "do not lie in such"),
            ("indi-displ-64-32", "do not lie in such"),
            ("clustered-mm-12.5", "have 12.5"),
            ("tiled-mm-32", "all clusters of tiled-mm-32"),
        ] {
            let message = by_depth(method).unwrap();
            assert!(message.contains(told), "{message}");
        }
        assert!(refused("clustered-mm-32", Marking::Geometry).unwrap().contains("use --marking depth"));
    }

    #[test]
    fn rectangles_ask_for_their_test() {
        let refused = |method: &str, test: &str| {
            let config = Config { assign: vec![Assign::Rectangles], ..config(&[method], &[test]) };
            config.cases()[0].check_case().err()
        };
        for (method, test) in [
            ("tiled-mm-32", "auto"),
            ("clustered-mm-32", "mm"),
            ("encl-persp-64", "mm"),
            ("all-lights", "auto"),
        ] {
            assert_eq!(refused(method, test), None, "{method} {test}");
        }
        for (method, test) in [("t-i-28", "auto"), ("tiled-mm-32", "exact"), ("g-20", "auto"), ("m", "auto")]
        {
            let message = refused(method, test).unwrap();
            assert!(message.contains("use --test mm"), "{message}");
        }
    }

    #[test]
    fn boxes_serve_boxes_alone() {
        let refused = |method: &str| config(&[method], &["box"]).cases()[0].check_case().err();
        assert_eq!(refused("encl-ortho-4"), None);
        assert_eq!(refused("all-lights"), None);
        assert!(refused("encl-persp-64").unwrap().contains("encl-persp-64 are no boxes"));
        assert!(refused("indi-displ-64-32").is_some());
        let seen = |method: &str| config(&[method], &["mm"]).cases()[0].check_case().err();
        for method in ["indi-persp-64", "encl-displ-64-32", "ortiz-16-9-24", "t-e-28", "all-lights"] {
            assert_eq!(seen(method), None);
        }
        for method in ["encl-ortho-4", "g-20"] {
            assert!(seen(method).unwrap().contains("no pieces of a frustum"));
        }
        assert_eq!(refused("g-20"), None);
        assert_eq!(refused("ortiz-16-9-24"), None);
        assert_eq!(ways(&config(&["ortiz-16-9-24"], &["auto"])), ["ortiz-16-9-24 brute box"]);
        for test in ["box", "hs", "sat-n"] {
            let refused = config(&["m"], &[test]).cases()[0].check_case().unwrap_err();
            assert!(refused.contains("`exact` alone") && refused.contains(test), "{refused}");
        }
        for test in ["auto", "exact"] {
            assert_eq!(ways(&config(&["m"], &[test])), ["m brute exact"]);
        }
    }
}
