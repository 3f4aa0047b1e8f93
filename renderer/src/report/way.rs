//! How light lists were built: the way of assignment and the test of light against cluster.

use crate::methods::{MethodSpec, Space};
use std::cmp::Ordering;
use std::fmt;

/// What the thesis does, by its name in configurations.
const BRUTE: &str = "brute";
/// The thesis's own test of each grid, by its name in configurations.
const OWN: &str = "auto";

/// Results of different ways are never drawn or judged together. The thesis's own comes first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Way {
    /// `brute`, `hierarchy`, `scatter`, or `auto` for whatever was likely fastest.
    pub assign: String,
    /// `auto` for the thesis's own, half spaces or the box; otherwise the test's name.
    test: String,
}

impl Way {
    /// The way of a run of `method`; what a configuration leaves out is the thesis's.
    pub fn new(assign: Option<String>, test: Option<String>, method: MethodSpec) -> Self {
        let own = Self::default();
        let test = test.filter(|test| test != own_test(method)).unwrap_or(own.test);
        Self { assign: assign.unwrap_or(own.assign), test }
    }

    /// The test's name where the clusters are those of `method`.
    pub fn test(&self, method: MethodSpec) -> &str {
        if self.test == OWN { own_test(method) } else { &self.test }
    }

    fn key(&self) -> (bool, &str, bool, &str) {
        (self.assign != BRUTE, &self.assign, self.test != OWN, &self.test)
    }
}

/// What the thesis asks of a light and a cluster: the box of an orthographic one, else its half spaces.
fn own_test(method: MethodSpec) -> &'static str {
    match method {
        MethodSpec::Clustered { space: Space::Ortho { .. }, .. } => "box",
        _ => "hs",
    }
}

impl Default for Way {
    fn default() -> Self {
        Self { assign: BRUTE.into(), test: OWN.into() }
    }
}

impl Ord for Way {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl PartialOrd for Way {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.assign.as_str() {
            BRUTE => "brute force",
            OWN => "the way chosen by counts",
            other => other,
        })?;
        if self.test == OWN { Ok(()) } else { write!(f, ", test {}", self.test) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way(assign: &str, test: &str, method: &str) -> Way {
        Way::new(Some(assign.into()), Some(test.into()), method.parse().unwrap())
    }

    #[test]
    fn the_own_test_of_every_grid_is_one_way() {
        assert_eq!(way("brute", "hs", "indi-persp-64"), Way::default());
        assert_eq!(way("brute", "box", "indi-ortho-4"), Way::default());
        assert_eq!(way("brute", "auto", "indi-ortho-4"), Way::default());
        assert_eq!(Way::new(None, None, "encl-displ-64-32".parse().unwrap()), Way::default());
        assert_ne!(way("brute", "hs", "indi-ortho-4"), Way::default());
        assert_eq!(Way::default().test("indi-ortho-4".parse().unwrap()), "box");
    }

    #[test]
    fn the_thesis_comes_first() {
        let mut ways = [("auto", "hs"), ("brute", "exact"), ("hierarchy", "hs"), ("brute", "hs")]
            .map(|(assign, test)| way(assign, test, "indi-persp-64"));
        ways.sort();
        let names = ways.map(|way| way.to_string());
        assert_eq!(
            names,
            ["brute force", "brute force, test exact", "the way chosen by counts", "hierarchy"]
        );
    }
}
