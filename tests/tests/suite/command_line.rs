//! A replay as its users meet it: files in, files out, exit codes, one clear line for what is wrong.

use manylight_tests::program::{read, refused, small, small_unlit, stderr, succeed};
use manylight_tests::{copy_shaders, manylight};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn a_replay_writes_every_file_and_the_table() {
    let out = tempfile::tempdir().unwrap();
    let printed = succeed(small(out.path()).args(["--exr", "300", "--validate"]));
    let table = String::from_utf8_lossy(&printed.stdout).into_owned();
    assert!(table.contains("indi-persp-64") && table.contains("encl-ortho-4"), "{table}");
    assert_eq!(read(out.path().join("summary.csv")).lines().count(), 3);
    for run in ["indi-persp-64", "encl-ortho-4"] {
        let directory = out.path().join(run);
        let rows = |name: &str| read(directory.join(name)).lines().count();
        assert_eq!(rows("frames.csv"), 3);
        assert!(rows("timings.csv") > 20);
        assert_eq!(rows("clusterings.csv"), if run.starts_with("indi") { 5 } else { 3 });
        assert!(rows("histograms.csv") > 10);
        for image in [".exr", ".png", "_lights.png", "_clusters.png", "_birdseye.png"] {
            assert!(directory.join(format!("frames/000300{image}")).is_file(), "{run}, {image}");
        }
        let manifest: serde_json::Value = serde_json::from_str(&read(directory.join("run.json"))).unwrap();
        assert_eq!(manifest["format"], "manylight.run/1");
        assert!(manifest["scene"]["sha256"].as_str().unwrap().len() == 64);
    }
}

/// A file of tables without the columns of times.
fn counters(path: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let timed: Vec<bool> = reader.headers().unwrap().iter().map(|name| name.contains("_ms")).collect();
    reader
        .records()
        .map(|row| {
            let row = row.unwrap();
            let cells = row.iter().zip(&timed).filter(|(_, timed)| !**timed);
            cells.map(|(cell, _)| cell.to_owned()).collect()
        })
        .collect()
}

#[test]
fn two_replays_give_equal_counters_and_equal_images() {
    let [a, b] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    for out in [&a, &b] {
        succeed(small(out.path()).args(["--exr", "all"]));
    }
    for run in ["indi-persp-64", "encl-ortho-4"] {
        let [a, b] = [a.path().join(run), b.path().join(run)];
        assert_eq!(counters(&a.join("frames.csv")), counters(&b.join("frames.csv")));
        for name in ["clusterings.csv", "histograms.csv", "frames/000300.exr", "frames/000380.exr"] {
            assert_eq!(fs::read(a.join(name)).unwrap(), fs::read(b.join(name)).unwrap(), "{run}/{name}");
        }
    }
}

#[test]
fn a_frame_is_the_same_alone_and_in_a_replay() {
    let [alone, within] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    succeed(small(alone.path()).args(["--frames", "380", "--runs", "0"]));
    succeed(small(within.path()).args(["--runs", "0"]));
    let last = |out: &Path| counters(&out.join("encl-ortho-4/frames.csv")).pop().unwrap();
    assert_eq!(last(alone.path()), last(within.path()));
}

#[test]
fn where_the_frame_alone_is_timed_no_stage_has_a_time() {
    let out = tempfile::tempdir().unwrap();
    succeed(small(out.path()).args(["--scopes", "frame", "--frames", "300"]));
    let table = |name: &str| {
        let mut reader = csv::Reader::from_path(out.path().join(name)).unwrap();
        reader.deserialize().map(Result::unwrap).collect::<Vec<BTreeMap<String, String>>>()
    };
    let timings = table("encl-ortho-4/timings.csv");
    assert_eq!(timings.len(), 1);
    assert_eq!(timings[0]["stage"], "frame");
    let frame = &table("encl-ortho-4/frames.csv")[0];
    assert!(frame["gpu_ms_frame"].parse::<f64>().unwrap() > 0.0);
    assert_eq!([&frame["gpu_ms_cluster"], &frame["gpu_ms_shade"]], ["", ""]);
    assert_eq!(table("summary.csv")[0]["shading_ms"], "");
}

#[test]
fn where_passes_are_timed_their_times_sum_up_to_their_stage() {
    let out = tempfile::tempdir().unwrap();
    succeed(
        small(out.path())
            .args(["--scopes", "passes", "--frames", "300", "--assign", "scatter", "--runs", "1"]),
    );
    let mut reader = csv::Reader::from_path(out.path().join("encl-ortho-4/timings.csv")).unwrap();
    let rows = reader.deserialize().map(Result::unwrap).collect::<Vec<BTreeMap<String, String>>>();
    let ms = |row: &BTreeMap<String, String>| row["gpu_ms"].parse::<f64>().unwrap();
    let stage = "frame/cluster[0]/count_lights";
    let whole = ms(rows.iter().find(|row| row["stage"] == stage).unwrap());
    let passes: Vec<_> = rows.iter().filter(|row| row["stage"].starts_with(&format!("{stage}/"))).collect();
    let names: Vec<_> = passes.iter().map(|row| &row["stage"][stage.len() + 1..]).collect();
    let expected = ["clear_lists[0]", "scatter_groups[0]", "single[0]", "scatter_groups[1]", "scatter[0]"];
    assert_eq!(names, expected);
    let sum: f64 = passes.iter().map(|row| ms(row)).sum();
    // The passes fill their stage; each time is written to a nanosecond.
    let rounding = 1e-6 * (passes.len() + 1) as f64;
    assert!(sum <= whole + rounding && passes.iter().all(|row| ms(row) > 0.0), "{sum} of {whole}");
}

#[test]
fn a_mirror_beside_eyes_is_replayed_and_no_frustum_encloses_both() {
    let directory = tempfile::tempdir().unwrap();
    let replay = |method| {
        let mut command = manylight();
        command.args([
            "replay",
            "--quiet",
            "--validate",
            "--resolution",
            "64x40",
            "--frames",
            "300",
            "--lights",
            "200",
        ]);
        command.args(["--recording", "bistro-mirror", "--runs", "1", "--method", method]);
        command.arg("--out").arg(directory.path());
        command
    };
    for method in ["encl-ortho-4", "indi-persp-64"] {
        succeed(&mut replay(method));
    }
    for method in ["encl-persp-64", "encl-displ-64-32"] {
        let message = refused(&mut replay(method));
        assert!(message.contains(method) && message.contains("encl-ortho-4"), "{message}");
    }
}

#[test]
fn a_display_of_many_eyes_is_replayed() {
    let directory = tempfile::tempdir().unwrap();
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../recordings/bistro-vive.json");
    let mut recording: serde_json::Value = serde_json::from_str(&read(bundled)).unwrap();
    let eyes = recording["hmd"]["eyes"].as_array_mut().unwrap();
    let right = eyes.remove(1);
    for number in 1..12 {
        let mut eye = right.clone();
        eye["name"] = format!("eye{number}").into();
        eyes.push(eye);
    }
    let path = directory.path().join("many-eyes.json");
    fs::write(&path, recording.to_string()).unwrap();
    let mut replay = small(&directory.path().join("out"));
    replay.args(["--resolution", "16x16", "--frames", "300", "--validate", "--recording"]).arg(path);
    succeed(&mut replay);
    let rows = counters(&directory.path().join("out/indi-persp-64/clusterings.csv"));
    assert_eq!(rows.len(), 12);
}

#[test]
fn small_buffers_grow_and_give_the_same_counters() {
    let [roomy, tight] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    succeed(&mut small(roomy.path()));
    succeed(small(tight.path()).args(["--visible-cluster-capacity", "1", "--light-index-capacity", "5"]));
    let rows = |out: &Path| counters(&out.join("indi-persp-64/clusterings.csv"));
    assert_eq!(rows(roomy.path()), rows(tight.path()));
    let manifest: serde_json::Value =
        serde_json::from_str(&read(tight.path().join("indi-persp-64/run.json"))).unwrap();
    let growth = manifest["growth"].as_array().unwrap();
    assert!(
        growth.iter().any(|event| event["buffer"] == "visible_clusters" && event["from"] == 1),
        "{growth:?}"
    );
    assert!(growth.iter().any(|event| event["buffer"] == "light_indices"), "{growth:?}");
}

#[test]
fn attenuations_change_the_image_and_not_the_lists() {
    let out = tempfile::tempdir().unwrap();
    let images: Vec<(Vec<u8>, Vec<Vec<String>>)> = ["phy_red_2", "lin", "stp"]
        .iter()
        .map(|name| {
            let out = out.path().join(name);
            succeed(small(&out).args(["--attenuation", name, "--exr", "300", "--runs", "0"]));
            let run = out.join("indi-persp-64");
            (fs::read(run.join("frames/000300.png")).unwrap(), counters(&run.join("frames.csv")))
        })
        .collect();
    assert!(images[0].0 != images[1].0 && images[1].0 != images[2].0);
    assert_eq!(images[0].1, images[1].1);
}

#[test]
fn what_cannot_be_rendered_is_refused_in_one_line() {
    let out = tempfile::tempdir().unwrap();
    let target = out.path().join("runs");
    let cases: [(&[&str], &str); 16] = [
        (&["--scene", "nowhere.gltf"], "nowhere.gltf"),
        (&["--recording", "nowhere.json"], "nowhere.json"),
        (&["--config", "nowhere.json"], "nowhere.json"),
        (&["--lights-file", "nowhere.csv"], "nowhere.csv"),
        (&["--shaders", "nowhere"], "nowhere"),
        (&["--method", "indi-persp-0"], "indi-persp-0"),
        (&["--method", "indi-displ-64-0"], "indi-displ-64-0"),
        (&["--method", "indi-perps-64"], "indi-persp-64"),
        (&["--resolution", "0x10"], "resolution"),
        (&["--resolution", "64xNaN"], "64xNaN"),
        (&["--frames", "600..700"], "670"),
        (&["--lights", "10,NaN"], "NaN"),
        (&["--msaa", "3"], "msaa"),
        (&["--device", "no such device"], "no such device"),
        (&["--attenuation", "phy_red2"], "phy_red_2"),
        (&["--scene-lights"], "light"),
    ];
    for (flags, named) in cases {
        let message = refused(small_unlit(&target).args(flags));
        assert!(message.contains(named), "{flags:?}: {message}");
        assert!(!target.join("indi-persp-64").exists(), "{flags:?} left output behind");
    }
}

#[test]
fn more_clusters_or_lights_than_the_device_holds_are_refused() {
    let out = tempfile::tempdir().unwrap();
    for flags in [["--method", "indi-ortho-0.05"], ["--lights", "4000000000"]] {
        let mut command = small_unlit(out.path());
        command.args(flags);
        refused(&mut command);
    }
}

#[test]
fn an_output_that_cannot_be_written_is_refused_at_once() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("file");
    fs::write(&file, "in the way").unwrap();
    let message = refused(&mut small(&file.join("runs")));
    assert!(message.contains("file"), "{message}");
    assert_eq!(read(&file), "in the way");
}

#[test]
fn broken_shaders_name_file_and_line() {
    let directory = tempfile::tempdir().unwrap();
    let shaders = directory.path().join("shaders-glsl");
    copy_shaders(&shaders);
    succeed(small(&directory.path().join("whole")).arg("--shaders").arg(&shaders).args(["--runs", "0"]));
    let broken = shaders.join("lib/brdf.glsl");
    fs::write(&broken, read(&broken).replace("const float PI", "const flaot PI")).unwrap();
    let message = refused(small(&directory.path().join("broken")).arg("--shaders").arg(&shaders));
    assert!(message.contains("lib/brdf.glsl:") && message.contains("shade/forward.frag"), "{message}");
}

#[test]
#[cfg(unix)]
fn an_interruption_keeps_complete_runs_and_says_so() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args(["replay", "--resolution", "64x40", "--frames", "0..80", "--runs", "1", "--lights", "200"]);
    command.args(["--method", "indi-ortho-8", "--method", "encl-ortho-8", "--out"]).arg(out.path());
    let mut child = command.stderr(std::process::Stdio::piped()).spawn().unwrap();
    let first = out.path().join("indi-ortho-8/run.json");
    while !first.exists() {
        assert!(child.try_wait().unwrap().is_none(), "the replay ended before it was interrupted");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(stderr(&output).contains("interrupted"), "{}", stderr(&output));
    let names: Vec<String> = fs::read_dir(out.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(!names.iter().any(|name| name.starts_with("encl")), "half a run was left: {names:?}");
    assert_eq!(read(out.path().join("summary.csv")).lines().count(), 2);
}

#[test]
fn a_trace_has_every_stage_of_the_chosen_frames_inside_its_parent() {
    let out = tempfile::tempdir().unwrap();
    succeed(small(out.path()).args(["--trace", "380", "--runs", "2"]));
    for run in ["indi-persp-64", "encl-ortho-4"] {
        let trace: serde_json::Value =
            serde_json::from_str(&read(out.path().join(run).join("trace.json"))).unwrap();
        let number = |value: &serde_json::Value| value.as_f64().expect("a number");
        let mut spans = BTreeMap::new();
        for event in trace["traceEvents"].as_array().unwrap() {
            if event["ph"] == "M" {
                continue;
            }
            assert_eq!((&event["ph"], &event["args"]["frame"]), (&"X".into(), &380.into()));
            let (start, length) = (number(&event["ts"]), number(&event["dur"]));
            assert!(start >= 0.0 && length >= 0.0, "{event}");
            let stage = event["args"]["stage"].as_str().unwrap().to_owned();
            let track = (event["pid"].as_u64().unwrap(), event["args"]["run"].as_u64().unwrap());
            if let Some((parent, _)) = stage.rsplit_once('/') {
                let &(from, to) = spans.get(&(track, parent.to_owned())).expect("parents come first");
                assert!(from <= start && start + length <= to + 1e-3, "{event} is not inside {parent}");
            }
            assert!(spans.insert((track, stage), (start, start + length)).is_none(), "{event} comes twice");
        }
        let stages = read(out.path().join(run).join("timings.csv")).lines().skip(1).count() / 2;
        // Two clocks, and of two frames in timings.csv only one was asked for.
        assert_eq!(spans.len(), 2 * stages, "{run}");
    }
    let message = refused(small(out.path()).args(["--trace", "381"]));
    assert!(message.contains("trace: frame 381"), "{message}");
    let message = refused(small(out.path()).args(["--trace", "--runs", "0"]));
    assert!(message.contains("trace") && message.contains("runs"), "{message}");
}
