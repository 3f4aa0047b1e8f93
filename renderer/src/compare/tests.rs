use super::*;
use std::fs;
use std::path::PathBuf;

/// A result directory under construction: counters of two frames, times of two runs.
struct Fixture {
    method: &'static str,
    test: &'static str,
    scene_sha: &'static str,
    out: &'static str,
    frames: Vec<(u32, u64)>,
    /// By run: milliseconds of every frame.
    runs: Vec<f64>,
    histogram: &'static str,
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
            histogram: "0,0,lights_per_cluster,3,1,1\n",
        }
    }
}

impl Fixture {
    fn write(&self, directory: PathBuf) {
        fs::create_dir_all(&directory).unwrap();
        let write = |name: &str, text: String| fs::write(directory.join(name), text).unwrap();
        let manifest = serde_json::json!({
            "format": "manylight.run/1", "version": "0.1.0", "git_revision": "abc", "method": self.method,
            "lighting": { "count": 1000, "intensity": 100.0, "cutoff": 0.5, "r0": 0.1 },
            "config": { "resolution": [64, 40], "msaa": 1, "marking": "depth", "attenuation": "phy", "out": self.out,
                "assign": "brute", "test": self.test },
            "scene": { "name": "street", "sha256": self.scene_sha },
            "recording": { "name": "bistro", "sha256": "bbbbbbbbbbbb" },
            "device": { "name": "llvmpipe", "driver": "Mesa" },
        });
        write("run.json", manifest.to_string());
        let mut frames = "frame,time_s,visible_clusters,gpu_ms_frame\n".to_owned();
        let mut clusterings = "frame,clustering,lists_hash\n".to_owned();
        let mut timings = "run,frame,stage,gpu_ms,cpu_ms\n".to_owned();
        for (frame, count) in &self.frames {
            frames += &format!("{frame},0.5,{count},1.0\n");
            clusterings += &format!("{frame},0,{count:016x}\n");
            for (run, ms) in self.runs.iter().enumerate() {
                timings += &format!("{run},{frame},frame,{ms},1\n");
                timings += &format!("{run},{frame},frame/shade[0],{},1\n", ms / 4.0);
                timings += &format!("{run},{frame},frame/shade[1],{},1\n", ms / 4.0);
            }
        }
        write("frames.csv", frames);
        write("clusterings.csv", clusterings);
        write("timings.csv", timings);
        write("histograms.csv", format!("frame,clustering,kind,bin,clusters,fragments\n{}", self.histogram));
    }
}

/// Compares two sets of one run each, which lie under different paths.
fn compare_runs(a: &Fixture, b: &Fixture) -> Comparison {
    let root = tempfile::tempdir().unwrap();
    a.write(root.path().join("a/run"));
    b.write(root.path().join("b/shards/0/other name"));
    compare(&root.path().join("a"), &root.path().join("b")).unwrap()
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
    let visible = &same.runs[0].counters[0];
    assert_eq!((visible.a, visible.b, visible.ratio), (Some(150), Some(150), Some(1.0)));
    let metrics: Vec<&str> = same.runs[0].counters.iter().map(|counter| counter.metric.as_str()).collect();
    assert_eq!(metrics, ["visible_clusters", "clusterings.csv", "histograms.csv"]);
    assert!(same.to_string().contains("counters: all 3 equal in 2 frames"), "{same}");
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
    assert!(comparison.runs[0].run.ends_with(", brute, exact"), "{}", comparison.runs[0].run);
    assert!(comparison.missing_in_a[0].ends_with("sat-n") && comparison.missing_in_b[0].ends_with("hs"));
}

#[test]
fn a_counter_that_differs_in_one_frame_is_found() {
    let b = Fixture { frames: vec![(0, 100), (40, 75)], ..Fixture::default() };
    let comparison = compare_runs(&Fixture::default(), &b);
    let visible = &comparison.runs[0].counters[0];
    assert_eq!((visible.frames_differing, visible.first_difference), (1, Some(40)));
    assert_eq!(visible.over_frames, Some(Spread { min: 1.0, median: 1.25, max: 1.5 }));
    assert_eq!(visible.ratio, Some(175.0 / 150.0));
    let lists = &comparison.runs[0].counters[1];
    assert_eq!((lists.frames_differing, lists.first_difference), (1, Some(40)));
    assert_eq!(
        comparison.difference().as_deref(),
        Some("the results differ: 1 run with counters that differ")
    );
    assert!(comparison.to_string().contains("differs in 1 of 2 frames, first 40"), "{comparison}");
}

#[test]
fn a_histogram_that_differs_is_found() {
    let b = Fixture { histogram: "0,0,lights_per_cluster,4,1,1\n", ..Fixture::default() };
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
fn times_are_ratios_of_minima_and_count_beyond_the_noise_of_the_runs() {
    let compare_times = |runs: &[f64]| {
        let b = Fixture { runs: runs.to_vec(), ..Fixture::default() };
        let comparison = compare_runs(&Fixture::default(), &b);
        assert_eq!(comparison.difference(), None, "times are no counters");
        comparison.runs.into_iter().next().unwrap().times
    };
    let slower = compare_times(&[10.0, 9.6]);
    let stages: Vec<&str> = slower.iter().map(|time| time.stage.as_str()).collect();
    assert_eq!(stages, ["frame", "frame/shade"], "views are summed");
    let shade = &slower[1];
    assert_eq!((shade.a_ms, shade.b_ms), (4.0, 4.8));
    assert!((shade.ratio - 1.2).abs() < 1e-12 && (shade.over_frames.max - 1.2).abs() < 1e-12);
    assert!((shade.spread_over_runs_a.unwrap() - 0.05).abs() < 1e-9);
    assert!((shade.noise.unwrap() - (1.05 * 10.0 / 9.6 - 1.0)).abs() < 1e-9);
    assert_eq!(shade.exceeds_noise, Some(true));
    assert_eq!(compare_times(&[8.2, 8.6])[0].exceeds_noise, Some(false));
    assert_eq!(compare_times(&[6.0, 6.1])[0].exceeds_noise, Some(true), "faster counts too");
    assert_eq!(compare_times(&[9.0])[0].exceeds_noise, None);
    assert!(compare_times(&[]).is_empty());
}

#[test]
fn what_cannot_be_compared_is_said_in_one_line() {
    let root = tempfile::tempdir().unwrap();
    let [good, empty, twice, broken] =
        ["good", "empty", "twice", "broken"].map(|name| root.path().join(name));
    Fixture::default().write(good.join("run"));
    fs::create_dir(&empty).unwrap();
    Fixture::default().write(twice.join("x"));
    Fixture::default().write(twice.join("y"));
    assert!(refused(&good, &root.path().join("nowhere")).contains("nowhere"));
    assert!(refused(&empty, &good).contains("holds no result"));
    assert!(refused(&good, &twice).contains("one configuration"));
    Fixture::default().write(broken.clone());
    for (file, text, expected) in [
        ("timings.csv", "run,frame,stage,gpu_ms,cpu_ms\n0,0,frame,fast,1\n", "line 2"),
        ("frames.csv", "frame,time_s,visible_clusters\n0,0,x\n", "line 2"),
        ("run.json", "{\"format\": \"manylight.run/9\"}", "manylight.run/1"),
        ("run.json", "{\"format\"", "no JSON"),
    ] {
        fs::write(broken.join(file), text).unwrap();
        let message = refused(&broken, &good);
        assert!(message.contains(file) && message.contains(expected), "{message}");
    }
    Fixture::default().write(broken.clone());
    for (text, expected) in [("", "no frames"), ("frame,time_s,visible_clusters\n0,0", "is damaged")] {
        fs::write(broken.join("frames.csv"), text).unwrap();
        assert!(refused(&broken, &good).contains(expected), "{text}");
    }
    assert!(refused(&good.join("run/run.json"), &good).contains("is no directory"));
    fs::remove_file(good.join("run/frames.csv")).unwrap();
    assert!(refused(&good, &twice.join("x")).contains("frames.csv"));
}
