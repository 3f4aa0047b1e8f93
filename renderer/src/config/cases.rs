//! What the configuration of one run says: the way of assignment and the test.

use super::{Assign, Config, LightsFrom};
use crate::assign::Marking;
use crate::geometry::{CellShape, SphereTest};
use crate::methods::Method;
use crate::nearest;
use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;

/// What decides whether a light gets onto a cluster's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Test {
    /// The thesis's own: half spaces in perspective grids, the box in orthographic ones.
    Auto,
    /// The test of this name.
    Named(SphereTest),
}

impl Test {
    /// The test that is asked of the clusters of `method`; a method without clusters asks nothing.
    pub fn of(self, method: &Method) -> SphereTest {
        match self {
            _ if has_models(method) => SphereTest::Exact,
            Self::Named(test) => test,
            Self::Auto if has_boxes(method) => SphereTest::Box,
            Self::Auto => SphereTest::HALF_SPACES,
        }
    }

    /// The test by its name for the clusters of `method`; a method without clusters has none. One that the method does not
    /// serve stays as it is, to be refused.
    pub fn resolved(self, method: &Method) -> Self {
        match self {
            _ if !method.has_lists() => Self::Auto,
            Self::Named(_) => self,
            Self::Auto => Self::Named(self.of(method)),
        }
    }
}

/// Whether the method's clusters are axis-aligned boxes.
fn has_boxes(method: &Method) -> bool {
    method.kind().cells == Some(CellShape::Box)
}

/// Whether the method's groups are models.
fn has_models(method: &Method) -> bool {
    method.kind().cells == Some(CellShape::Model)
}

impl Config {
    /// Refuses a run whose test cannot serve its method's clusters, or whose fragments may lie off their models.
    ///
    /// # Errors
    /// Names both.
    pub fn check_case(&self) -> Result<(), String> {
        if self.msaa > 1 && self.marking == Marking::Geometry && self.methods.first().is_some_and(has_models)
        {
            return Err(format!(
                "marking: from geometry, fragments of {} samples are shaded at the centre of their pixel, which may lie off the \
                 model whose lights {} looks up: use depth",
                self.msaa, self.methods[0]
            ));
        }
        match (self.methods.first(), self.test.first()) {
            (Some(method), Some(Test::Named(test))) if has_models(method) && *test != SphereTest::Exact => {
                Err(format!(
                    "test: {method} tests lights against the boxes of models, by `exact` alone: leave `{test}` out, or \
                     exclude the run"
                ))
            }
            (Some(method), Some(Test::Named(SphereTest::Box))) if !has_boxes(method) => Err(format!(
                "test: the clusters of {method} are no boxes: test them with `exact`, or exclude the run"
            )),
            _ => Ok(()),
        }
    }

    /// Where the lights of a run's configuration come from.
    pub fn lights_of_run(&self) -> LightsFrom {
        self.lights_from().into_iter().next().unwrap_or(LightsFrom::Scene)
    }
}

impl fmt::Display for Test {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Named(test) => test.fmt(f),
        }
    }
}

impl FromStr for Test {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" { Ok(Self::Auto) } else { text.parse().map(Self::Named) }
    }
}

impl fmt::Display for Assign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Brute => "brute",
            Self::Hierarchy => "hierarchy",
            Self::Scatter => "scatter",
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
    fn boxes_serve_boxes_alone() {
        let refused = |method: &str| config(&[method], &["box"]).cases()[0].check_case().err();
        assert_eq!(refused("encl-ortho-4"), None);
        assert_eq!(refused("all-lights"), None);
        assert!(refused("encl-persp-64").unwrap().contains("encl-persp-64 are no boxes"));
        assert!(refused("indi-displ-64-32").is_some());
        assert_eq!(refused("g-20"), None);
        for test in ["box", "hs", "sat-n"] {
            let refused = config(&["m"], &[test]).cases()[0].check_case().unwrap_err();
            assert!(refused.contains("`exact` alone") && refused.contains(test), "{refused}");
        }
        for test in ["auto", "exact"] {
            assert_eq!(ways(&config(&["m"], &[test])), ["m brute exact"]);
        }
    }
}
