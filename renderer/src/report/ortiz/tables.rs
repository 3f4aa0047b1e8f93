//! Tables beside the post: how far clusters are from cubes, what slice laws come to in a replay, and its table of algorithms.

use super::aspects::{DEPTHS, FIELD, aspects};
use super::measures;
use crate::geometry::SliceLaw;
use crate::report::claim::mean;
use crate::report::results::{ResultSet, Run, metric};
use crate::report::tables::{Row, Table};
use crate::report::way::Way;
use glam::DVec3;

/// Tables that have rows.
pub fn all(set: &ResultSet) -> Vec<Table> {
    let mut tables = vec![of_aspects(set), of_laws(set), of_algorithms()];
    tables.retain(|table| !table.rows.is_empty());
    tables
}

/// Grids of the post's methods, each once.
pub fn grids(set: &ResultSet) -> Vec<[u32; 3]> {
    let mut grids: Vec<[u32; 3]> =
        set.runs.iter().filter(|run| measures(run.method)).filter_map(|run| run.grid).collect();
    grids.sort_unstable();
    grids.dedup();
    grids
}

/// What a grid is told by.
pub fn grid_name([columns, rows, slices]: [u32; 3]) -> String {
    let [near, far] = DEPTHS;
    format!(
        "{columns} x {rows} x {slices} clusters, square across, {FIELD} radians wide, from {near} to {far} m"
    )
}

fn of_aspects(set: &ResultSet) -> Table {
    let row = |grid: [u32; 3], law: SliceLaw| {
        let found = aspects(law, DVec3::from_array(grid.map(f64::from)), DEPTHS);
        Row {
            setting: grid_name(grid),
            labels: vec![law.to_string()],
            numbers: [found.slices, found.mean, found.least, found.largest].map(Some).to_vec(),
        }
    };
    let rows = grids(set).into_iter().flat_map(|grid| SliceLaw::EXAMPLES.map(|law| row(grid, law)));
    Table {
        id: "ortiz-aspects",
        title: "How far clusters are from cubes, by slice law",
        caption: "Computed, not measured. Of each cluster the longest over the shortest of width, height and depth, with width and height \
                  in the middle of its depth: 1 is a cube.",
        labels: &["slices"],
        groups: vec![("how many", &[""]), ("edge ratio", &["mean", "least", "largest"])],
        rows: rows.collect(),
    }
}

/// Runs whose clusters are visible, of settings and lightings with more than one law.
fn of_laws(set: &ResultSet) -> Table {
    let is_of =
        |run: &&Run| measures(run.method) && run.setting.way.value("clusters", run.method) == "visible";
    let mut runs: Vec<&Run> = set.runs.iter().filter(is_of).collect();
    let key = |run: &Run| (run.setting.by(&run.setting.way.without("slices")), run.lighting.clone());
    runs.sort_by_cached_key(|run| (key(run), run.method.to_string(), run.setting.way.clone()));
    let same = |a: &&Run, b: &&Run| key(a) == key(b) && a.method == b.method;
    let blocks = runs.chunk_by(same).filter(|block| block.len() > 1);
    Table {
        id: "ortiz-slices",
        title: "What slice laws come to in the replay",
        caption: "Visible clusters and their lists by slice law; times are of counting lights and writing lists, of shading, and of the \
                  frame. Means over frames.",
        labels: &["method", "lighting", "test", "slices"],
        groups: vec![
            ("visible clusters", &[""]),
            ("light indices", &["", "a cluster"]),
            ("lighting computations", &[""]),
            ("lists ms", &[""]),
            ("shading ms", &[""]),
            ("frame ms", &[""]),
        ],
        rows: blocks.flatten().map(|run| law_row(run)).collect(),
    }
}

fn law_row(run: &Run) -> Row {
    let of = |metric| mean(run, metric);
    let (clusters, indices) = (of(metric::VISIBLE), of(metric::INDICES));
    let each = clusters.zip(indices).map(|(clusters, indices)| indices / clusters);
    let way = |axis| run.setting.way.value(axis, run.method);
    Row {
        setting: run.setting.by(&Way::default()).to_string(),
        labels: vec![run.method.to_string(), run.lighting.label.clone(), way("test"), way("slices")],
        numbers: vec![
            clusters,
            indices,
            each,
            of(metric::COMPUTATIONS),
            list_time(run),
            of(metric::SHADE),
            of(metric::FRAME),
        ],
    }
}

/// Mean time to count lights and to write the lists, milliseconds.
pub fn list_time(run: &Run) -> Option<f64> {
    Some(mean(run, metric::COUNT)? + mean(run, metric::ASSIGN)?)
}

/// OF11. Manylight's own pipeline is the last.
fn of_algorithms() -> Table {
    let row = |algorithm: &str, words: [&str; 7]| Row {
        setting: "after Akenine-Möller et al., Real-Time Rendering, as Ortiz has it".into(),
        labels: [algorithm].into_iter().chain(words).map(str::to_owned).collect(),
        numbers: vec![],
    };
    Table {
        id: "ortiz-algorithms",
        title: "OF11: algorithms compared",
        caption: "As told in the post, nothing measured. Methods of manylight are of the last row: clustered forward, with transparent \
                  surfaces and several samples a pixel.",
        labels: &[
            "algorithm",
            "geometry passes",
            "light passes",
            "transparent",
            "MSAA",
            "bandwidth",
            "registers",
            "shading that varies",
        ],
        groups: vec![],
        rows: vec![
            row("simple forward", ["1", "0", "yes", "yes", "low", "high", "easy"]),
            row("simple deferred", ["1", "1 a light", "no", "no", "high", "low", "hard"]),
            row("tiled or clustered deferred", ["1", "1", "no", "no", "medium", "possibly low", "medium"]),
            row("tiled or clustered forward", ["1 to 2", "1", "yes", "yes", "low", "possibly high", "easy"]),
        ],
    }
}
