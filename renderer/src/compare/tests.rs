use super::{
    Comparison, Comparisons, CounterComparison, Markdown, Options, Result, Spread, Verdict, write_page,
};
use std::fs;
use std::path::{Path, PathBuf};

/// The one comparison of two sets, by the usual threshold.
fn compare(a: &Path, b: &Path) -> Result<Comparison> {
    Ok(compare_all(a, &[b.to_owned()])?.first)
}

fn compare_all(base: &Path, others: &[PathBuf]) -> Result<Comparisons> {
    super::compare(base, others, &Options { threshold_percent: 1.0, pictures: None })
}

/// A result directory under construction: counters of two frames, times of two runs.
struct Fixture {
    method: &'static str,
    test: &'static str,
    scene_sha: &'static str,
    out: &'static str,
    frames: Vec<(u32, u64)>,
    /// By run: milliseconds of every frame.
    runs: Vec<f64>,
    /// Lights in every cluster.
    lights_per_cluster: u32,
    /// A file of static lights instead of the rain: its path and its SHA-256.
    lights_file: Option<[&'static str; 2]>,
    started: &'static str,
}

impl Default for Fixture {
    fn default() -> Self {
        Self {
            method: "indi-persp-64",
            test: "hs",
            scene_sha: "aaaaaaaaaaaa",
            out: "one",
            frames: vec![(0, 100), (40, 50)],
            runs: vec![8.0, 8.4],
            lights_per_cluster: 3,
            lights_file: None,
            started: "2026-01-01T00:00:00Z",
        }
    }
}

impl Fixture {
    fn write(&self, directory: PathBuf) {
        fs::create_dir_all(&directory).unwrap();
        let write = |name: &str, text: String| fs::write(directory.join(name), text).unwrap();
        let mut manifest = serde_json::json!({
            "format": "manylight.run/1", "version": "0.1.0", "git_revision": "abc", "method": self.method,
            "lighting": { "count": 1000, "intensity": 100.0, "cutoff": 0.5, "r0": 0.1 },
            "config": { "methods": [self.method], "resolution": [64, 40], "msaa": 1, "marking": "depth", "attenuation": "phy", "out": self.out,
                "assign": "brute", "test": self.test, "runs": self.runs.len() },
            "scene": { "name": "street", "sha256": self.scene_sha },
            "recording": { "name": "bistro", "sha256": "bbbbbbbbbbbb" },
            "device": { "name": "llvmpipe", "driver": "Mesa" },
            "started": self.started,
        });
        if let Some([path, sha256]) = self.lights_file {
            manifest["lighting"] = serde_json::Value::Null;
            manifest["config"]["lights_file"] = path.into();
            manifest["lights_file"] = serde_json::json!({ "name": "lights.csv", "sha256": sha256 });
        }
        write("run.json", manifest.to_string());
        let mut frames = "frame,time_s,views,clusterings,clusters,visible_clusters,light_indices,lighting_computations,\
            needed_computations,intersection_tests,fragments_shaded,fragments_without_cluster,light_indices_dropped,\
            visible_clusters_dropped,depth_discontinuity,gpu_ms_frame,gpu_ms_cluster,gpu_ms_visibility,gpu_ms_count_lights,\
            gpu_ms_assign_lights,gpu_ms_shade\n"
            .to_owned();
        let mut clusterings =
            "frame,clustering,dx,dy,dz,visible_clusters,light_indices,intersection_tests,lists_hash\n"
                .to_owned();
        let mut timings = "run,frame,stage,gpu_ms,cpu_ms\n".to_owned();
        let mut histograms = "frame,clustering,kind,bin,clusters,fragments\n".to_owned();
        let gpu_ms = if self.runs.is_empty() { "" } else { "1.0" };
        for (frame, count) in &self.frames {
            frames += &format!("{frame},0.5,1,1,999,{count},7,5,5,9,0,0,0,0,0,{gpu_ms},,,,,\n");
            clusterings += &format!("{frame},0,1,2,3,{count},7,9,{count:016x}\n");
            histograms += &format!("{frame},0,lights_per_cluster,{},{count},1\n", self.lights_per_cluster);
            histograms += &format!("{frame},0,fragments_per_cluster,1,{count},1\n");
            for (run, ms) in self.runs.iter().enumerate() {
                timings += &format!("{run},{frame},frame,{ms},1\n");
                timings += &format!("{run},{frame},frame/shade[0],{},1\n", ms / 4.0);
                timings += &format!("{run},{frame},frame/shade[1],{},1\n", ms / 4.0);
            }
        }
        write("frames.csv", frames);
        write("clusterings.csv", clusterings);
        write("timings.csv", timings);
        write("histograms.csv", histograms);
        write("memory.csv", "structure,purpose,allocated,used,most\n".to_owned());
    }
}

/// Compares two sets of one run each, which lie under different paths.
fn compare_runs(a: &Fixture, b: &Fixture) -> Comparison {
    let root = tempfile::tempdir().unwrap();
    a.write(root.path().join("a/run"));
    b.write(root.path().join("b/shards/0/other name"));
    compare(&root.path().join("a"), &root.path().join("b")).unwrap()
}

fn counter<'c>(comparison: &'c Comparison, metric: &str) -> &'c CounterComparison {
    comparison.runs[0].counters.iter().find(|counter| counter.metric == metric).unwrap()
}

fn refused(a: &Path, b: &Path) -> String {
    let message = compare(a, b).unwrap_err().to_string();
    assert_eq!(message.lines().count(), 1, "{message}");
    message
}

#[test]
fn equal_runs_are_joined_wherever_they_lie_and_whatever_their_output_was_called() {
    let same = compare_runs(&Fixture::default(), &Fixture { out: "two", ..Fixture::default() });
    assert_eq!(same.difference(), None);
    assert_eq!(same.runs.len(), 1);
    let visible = counter(&same, "visible_clusters");
    assert_eq!((visible.a, visible.b, visible.ratio), (Some(150), Some(150), Some(1.0)));
    let metrics: Vec<&str> = same.runs[0].counters.iter().map(|counter| counter.metric.as_str()).collect();
    assert_eq!(metrics[metrics.len() - 3..], ["octree_extra_indices", "clusterings.csv", "histograms.csv"]);
    assert!(same.to_string().contains("counters: all 23 equal in 2 frames"), "{same}");
}

#[test]
fn runs_are_joined_by_test_where_a_set_has_several_and_across_tests_where_not() {
    let with = |test| Fixture { test, ..Fixture::default() };
    assert_eq!(compare_runs(&with("hs"), &with("exact")).runs.len(), 1);

    let root = tempfile::tempdir().unwrap();
    let [a, b] = ["a", "b"].map(|name| root.path().join(name));
    for (set, tests) in [(&a, ["hs", "exact"]), (&b, ["exact", "sat-n"])] {
        tests.iter().for_each(|test| with(test).write(set.join(test)));
    }
    let comparison = compare(&a, &b).unwrap();
    assert_eq!(comparison.runs.len(), 1);
    assert!(
        comparison.runs[0].run.ends_with(
            ", brute, exact, visible, implicit, cones-0, geometric, prepass, forward, offsets, ranks"
        ),
        "{}",
        comparison.runs[0].run
    );
    assert!(comparison.missing_in_a[0].contains("sat-n") && comparison.missing_in_b[0].contains("brute, hs"));
}

#[test]
fn a_counter_that_differs_in_one_frame_is_found() {
    let b = Fixture { frames: vec![(0, 100), (40, 75)], ..Fixture::default() };
    let comparison = compare_runs(&Fixture::default(), &b);
    let visible = counter(&comparison, "visible_clusters");
    assert_eq!((visible.frames_differing, visible.first_difference), (1, Some(40)));
    assert_eq!(visible.over_frames, Some(Spread { min: 1.0, median: 1.25, max: 1.5 }));
    assert_eq!(visible.ratio, Some(175.0 / 150.0));
    let lists = counter(&comparison, "clusterings.csv");
    assert_eq!((lists.frames_differing, lists.first_difference), (1, Some(40)));
    assert_eq!(
        comparison.difference().as_deref(),
        Some("the results differ: 1 run with counters that differ")
    );
    assert!(comparison.to_string().contains("differs in 1 of 2 frames, first 40"), "{comparison}");
}

#[test]
fn a_histogram_that_differs_is_found() {
    let b = Fixture { lights_per_cluster: 4, ..Fixture::default() };
    assert!(compare_runs(&Fixture::default(), &b).difference().is_some());
}

#[test]
fn frames_and_runs_on_one_side_are_a_difference_and_are_named() {
    let fewer = Fixture { frames: vec![(0, 100)], ..Fixture::default() };
    let comparison = compare_runs(&Fixture::default(), &fewer);
    assert_eq!(comparison.runs[0].frames_missing_in_b, [40]);
    assert!(comparison.difference().unwrap().contains("1 run with frames that only one side has"));
    for other in [
        Fixture { method: "encl-ortho-4", ..Fixture::default() },
        Fixture { scene_sha: "cccccccccccc", ..Fixture::default() },
    ] {
        let comparison = compare_runs(&Fixture::default(), &other);
        assert_eq!((comparison.runs.len(), comparison.missing_in_a.len()), (0, 1));
        assert!(comparison.missing_in_b[0].starts_with("indi-persp-64, 1000 lights"), "{comparison}");
        assert!(comparison.difference().unwrap().ends_with("1 run missing in A, 1 run missing in B"));
    }
}

#[test]
fn ways_of_assignment_compare_with_each_other_unless_a_set_holds_several() {
    let root = tempfile::tempdir().unwrap();
    let by = |set: &str, ways: &[&str]| {
        for way in ways {
            let run = root.path().join(set).join(way);
            Fixture::default().write(run.clone());
            let text = fs::read_to_string(run.join("run.json")).unwrap();
            let mut manifest: serde_json::Value = serde_json::from_str(&text).unwrap();
            manifest["config"]["assign"] = (*way).into();
            fs::write(run.join("run.json"), manifest.to_string()).unwrap();
        }
        root.path().join(set)
    };
    let (brute, scatter) = (by("a", &["brute"]), by("b", &["scatter"]));
    assert_eq!(compare(&brute, &scatter).unwrap().runs.len(), 1);
    let both = by("c", &["brute", "scatter"]);
    assert_eq!(compare(&both, &both).unwrap().runs.len(), 2);
    let halves = compare(&both, &scatter).unwrap();
    assert_eq!((halves.runs.len(), halves.missing_in_b.len()), (1, 1));
    assert!(halves.missing_in_b[0].contains(", brute, "), "{halves}");
}

#[test]
fn times_are_ratios_of_minima_over_as_many_runs_as_both_have() {
    let compare_times = |a: &[f64], b: &[f64]| {
        let with = |runs: &[f64]| Fixture { runs: runs.to_vec(), ..Fixture::default() };
        let comparison = compare_runs(&with(a), &with(b));
        assert_eq!(comparison.difference(), None, "times are no counters");
        comparison.runs.into_iter().next().unwrap().times
    };
    let slower = compare_times(&[8.0, 8.4], &[10.0, 9.6]);
    let stages: Vec<&str> = slower.iter().map(|time| time.stage.as_str()).collect();
    assert_eq!(stages, ["frame", "frame/shade"], "views are summed");
    let shade = &slower[1];
    assert_eq!((shade.a_ms, shade.b_ms), (4.0, 4.8));
    assert!((shade.ratio - 1.2).abs() < 1e-12 && (shade.over_frames.max - 1.2).abs() < 1e-12);
    assert!((shade.spread_over_runs_a.unwrap() - 0.05).abs() < 1e-9);
    assert!(
        shade.verdict == Verdict::Undecided && shade.interval.unwrap().straddles(1.0),
        "two runs: {shade:?}"
    );
    let five = [8.0, 8.02, 8.01, 8.03, 8.02];
    let verdict = |factor: f64| compare_times(&five, &five.map(|ms| ms * factor))[0].verdict;
    let expected = [Verdict::Slower, Verdict::Faster, Verdict::Same, Verdict::Same];
    assert_eq!([1.2, 0.9, 1.0, 1.001].map(verdict), expected);
    let fewer = &compare_times(&five, &[9.0])[0];
    assert_eq!((fewer.runs, fewer.interval, fewer.verdict), (1, None, Verdict::Undecided));
    assert!(compare_times(&five, &[]).is_empty());
}

/// Five temporal runs of one frame's time, with noise of each run and of each frame, one-sided as another's load is.
fn noisy_runs(seed: u64, scale: f64) -> Vec<f64> {
    use rand_core::Rng;
    let mut random = rand_pcg::Pcg32::new(seed, 11);
    let mut uniform = || (f64::from(random.next_u32()) + 0.5) / 4_294_967_296.0;
    (0..5).map(|_| scale * 8.0 * (1.0 + 0.01 * uniform()) * (1.0 - 0.003 * uniform().ln())).collect()
}

/// A set of four methods, of which one is slower by a factor.
fn write_set(root: &Path, seed: u64, slow: f64) {
    for (place, method) in
        ["indi-persp-64", "encl-persp-64", "indi-ortho-4", "encl-ortho-4"].into_iter().enumerate()
    {
        let scale = if place == 2 { slow } else { 1.0 };
        let runs = noisy_runs(seed * 10 + place as u64, scale);
        let frames = (0..30).map(|frame| (frame, 100)).collect();
        Fixture { method, runs, frames, ..Fixture::default() }.write(root.join(method));
    }
}

#[test]
fn a_method_slowed_by_a_twentieth_is_called_slower_and_no_other() {
    let root = tempfile::tempdir().unwrap();
    let [a, b] = ["a", "b"].map(|name| root.path().join(name));
    write_set(&a, 1, 1.0);
    write_set(&b, 2, 1.05);
    let compared = compare_all(&a, std::slice::from_ref(&b)).unwrap();
    for (run, time) in compared.first.times() {
        let slowed = run.run.starts_with("indi-ortho-4");
        assert_eq!(time.verdict == Verdict::Slower, slowed, "{compared}");
    }
    let fault = compared.slower_than(2.0).unwrap();
    assert!(
        fault.starts_with("slower by more than 2 %: frame of indi-ortho-4, ")
            && fault.ends_with("(and 1 more)"),
        "{fault}"
    );
    assert_eq!(compared.slower_than(6.0), None);
    assert_eq!(compared.difference(), None);
    let text = Markdown(&compared).to_string();
    assert!(text.starts_with("### manylight compare: 2 slower, 0 faster, "), "{text}");
    assert_eq!(text.matches("| **slower** |").count(), 2, "{text}");
    let page = root.path().join("page.html");
    write_page(&page, &compared).unwrap();
    let page = fs::read_to_string(page).unwrap();
    assert_eq!(page.matches("class=\"verdict fails\">slower").count(), 2);
}

#[test]
fn times_of_one_distribution_are_never_called_slower() {
    let root = tempfile::tempdir().unwrap();
    for seed in 0..10 {
        let [a, b] = ["a", "b"].map(|name| root.path().join(format!("{name}{seed}")));
        write_set(&a, 100 + 2 * seed, 1.0);
        write_set(&b, 101 + 2 * seed, 1.0);
        let compared = compare_all(&a, &[b]).unwrap();
        assert_eq!((compared.verdicts.slower, compared.verdicts.faster), (0, 0), "seed {seed}: {compared}");
    }
}

#[test]
fn several_sets_are_each_compared_with_the_first() {
    let root = tempfile::tempdir().unwrap();
    let [a, b, c] = ["a", "b", "c"].map(|name| root.path().join(name));
    Fixture::default().write(a.join("run"));
    Fixture { runs: vec![9.0, 9.1], ..Fixture::default() }.write(b.join("run"));
    Fixture { frames: vec![(0, 100), (40, 75)], ..Fixture::default() }.write(c.join("run"));
    let compared: Comparisons = compare_all(&a, &[b, c.clone()]).unwrap();
    assert_eq!((compared.first.difference(), compared.further.len()), (None, 1));
    let difference = compared.difference().unwrap();
    assert!(difference.starts_with(&format!("{}: the results differ", c.display())), "{difference}");
    let json = serde_json::to_value(&compared).unwrap();
    assert_eq!(json["runs"][0]["times"][0]["verdict"], "undecided");
    assert_eq!(json["further"][0]["runs"][0]["frames"], 2);
    assert!(compare_all(&a, &[]).is_err());
}

#[test]
fn what_cannot_be_compared_is_said_in_one_line() {
    let root = tempfile::tempdir().unwrap();
    let [good, empty, broken] = ["good", "empty", "broken"].map(|name| root.path().join(name));
    Fixture::default().write(good.join("run"));
    fs::create_dir(&empty).unwrap();
    assert!(refused(&good, &root.path().join("nowhere")).contains("nowhere"));
    assert!(refused(&empty, &good).contains("holds no result"));
    Fixture::default().write(broken.clone());
    for (file, text, expected) in [
        ("timings.csv", "run,frame,stage,gpu_ms,cpu_ms\n0,0,frame,fast,1\n", "line 2"),
        ("run.json", "{\"format\": \"manylight.run/9\"}", "manylight.run/1"),
        ("run.json", "{\"format\"", "no JSON"),
    ] {
        fs::write(broken.join(file), text).unwrap();
        let message = refused(&broken, &good);
        assert!(message.contains(file) && message.contains(expected), "{message}");
    }
    Fixture::default().write(broken.clone());
    fs::write(broken.join("frames.csv"), "").unwrap();
    assert!(refused(&broken, &good).contains("frames.csv: is empty"));
    Fixture::default().write(broken.clone());
    assert!(refused(&good.join("run/run.json"), &good).contains("is no directory"));
    fs::remove_file(good.join("run/frames.csv")).unwrap();
    assert!(refused(&good, &broken).contains("frames.csv: is missing"));
}

#[test]
fn of_one_run_in_two_directories_the_newer_is_compared_and_the_other_named() {
    let root = tempfile::tempdir().unwrap();
    let [a, b] = ["a", "b"].map(|name| root.path().join(name));
    let newer = Fixture { started: "2026-02-01T00:00:00Z", frames: vec![(0, 100)], ..Fixture::default() };
    newer.write(a.join("indi-persp-64"));
    Fixture::default().write(a.join("indi-persp-64_brute"));
    newer.write(b.join("run"));
    let comparison = compare(&a, &b).unwrap();
    assert_eq!((comparison.runs.len(), comparison.difference()), (1, None));
    let older = &comparison.older[0];
    assert!(older.run.ends_with("indi-persp-64_brute") && older.newer.ends_with("indi-persp-64"), "{older}");
    assert!(comparison.to_string().contains("is the same run, made later"), "{comparison}");
}

#[test]
fn a_lights_file_is_known_by_what_it_holds() {
    let with = |path, sha256| Fixture { lights_file: Some([path, sha256]), ..Fixture::default() };
    let same = compare_runs(&with("lights.csv", "aaaaaaaaaaaa"), &with("./x/lights.csv", "aaaaaaaaaaaa"));
    assert_eq!((same.runs.len(), same.difference()), (1, None));
    let other = compare_runs(&with("lights.csv", "aaaaaaaaaaaa"), &with("lights.csv", "bbbbbbbbbbbb"));
    assert_eq!(other.runs.len(), 0);
    assert!(other.missing_in_b[0].contains("lights.csv (aaaaaaaa)"), "{other}");
    assert!(other.missing_in_a[0].contains("lights.csv (bbbbbbbb)"), "{other}");
}

#[test]
fn lights_files_of_earlier_versions_are_known_by_their_paths() {
    let root = tempfile::tempdir().unwrap();
    let [a, b] = ["a", "b"].map(|name| root.path().join(name));
    let with = Fixture { lights_file: Some(["lights.csv", "aaaaaaaaaaaa"]), ..Fixture::default() };
    with.write(a.join("run"));
    with.write(b.join("run"));
    let path = a.join("run/run.json");
    let mut manifest: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    manifest.as_object_mut().unwrap().remove("lights_file");
    fs::write(&path, manifest.to_string()).unwrap();
    assert_eq!(compare(&a, &b).unwrap().runs.len(), 1);
}
