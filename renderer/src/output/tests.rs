use super::testing::{counts, manifest, memory, times, view};
use super::*;
use crate::config::{Assign, Axis, Config, ExrLayout, Labels};
use crate::lights::Lighting;
use crate::measure::{FrameCounts, FrameTimes};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

fn csv_text(write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn frames(counts: &[FrameCounts], times: &[FrameTimes]) -> String {
    let minima = StageMinima::from_times(times);
    csv_text(|out| tables::write(out, tables::frames(counts, &minima)))
}

#[test]
fn frames_csv_has_the_documented_columns_and_the_minimum_over_runs() {
    let text = frames(&[counts(40)], &[times(0, 40, 9.0), times(1, 40, 8.0)]);
    let expected = "frame,time_s,views,clusterings,clusters,visible_clusters,light_indices,lighting_computations,\
        needed_computations,intersection_tests,fragments_shaded,fragments_hidden,fragments_without_cluster,light_indices_dropped,\
        visible_clusters_dropped,lights_dropped,lights_skipped,depth_discontinuity,octree_rebuilds,octree_bytes,octree_tables_hashed,octree_bytes_uploaded,octree_extra_indices,gpu_ms_frame,gpu_ms_cluster,gpu_ms_visibility,gpu_ms_count_lights,\
        gpu_ms_assign_lights,gpu_ms_shade\n\
        40,0.4444444444444444,2,2,2904,4,9,650,600,4000,257,0,0,0,0,0,0,0,0,0,0,0,0,8.000000,2.000000,1.000000,0.000000,0.000000,4.000000\n";
    assert_eq!(text, expected);
}

#[test]
fn frames_csv_leaves_times_empty_without_temporal_runs() {
    let text = frames(&[counts(0)], &[]);
    assert!(text.ends_with("\n0,0,2,2,2904,4,9,650,600,4000,257,0,0,0,0,0,0,0,0,0,0,0,0,,,,,,\n"), "{text}");
}

#[test]
fn timings_csv_has_every_stage_of_every_run() {
    let text = csv_text(|out| tables::write(out, tables::timings(&[times(1, 40, 8.0)])));
    let expected = "run,frame,stage,gpu_ms,cpu_ms\n\
        1,40,frame,8.000000,0.500000\n\
        1,40,frame/cluster[0],2.000000,0.500000\n\
        1,40,frame/cluster[0]/mark[0],1.000000,0.500000\n\
        1,40,frame/shade[0],4.000000,0.500000\n";
    assert_eq!(text, expected);
}

#[test]
fn clusterings_csv_has_grid_and_counters() {
    let text = csv_text(|out| tables::write(out, tables::clusterings(&[counts(40)])));
    let expected = "frame,clustering,dx,dy,dz,visible_clusters,light_indices,intersection_tests,lists_hash\n\
        40,0,10,12,24,3,9,3000,0000000000000abc\n\
        40,1,2,3,4,1,0,1000,ffffffffffffffff\n";
    assert_eq!(text, expected);
}

#[test]
fn histograms_csv_has_exact_ascending_bins() {
    let text = csv_text(|out| tables::write(out, tables::histograms(&[counts(40)])));
    let expected = "frame,clustering,kind,bin,clusters,fragments\n\
        40,0,lights_per_cluster,2,2,200\n\
        40,0,lights_per_cluster,5,1,50\n\
        40,0,fragments_per_cluster,50,1,50\n\
        40,0,fragments_per_cluster,100,2,200\n\
        40,0,lights_per_fragment,2,2,200\n\
        40,0,lights_per_fragment,5,1,50\n\
        40,1,lights_per_cluster,0,1,7\n\
        40,1,fragments_per_cluster,7,1,7\n\
        40,1,lights_per_fragment,0,1,7\n";
    assert_eq!(text, expected);
}

#[test]
fn memory_csv_has_what_structures_take() {
    let text = csv_text(|out| tables::write(out, memory().iter().map(MemoryRow::new)));
    let expected = "structure,purpose,allocated,used,most\n\
        light_indices,lists,4096,36,40\n\
        lights,lights,320,320,320\n";
    assert_eq!(text, expected);
}

#[test]
fn histograms_of_all_lights_are_per_view_and_know_no_clusters() {
    let frame =
        FrameCounts { frame: 3, lights_per_fragment: vec![vec![(1000, 12)]], ..FrameCounts::default() };
    let text = csv_text(|out| tables::write(out, tables::histograms(&[frame])));
    assert!(text.ends_with("fragments\n3,0,lights_per_fragment,1000,0,12\n"), "{text}");
}

fn run(method: &str, lighting: &str, counts: &[FrameCounts], times: &[FrameTimes]) -> RunMeans {
    let minima = StageMinima::from_times(times);
    let rows: Vec<FrameRow> = tables::frames(counts, &minima).collect();
    let config = Config {
        methods: vec![method.parse().unwrap()],
        lights: vec![lighting.parse().unwrap()],
        ..Config::default()
    };
    let labels = Labels::new(&config, &config);
    RunMeans {
        method: config.methods[0],
        labels,
        frames: rows.len(),
        means: Values::mean(&rows),
        times: measured(times),
    }
}

/// The times as they are read back from a run's table.
fn measured(times: &[FrameTimes]) -> MeasuredTimes {
    let directory = tempfile::tempdir().unwrap();
    let frames: Vec<u32> = times.iter().filter(|time| time.run == 0).map(|time| time.frame).collect();
    fs::write(
        directory.path().join("timings.csv"),
        csv_text(|out| tables::write(out, tables::timings(times))),
    )
    .unwrap();
    MeasuredTimes::new(&saved_times(directory.path(), &frames).unwrap())
}

/// Counts with twice the lighting computations.
fn doubled(frame: u32) -> FrameCounts {
    let mut counts = counts(frame);
    counts.counters.lighting_computations *= 2;
    counts
}

#[test]
fn summary_ratios_are_to_indi_persp_of_the_same_lighting() {
    let (few, many) = ([counts(0), counts(40)], [doubled(0), doubled(40)]);
    let (slow, fast) =
        ([times(0, 0, 8.0), times(0, 40, 16.0)], [times(0, 0, 4.0), times(1, 0, 5.0), times(0, 40, 2.0)]);
    let summary = Summary::from_means(&[
        run("encl-persp-64", "1000", &many, &fast),
        run("indi-persp-64", "1000", &few, &slow),
        run("encl-ortho-4", "100", &few, &slow),
        run("indi-ortho-4", "100", &many, &[]),
    ]);
    let [encl, indi, first, untimed] = summary.rows.as_slice() else { panic!("four rows") };
    assert_eq!((encl.reference.as_str(), encl.frames), ("indi-persp-64", 2));
    assert_eq!(encl.means.get("total_ms"), Some(3.0));
    assert_eq!(encl.means.get("clustering_ms"), Some(0.75));
    assert_eq!(encl.means.get("shading_ms"), Some(1.5));
    assert_eq!(
        (encl.ratios.get("total_ms"), encl.ratios.get("lighting_computations")),
        (Some(0.25), Some(2.0))
    );
    assert_eq!((encl.ratios.get("visible_clusters"), indi.ratios.get("total_ms")), (Some(1.0), Some(1.0)));
    assert_eq!((first.reference.as_str(), untimed.reference.as_str()), ("encl-ortho-4", "encl-ortho-4"));
    assert_eq!((untimed.means.get("total_ms"), untimed.ratios.get("total_ms")), (None, None));
    assert_eq!(untimed.ratios.get("lighting_computations"), Some(2.0));
}

#[test]
fn summary_has_no_ratio_to_nothing() {
    let none = [FrameCounts::default()];
    let summary = Summary::from_means(&[
        run("all-lights", "9", &none, &[]),
        run("encl-ortho-4", "9", &[counts(0)], &[]),
    ]);
    assert_eq!(summary.rows[1].ratios.get("visible_clusters"), None);
    assert!(Summary::from_means(&[]).to_string().contains("method"));
}

#[test]
fn summary_csv_has_means_and_ratios() {
    let (few, fast) = ([counts(0)], [times(0, 0, 4.0)]);
    let summary = Summary::from_means(&[run("indi-persp-64", "1000", &few, &fast)]);
    let expected = "method,lighting,frames,visible_clusters,light_indices,lighting_computations,clustering_ms,shading_ms,\
        total_ms,reference,visible_clusters_ratio,light_indices_ratio,lighting_computations_ratio,clustering_ms_ratio,\
        shading_ms_ratio,total_ms_ratio,runs,clustering_ms_low,clustering_ms_high,shading_ms_low,shading_ms_high,\
        total_ms_low,total_ms_high,clustering_ms_ratio_low,clustering_ms_ratio_high,shading_ms_ratio_low,\
        shading_ms_ratio_high,total_ms_ratio_low,total_ms_ratio_high\n\
        indi-persp-64,1000,1,4.000,9.000,650.000,1.000000,2.000000,4.000000,indi-persp-64,\
        1.000000,1.000000,1.000000,1.000000,1.000000,1.000000,1,,,,,,,,,,,,\n";
    assert_eq!(csv_text(|out| summary.write_csv(out)), expected);
}

#[test]
fn summary_tells_how_far_times_and_their_ratios_can_be_trusted() {
    // Three runs of two frames; all of the second method took half as long.
    let runs = |scale: f64| -> Vec<FrameTimes> {
        let run = |(run, ms): (u32, f64)| [times(run, 0, ms * scale), times(run, 40, 2.0 * ms * scale)];
        (0..).zip([8.0, 8.5, 8.2]).flat_map(run).collect()
    };
    let both = [counts(0), counts(40)];
    let summary = Summary::from_means(&[
        run("indi-persp-64", "1000", &both, &runs(1.0)),
        run("encl-persp-64", "1000", &both, &runs(0.5)),
        run("encl-ortho-4", "1000", &both, &runs(0.5)[..4]),
    ]);
    let [first, half, fewer] = summary.rows.as_slice() else { panic!("three rows") };
    let total = first.intervals.get("total_ms").unwrap();
    assert!(total.straddles(first.means.get("total_ms").unwrap()) && total.half() > 0.5, "{total:?}");
    let ratio = half.ratio_intervals.get("total_ms").unwrap();
    assert!((ratio.low - 0.5).abs() < 1e-9 && ratio.half() < 1e-9, "they are paired: {ratio:?}");
    assert_eq!(fewer.ratio_intervals.get("total_ms"), None, "minima over different numbers do not compare");
    assert_eq!((half.runs, fewer.runs, half.intervals.get("light_indices")), (3, 2, None));
    let table = summary.to_string();
    assert!(table.contains("12.0 ±1.7 (1.00)"), "{table}");
    assert!(table.ends_with("± is half the 95 % interval by 2 or 3 temporal runs."), "{table}");
    let text = csv_text(|out| summary.write_csv(out));
    let cells: Vec<&str> = text.lines().nth(2).unwrap().split(',').collect();
    assert_eq!(cells[cells.len() - 2..], ["0.500000", "0.500000"], "{text}");
}

#[test]
fn summary_names_ways_and_tests_where_runs_differ_in_them() {
    let means = |test: &str, light_indices| {
        let row = FrameRow { light_indices, ..FrameRow::default() };
        let all = Config { test: vec!["hs".parse().unwrap(), "exact".parse().unwrap()], ..Config::default() };
        let one = Config { test: vec![test.parse().unwrap()], ..all.clone() };
        RunMeans {
            labels: Labels::new(&Config { methods: vec![one.methods[0]], ..one }, &all),
            means: Values::mean(&[row]),
            ..run("indi-persp-64", "1000", &[], &[])
        }
    };
    let summary = Summary::from_means(&[means("hs", 8), means("exact", 2)]);
    let text = csv_text(|out| summary.write_csv(out));
    assert!(text.starts_with("method,lighting,test,frames,visible_clusters,"), "{text}");
    assert!(text.contains("\nindi-persp-64,1000,exact,0,0.000,2.000,"), "{text}");
    assert_eq!(summary.rows[1].ratios.get("light_indices"), Some(0.25));
    assert!(
        summary.to_string().ends_with("the ratio to indi-persp-64, by its first way and test."),
        "{summary}"
    );
}

#[test]
fn summary_table_is_narrow_and_says_what_ratios_are_to() {
    let mut frame = counts(0);
    frame.counters.lighting_computations = 9_876_543_210;
    let (counts, times) = ([frame], [times(0, 0, 12_345.678)]);
    let names = ["indi-persp-64", "encl-displ-64-32"];
    let bright = Lighting::with_count(100_000);
    let lights = vec![bright, Lighting { intensity: 20.0, ..bright }];
    let all = Config { lights, ..Config::default() };
    let long = |name: &&str| {
        let config =
            Config { methods: vec![name.parse().unwrap()], lights: vec![bright], ..Config::default() };
        RunMeans { labels: Labels::new(&config, &all), ..run(name, "100000", &counts, &times) }
    };
    let runs: Vec<_> = names.iter().map(long).collect();
    let table = Summary::from_means(&runs).to_string();
    assert!(table.lines().all(|line| line.chars().count() < 140), "{table}");
    assert!(table.contains("100000-100-0.5-0.1"), "{table}");
    assert!(
        table.contains("9 876 543 210 (1.00)") && table.ends_with("the ratio to indi-persp-64."),
        "{table}"
    );
}

#[test]
fn runs_are_named_by_method_and_by_lighting_where_needed() {
    let names = |lights: Vec<Lighting>| {
        let config = Config { lights, methods: vec!["encl-ortho-0.5".parse().unwrap()], ..Config::default() };
        planned_runs(&config).into_iter().map(|run| run.name).collect::<Vec<_>>()
    };
    let thousand = Lighting::with_count(1000);
    assert_eq!(names(vec![thousand]), ["encl-ortho-0.5"]);
    let dim = Lighting { intensity: 20.0, ..thousand };
    assert_eq!(
        names(vec![thousand, Lighting::with_count(7), dim]),
        ["encl-ortho-0.5_1000-100-0.5-0.1", "encl-ortho-0.5_7", "encl-ortho-0.5_1000-20-0.5-0.1"]
    );
    let config = Config { lights: vec![thousand, Lighting::with_count(7)], ..Config::default() };
    let planned = planned_runs(&config);
    assert_eq!((planned.len(), planned[1].name.as_str()), (12, "encl-persp-64_1000"));
    let lighting = |run: &PlannedRun| run.labels.get(Axis::named("lights").unwrap()).to_owned();
    assert_eq!(lighting(&planned[6]), "7");
    let several = Config {
        methods: vec!["indi-persp-64".parse().unwrap(), "all-lights".parse().unwrap()],
        assign: vec![Assign::Hierarchy, Assign::Brute],
        test: ["auto", "hs+sat-n"].map(|test| test.parse().unwrap()).to_vec(),
        ..config
    };
    let planned: Vec<String> = planned_runs(&several).into_iter().map(|run| run.name).collect();
    assert_eq!(planned.len(), 10);
    assert_eq!(planned[0], "indi-persp-64_1000_hierarchy_hs");
    assert_eq!(planned[3], "indi-persp-64_1000_brute_hs+sat-n");
    assert_eq!(planned[4], "all-lights_1000");
    let config = Config { lights: vec![thousand], test: several.test, ..Config::default() };
    assert_eq!(planned_runs(&config)[1].name, "indi-persp-64_hs+sat-n");
    let config = Config { lights: Vec::new(), scene_lights: true, ..Config::default() };
    assert_eq!(lighting(&planned_runs(&config)[0]), "scene");
}

/// All files under a directory with their bytes.
fn contents(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()) {
        let name = entry.file_name().unwrap().to_str().unwrap().to_owned();
        if entry.is_dir() {
            files.extend(
                contents(&entry).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)),
            );
        } else {
            files.insert(name, fs::read(&entry).unwrap());
        }
    }
    files
}

fn write_run(out: &Path) {
    let writer = RunWriter::create(out, "encl-ortho-4").unwrap();
    writer.write_images(40, &[view("left", 4, 3), view("right", 4, 3)], ExrLayout::Multipart).unwrap();
    writer.write_counted(&[counts(40)]).unwrap();
    writer.write_memory(&memory()).unwrap();
    writer.finish(&manifest(), &[counts(40)], &[times(0, 40, 8.0)]).unwrap();
}

#[test]
fn a_run_directory_is_whole_and_repeats_byte_for_byte() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("deep/out");
    prepare_output(&out).unwrap();
    write_run(&out);
    let first = contents(&out);
    let names: Vec<&str> = first.keys().map(String::as_str).collect();
    let files = [
        "clusterings.csv",
        "frames.csv",
        "frames/000040.exr",
        "frames/000040.png",
        "frames/000040_clusters.png",
        "frames/000040_heat.png",
        "frames/000040_lights.png",
        "frames/000040_share.png",
        "histograms.csv",
        "memory.csv",
        "run.json",
        "timings.csv",
    ];
    assert_eq!(names, files.map(|file| format!("encl-ortho-4/{file}")));
    write_run(&out);
    assert_eq!(contents(&out), first);
}

#[test]
fn the_manifest_tells_how_the_run_came_to_be() {
    let json = serde_json::to_value(manifest()).unwrap();
    assert_eq!(json["format"], "manylight.run/1");
    assert_eq!(json["config"]["methods"][1], "encl-persp-64");
    assert_eq!(json["growth"][0]["buffer"], "light_indices");
    assert_eq!(json["recording"]["sha256"], "11");
}

#[test]
fn an_unfinished_run_leaves_the_earlier_one() {
    let dir = tempfile::tempdir().unwrap();
    write_run(dir.path());
    let before = contents(dir.path());
    let writer = RunWriter::create(dir.path(), "encl-ortho-4").unwrap();
    writer.write_images(0, &[view("mono", 2, 2)], ExrLayout::Multipart).unwrap();
    drop(writer);
    assert_eq!(contents(dir.path()), before);
}

#[test]
fn a_file_that_cannot_be_written_is_named_by_where_it_was_to_be() {
    let dir = tempfile::tempdir().unwrap();
    let writer = RunWriter::create(dir.path(), "run").unwrap();
    let pixels = [view("mono", 2, 2)];
    writer.write_images(0, &pixels, ExrLayout::Multipart).unwrap();
    let staged = fs::read_dir(dir.path()).unwrap().next().unwrap().unwrap().path();
    fs::remove_dir_all(staged.join("frames")).unwrap();
    fs::write(staged.join("frames"), "in the way").unwrap();
    let error = writer.write_images(0, &pixels, ExrLayout::Multipart).unwrap_err().to_string();
    assert!(error.starts_with(&format!("{}: ", dir.path().join("run/frames").display())), "{error}");
}

#[test]
fn an_output_directory_that_cannot_be_is_named_with_the_cause() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    fs::write(&file, "").unwrap();
    for error in [
        prepare_output(&file.join("out")).unwrap_err(),
        RunWriter::create(&file.join("out"), "x").unwrap_err(),
    ] {
        assert_eq!(
            error.to_string(),
            format!("{}: the directory cannot be made: Not a directory", file.join("out").display())
        );
        assert_eq!(error.exit_code(), 2);
    }
}
