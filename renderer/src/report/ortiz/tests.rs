//! Claims on data for which they hold, data for which they do not, and none; figures and tables of made-up runs.

use super::{claims, figures, judged, tables};
use crate::assign::Clusters;
use crate::config::{Config, Test};
use crate::geometry::{SliceLaw, SphereTest};
use crate::report::claim::{self, Claim, Verdict};
use crate::report::results::{Picture, Run, metric};
use crate::report::testing::{run, set, timed};
use crate::report::way::Way;
use std::path::PathBuf;

const NAME: &str = "ortiz-16-9-24";

fn claims_of(runs: Vec<Run>) -> Vec<Claim> {
    claim::check(&claims::CLAIMS, judged(&set(runs)))
}

fn claim_of(id: &str, runs: Vec<Run>) -> Claim {
    claims_of(runs).into_iter().find(|claim| claim.id == id).unwrap()
}

fn verdict(id: &str, runs: Vec<Run>) -> Verdict {
    claim_of(id, runs).verdict
}

/// What a run does that differs from its method's own.
fn by(mut run: Run, test: SphereTest, clusters: Clusters, law: SliceLaw) -> Run {
    let config = Config {
        test: vec![Test::from(test)],
        clusters: vec![clusters.into()],
        slices: vec![law.into()],
        ..Config::default()
    };
    run.setting.way = Way::new(&config, run.method);
    run.grid = Some([16, 9, 24]);
    run
}

fn exact(method: &str, clusters: f64) -> Run {
    let made =
        run(method, 1, 1000, move |name, _| Some(if name == metric::VISIBLE { clusters } else { 7.0 }));
    by(made, SphereTest::Exact, Clusters::Visible, SliceLaw::Geometric)
}

/// A run whose lists take twice so many milliseconds.
fn listed(clusters: Clusters, ms: f64) -> Run {
    let of_lists = [metric::COUNT, metric::ASSIGN];
    let made = run(NAME, 1, 1000, move |name, _| Some(if of_lists.contains(&name) { ms } else { 1.0 }));
    by(made, SphereTest::Box, clusters, SliceLaw::Geometric)
}

#[test]
fn without_data_nothing_is_said() {
    for claim in claims_of(vec![]) {
        assert_eq!(claim.verdict, Verdict::NotEnoughData, "{}", claim.id);
        assert!(claim.evidence.is_empty() && !claim.missing.is_empty(), "{}", claim.id);
    }
    assert!(
        claims_of(vec![run("sc-i-20-24", 1, 1000, |_, _| Some(1.0))])
            .iter()
            .all(|claim| claim.evidence.is_empty())
    );
}

#[test]
fn cubes_are_nearest_by_exponential_slices_unless_there_are_too_few() {
    let of_grid = |grid| {
        let mut made = exact(NAME, 9.0);
        made.grid = Some(grid);
        claim_of("O1", vec![made])
    };
    let post = of_grid([16, 9, 24]);
    assert_eq!((post.verdict, post.evidence.len()), (Verdict::Holds, 2));
    let largest: Vec<f64> = post.evidence[1].numbers.iter().map(|number| number.value).collect();
    assert!(largest[0] > 19.0 && (2.6..2.7).contains(&largest[2]), "{largest:?}");
    // A few slices are all far deeper than wide.
    assert_eq!(of_grid([64, 36, 3]).verdict, Verdict::DoesNotHold);
}

#[test]
fn a_sum_finds_slices_where_every_count_is_that_of_a_ratio() {
    let with = |clusters| vec![exact(NAME, 900.0), exact("sc-i-20-24", clusters)];
    assert_eq!(verdict("O2", with(900.0)), Verdict::Holds);
    assert_eq!(verdict("O2", with(901.0)), Verdict::DoesNotHold);
    let mut other_grid = with(900.0);
    other_grid[1].grid = Some([32, 18, 24]);
    assert_eq!(verdict("O2", other_grid), Verdict::NotEnoughData);
    let mut other_test = with(900.0);
    other_test[0].setting.way = Way::default();
    assert_eq!(verdict("O2", other_test), Verdict::NotEnoughData);
}

#[test]
fn lists_of_all_clusters_take_half_as_long_again() {
    let with = |ms| vec![listed(Clusters::Visible, 2.0), listed(Clusters::All, ms)];
    let claim = claim_of("O3", with(5.0));
    assert_eq!(claim.verdict, Verdict::Holds);
    let numbers: Vec<f64> = claim.evidence[0].numbers.iter().map(|number| number.value).collect();
    assert_eq!(numbers[..3], [4.0, 10.0, 2.5]);
    assert_eq!(verdict("O3", with(2.9)), Verdict::DoesNotHold);
    assert_eq!(verdict("O3", with(5.0)[..1].to_vec()), Verdict::NotEnoughData);
    let mut other_lights = with(5.0);
    other_lights[1].lighting.count = Some(9);
    assert_eq!(verdict("O3", other_lights), Verdict::NotEnoughData);
}

#[test]
fn lists_within_the_noise_of_the_bound_are_undecided() {
    let noisy = |run: Run, factors| timed(timed(run, metric::COUNT, factors), metric::ASSIGN, factors);
    let with = |ms, factors: [[f64; 3]; 2]| {
        vec![noisy(listed(Clusters::Visible, 2.0), factors[0]), noisy(listed(Clusters::All, ms), factors[1])]
    };
    let loose = [[1.0, 1.3, 1.1], [1.2, 1.0, 1.05]];
    let claim = claim_of("O3", with(3.05, loose));
    assert_eq!(claim.verdict, Verdict::Undecided);
    assert!(claim.evidence[0].interval.unwrap().straddles(0.0));
    // What both share in a run cancels.
    assert_eq!(verdict("O3", with(3.05, [loose[0]; 2])), Verdict::Holds);
}

#[test]
fn slices_are_drawn_a_row_a_law_and_told_in_tables() {
    let directory = tempfile::tempdir().unwrap();
    let path: PathBuf = directory.path().join("000300_slices.png");
    image::RgbImage::new(4, 2).save(&path).unwrap();
    let mut runs: Vec<Run> = [SliceLaw::Geometric, SliceLaw::UniformNdc]
        .map(|law| by(exact(NAME, 90.0), SphereTest::Box, Clusters::Visible, law))
        .to_vec();
    for run in &mut runs {
        let slices = Some(path.clone());
        let image = path.clone();
        run.pictures = vec![Picture { frame: 300, image, slices, ..Picture::default() }];
    }
    let set = set(runs);
    let figures = figures::all(&set).unwrap();
    let ids: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
    assert_eq!(ids, ["OF8", "OF9", "OF10"]);
    let seen = figures[2].chart.as_ref().unwrap();
    assert_eq!(
        (&seen.rows[..], seen.panels.len()),
        (&["geometric".to_owned(), "uniform-ndc".to_owned()][..], 2)
    );
    let tables = tables::all(&set);
    let rows: Vec<(&str, usize)> = tables.iter().map(|table| (table.id, table.rows.len())).collect();
    assert_eq!(rows, [("ortiz-aspects", 6), ("ortiz-slices", 2), ("ortiz-algorithms", 4)]);
    assert_eq!(tables[1].rows[0].numbers[2], Some(7.0 / 90.0));
    for table in tables {
        let mut csv = vec![];
        table.write_csv(&mut csv).unwrap();
        assert_eq!(String::from_utf8(csv).unwrap().lines().count(), 1 + table.rows.len());
    }
}

#[test]
fn the_plot_has_both_laws_up_to_the_far_plane() {
    use crate::report::chart::Plot;
    let figures = figures::all(&set(vec![])).unwrap();
    let Some(Plot::Lines(series)) = &figures[1].chart.as_ref().unwrap().panels[0] else { panic!("lines") };
    let ends: Vec<[f64; 2]> = series.iter().map(|series| *series.points.last().unwrap()).collect();
    assert!((ends[0][0] - 100.0).abs() < 1e-9 && ends[0][1] == 31.0);
    assert_eq!(ends[1], [100.0, 48.0]);
    assert_eq!(series[0].points[0], [0.3, 0.0]);
    // Both slices meet at the plane between them.
    assert_eq!(series[0].points[1][0], series[0].points[2][0]);
}
