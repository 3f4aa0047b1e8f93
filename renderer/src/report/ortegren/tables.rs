//! Tables: node layouts (4.1), times and nodes beside the paper's (C.1), and meshes against tests of lights.

use super::claims::tests_exactly;
use super::evaluation::{Case, Evaluation, PARTS};
use super::printed::{ASSIGNMENT, NODES, SHADING, printed};
use crate::assign::NodeLayout;
use crate::report::claim::mean;
use crate::report::results::{ResultSet, Run, metric};
use crate::report::tables::{Row, Table};
use crate::report::way::Way;

/// Tables that have rows.
pub fn all(set: &ResultSet) -> Vec<Table> {
    let evaluations = Evaluation::all(set);
    let mut tables = vec![of_layouts(), of_times(&evaluations), of_tests(set, &evaluations)];
    tables.retain(|table| !table.rows.is_empty());
    tables
}

fn of_layouts() -> Table {
    let row = |name: &str, layout: NodeLayout, bits: [&str; 3]| Row {
        setting: "nodes of linked lists".into(),
        labels: [name].into_iter().chain(bits).map(str::to_owned).collect(),
        numbers: vec![
            Some(f64::from(layout.most_lights())),
            Some(layout.most_nodes() as f64),
            Some(4.0 * layout.words() as f64),
        ],
    };
    Table {
        id: "ortegren-nodes",
        title: "What nodes of linked lists hold",
        caption: "The paper's table 4.1 has 2 bits for the kind and 10 for the light in 32; here the light tells its kind.",
        labels: &["lists", "kind", "light", "next node"],
        groups: vec![("most lights", &[""]), ("most nodes", &[""]), ("bytes", &[""])],
        rows: vec![
            row("linked-64", NodeLayout::Bits64, ["8 bits", "24 bits", "32 bits"]),
            row("linked-32", NodeLayout::Bits32, ["", "12 bits", "20 bits"]),
        ],
    }
}

/// A number over that of the first case under the same lights.
fn relative(value: Option<f64>, first: Option<f64>) -> Option<f64> {
    Some(value? / first.filter(|first| *first > 0.0)?)
}

fn of_times(evaluations: &[Evaluation]) -> Table {
    Table {
        id: "ortegren-times",
        title: "C.1: nodes and times by grid, beside the paper's",
        caption: "Milliseconds, means over frames of the least of all temporal runs; assignment is all from lights to lists. Relative numbers \
                  are those of the row over the first grid's under the same lights, here and in the paper (GeForce GTX 970), whose \
                  assignment is shells and fills. Memory is heads, nodes and shells.",
        labels: &["lights", "grid", "lists"],
        groups: vec![
            (
                "ms",
                &["point shell", "point fill", "spot shell", "spot fill", "assignment", "shading", "total"],
            ),
            ("nodes", &["", "a cluster"]),
            ("MiB", &[""]),
            ("relative nodes", &["here", "paper"]),
            ("relative assignment", &["here", "paper"]),
            ("relative shading", &["here", "paper"]),
        ],
        rows: evaluations.iter().flat_map(times_of).collect(),
    }
}

fn times_of(evaluation: &Evaluation) -> Vec<Row> {
    let row = |case: &Case| {
        let first = evaluation.of_lights(case.lights).next().unwrap_or(case);
        let pair = |[here, at_first]: [Option<f64>; 2], table| {
            let of = |case: &Case| printed(table, case.lights, case.grid, case.linear);
            [relative(here, at_first), relative(of(case), of(first))]
        };
        let mut numbers = PARTS.map(|(_, stage)| case.stage(stage)).to_vec();
        numbers.extend([case.assignment(), case.shading(), case.total(), case.nodes()]);
        numbers.push(case.nodes().map(|nodes| nodes / f64::from(case.clusters())));
        numbers.push(case.memory().map(|bytes| bytes / f64::from(1 << 20)));
        numbers.extend(pair([case.nodes(), first.nodes()], &NODES));
        numbers.extend(pair([case.assignment(), first.assignment()], &ASSIGNMENT));
        numbers.extend(pair([case.shading(), first.shading()], &SHADING));
        Row {
            setting: evaluation.setting.by(&Way::default()).to_string(),
            labels: vec![case.lights_name(), case.name(), case.lists()],
            numbers,
        }
    };
    evaluation.cases.iter().map(row).collect()
}

/// Each grid by its mesh and by tests of all of its clusters, under the same lights.
fn of_tests(set: &ResultSet, evaluations: &[Evaluation]) -> Table {
    let mut rows = vec![];
    for evaluation in evaluations {
        for case in &evaluation.cases {
            let alike = |run: &&Run| {
                run.lighting == case.run.lighting
                    && run.setting.by(&Way::default()) == case.run.setting.by(&Way::default())
                    && tests_exactly(run, case)
            };
            let tests: Vec<&Run> = set.runs.iter().filter(alike).collect();
            if tests.is_empty() {
                continue;
            }
            let setting = evaluation.setting.by(&Way::default()).to_string();
            let first = tests[0];
            rows.push(test_row(&setting, case, (case.run, case.lists()), first));
            for run in &tests {
                let way = run.setting.way.value("assign", run.method);
                rows.push(test_row(&setting, case, (run, way), first));
            }
        }
    }
    Table {
        id: "ortegren-tests",
        title: "Meshes against tests of lights",
        caption: "The same lights and grids, all clusters with lists: by meshes, and by exact tests of points and cones (exact+cone). In vain \
                  are light indices beyond the exact ones. Times are from lights to lists; memory is of all structures.",
        labels: &["lights", "grid", "lists or way"],
        groups: vec![
            ("nodes", &["", "in vain %"]),
            ("lighting computations", &[""]),
            ("lists ms", &[""]),
            ("shading ms", &[""]),
            ("MiB", &[""]),
        ],
        rows,
    }
}

fn test_row(setting: &str, case: &Case, (run, way): (&Run, String), exact: &Run) -> Row {
    let nodes = mean(run, metric::INDICES);
    let in_vain = relative(nodes, mean(exact, metric::INDICES)).map(|ratio| 100.0 * (ratio - 1.0));
    let bytes: u64 = run.memory.iter().map(|row| row.used).sum();
    let lists =
        [metric::COUNT, metric::ASSIGN].iter().filter_map(|metric| mean(run, metric)).reduce(|a, b| a + b);
    Row {
        setting: setting.to_owned(),
        labels: vec![case.lights_name(), case.name(), way],
        numbers: vec![
            nodes,
            in_vain,
            mean(run, metric::COMPUTATIONS),
            lists,
            mean(run, metric::SHADE),
            (bytes > 0).then(|| bytes as f64 / f64::from(1 << 20)),
        ],
    }
}
