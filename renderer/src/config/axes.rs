//! The axes of the product that runs are made of. Each is one entry of [`AXES`]: the product, the rules of `exclude`
//! with their schema, names of run directories, the closing table's columns and what reports tell runs apart by follow.

mod labels;
mod values;

pub use labels::{Labels, run_name};

use super::{Config, Own};
use crate::assign::{Bounds, Clusters};
use crate::geometry::{SliceLaw, VolumeTest};
use crate::methods::Method;
use std::fmt;
use values::{choices, each, lighting_name, name_and_stem, names, of_scene};

/// What an axis is to a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// What is looked at: of several, each has a directory for its runs.
    Scene,
    /// How lights are found: names every run.
    Method,
    /// What light falls: in every table, and in the names of runs where there are several.
    Lighting,
    /// How a method does its work: told where there are several.
    Way,
    /// What a scene is looked at by: where one has several, each has a directory for its runs.
    WithScene,
}

impl Role {
    /// Whether all runs of a directory share what is on the axis.
    fn is_of_scene(self) -> bool {
        matches!(self, Self::Scene | Self::WithScene)
    }
}

/// What tells the normal cones of a run from others, also beside numbers of other things.
fn cones_name(run: &Config) -> String {
    format!("cones-{}", names(&run.normal_cones))
}

/// What tells the meshes of a run from others, also beside numbers of other things.
fn detail_name(run: &Config) -> String {
    format!("mesh-{}", names(&run.mesh_detail))
}

/// What a resolution is called by.
pub fn resolution_name([width, height]: [u32; 2]) -> String {
    format!("{width}x{height}")
}

/// What a rule of `exclude` calls values by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Values {
    /// Texts, in which `*` stands for anything.
    Names,
    /// Numbers, compared as such.
    Counts,
}

/// An axis. A configuration may have several values on it; that of a run has one.
pub struct Axis {
    /// Name of the axis in rules that exclude.
    pub name: &'static str,
    /// What rules know of it, for the schema.
    pub description: &'static str,
    /// Column of the axis in CSV and JSON.
    pub column: &'static str,
    /// What part the axis plays in a run.
    pub role: Role,
    /// What rules call its values by.
    pub values: Values,
    /// Whether the runs of a method differ along the axis.
    pub applies: fn(&Method) -> bool,
    /// How many values a configuration gives.
    count: fn(&Config) -> usize,
    /// A configuration for each value. The method is one already, but for the axes before it.
    split: fn(&Config) -> Vec<Config>,
    /// What a rule may call the value of a run.
    called: fn(&Config) -> Vec<String>,
    /// What tells the value of a run from the others of the configuration.
    label: fn(&Config, &Config) -> String,
}

/// Every axis: of the product the first varies slowest.
pub static AXES: [Axis; 18] = [
    Axis {
        name: "scene",
        description: "The scene as the configuration has it, or its file's name without extension; `*` stands for any \
                      text.",
        column: "scene",
        role: Role::Scene,
        values: Values::Names,
        applies: |_| true,
        count: |config| config.scenes.len().max(1),
        split: |config| {
            let several = config.scenes.len() > 1;
            config.scene_entries().iter().map(|entry| of_scene(config, entry, several)).collect()
        },
        called: |run| name_and_stem(&run.scene),
        // Its directory tells it.
        label: |_, _| String::new(),
    },
    Axis {
        name: "recording",
        description: "The recording as the configuration has it, or its file's name without extension; `*` stands for any \
                      text.",
        column: "recording",
        role: Role::WithScene,
        values: Values::Names,
        applies: |_| true,
        count: |_| 1,
        split: |config| vec![config.clone()],
        called: |run| name_and_stem(&run.recording),
        label: |_, _| String::new(),
    },
    Axis {
        name: "resolution",
        description: "The resolution, such as 320x180; `*` stands for any text.",
        column: "resolution",
        role: Role::WithScene,
        values: Values::Names,
        applies: |_| true,
        count: |config| config.resolutions.len().max(1),
        split: |config| match config.resolutions.as_slice() {
            [] => vec![config.clone()],
            several => {
                each(several, |resolution| Config { resolution, resolutions: vec![], ..config.clone() })
            }
        },
        called: |run| vec![resolution_name(run.resolution)],
        // As of a scene.
        label: |_, _| String::new(),
    },
    Axis {
        name: "lights",
        description: "How many lights are made.",
        column: "lighting",
        role: Role::Lighting,
        values: Values::Counts,
        applies: |_| true,
        count: |config| config.lights_from().len(),
        split: |config| match config.lights.as_slice() {
            [] => vec![config.clone()],
            lights => each(lights, |lighting| Config { lights: vec![lighting], ..config.clone() }),
        },
        called: |run| run.lights.iter().map(|lighting| lighting.count.to_string()).collect(),
        label: |run, all| lighting_name(&run.lights_of_run(), &all.lights_from()),
    },
    Axis {
        name: "method",
        description: "The method's name; `*` stands for any text.",
        column: "method",
        role: Role::Method,
        values: Values::Names,
        applies: |_| true,
        count: |config| config.methods.len(),
        split: |config| each(&config.methods, |method| Config { methods: vec![method], ..config.clone() }),
        called: |run| vec![names(&run.methods)],
        label: |run, _| names(&run.methods),
    },
    Axis {
        name: "assign",
        description: "The way of assignment; `*` stands for any text.",
        column: "assign",
        role: Role::Way,
        values: Values::Names,
        applies: Method::takes_ways,
        count: |config| config.assign.len(),
        split: |config| each(&config.assign, |assign| Config { assign: vec![assign], ..config.clone() }),
        called: |run| vec![names(&run.assign)],
        label: |run, _| names(&run.assign),
    },
    Axis {
        name: "test",
        description: "The test of light against cluster, `auto` as what it is for the method; `*` stands for any text.",
        column: "test",
        role: Role::Way,
        values: Values::Names,
        applies: VolumeTest::applies,
        count: |config| config.test.len(),
        split: |config| {
            each(&choices(config, &config.test), |test| Config { test: vec![test], ..config.clone() })
        },
        called: |run| vec![names(&choices(run, &run.test))],
        label: |run, _| names(&choices(run, &run.test)),
    },
    Axis {
        name: "clusters",
        description: "Which clusters get lists, `auto` as what it is for the method; `*` stands for any text.",
        column: "clusters",
        role: Role::Way,
        values: Values::Names,
        applies: Clusters::applies,
        count: |config| config.clusters.len(),
        split: |config| {
            each(&choices(config, &config.clusters), |value| Config {
                clusters: vec![value],
                ..config.clone()
            })
        },
        called: |run| vec![names(&choices(run, &run.clusters))],
        label: |run, _| names(&choices(run, &run.clusters)),
    },
    Axis {
        name: "bounds",
        description: "What of a cluster is tested against lights, `auto` as what it is for the method; `*` stands for any text.",
        column: "bounds",
        role: Role::Way,
        values: Values::Names,
        applies: Bounds::applies,
        count: |config| config.bounds.len(),
        split: |config| {
            each(&choices(config, &config.bounds), |value| Config { bounds: vec![value], ..config.clone() })
        },
        called: |run| vec![names(&choices(run, &run.bounds))],
        label: |run, _| names(&choices(run, &run.bounds)),
    },
    Axis {
        name: "normal_cones",
        description: "Into how many squares, along a side, each face of the cube of normal cones is divided, 0 without cones; \
                      `*` stands for any text.",
        column: "normal_cones",
        role: Role::Way,
        values: Values::Names,
        applies: Bounds::applies,
        count: |config| config.normal_cones.len(),
        split: |config| {
            each(&config.normal_cones, |cones| Config { normal_cones: vec![cones], ..config.clone() })
        },
        called: |run| vec![names(&run.normal_cones), cones_name(run)],
        label: |run, _| cones_name(run),
    },
    Axis {
        name: "slices",
        description: "Where slices begin, `auto` as what it is for the method; `*` stands for any text.",
        column: "slices",
        role: Role::Way,
        values: Values::Names,
        applies: SliceLaw::applies,
        count: |config| config.slices.len(),
        split: |config| {
            each(&choices(config, &config.slices), |value| Config { slices: vec![value], ..config.clone() })
        },
        called: |run| vec![names(&choices(run, &run.slices))],
        label: |run, _| names(&choices(run, &run.slices)),
    },
    Axis {
        name: "shading",
        description: "How surfaces are shaded, after a prepass or with overdraw; `*` stands for any text.",
        column: "shading",
        role: Role::Way,
        values: Values::Names,
        applies: |_| true,
        count: |config| config.shading.len(),
        split: |config| each(&config.shading, |shading| Config { shading: vec![shading], ..config.clone() }),
        called: |run| vec![names(&run.shading)],
        label: |run, _| names(&run.shading),
    },
    Axis {
        name: "pipeline",
        description: "Who evaluates lights, forward or deferred; `*` stands for any text.",
        column: "pipeline",
        role: Role::Way,
        values: Values::Names,
        applies: |_| true,
        count: |config| config.pipeline.len(),
        split: |config| each(&config.pipeline, |way| Config { pipeline: vec![way], ..config.clone() }),
        called: |run| vec![names(&run.pipeline)],
        label: |run, _| names(&run.pipeline),
    },
    Axis {
        name: "lists",
        description: "How light lists lie in memory; `*` stands for any text.",
        column: "lists",
        role: Role::Way,
        values: Values::Names,
        applies: Method::assigns,
        count: |config| config.lists.len(),
        split: |config| each(&config.lists, |store| Config { lists: vec![store], ..config.clone() }),
        called: |run| vec![names(&run.lists)],
        label: |run, _| names(&run.lists),
    },
    Axis {
        name: "compaction",
        description: "How visible clusters get their places among the lists; `*` stands for any text.",
        column: "compaction",
        role: Role::Way,
        values: Values::Names,
        applies: Clusters::applies,
        count: |config| config.compaction.len(),
        split: |config| each(&config.compaction, |way| Config { compaction: vec![way], ..config.clone() }),
        called: |run| vec![names(&run.compaction)],
        label: |run, _| names(&run.compaction),
    },
    Axis {
        name: "conservative",
        description: "How meshes around lights are rasterised; `*` stands for any text.",
        column: "conservative",
        role: Role::Way,
        values: Values::Names,
        applies: Method::has_shells,
        count: |config| config.conservative.len(),
        split: |config| {
            each(&config.conservative, |way| Config { conservative: vec![way], ..config.clone() })
        },
        called: |run| vec![names(&run.conservative)],
        label: |run, _| names(&run.conservative),
    },
    Axis {
        name: "mesh_detail",
        description: "How fine the meshes around point lights are; `*` stands for any text.",
        column: "mesh_detail",
        role: Role::Way,
        values: Values::Names,
        applies: Method::has_meshes,
        count: |config| config.mesh_detail.len(),
        split: |config| {
            each(&config.mesh_detail, |detail| Config { mesh_detail: vec![detail], ..config.clone() })
        },
        called: |run| vec![names(&run.mesh_detail), detail_name(run)],
        label: |run, _| detail_name(run),
    },
    Axis {
        name: "octree",
        description: "How octrees are made; `*` stands for any text.",
        column: "octree",
        role: Role::Way,
        values: Values::Names,
        applies: Method::has_octree,
        count: |config| config.octree.len(),
        split: |config| each(&config.octree, |way| Config { octree: vec![way], ..config.clone() }),
        called: |run| vec![names(&run.octree)],
        label: |run, _| names(&run.octree),
    },
];

impl Axis {
    /// The axis of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        AXES.iter().find(|axis| axis.name == name)
    }

    /// The axes of a role.
    pub fn of_role(role: Role) -> impl Iterator<Item = &'static Self> {
        AXES.iter().filter(move |axis| axis.role == role)
    }

    /// Axes that tables have columns for, in the columns' order.
    pub fn told() -> impl Iterator<Item = &'static Self> {
        [Role::Scene, Role::Method, Role::Lighting, Role::Way].into_iter().flat_map(Self::of_role)
    }

    /// A configuration for each value, what comes out the same once; one where runs of the method do not differ.
    pub fn split(&self, config: &Config) -> Vec<Config> {
        let mut runs: Vec<Config> = vec![];
        for run in (self.split)(config) {
            if !runs.contains(&run) {
                runs.push(run);
            }
        }
        if config.methods.first().is_some_and(|method| !(self.applies)(method)) {
            runs.truncate(1);
        }
        runs
    }

    /// Whether a rule may call the value of a run so; a method that the axis does not apply to has none.
    pub fn is_called(&self, run: &Config, matches: impl Fn(&str) -> bool) -> bool {
        run.methods.first().is_none_or(self.applies) && (self.called)(run).iter().any(|name| matches(name))
    }

    /// What tells the value of `run` from the others of `all`.
    pub fn label(&self, run: &Config, all: &Config) -> String {
        (self.label)(run, all)
    }

    /// The value of a run, as a table has it; empty where the runs of its method do not differ along the axis.
    pub fn value(&self, run: &Config) -> String {
        if run.methods.first().is_some_and(|method| !(self.applies)(method)) {
            return String::new();
        }
        match self.label(run, run) {
            // What no name of a run tells is as the configuration has it.
            label if label.is_empty() => (self.called)(run).into_iter().next().unwrap_or_default(),
            label => label,
        }
    }

    /// Whether `run` must be told from others of `all` by its value.
    fn tells_apart(&self, run: &Config, all: &Config) -> bool {
        match self.role {
            Role::Method => true,
            Role::Lighting | Role::Way => {
                (self.count)(all) > 1 && run.methods.first().is_some_and(self.applies)
            }
            Role::Scene | Role::WithScene => false,
        }
    }
}

impl fmt::Debug for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for Axis {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Config {
    /// A configuration for each scene in each resolution.
    pub fn by_scene(&self) -> Vec<Self> {
        self.product(Role::is_of_scene)
    }

    /// The configuration of every run of one scene in one resolution.
    pub fn cases(&self) -> Vec<Self> {
        self.product(|role| !role.is_of_scene())
    }

    fn product(&self, of: impl Fn(Role) -> bool) -> Vec<Self> {
        let axes = AXES.iter().filter(|axis| of(axis.role));
        axes.fold(vec![self.clone()], |configs, axis| {
            configs.iter().flat_map(|config| axis.split(config)).collect()
        })
    }
}

#[cfg(test)]
mod tests;
