//! The report as its readers meet it: the files, the page in a browser, one clear line for what is wrong.

use manylight::config::{Config, ExrLayout};
use manylight::measure::{
    ClusterRecord, ClusteringCounts, DeviceCounts, FrameCounts, FrameTimes, Purpose, StageTime,
    StructureMemory, ViewPixels,
};
use manylight::output::{Manifest, RUN_FORMAT, RunWriter, Source};
use manylight_tests::{manylight, program};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Frames of the made-up runs.
const FRAMES: [u32; 4] = [0, 300, 580, 660];

/// A run directory as a replay would write it, with made-up numbers and two pictures.
fn write_run(out: &Path, scene: [&str; 2], views: u32, method: &str, lights: u32) {
    let lighting = Config::default().lights[0];
    let manifest = Manifest {
        fingerprint: String::new(),
        assigned_by: "brute".into(),
        format: RUN_FORMAT.into(),
        version: "0.1.0".into(),
        git_revision: "unknown".into(),
        method: method.into(),
        lighting: Some(manylight::lights::Lighting { count: lights, ..lighting }),
        config: Config { resolution: [32, 20], ..Config::default() },
        scene: Source { name: scene[0].into(), sha256: "0".into() },
        recording: Source { name: scene[1].into(), sha256: "1".into() },
        extent: None,
        lights_file: None,
        generated: None,
        frame_count: Some(FRAMES.len()),
        device: Default::default(),
        machine: Default::default(),
        conditions: Default::default(),
        doubts: vec![],
        timing: None,
        capacities: Default::default(),
        memory_bytes: None,
        growth: vec![],
        discontinuity: None,
        started: "2026-01-01T00:00:00Z".into(),
        duration_s: 1.0,
    };
    let clusterings = if method.starts_with("encl") { 1 } else { views };
    let counts = FRAMES.map(|frame| counts(frame, views, clusterings));
    let times: Vec<FrameTimes> =
        FRAMES.iter().flat_map(|&frame| [times(0, frame), times(1, frame)]).collect();
    let writer = RunWriter::create(out, &format!("{method}_{lights}")).unwrap();
    for frame in [300, 580] {
        writer.write_images(frame, &[pixels()], ExrLayout::Multipart).unwrap();
        writer.write_look(frame, "birdseye", &image::RgbImage::new(32, 20)).unwrap();
    }
    writer.write_counted(&counts).unwrap();
    writer.write_memory(&memory(lights)).unwrap();
    writer.finish(&manifest, &counts, &times).unwrap();
}

fn counts(frame: u32, views: u32, clusterings: u32) -> FrameCounts {
    let cluster = |index| ClusterRecord { index, fragments: 40 * index + 1, lights: index * index };
    let clustering = ClusteringCounts {
        dimensions: [10, 12, 24],
        visible_clusters: 30,
        light_indices: 9000,
        intersection_tests: 30_000,
        clusters: (0..30).map(cluster).collect(),
        ..ClusteringCounts::default()
    };
    FrameCounts {
        frame,
        time_s: f64::from(frame) / 90.0,
        views,
        clusterings: vec![clustering; clusterings as usize],
        counters: DeviceCounts { lighting_computations: 1000 + u64::from(frame), ..DeviceCounts::default() },
        ..FrameCounts::default()
    }
}

fn memory(lights: u32) -> [StructureMemory; 3] {
    let of = |structure, purpose, bytes| StructureMemory {
        structure,
        purpose,
        allocated: 4 * bytes,
        used: bytes,
        most: 2 * bytes,
    };
    [
        of("visible_clusters", Purpose::Grouping, 4096),
        of("light_indices", Purpose::Lists, 10 * u64::from(lights)),
        of("lights", Purpose::Lights, 48 * u64::from(lights)),
    ]
}

fn times(run: u32, frame: u32) -> FrameTimes {
    let stage = |stage: &str, gpu_ms| StageTime { stage: stage.into(), gpu_ms, cpu_ms: 0.1 };
    let more = f64::from(run);
    let stages = vec![
        stage("frame", 12.0 + more),
        stage("frame/cluster[0]", 5.0 + more),
        stage("frame/cluster[0]/depth[0]", 1.5),
        stage("frame/cluster[0]/count_lights", 1.0),
        stage("frame/cluster[0]/assign_lights", 2.0),
        stage("frame/shade[0]", 6.0 + more),
    ];
    FrameTimes { run, frame, stages }
}

fn pixels() -> ViewPixels {
    let pixels = 32 * 20;
    let channel = |value: f32| half::f16::from_f32(value);
    ViewPixels {
        name: "mono".into(),
        width: 32,
        height: 20,
        color: (0..pixels)
            .map(|i| [channel(i as f32 / 640.0), channel(0.2), channel(0.4), channel(1.0)])
            .collect(),
        background: [0.0; 3],
        depth: vec![1.0; pixels],
        lights: 1000,
        light_count: (0..pixels as u32).collect(),
        fragment_count: vec![1; pixels],
        cluster_index: vec![0; pixels],
        dimensions: [10, 12, 24],
        world_from_view: Default::default(),
        clip_from_view: Default::default(),
    }
}

/// Results for every figure: both scenes, sweeps in mono, tuned methods in stereo, two lightings.
fn write_everything(out: &Path) {
    let mono = [
        "indi-persp-16",
        "indi-persp-64",
        "indi-ortho-4",
        "indi-ortho-16",
        "indi-displ-64-8",
        "indi-displ-64-32",
    ];
    let stereo = ["indi-persp-64", "encl-persp-64", "indi-ortho-4", "encl-ortho-4"];
    for lights in [1000, 10_000] {
        for method in mono {
            write_run(&out.join("street"), ["street", "bistro"], 1, method, lights);
            write_run(&out.join("deep/temple"), ["temple", "suntem"], 1, method, lights);
        }
        for method in stereo {
            write_run(&out.join("stereo"), ["street", "bistro-vive"], 2, method, lights);
        }
    }
}

fn report(arguments: &[&OsStr]) -> Output {
    manylight().arg("report").args(arguments).output().expect("the program starts")
}

/// The one line that a report refuses its arguments with.
fn refused(arguments: &[&OsStr]) -> String {
    program::refused(manylight().arg("report").args(arguments))
}

const OF_THE_THESIS: [&str; 20] = [
    "4.7", "4.8", "6.1", "6.2", "6.3", "6.4", "6.5", "6.6", "6.7", "6.8", "6.9", "6.10", "A.1", "A.2", "A.3",
    "A.4", "C.1", "C.2", "C.3", "C.4",
];

/// What the page says of itself after its self-test in a headless browser.
fn self_test(page: &Path) -> serde_json::Value {
    let home = tempfile::tempdir().unwrap();
    let browser = ["chromium", "chromium-browser", "google-chrome"].into_iter().find_map(|name| {
        let mut command = Command::new(name);
        command.args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-sync"]);
        command.args([
            "--disable-background-networking",
            "--disable-component-update",
            "--window-size=1280,800",
        ]);
        command.args(["--virtual-time-budget=10000", "--dump-dom"]);
        command.arg(format!("--user-data-dir={}", home.path().display()));
        command.arg(format!("file://{}#selftest", page.display()));
        command.output().ok()
    });
    let browser = browser.expect("install chromium: scripts/setup.sh --browser");
    let dom = String::from_utf8_lossy(&browser.stdout).into_owned();
    let found = dom.split_once("data-selftest=\"").and_then(|(_, rest)| rest.split_once('"'));
    let (json, _) =
        found.unwrap_or_else(|| panic!("no self-test: {}", String::from_utf8_lossy(&browser.stderr)));
    serde_json::from_str(&json.replace("&quot;", "\"").replace("&lt;", "<").replace("&amp;", "&")).unwrap()
}

#[test]
fn the_page_opens_offline_draws_every_figure_and_tells_values() {
    let results = tempfile::tempdir().unwrap();
    write_everything(results.path());
    let output = report(&[results.path().as_ref()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let directory = results.path().join("report");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(printed.lines().last(), Some(directory.join("index.html").to_str().unwrap()));
    for id in OF_THE_THESIS {
        for kind in ["svg", "csv"] {
            assert!(directory.join(format!("figures/{id}.{kind}")).is_file(), "{id}.{kind}");
        }
    }
    let claims: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(directory.join("claims.json")).unwrap()).unwrap();
    assert_eq!(claims.as_array().unwrap().len(), 8);
    assert_eq!((&claims[0]["id"], &claims[0]["verdict"]), (&"G1".into(), &"holds".into()));

    let seen = self_test(&directory.join("index.html"));
    assert_eq!(seen["problems"], serde_json::json!([]));
    assert_eq!(seen["requests"], serde_json::json!([]));
    assert_eq!(seen["wide"], 0, "the page is no wider than the window");
    assert_eq!(seen["tipHidden"], true, "the tip goes with the pointer");
    for id in OF_THE_THESIS {
        assert!(seen["marks"][id].as_u64() > Some(0), "{id} has no marks: {seen}");
        if !["4.7", "4.8", "6.1", "A.2", "A.3", "A.4", "C.1", "C.2"].contains(&id) {
            let tip = seen["hovered"][id].as_str().unwrap_or_default();
            assert!(tip.chars().any(|c| c.is_ascii_digit()), "{id} tells no value: {seen}");
        }
    }
    assert!(seen["marks"]["analysis-times"].as_u64() > Some(0), "the analysis has bars: {seen}");
    assert!(seen["hovered"]["6.2"].as_str().unwrap().contains("Persp 64"), "{seen}");
    assert!(seen["hovered"]["6.7"].as_str().unwrap().contains("Shading"), "{seen}");
}

#[test]
fn a_second_report_equals_the_first_and_removes_what_is_outdated() {
    let results = tempfile::tempdir().unwrap();
    write_run(results.path(), ["street", "bistro"], 1, "indi-ortho-4", 1000);
    let out = tempfile::tempdir().unwrap();
    let arguments = [results.path().as_os_str(), "--out".as_ref(), out.path().as_os_str()];
    fs::create_dir(out.path().join("figures")).unwrap();
    fs::write(out.path().join("figures/6.5.svg"), "old").unwrap();
    let read = || fs::read(out.path().join("index.html")).unwrap();
    assert!(report(&arguments).status.success());
    let first = read();
    assert!(report(&arguments).status.success());
    assert!(first == read(), "the page depends on the results alone");
    assert!(!out.path().join("figures/6.5.svg").exists());
    assert!(out.path().join("figures/6.7.svg").is_file());
}

#[test]
fn three_numbers_of_lights_make_lines_and_rankings() {
    let results = tempfile::tempdir().unwrap();
    let write = |method, lights| write_run(results.path(), ["street", "bistro"], 1, method, lights);
    let rows = |name: &str| {
        let table = fs::read_to_string(results.path().join("report").join(name)).unwrap();
        csv::Reader::from_reader(table.as_bytes()).records().count()
    };
    for (lights, have_lines) in [(100, false), (1000, false), (10_000, true)] {
        ["indi-persp-64", "tiled-16"].into_iter().for_each(|method| write(method, lights));
        assert!(report(&[results.path().as_ref()]).status.success());
        for (file, is_there) in [
            ("figures/analysis-times.svg", true),
            ("figures/analysis-lines.svg", have_lines),
            ("figures/analysis-slopes.csv", have_lines),
            ("analysis-lines.csv", have_lines),
        ] {
            assert_eq!(
                results.path().join("report").join(file).is_file(),
                is_there,
                "{lights} lights: {file}"
            );
        }
    }
    assert_eq!((rows("analysis-times.csv"), rows("analysis-lines.csv")), (2 * 3, 2 * 3));
    // Each of the two by SD and RSD, at three numbers of lights, and by slope and offset of three parts.
    assert_eq!(rows("analysis-classes.csv"), 2 * (2 + 3 + 2 * 3));
    assert!(
        self_test(&results.path().join("report/index.html"))["hovered"]["analysis-lines"]
            .as_str()
            .unwrap()
            .contains("Tiled 16, line")
    );
}

/// Rewrites a file of a run.
fn edit(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains(from));
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

#[test]
fn one_wrong_number_of_a_run_shows_in_its_own_place_of_every_figure_it_is_in() {
    let results = tempfile::tempdir().unwrap();
    for (method, lights) in ["all-lights", "tiled-mm-32", "hashed-0.5-3", "hashed-1-3"]
        .into_iter()
        .flat_map(|method| [100, 1000].map(|lights| (method, lights)))
    {
        write_run(results.path(), ["street", "bistro"], 1, method, lights);
    }
    let drawn = || {
        let output = report(&[results.path().as_ref()]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        ["T5.10", "T7.28"].map(|id| {
            let file = results.path().join(format!("report/figures/{id}.csv"));
            fs::read_to_string(file).unwrap().lines().map(str::to_owned).collect::<Vec<_>>()
        })
    };
    let right = drawn();
    let mean = 1000 + FRAMES.iter().sum::<u32>() / 4;
    let tiles = |mean| format!("computations (forward),street (bistro),Tiled MM 32,1000,{mean}");
    let nodes = |mean| format!("computations,street (bistro),100 lights,0.5,{mean}");
    assert!(right[0].contains(&tiles(mean)) && right[1].contains(&nodes(mean)), "{right:?}");
    for (run, more) in [("tiled-mm-32_1000", 4000), ("hashed-0.5-3_100", 8000)] {
        let wrong = 1000 + FRAMES[1] + more;
        edit(&results.path().join(run).join("frames.csv"), ",1300,", &format!(",{wrong},"));
    }
    let wrong = drawn();
    for (place, (told, line)) in
        [(tiles(mean), tiles(mean + 1000)), (nodes(mean), nodes(mean + 2000))].into_iter().enumerate()
    {
        let mut expected = right[place].clone();
        expected.iter_mut().filter(|known| **known == told).for_each(|known| known.clone_from(&line));
        assert_eq!(wrong[place], expected);
        assert_ne!(wrong[place], right[place]);
    }
}

#[test]
fn ways_of_assignment_stand_side_by_side_and_never_in_one_figure() {
    let results = tempfile::tempdir().unwrap();
    for (way, test) in [("brute", "hs"), ("hierarchy", "hs"), ("brute", "exact")] {
        for method in ["indi-persp-64", "encl-persp-64"] {
            let out = results.path().join(format!("{way}-{test}"));
            write_run(&out, ["street", "bistro-vive"], 2, method, 1000);
            let manifest = out.join(format!("{method}_1000/run.json"));
            let mut value: serde_json::Value =
                serde_json::from_str(&fs::read_to_string(&manifest).unwrap()).unwrap();
            value["config"]["assign"] = way.into();
            value["config"]["test"] = test.into();
            fs::write(&manifest, value.to_string()).unwrap();
        }
    }
    assert!(report(&[results.path().as_ref()]).status.success());
    let read = |name: &str| fs::read_to_string(results.path().join("report").join(name)).unwrap();
    let page = read("index.html");
    for id in ["6.5", "6.5-2", "6.5-3"] {
        assert!(page.contains(&format!("data-figure=\"{id}\"")), "{id}");
    }
    assert!(page.contains("lights assigned by brute force, test exact"));
    let ways = ["brute force", "\"brute force, test exact\"", "hierarchy"];
    let table = read("indi-encl.csv");
    assert_eq!(table.lines().count(), 1 + ways.len(), "{table}");
    assert!(ways.iter().all(|way| table.contains(&format!(",1000 lights,{way},"))), "{table}");
    assert_eq!(read("tests.csv").lines().count(), 1 + 2 * ways.len());
    let claims: serde_json::Value = serde_json::from_str(&read("claims.json")).unwrap();
    assert_eq!(claims[0]["other_ways"].as_array().unwrap().len(), 2);
    assert_eq!(claims[0]["evidence"].as_array().unwrap().len(), 1);
}

#[test]
fn what_is_no_result_is_refused_in_one_line() {
    let results = tempfile::tempdir().unwrap();
    let path = results.path();
    let missing = path.join("nowhere");
    assert!(refused(&[missing.as_ref()]).contains("there is no such directory"));
    assert!(refused(&[path.as_ref()]).contains("holds no results"));
    write_run(path, ["street", "bistro"], 1, "indi-ortho-4", 1000);
    let run = path.join("indi-ortho-4_1000");
    let file = run.join("frames.csv");
    assert!(refused(&[file.as_ref()]).contains("is no directory"));

    write_run(path, ["street", "bistro"], 1, "indi-persp-64", 1000);
    let other = path.join("indi-persp-64_1000/run.json");
    edit(&other, "\"version\": \"0.1.0\"", "\"version\": \"0.0.9\"");
    let message = refused(&[path.as_ref()]);
    assert!(message.contains("0.0.9") && message.contains("different versions"), "{message}");
    edit(&other, "manylight.run/1", "manylight.run/9");
    assert!(refused(&[path.as_ref()]).contains("has format manylight.run/9"));
    fs::write(&other, "{}").unwrap();
    assert!(refused(&[path.as_ref()]).contains("was not written by a replay"));
    fs::remove_dir_all(other.parent().unwrap()).unwrap();

    assert!(
        report(&[path.as_ref(), run.as_ref()]).status.success(),
        "a run in two given directories is one run"
    );
    edit(&file, "visible_clusters", "visible");
    assert!(refused(&[run.as_ref()]).contains("line 1: a column `visible` is not known"));
    fs::remove_file(&file).unwrap();
    assert!(refused(&[run.as_ref()]).contains("is missing"));
}
