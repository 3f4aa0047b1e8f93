//! What the evaluation of a run needs beside its counters: how much depth jumps, which frames that finds, lights per group.

use exr::prelude::{AnyChannels, FlatSamples, Layer, ReadChannels, ReadLayers, read};
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::cpu;
use manylight::lights::Lighting;
use manylight::measure::OCTAVE_PARTS;
use manylight::shading::Shading;
use manylight_tests::program::{self, succeed, text};
use manylight_tests::{manylight, methods, run};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The jumps that a run's shaders counted, and those of the depth in its pictures.
fn assert_jumps_are_those_of_the_pictures(config: Config) {
    let runs = run(Config { runs: 0.into(), exr: ExrFrames::All, ..config });
    let of = |run: &manylight_tests::Run| -> Vec<(u64, u64)> {
        run.counts.iter().map(|frame| (frame.counters.depth_steps, frame.counters.depth_pairs)).collect()
    };
    for run in &runs {
        let seen =
            run.images.iter().map(|(_, views)| cpu::depth_steps(&views[0].depth, views[0].width as usize));
        assert_eq!(of(run), seen.collect::<Vec<_>>(), "{}", run.planned.name);
        assert_eq!(of(run), of(&runs[0]), "{}: depth is the same whatever the method", run.planned.name);
        assert!(of(run).iter().all(|&(steps, pairs)| steps > 0 && pairs > 1000), "{:?}", of(run));
    }
}

#[test]
fn depth_jumps_as_in_the_pictures_by_every_method() {
    let frames = FrameRange { first: 300, end: Some(581), step: 280 };
    let street = Config {
        methods: methods(&["all-lights", "indi-persp-64", "t-e-28", "g-20", "m"]),
        lights: vec![Lighting::with_count(20)],
        // No multiple of the shader's workgroups.
        resolution: [61, 43],
        frames,
        ..Config::default()
    };
    assert_jumps_are_those_of_the_pictures(Config {
        msaa: 4,
        methods: methods(&["encl-ortho-4"]),
        ..street.clone()
    });
    assert_jumps_are_those_of_the_pictures(Config { multiview: true, ..street.clone() });
    assert_jumps_are_those_of_the_pictures(Config { shading: vec![Shading::Overdraw], ..street.clone() });
    let (scene, recording) = ("hall".to_owned(), "hall".to_owned());
    assert_jumps_are_those_of_the_pictures(Config {
        scene,
        recording,
        methods: methods(&["sc-i-48-40"]),
        ..street
    });
}

fn layer(path: &Path) -> Layer<AnyChannels<FlatSamples>> {
    let reader =
        read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    reader.from_file(path).unwrap().layer_data.remove(0)
}

fn samples(layer: &Layer<AnyChannels<FlatSamples>>, name: &str) -> FlatSamples {
    let channel = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name);
    channel.unwrap().sample_data.clone()
}

/// A replay of the hall into `out`, few pixels and lights.
fn hall(out: &Path, more: &[&str]) -> std::process::Output {
    let mut command = manylight();
    command.args([
        "replay",
        "--scene",
        "hall",
        "--recording",
        "hall",
        "--resolution",
        "64x36",
        "--runs",
        "0",
    ]);
    command.args(["--frames", "25..1200/275", "--lights", "300,1.5,0.1", "--out"]).arg(out).args(more);
    succeed(&mut command)
}

fn column(table: &Path, name: &str) -> BTreeMap<u32, u64> {
    let mut reader = csv::Reader::from_path(table).unwrap();
    let place = reader.headers().unwrap().iter().position(|column| column == name).unwrap();
    let cell = |row: csv::StringRecord| (row[0].parse().unwrap(), row[place].parse().unwrap());
    reader.records().map(|row| cell(row.unwrap())).collect()
}

#[test]
fn the_frames_of_least_and_most_discontinuity_are_found_and_told() {
    let out = tempfile::tempdir().unwrap();
    let methods = ["--method", "sc-e-16-24", "--method", "m"];
    let notes = text(&hall(out.path(), &[&methods[..], &["--exr"]].concat()).stderr);
    let table = column(&out.path().join("m/frames.csv"), "depth_discontinuity");
    let (least, _) = table.iter().min_by_key(|(_, jump)| **jump).unwrap();
    let (most, _) = table.iter().max_by_key(|(_, jump)| **jump).unwrap();
    assert!(table.len() == 5 && table[least] * 4 < table[most], "{table:?}");
    let told = format!("images of depth discontinuity: frames {least} (least) and {most} (most)");
    assert_eq!(notes.matches(&told).count(), 1, "both methods find the same: {notes}");
    for method in ["sc-e-16-24", "m"] {
        let run = out.path().join(method);
        assert_eq!(column(&run.join("frames.csv"), "depth_discontinuity"), table);
        let manifest: serde_json::Value = serde_json::from_str(&program::read(run.join("run.json"))).unwrap();
        assert_eq!(manifest["discontinuity"], serde_json::json!({ "least": least, "most": most }));
        assert_eq!(manifest["config"]["exr"], "discontinuity");
        let mut files: Vec<String> = fs::read_dir(run.join("frames"))
            .unwrap()
            .map(|file| file.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(".exr"))
            .collect();
        files.sort();
        let mut both = [least, most].map(|frame| format!("{frame:06}.exr"));
        both.sort();
        assert_eq!(files, both);
        for frame in [least, most] {
            let seen = layer(&run.join(format!("frames/{frame:06}.exr")));
            let depth: Vec<f32> = samples(&seen, "Z").values_as_f32().collect();
            let (steps, pairs) = cpu::depth_steps(&depth, 64);
            assert_eq!(table[frame], steps * 1_000_000 / (pairs * u64::from(OCTAVE_PARTS)), "frame {frame}");
        }
    }
    // Images are those of frames that are named; and a run whose frames were found is not made again.
    let named = tempfile::tempdir().unwrap();
    hall(named.path(), &[&methods[..], &["--exr", &format!("{least},{most}")]].concat());
    let mut compare = manylight();
    succeed(compare.arg("compare").args([out.path(), named.path()]));
    for frame in [least, most] {
        let file = format!("m/frames/{frame:06}.exr");
        assert!(fs::read(out.path().join(&file)).unwrap() == fs::read(named.path().join(&file)).unwrap());
    }
    let again = text(&hall(out.path(), &[&methods[..], &["--exr"]].concat()).stderr);
    assert!(again.contains("2 of 2 runs were complete and unchanged"), "{again}");
    let refused = program::refused(manylight().args(["replay", "--runs", "1", "--trace", "discontinuity"]));
    assert!(refused.contains("trace: discontinuity"), "{refused}");
}

#[test]
fn groups_are_drawn_by_their_lights_beside_where_they_are() {
    let out = tempfile::tempdir().unwrap();
    hall(out.path(), &["--method", "m", "--method", "sc-e-16-24", "--exr", "25,850"]);
    succeed(manylight().arg("report").arg(out.path()));
    let report = out.path().join("report");
    let drawn = ["analysis-groups", "analysis-groups-2"]
        .map(|id| program::read(report.join(format!("figures/{id}.svg"))));
    assert!(drawn.iter().all(|svg| svg.matches("mark-picture").count() == 2 && svg.contains("mark-area")));

    let mut groups: BTreeMap<(String, u32), u64> = BTreeMap::new();
    let mut reader = csv::Reader::from_path(report.join("groups.csv")).unwrap();
    for row in reader.deserialize() {
        let (run, frame, clustering, from, to, count): (String, u32, u32, u32, u32, u64) = row.unwrap();
        let bin = (from, to);
        assert_eq!(clustering, 0);
        assert!(
            bin == (0, 0) && run == "m" || bin == (0, 25) || bin.0 % 25 == 1 && to % 25 == 0,
            "{run} {bin:?}"
        );
        *groups.entry((run, frame)).or_default() += count;
    }
    for method in ["m", "sc-e-16-24"] {
        let visible = column(&out.path().join(method).join("frames.csv"), "visible_clusters");
        for frame in [25, 850] {
            assert_eq!(groups[&(method.to_owned(), frame)], visible[&frame], "{method} {frame}");
        }
    }

    let frames = out.path().join("sc-e-16-24/frames");
    let [seen, heat] =
        ["", "_heat"].map(|kind| image::open(frames.join(format!("000850{kind}.png"))).unwrap().to_rgb8());
    let image = layer(&frames.join("000850.exr"));
    let FlatSamples::U32(lights) = samples(&image, "light_count") else { panic!("whole numbers") };
    let depth: Vec<f32> = samples(&image, "Z").values_as_f32().collect();
    assert!(lights.iter().any(|&count| count > 0));
    for (place, (x, y, pixel)) in heat.enumerate_pixels().enumerate() {
        let red = f64::from(lights[place]) / 150.0 * 255.0;
        let color = if red > 255.0 { [0.0, 255.0, 0.0] } else { [red.round(), 0.0, (255.0 - red).round()] };
        let expected: Vec<u8> = seen
            .get_pixel(x, y)
            .0
            .iter()
            .zip(color)
            .map(|(&own, color)| match depth[place].is_finite() {
                true => ((f64::from(own) + color) / 2.0).floor() as u8,
                false => own,
            })
            .collect();
        assert_eq!(pixel.0[..], expected[..], "pixel {x}, {y} of {} lights", lights[place]);
    }
}

/// The rows of a run's `memory.csv`: allocated, used and most by structure.
fn memory(run: &Path) -> BTreeMap<String, [u64; 3]> {
    let mut reader = csv::Reader::from_path(run.join("memory.csv")).unwrap();
    let rows = reader.deserialize().map(|row| {
        let (structure, _, allocated, used, most): (String, String, u64, u64, u64) = row.unwrap();
        (structure, [allocated, used, most])
    });
    rows.collect()
}

#[test]
fn memory_is_what_frames_hold_within_what_buffers_grew_to() {
    let out = tempfile::tempdir().unwrap();
    let methods = ["--method", "sc-e-16-24", "--method", "dc-i-16-24"];
    let small = ["--visible-cluster-capacity", "1", "--light-index-capacity", "1"];
    hall(out.path(), &[&methods[..], &small].concat());
    for method in ["sc-e-16-24", "dc-i-16-24"] {
        let run = out.path().join(method);
        let found = memory(&run);
        for (structure, counter) in
            [("light_indices", "light_indices"), ("visible_clusters", "visible_clusters")]
        {
            let bytes: Vec<u64> =
                column(&run.join("frames.csv"), counter).into_values().map(|count| 4 * count).collect();
            let [allocated, used, most] = found[structure];
            assert_eq!(used, bytes.iter().sum::<u64>() / bytes.len() as u64, "{method} {structure}");
            assert_eq!(most, *bytes.iter().max().unwrap(), "{method} {structure}");
            // Growing leaves a fifth of room.
            assert!((most..=most + most / 5).contains(&allocated), "{method} {structure}: {allocated}");
        }
        let manifest: serde_json::Value = serde_json::from_str(&program::read(run.join("run.json"))).unwrap();
        assert_eq!(manifest["memory_bytes"], found.values().map(|[allocated, ..]| allocated).sum::<u64>());
        assert_eq!(found.contains_key("cluster_bits"), method == "sc-e-16-24", "what marking alone needs");
    }
    let lists = |method: &str| memory(&out.path().join(method))["light_indices"][1];
    assert!(lists("sc-e-16-24") * 4 < lists("dc-i-16-24"), "most clusters hold nothing that is seen");

    let table = out.path().join("memory.csv");
    succeed(manylight().args(["export", "--memory", "--out"]).arg(&table).arg(out.path()));
    let mut reader = csv::Reader::from_path(&table).unwrap();
    let rows: Vec<BTreeMap<String, String>> = reader.deserialize().map(Result::unwrap).collect();
    assert_eq!(
        rows.len(),
        ["sc-e-16-24", "dc-i-16-24"]
            .map(|method| memory(&out.path().join(method)).len())
            .iter()
            .sum::<usize>()
    );
    let row =
        rows.iter().find(|row| row["method"] == "sc-e-16-24" && row["structure"] == "light_indices").unwrap();
    assert_eq!((row["used"].clone(), row["purpose"].as_str()), (lists("sc-e-16-24").to_string(), "lists"));
}
