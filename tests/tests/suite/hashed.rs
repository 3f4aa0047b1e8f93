//! Octrees over the lights: built where these have changed and nowhere else, what is told of them, and what is refused.

use manylight::assign::Marking;
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::lights::{GeneratorKind, LightMotion, Lighting};
use manylight::measure::{FrameCounts, FrameTimes};
use manylight::octree::BuildTimes;
use manylight_tests::{Run, assert_equal_the_truth, manylight, methods, run, three_frames};
use std::collections::BTreeMap;
use std::path::Path;

/// Static lights in the hall, which reach two metres.
fn hall(names: &[&str]) -> Config {
    Config {
        scene: "hall".into(),
        light_source: GeneratorKind::Volume,
        lights: vec![Lighting { intensity: 2.0, ..Lighting::with_count(1500) }],
        ..three_frames("hall", 1, Marking::Depth, names)
    }
}

fn rebuilds(run: &Run) -> Vec<u64> {
    run.counts.iter().map(|counts| counts.octree_rebuilds()).collect()
}

/// CPU milliseconds of the steps of building, and GPU milliseconds of the upload, of a frame.
fn building(frame: &FrameTimes) -> [f64; 2] {
    let stage = |name: &str| {
        let path = format!("frame/octree/{name}");
        let found = frame.stages.iter().find(|stage| stage.stage == path);
        found.unwrap_or_else(|| panic!("{path} is no stage of {:?}", frame.stages))
    };
    [BuildTimes::STEPS.iter().map(|step| stage(step).cpu_ms).sum(), stage("upload").gpu_ms]
}

#[test]
fn lights_that_stay_cost_a_frame_nothing() {
    let runs = run(Config { runs: 1.into(), ..hall(&["all-lights", "hashed-0.5-3", "hashed-0.5-0"]) });
    assert_equal_the_truth(&runs, Marking::Depth);
    for run in &runs[1..] {
        assert_eq!(rebuilds(run), [1, 0, 0]);
        // The frame that warms up has built it.
        assert!(run.times.iter().all(|frame| building(frame) == [0.0, 0.0]), "{:?}", run.times);
    }
    let [shallow, deep] = [&runs[2], &runs[1]]
        .map(|run| run.counts.iter().map(|counts| counts.counters.lighting_computations).collect::<Vec<_>>());
    assert_eq!(shallow, deep, "where lookups begin changes no list");
}

#[test]
fn lights_that_move_have_an_octree_of_their_own_in_each_frame() {
    let names = ["all-lights", "hashed-1-3", "hashed-4m-2"];
    let frames = FrameRange { first: 100, end: Some(341), step: 240 };
    let lights = vec![Lighting::with_count(100)];
    let config = three_frames("bistro-vive", 4, Marking::Depth, &names);
    let runs = run(Config { runs: 1.into(), frames, lights, resolution: [48, 32], ..config });
    assert_equal_the_truth(&runs, Marking::Depth);
    for run in &runs[1..] {
        assert_eq!(rebuilds(run), [1, 1]);
        // The frame that warms up has built that of the first.
        let built = run.times.iter().skip(1).map(building);
        assert!(built.into_iter().all(|[cpu, gpu]| cpu > 0.0 && gpu > 0.0), "{:?}", run.times);
        let whole = run.times.iter().all(|frame| frame.stages[0].cpu_ms >= building(frame)[0]);
        assert!(whole, "a frame takes as long as building at least");
    }
}

/// The rows of a table, by column.
fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    csv::Reader::from_path(path).unwrap().deserialize().collect::<Result<_, _>>().unwrap()
}

/// Checks that tables are as large as their sides say, of depths that follow each other from that at which lookups begin, 2.
fn sides_and_depths_fit(tables: &[BTreeMap<String, String>]) {
    let mut depths: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    for row in tables {
        let number = |column: &str| row[column].parse::<u64>().unwrap();
        let slot = if row["table"] == "data" { 8 } else { 2 };
        assert_eq!(number("slot_side").pow(3) * slot, number("slot_bytes"), "{row:?}");
        assert_eq!(number("offset_side").pow(3) * 4, number("offset_bytes"), "{row:?}");
        assert!((1..=number("slot_side").pow(3)).contains(&number("keys")), "{row:?}");
        depths.entry(&row["table"]).or_default().push(number("depth"));
    }
    let (structure, data) = (&depths["structure"], &depths["data"]);
    assert!(structure.iter().copied().eq((2..).take(structure.len())), "{depths:?}");
    assert!(
        data.is_sorted() && data.last() == structure.last().map(|depth| depth + 1).as_ref(),
        "{depths:?}"
    );
}

/// Checks the rows of the builds of a run with static lights: one in the first frame that is counted, one before the first timed.
fn builds_are_told(builds: &[BTreeMap<String, String>], tables: &[BTreeMap<String, String>]) {
    let told = |column: &str| builds.iter().map(|row| row[column].as_str()).collect::<Vec<_>>();
    assert_eq!(told("phase"), [["counted"; 5], ["warm-up"; 5]].concat());
    assert_eq!(told("step"), [BuildTimes::STEPS; 2].concat());
    let nodes: u64 = tables.iter().map(|row| row["keys"].parse::<u64>().unwrap()).sum();
    for row in builds {
        let columns = ["frame", "lights", "nodes"].map(|column| row[column].clone());
        assert_eq!(columns, ["100".to_owned(), "200".to_owned(), nodes.to_string()]);
    }
    let took = |row: &&BTreeMap<String, String>| row["cpu_ms"].parse::<f64>().unwrap() > 0.0;
    assert!(builds.iter().all(|row| took(&row)), "{builds:?}");
}

#[test]
fn tables_tell_what_an_octree_takes() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args([
        "replay",
        "--scene",
        "hall",
        "--recording",
        "hall",
        "--light-source",
        "volume",
        "--lights",
        "200,2",
    ]);
    command.args([
        "--method",
        "hashed-0.5-2",
        "--frames",
        "100..581/240",
        "--resolution",
        "32x20",
        "--runs",
        "1",
        "--out",
    ]);
    assert!(command.arg(out.path()).status().unwrap().success());
    let run = out.path().join("hashed-0.5-2");
    let tables = rows(&run.join("octree.csv"));
    let sum = |table: &str, column: &str| -> u64 {
        let found = tables.iter().filter(|row| row["table"] == table);
        found.map(|row| row[column].parse::<u64>().unwrap()).sum()
    };
    assert!(tables.iter().all(|row| row["frame"] == "100"), "one frame built one");
    let (offsets, slots) = (
        ["structure", "data"].map(|t| sum(t, "offset_bytes")),
        ["structure", "data"].map(|t| sum(t, "slot_bytes")),
    );
    sides_and_depths_fit(&tables);
    let indices = sum("data", "light_indices");
    let told: u64 = offsets.iter().sum::<u64>() + slots.iter().sum::<u64>() + 4 * indices;
    let frames = rows(&run.join("frames.csv"));
    let of_frames = |column: &str| frames.iter().map(|row| row[column].clone()).collect::<Vec<_>>();
    assert_eq!(of_frames("octree_rebuilds"), ["1", "0", "0"]);
    assert_eq!(of_frames("octree_bytes"), [told.to_string(), told.to_string(), told.to_string()]);
    assert_eq!(of_frames("visible_clusters")[0], sum("data", "keys").to_string());
    builds_are_told(&rows(&run.join("octree_builds.csv")), &tables);
    let memory = rows(&run.join("memory.csv"));
    let held = |name: &str| memory.iter().find(|row| row["structure"] == name).unwrap()["allocated"].clone();
    assert_eq!(held("octree_nodes"), slots[0].to_string());
    assert_eq!(held("octree_leaves"), slots[1].to_string());
    assert_eq!(held("octree_offsets"), (offsets[0] + offsets[1]).to_string());
    assert_eq!(held("octree_indices"), (4 * indices).to_string());
}

#[test]
fn every_way_makes_octrees_with_the_same_lists() {
    let frames = FrameRange { first: 300, end: Some(301), step: 1 };
    let octree = ["rebuild", "seed-7", "shared", "geometry"].map(|way| way.parse().unwrap()).to_vec();
    let runs = run(Config { octree, frames, ..hall(&["all-lights", "hashed-0.5-3"]) });
    assert_eq!(runs.len(), 5, "a run a way");
    assert_equal_the_truth(&runs, Marking::Depth);
    let told = |run: &Run| {
        let counts = &run.counts[0];
        (counts.counters.lighting_computations, counts.visible_clusters(), counts.light_indices())
    };
    assert!(runs[2..4].iter().all(|run| told(run) == told(&runs[1])));
    let [rebuilt, seeded, shared, trimmed] = [1, 2, 3, 4].map(|run| runs[run].counts[0].octree_bytes());
    assert!(
        rebuilt.abs_diff(seeded) * 100 <= rebuilt,
        "a seed changes no more than chance: {rebuilt}, {seeded}"
    );
    assert!(shared < rebuilt, "what is shared takes less: {shared}, {rebuilt}");
    assert!(trimmed * 4 < rebuilt * 3, "most of the hall is air: {trimmed}, {rebuilt}");
    assert_eq!(told(&runs[4]).0, told(&runs[1]).0, "surfaces have the same lists");
    assert_ne!(runs[1].lists[0].indices, runs[2].lists[0].indices, "leaves lie in other slots");
}

/// Lights that bounce in the hall: a part of them.
fn bouncing(part: f64, names: &[&str]) -> Config {
    Config {
        light_source: GeneratorKind::Gamma,
        light_motion: Some(LightMotion::Bounce),
        light_moving: Some(part),
        light_radius_mode: Some(1.9),
        light_radius_mean: Some(2.0),
        lights: vec![Lighting::with_count(60)],
        frames: FrameRange { first: 100, end: Some(161), step: 12 },
        resolution: [48, 32],
        octree: ["rebuild", "dynamic-1", "dynamic-2"].map(|way| way.parse().unwrap()).to_vec(),
        runs: 2.into(),
        ..hall(names)
    }
}

/// Checks a run whose octree is kept against one that builds its own for each frame.
fn keeps_its_octree(kept: &Run, rebuilt: &Run) {
    let each = |run: &Run, of: fn(&FrameCounts) -> u64| run.counts.iter().map(of).collect::<Vec<_>>();
    let name = &kept.planned.name;
    assert_eq!(rebuilds(kept), [1, 0, 0, 0, 0, 0], "{name}");
    let needed = |frame: &FrameCounts| frame.counters.needed_computations;
    assert_eq!(each(kept, needed), each(rebuilt, needed), "{name}");
    let [hashed, all] = [kept, rebuilt].map(|run| each(run, FrameCounts::octree_tables_hashed));
    assert!(
        hashed[0] == all[0] && hashed[1..].iter().zip(&all[1..]).all(|(some, all)| some <= all),
        "{name}"
    );
    let [uploaded, bytes] =
        [FrameCounts::octree_bytes_uploaded, FrameCounts::octree_bytes].map(|of| each(kept, of));
    assert!(uploaded[0] == bytes[0] && uploaded[1..].iter().all(|bytes| *bytes > 0), "{name}: {uploaded:?}");
    for frame in kept.times.iter().filter(|frame| frame.frame > 100) {
        let [cpu, gpu] = building(frame);
        assert!(cpu > 0.0 && gpu > 0.0, "{name}: {frame:?}");
    }
}

#[test]
fn octrees_that_are_kept_follow_their_lights() {
    let names = ["all-lights", "hashed-0.5m-2"];
    let few = run(bouncing(0.1, &names));
    let many = run(bouncing(1.0, &names));
    for runs in [&few, &many] {
        assert_equal_the_truth(runs, Marking::Depth);
        assert_eq!(rebuilds(&runs[1]), [1; 6]);
        runs[2..].iter().for_each(|kept| keeps_its_octree(kept, &runs[1]));
    }
    let sum = |run: &Run, of: fn(&FrameCounts) -> u64| run.counts[1..].iter().map(of).sum::<u64>();
    let hashed =
        [&few[2], &few[3], &many[2], &many[3]].map(|run| sum(run, FrameCounts::octree_tables_hashed));
    assert!(hashed[1] < hashed[0] && hashed[3] < hashed[2], "more slots spare hashing: {hashed:?}");
    let [of_few, of_all] = [&few[3], &few[1]].map(|run| sum(run, FrameCounts::octree_bytes_uploaded));
    assert!(of_few * 3 < of_all, "what stays stays on the device: {of_few}, {of_all}");
    assert!(sum(&few[3], FrameCounts::octree_extra_indices) > 0, "lights that leave a part of a leaf stay");
    let untimed = Config { runs: 0.into(), exr: ExrFrames::List(vec![]), ..bouncing(0.1, &names[1..]) };
    let again = run(untimed);
    assert!(again.len() == 3, "a run a way");
    assert!(few[1..].iter().zip(&again).all(|(one, other)| one.counts == other.counts), "counts repeat");
}

#[test]
fn memory_grows_with_the_cube_of_nodes_and_not_with_pictures() {
    let bytes = |names: &[&str], resolution: [u32; 2]| -> Vec<u64> {
        let runs = run(Config {
            lights: vec![Lighting::with_count(384)],
            // Lights everywhere lie in many others.
            light_volumes: vec!["-4,1,-4,4,7,4:8x6x8:4".parse().unwrap()],
            frames: FrameRange { first: 300, end: Some(301), step: 1 },
            exr: ExrFrames::List(vec![]),
            resolution,
            ..hall(names)
        });
        runs.iter().map(|run| run.counts[0].octree_bytes()).collect()
    };
    let found = bytes(&["hashed-0.125-3", "hashed-0.0625-3"], [16, 16]);
    let exponent = (found[1] as f64 / found[0] as f64).log2();
    assert!((exponent - 3.0).abs() <= 0.2, "{exponent}: {found:?}");
    assert_eq!(bytes(&["hashed-0.125-3"], [96, 64]), found[..1], "whatever the pixels");
}

#[test]
fn what_no_octree_holds_is_refused_in_one_line() {
    for (name, code, words) in [
        ("hashed-0.00001m-3", 3, "error: 1 of 1 runs failed, each left its <run>.error.json; the first was"),
        ("hashed-1-8", 2, "method hashed-1-8: lookups begin at depth 7 at most"),
        ("hashed-0-3", 2, "did you mean 'hashed-0.5-3'?"),
        ("hashed-2-3m", 2, "SIZE"),
    ] {
        let mut command = manylight();
        let out = tempfile::tempdir().unwrap();
        command.args([
            "replay",
            "--method",
            name,
            "--frames",
            "300",
            "--resolution",
            "32x20",
            "--lights",
            "20",
            "--out",
        ]);
        let output = command.arg(out.path()).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        let error = told.lines().filter(|line| line.contains(words)).count();
        assert_eq!((output.status.code(), error), (Some(code), 1), "{name}: {told}");
    }
}

#[test]
fn lights_too_large_for_nodes_of_the_smallest_are_refused_before_their_octrees_are_made() {
    let out = tempfile::tempdir().unwrap();
    let file = out.path().join("lights.csv");
    let lights = "x,y,z,r,g,b,i,i0,r0,r1\n0,1,0,1,1,1,1,0.5,0.001,0.01\n0,1,0,1,1,1,100000,0.5,0.1,50\n";
    std::fs::write(&file, lights).unwrap();
    let mut command = manylight();
    command.args(["replay", "--method", "hashed-0.5-3", "--frames", "300", "--resolution", "32x20"]);
    command.arg("--lights-file").arg(&file).arg("--out").arg(out.path().join("out"));
    let output = command.output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.contains("the lights are too large for nodes of"), "{told}");
}

#[test]
fn frames_without_lights_are_dark_and_right() {
    let frames = FrameRange { first: 300, end: Some(301), step: 1 };
    let lights = vec![Lighting::with_count(0)];
    let runs = run(Config { lights, frames, methods: methods(&["all-lights", "hashed-0.5-3"]), ..hall(&[]) });
    assert_equal_the_truth(&runs, Marking::Depth);
}
