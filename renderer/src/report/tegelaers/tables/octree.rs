//! What octrees take: the steps of building them, and the memory of their layers.

use crate::octree::BuildTimes;
use crate::report::results::{BuiltOctree, Run};
use crate::report::tables::{Row, Table};
use crate::report::tegelaers::evaluation::{Case, Evaluation, HASHED, Scene, lights, name};
use crate::report::tegelaers::octree::{TABLES, bytes, construction};

/// Bytes in a KiB.
const KIB: f64 = 1024.0;

/// A row a method, number of lights and scene.
pub fn building(evaluations: &[Evaluation<'_>]) -> Table {
    Table {
        id: "tegelaers-building",
        title: "Building octrees",
        caption: "What the host takes for each step, milliseconds, the least over all builds. Frames whose lights are those of the last build none. \
                  The thesis's octrees are built by one core of an Intel Core i7-6700HQ.",
        labels: &["scene", "method", "lights"],
        groups: vec![(
            "ms",
            &["empty octree", "octrees of lights", "adding them", "merging", "hashing layers", "all"],
        )],
        rows: evaluations.iter().flat_map(|evaluation| rows(evaluation, |_| true, steps)).collect(),
    }
}

/// A row a depth of each method's octree under the most lights.
pub fn layers(evaluations: &[Evaluation<'_>]) -> Table {
    let of_most = |case: &Case<'_>, scene: &Scene<'_>| {
        let of_method = scene.cases.iter().filter(|other| other.run.method == case.run.method);
        of_method.map(|other| other.lights).max() == Some(case.lights)
    };
    let of = |evaluation: &Evaluation<'_>| {
        let scenes = evaluation.scenes.iter();
        let of_scene = |scene| rows_of(evaluation, scene, &|case| of_most(case, scene), &by_depth);
        scenes.flat_map(of_scene).collect::<Vec<_>>()
    };
    Table {
        id: "tegelaers-layers",
        title: "Octrees by layer",
        caption: "Nodes of each depth that tables hold, slots m and offsets r along an axis, and KiB: branches (structure), filled leaves with their \
                  light indices (data). Under the most lights of each method.",
        labels: &["scene", "method", "lights", "depth"],
        groups: vec![("structure", &["nodes", "m", "r", "KiB"]), ("data", &["nodes", "m", "r", "KiB"])],
        rows: evaluations.iter().flat_map(of).collect(),
    }
}

/// Words and numbers of the rows of a run.
type Cells = Vec<(Vec<String>, Vec<Option<f64>>)>;

fn rows(
    evaluation: &Evaluation<'_>,
    is_shown: fn(&Case<'_>) -> bool,
    cells: fn(&Run, &BuiltOctree) -> Cells,
) -> Vec<Row> {
    evaluation.scenes.iter().flat_map(|scene| rows_of(evaluation, scene, &is_shown, &cells)).collect()
}

/// Of each hashed method and number of lights the run with the fewest pixels, for an octree does not depend on them.
fn rows_of(
    evaluation: &Evaluation<'_>,
    scene: &Scene<'_>,
    is_shown: &dyn Fn(&Case<'_>) -> bool,
    cells: &dyn Fn(&Run, &BuiltOctree) -> Cells,
) -> Vec<Row> {
    let mut rows = vec![];
    for method in evaluation.methods(HASHED) {
        let mut seen = vec![];
        for case in scene.cases.iter().filter(|case| case.run.method == method && is_shown(case)) {
            let Some(built) = case.run.octree.as_ref().filter(|_| !seen.contains(&case.lights)) else {
                continue;
            };
            seen.push(case.lights);
            rows.extend(cells(case.run, built).into_iter().map(|(words, numbers)| Row {
                setting: evaluation.setting.to_string(),
                labels: [vec![scene.name(), name(method), lights(case.lights)], words].concat(),
                numbers,
            }));
        }
    }
    rows
}

fn steps(run: &Run, built: &BuiltOctree) -> Cells {
    let ms = |step: &str| built.steps.iter().find(|(known, _)| known == step).map(|(_, ms)| *ms);
    construction(run)
        .map(|all| (vec![], BuildTimes::STEPS.map(ms).into_iter().chain([Some(all)]).collect()))
        .into_iter()
        .collect()
}

fn by_depth(_: &Run, built: &BuiltOctree) -> Cells {
    let row = |depth: u32| {
        let cells = |name: &str| {
            built.table(name, depth).map_or([None; 4], |table| {
                let sides = [table.slot_side, table.offset_side].map(f64::from);
                [table.keys as f64, sides[0], sides[1], bytes(table) / KIB].map(Some)
            })
        };
        (vec![depth.to_string()], TABLES.map(cells).concat())
    };
    built.depths().into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::tegelaers::testing::{costs, everything};
    use crate::report::testing::set;

    #[test]
    fn steps_and_layers_are_those_of_each_octree() {
        let set = set(everything(costs));
        let evaluations = Evaluation::all(&set);
        let building = building(&evaluations);
        assert_eq!(building.rows.len(), 7 * 3, "a row a method and set");
        let quarter =
            building.rows.iter().find(|row| row.labels[1..] == ["Hashed 0.25 3", "1200 lights"]).unwrap();
        let ms = 64.0 * 1200.0;
        assert_eq!(quarter.numbers, [None, Some(ms), None, None, Some(3.0 * ms), Some(4.0 * ms)]);
        let layers = layers(&evaluations);
        assert_eq!(layers.rows.len(), 7 * 3, "a row a method and depth");
        let deepest = layers.rows.iter().rfind(|row| row.labels[1] == "Hashed 1 3").unwrap();
        assert_eq!(deepest.labels[2..], ["1200 lights", "8"]);
        let kib = (1000.0 + 4.0 * 250.0) * 1200.0 / 1024.0;
        let numbers = [None, None, None, None, Some(1200.0), Some(100.0), Some(50.0), Some(kib)];
        assert_eq!(deepest.numbers, numbers);
    }
}
