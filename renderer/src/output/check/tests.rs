use super::super::RunWriter;
use super::super::saved::{saved_frames, saved_memory};
use super::super::testing::{counts, manifest, memory, times};
use super::*;
use std::fs;
use tempfile::TempDir;

/// A whole run of two frames, timed twice.
fn whole() -> TempDir {
    let out = tempfile::tempdir().unwrap();
    let timed = [times(0, 40, 8.0), times(0, 80, 9.0), times(1, 40, 8.0), times(1, 80, 7.0)];
    let manifest = Manifest { frame_count: Some(2), ..manifest() };
    let writer = RunWriter::create(out.path(), "run").unwrap();
    writer.write_counted(&[counts(40), counts(80)]).unwrap();
    writer.write_memory(&memory()).unwrap();
    writer.finish(&manifest, &[counts(40), counts(80)], &timed).unwrap();
    out
}

/// What is said of a run after `from` became `to`, where it first stands in `file`.
fn said(file: &str, from: &str, to: &str) -> String {
    let out = whole();
    let directory = out.path().join("run");
    let path = directory.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{file}: {from}");
    fs::write(&path, text.replacen(from, to, 1)).unwrap();
    let error = check_run(&directory).expect_err(&format!("{file}: {from} as {to}"));
    assert_eq!(error.exit_code(), 2);
    let message = error.to_string();
    assert_eq!(message.lines().count(), 1, "{message}");
    message.strip_prefix(&format!("{}: ", path.display())).expect("the file at fault").to_owned()
}

#[test]
fn what_was_written_is_whole() {
    let out = whole();
    check_run(&out.path().join("run")).unwrap();
}

#[test]
fn what_earlier_versions_wrote_is_whole_too() {
    let out = whole();
    let path = out.path().join("run/run.json");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("  \"frame_count\": 2,\n", "")).unwrap();
    check_run(&out.path().join("run")).unwrap();
}

#[test]
fn a_value_that_no_run_has_is_named_with_its_line() {
    let cases = [
        ("frames.csv", ",650,", ",NaN,", "line 2: lighting_computations `NaN` is no whole number"),
        ("frames.csv", ",650,", ",-1,", "line 2: lighting_computations `-1`"),
        ("frames.csv", ",650,", ",,", "line 2: lighting_computations ``"),
        ("frames.csv", ",650,", ",6.5,", "line 2: lighting_computations `6.5`"),
        ("frames.csv", ",650,", ",0x28a,", "line 2: lighting_computations `0x28a` is no whole number"),
        ("frames.csv", ",8.000000,", ",NaN,", "line 2: gpu_ms_frame `NaN` is no finite number from 0 on"),
        ("frames.csv", ",8.000000,", ",inf,", "line 2: gpu_ms_frame `inf`"),
        ("frames.csv", ",7.000000,", ",-7.0,", "line 3: gpu_ms_frame `-7.0`"),
        ("frames.csv", "\n80,", "\n40,", "line 3: frame 40 stands below frame 40"),
        ("frames.csv", "0.4444444444444444", "-inf", "line 2: time_s `-inf`"),
        ("timings.csv", ",8.000000,", ",inf,", "line 2: gpu_ms `inf`"),
        ("timings.csv", ",0.500000", ",NaN", "line 2: cpu_ms `NaN`"),
        ("timings.csv", "\n0,40", "\n2,40", "line 2: there is no run 2 of a frame 40"),
        ("timings.csv", "\n0,40", "\n0,41", "line 2: there is no run 0 of a frame 41"),
        ("clusterings.csv", "0000000000000abc", "abc", "line 2: lists_hash `abc`"),
        ("clusterings.csv", ",24,", ",-24,", "line 2: dz `-24`"),
        ("histograms.csv", "lights_per_cluster", "lights", "line 2: `lights` is no kind"),
        ("histograms.csv", ",200\n", ",1e9\n", "line 2: fragments `1e9`"),
        ("memory.csv", ",lists,", ",heads,", "line 2: `heads` is no purpose"),
        ("memory.csv", ",4096,", ",39,", "line 2: 36 bytes used, 40 at most, do not fit 39 allocated"),
        ("memory.csv", ",4096,", ",4095,", "allocated bytes add up to 4415, in run.json to 4416"),
        ("memory.csv", ",36,", ",41,", "line 2: 41 bytes used, 40 at most"),
        ("memory.csv", "\nlights,", "\nlight_indices,", "line 3: structure light_indices comes twice"),
    ];
    for (file, from, to, expected) in cases {
        let message = said(file, from, to);
        assert!(message.starts_with(expected), "{message}");
        assert!(message.ends_with("measure it again"), "{message}");
    }
}

#[test]
fn rows_and_cells_and_columns_that_miss_or_are_too_many_are_found() {
    let cases = [
        ("frames.csv", "gpu_ms_shade\n", "gpu_ms_shade,more\n", "line 1: a column `more` is not known"),
        ("frames.csv", "time_s,views", "time_s,time_s", "line 1: two columns are called `time_s`"),
        ("frames.csv", ",4.000000\n", ",4.000000,1\n", "line 2: 30 cells under a header of 29"),
        ("frames.csv", ",4.000000\n", "\n", "line 2: 28 cells under a header of 29"),
        ("clusterings.csv", "40,1,2,3,4,1,0,1000,ffffffffffffffff\n", "", "line 3: frame 80, clustering 0"),
        (
            "clusterings.csv",
            ",9,3000,",
            ",8,3000,",
            "light_indices of frame 40 add up to 8, in frames.csv to 9",
        ),
        (
            "histograms.csv",
            "40,0,lights_per_cluster,2,2,200\n",
            "",
            "lights_per_cluster of frame 40 add up to 2",
        ),
        (
            "histograms.csv",
            "40,1,lights_per_fragment,0,1,7\n",
            "",
            "lights_per_fragment of frame 40 add up to 250",
        ),
        (
            "histograms.csv",
            "lights_per_cluster,2,2,200",
            "lights_per_cluster,5,2,200",
            "line 3: the row is out of",
        ),
        ("timings.csv", "0,40,frame/shade[0],4.000000,0.500000\n", "", "the stages of run 0, frame 80"),
        ("timings.csv", "0,40,frame/cluster[0],", "0,40,frame,", "line 3: stage frame comes twice"),
    ];
    for (file, from, to, expected) in cases {
        let message = said(file, from, to);
        assert!(message.starts_with(expected), "{message}");
    }
    let missing = said("frames.csv", "frame,time_s,", "frame,");
    assert!(missing.starts_with("line 1: column `time_s` is missing"), "{missing}");
}

#[test]
fn tables_of_earlier_versions_lack_what_was_added_later() {
    let out = whole();
    let directory = out.path().join("run");
    let rows = saved_frames(&directory).unwrap();
    let path = directory.join("frames.csv");
    let text = fs::read_to_string(&path).unwrap();
    let columns: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let known = |place: usize| {
        !["fragments_hidden", "depth_discontinuity", "octree_bytes", "octree_bytes_uploaded"]
            .contains(&columns[place])
    };
    let without = |line: &str| {
        let cells = line.split(',').enumerate().filter(|(place, _)| known(*place));
        cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",") + "\n"
    };
    fs::write(&path, text.lines().map(without).collect::<String>()).unwrap();
    check_run(&directory).unwrap();
    assert_eq!(saved_frames(&directory).unwrap(), rows);

    assert_eq!(saved_memory(&directory).unwrap().len(), 2);
    fs::remove_file(directory.join("memory.csv")).unwrap();
    assert!(check_run(&directory).unwrap_err().to_string().contains("memory.csv: is missing"));
    let manifest = Manifest { memory_bytes: None, ..Manifest::read(&directory).unwrap() };
    fs::write(directory.join("run.json"), serde_json::to_string(&manifest).unwrap()).unwrap();
    check_run(&directory).unwrap();
    assert_eq!(saved_memory(&directory).unwrap(), []);
}

#[test]
fn a_stage_that_follows_changes_is_not_every_frames() {
    let out = whole();
    let path = out.path().join("run/timings.csv");
    let text = fs::read_to_string(&path).unwrap();
    let shaded = "0,40,frame/shade[0],4.000000,0.500000\n";
    let with = |stage: &str| text.replacen(shaded, &format!("{shaded}0,40,{stage},0.1,0.1\n"), 1);
    fs::write(&path, with("frame/cluster[0]/build_boxes")).unwrap();
    check_run(&out.path().join("run")).unwrap();
    fs::write(&path, with("frame/cluster[0]/count_lights")).unwrap();
    assert!(check_run(&out.path().join("run")).is_err());
}

#[test]
fn files_that_are_cut_off_anywhere_are_found() {
    let out = whole();
    let directory = out.path().join("run");
    for file in ["run.json", "frames.csv", "clusterings.csv", "histograms.csv", "memory.csv", "timings.csv"] {
        let path = directory.join(file);
        let bytes = fs::read(&path).unwrap();
        // The last line break of a manifest carries nothing.
        for end in 0..bytes.len() - 1 {
            fs::write(&path, &bytes[..end]).unwrap();
            let error = check_run(&directory).expect_err(&format!("{file} of {end} bytes")).to_string();
            assert!(error.starts_with(&path.display().to_string()), "{error}");
        }
        fs::write(&path, &bytes).unwrap();
    }
    check_run(&directory).unwrap();
}

#[test]
fn a_missing_frame_is_found_by_the_manifest() {
    let out = whole();
    let directory = out.path().join("run");
    // Every table loses the last frame alike.
    for file in ["frames.csv", "clusterings.csv", "histograms.csv", "timings.csv"] {
        let path = directory.join(file);
        let text = fs::read_to_string(&path).unwrap();
        let kept = text.lines().filter(|line| !line.starts_with("80,") && !line.contains(",80,frame"));
        fs::write(&path, kept.map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    }
    let error = check_run(&directory).unwrap_err().to_string();
    assert!(error.contains("frames.csv: holds 1 frames of 2"), "{error}");
}

#[test]
fn no_byte_makes_it_panic_or_say_more_than_a_line() {
    let out = whole();
    let directory = out.path().join("run");
    for file in ["run.json", "frames.csv", "clusterings.csv", "histograms.csv", "memory.csv", "timings.csv"] {
        let path = directory.join(file);
        let bytes = fs::read(&path).unwrap();
        for place in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[place] = b"\0-9,\n\"x\xff"[place % 8];
            fs::write(&path, &changed).unwrap();
            if let Err(error) = check_run(&directory) {
                let message = error.to_string();
                assert!(message.starts_with(&directory.display().to_string()), "{message}");
                assert_eq!(message.lines().count(), 1, "{message}");
            }
        }
        fs::write(&path, &bytes).unwrap();
    }
}
