//! What runs are called by what tells them apart.

use super::{Axis, Role};
use crate::config::Config;

/// What a run is called on each axis of [`Axis::told`]; empty where it need not be told.
#[derive(Debug, Clone, PartialEq)]
pub struct Labels(Vec<(&'static Axis, String)>);

impl Labels {
    /// Values on all axes of a run of the configuration `all`, which has one scene.
    pub fn new(run: &Config, all: &Config) -> Self {
        let label = |axis: &'static Axis| match axis.role == Role::Lighting || axis.tells_apart(run, all) {
            true => (axis, axis.label(run, all)),
            false => (axis, String::new()),
        };
        Self(Axis::told().map(label).collect())
    }

    /// These values, with the scene told.
    #[must_use]
    pub fn of_scene(mut self, scene: &str) -> Self {
        for (_, label) in self.0.iter_mut().filter(|(axis, _)| axis.role == Role::Scene) {
            scene.clone_into(label);
        }
        self
    }

    /// Every axis with the label on it.
    pub fn iter(&self) -> impl Iterator<Item = (&'static Axis, &str)> {
        self.0.iter().map(|(axis, label)| (*axis, label.as_str()))
    }

    /// The label on an axis.
    pub fn get(&self, axis: &Axis) -> &str {
        self.iter().find(|(other, _)| *other == axis).map_or("", |(_, label)| label)
    }

    /// The labels on the axes of some roles.
    pub fn of(&self, roles: &[Role]) -> Vec<&str> {
        self.iter().filter(|(axis, _)| roles.contains(&axis.role)).map(|(_, label)| label).collect()
    }
}

/// Name of a run's directory among the runs of the configuration `all`: the method, and behind it what tells it apart.
pub fn run_name(run: &Config, all: &Config) -> String {
    let told = Axis::told().filter(|axis| axis.tells_apart(run, all));
    told.map(|axis| axis.label(run, all)).collect::<Vec<_>>().join("_")
}
