//! How light lists were built: a run's value on each axis that is a method's way of working, such as the way of
//! assignment and the test of light against cluster.

use crate::config::{Axis, Config, Role};
use crate::methods::Method;
use std::fmt;

/// Results of different ways are never drawn or judged together. The thesis's own, which is the default, comes first.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Way {
    /// The value on each axis of [`Role::Way`], in their order, where it is not the thesis's own.
    values: Vec<Option<String>>,
}

fn axes() -> impl Iterator<Item = &'static Axis> {
    Axis::of_role(Role::Way)
}

/// A value as runs of `method` have it: a test by its name, not as `auto`.
fn value(axis: &Axis, config: &Config, method: Method) -> String {
    let of_method = Config { methods: vec![method], ..config.clone() };
    let mut labels: Vec<String> = of_method.cases().iter().map(|run| axis.label(run, config)).collect();
    labels.dedup();
    labels.join(" or ")
}

/// What the thesis does.
fn own(axis: &Axis, method: Method) -> String {
    value(axis, &Config::default(), method)
}

impl Way {
    /// The way of a run of `method`.
    pub fn new(config: &Config, method: Method) -> Self {
        let differing = |axis| Some(value(axis, config, method)).filter(|value| *value != own(axis, method));
        Self { values: axes().map(differing).collect() }
    }

    /// The value on the axis of a name where the clusters are those of `method`.
    pub fn value(&self, name: &str, method: Method) -> String {
        let found = axes().zip(&self.values).find(|(axis, _)| axis.name == name);
        found.map_or_else(String::new, |(axis, value)| value.clone().unwrap_or_else(|| own(axis, method)))
    }

    /// The value on the axis of a name where it is not the thesis's own.
    pub fn other(&self, name: &str) -> Option<&str> {
        axes().zip(&self.values).find(|(axis, _)| axis.name == name)?.1.as_deref()
    }

    /// The same way, but for the axis of a name: on that it is the thesis's own.
    pub fn without(&self, name: &str) -> Self {
        let kept =
            |(axis, value): (&'static Axis, &Option<String>)| value.clone().filter(|_| axis.name != name);
        Self { values: axes().zip(&self.values).map(kept).collect() }
    }

    /// The same way, but for the axis of a name: on that it is another than the thesis's own.
    #[cfg(test)]
    pub fn with(mut self, name: &str, value: &str) -> Self {
        let place = axes().position(|axis| axis.name == name).expect("an axis of that name");
        self.values[place] = Some(value.to_owned());
        self
    }

    /// A way by the names of its first two axes.
    #[cfg(test)]
    pub fn named(assign: &str, test: &str, method: Method) -> Self {
        let (assign, test) = (vec![assign.parse().unwrap()], vec![test.parse().unwrap()]);
        Self::new(&Config { assign, test, ..Config::default() }, method)
    }
}

impl Default for Way {
    fn default() -> Self {
        Self { values: axes().map(|_| None).collect() }
    }
}

impl fmt::Display for Way {
    /// The way of assignment, and what else is not the thesis's own by name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut values = axes().zip(&self.values);
        f.write_str(match values.next().and_then(|(_, assign)| assign.as_deref()) {
            None => "brute force",
            Some("auto") => "the way chosen by counts",
            Some(other) => other,
        })?;
        let mut others = values.filter_map(|(axis, value)| Some((axis.name, value.as_ref()?)));
        others.try_for_each(|(name, value)| write!(f, ", {name} {value}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way(assign: &str, test: &str, method: &str) -> Way {
        Way::named(assign, test, method.parse().unwrap())
    }

    #[test]
    fn the_own_test_of_every_grid_is_one_way() {
        assert_eq!(way("brute", "hs", "indi-persp-64"), Way::default());
        assert_eq!(way("brute", "box", "indi-ortho-4"), Way::default());
        assert_eq!(way("brute", "auto", "indi-ortho-4"), Way::default());
        assert_eq!(way("brute", "auto", "all-lights"), Way::default());
        assert_ne!(way("brute", "hs", "indi-ortho-4"), Way::default());
        assert_eq!(Way::default().value("test", "indi-ortho-4".parse().unwrap()), "box");
    }

    #[test]
    fn an_axis_can_be_left_to_the_thesis() {
        let both = way("scatter", "exact", "indi-persp-64");
        assert_eq!(both.without("test"), way("scatter", "hs", "indi-persp-64"));
        assert_eq!(both.without("assign").without("test"), Way::default());
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
