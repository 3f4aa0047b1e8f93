//! Stores of lists and compaction by a counter: pictures, lists and counts are those of the default, byte for byte, but for what
//! capped lists say they drop.

use manylight::assign::{Compaction, ListStore, Marking};
use manylight::config::{Assign, Config, ExrFrames, FrameRange};
use manylight::lights::Lighting;
use manylight::shading::ShadingPipeline;
use manylight_tests::program::{read, refused, small, stderr, succeed, text};
use manylight_tests::{Run, assert_equal_the_truth, few_far_lights, manylight, methods, run};

/// Every kind of group, with measured bounds among them.
const NAMES: [&str; 6] = ["indi-persp-16", "encl-ortho-4", "sc-e-12-10", "dc-i-16-12", "g-7", "m"];
/// Some of them.
const FEW: [&str; 3] = ["indi-persp-16", "sc-e-12-10", "m"];

fn config(recording: &str, msaa: u32, names: &[&str]) -> Config {
    Config {
        recording: recording.to_owned(),
        methods: methods(names),
        lights: few_far_lights(),
        resolution: [56, 36],
        msaa,
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

/// What is the same in every store: all counters, lists and pictures.
fn assert_same(made: &Run, offsets: &Run) {
    let name = &made.planned.name;
    assert_eq!(made.counts, offsets.counts, "{name}: counters");
    assert!(made.lists == offsets.lists, "{name}: lists");
    assert!(made.images == offsets.images, "{name}: pictures");
    assert!(made.looks == offsets.looks, "{name}: from above");
}

/// Runs of a method with several values on one axis, the first of which is the default's.
fn assert_all_same(runs: &[Run], values: usize) {
    assert!(runs.len() >= values && runs.len().is_multiple_of(values));
    for of_method in runs.chunks(values) {
        let (first, others) = of_method.split_first().unwrap();
        assert!(first.lists.iter().any(|lists| lists.indices.len() > 50), "{}", first.planned.name);
        others.iter().for_each(|other| assert_same(other, first));
    }
}

/// Two entries are too few for most lists: all grow, and nothing else changes.
fn grow((recording, msaa): (&str, u32), assign: Assign, names: &[&str]) {
    let stores = [ListStore::Offsets, ListStore::Fixed(2), ListStore::Fixed(1500), ListStore::Capped(1024)];
    let config = Config { assign: vec![assign], lists: stores.to_vec(), ..config(recording, msaa, names) };
    let runs = run(config);
    assert_all_same(&runs, stores.len());
    for of_method in runs.chunks(stores.len()) {
        let [offsets, few, many, _] = of_method else { panic!("four stores") };
        let longest = offsets.lists.iter().flat_map(|lists| lists.offsets.windows(2));
        let longest = longest.map(|ends| ends[1] - ends[0]).max().unwrap();
        let entries = few.result.capacities.list_entries;
        assert!(
            longest > 2 && (longest..=longest + longest / 5).contains(&entries),
            "{entries} of {longest}"
        );
        let grown = few.result.growth.iter().rfind(|event| event.buffer == "list_entries").unwrap();
        assert_eq!(grown.to, entries);
        assert_eq!((many.result.capacities.list_entries, many.result.growth.len()), (1500, 0));
    }
}

#[test]
fn every_store_in_mono() {
    grow(("bistro", 1), Assign::Brute, &NAMES);
}

#[test]
fn every_store_in_stereo_with_four_samples() {
    grow(("bistro-vive", 4), Assign::Brute, &NAMES);
}

#[test]
fn every_store_by_hierarchy() {
    grow(("bistro-vive", 1), Assign::Hierarchy, &FEW);
}

#[test]
fn every_store_by_scatter() {
    grow(("bistro-vive", 1), Assign::Scatter, &FEW);
}

/// Lists of nodes have the lights of offsets, in another order, and pools grow; sorted ones make the same pictures again.
#[test]
fn linked_lists_shade_what_offsets_do() {
    let stores = ["offsets", "linked-64", "linked-32", "linked-64-unsorted"];
    let config = |pipeline, names: &[&str]| Config {
        lists: stores.iter().map(|name| name.parse().unwrap()).collect(),
        pipeline: vec![pipeline],
        lights: vec![Lighting { intensity: 40.0, ..Lighting::with_count(600) }],
        spots: 0.5.try_into().unwrap(),
        ..config("bistro-vive", 1, names)
    };
    for pipeline in [ShadingPipeline::Forward, ShadingPipeline::Deferred] {
        let runs = run(config(pipeline, &["all-lights", "raster-1-1-2-e", "raster-count-4-3-6-l"]));
        assert_equal_the_truth(&runs, Marking::Depth);
        for of_method in runs[1..].chunks(stores.len()) {
            for linked in &of_method[1..] {
                let name = &linked.planned.name;
                assert_eq!(linked.counts, of_method[0].counts, "{name}: counters");
                assert!(linked.lists == of_method[0].lists, "{name}: lists");
                let grown = linked.result.growth.iter().any(|event| event.buffer == "list_entries");
                assert_eq!(grown, name.starts_with("raster-1-1-2-e"), "{name}");
            }
        }
        let again = run(config(pipeline, &["raster-1-1-2-e"]));
        for (first, again) in runs[2..4].iter().zip(&again[1..3]) {
            assert!(first.images == again.images, "{}: pictures", again.planned.name);
        }
    }
}

/// The truth knows no lists.
#[test]
fn lists_of_every_store_lose_nothing() {
    for (store, compaction) in [
        (ListStore::Fixed(2), Compaction::Atomic),
        (ListStore::Capped(1024), Compaction::Atomic),
        (ListStore::Capped(1024), Compaction::Ranks),
    ] {
        let runs = run(Config {
            lists: vec![store],
            compaction: vec![compaction],
            multiview: true,
            ..config("bistro-vive", 1, &["all-lights", "indi-persp-16", "encl-ortho-4", "sc-e-12-10"])
        });
        assert_equal_the_truth(&runs, Marking::Depth);
    }
}

#[test]
fn capped_lists_drop_what_they_say() {
    let stores = [ListStore::Offsets, ListStore::Capped(6)];
    for assign in [Assign::Brute, Assign::Hierarchy, Assign::Scatter] {
        let config =
            Config { assign: vec![assign], lists: stores.to_vec(), ..config("bistro-vive", 1, &FEW) };
        let runs = run(config.clone());
        for pair in runs.chunks(2) {
            let [offsets, capped] = pair else { panic!("two stores") };
            let mut dropped = 0;
            for (all, kept) in offsets.lists.iter().zip(&capped.lists) {
                for list in 0..all.offsets.len() - 1 {
                    let (first, beyond) = manylight::cpu::cap_list(all.list(list), 6);
                    assert_eq!(kept.list(list), first, "{}", capped.planned.name);
                    dropped += beyond;
                }
            }
            let told: u64 = capped.counts.iter().map(|frame| frame.counters.lights_dropped).sum();
            assert!(dropped > 20 && told == dropped, "{}: {told} of {dropped}", capped.planned.name);
            assert!(offsets.counts.iter().all(|frame| frame.counters.lights_dropped == 0));
            assert!(capped.images != offsets.images, "{}: nothing is missed", capped.planned.name);
        }
        let again = run(Config { lists: vec![stores[1]], ..config });
        runs.iter().skip(1).step_by(2).zip(&again).for_each(|(one, other)| assert_same(one, other));
    }
}

#[test]
fn places_of_a_counter_change_nothing() {
    let names = ["indi-persp-16", "encl-ortho-4", "sc-e-12-10"];
    let ways = [Compaction::Ranks, Compaction::Atomic];
    for (assign, store, msaa, marking) in [
        (Assign::Brute, ListStore::Offsets, 1, Marking::Depth),
        (Assign::Hierarchy, ListStore::Offsets, 4, Marking::Depth),
        (Assign::Brute, ListStore::Fixed(4), 4, Marking::Geometry),
        (Assign::Brute, ListStore::Capped(9), 1, Marking::Depth),
    ] {
        let config = Config {
            assign: vec![assign],
            lists: vec![store],
            compaction: ways.to_vec(),
            marking,
            ..config("bistro-vive", msaa, &names)
        };
        let runs = run(config.clone());
        assert_all_same(&runs, 2);
        // Whose threads take which place differs from run to run.
        let again = run(Config { compaction: vec![ways[1]], methods: methods(&names[..1]), ..config });
        assert_same(&runs[1], &again[0]);
    }
}

/// A few clusters have room at first, and none is lost for it.
#[test]
fn buffers_of_every_store_grow_with_their_clusters() {
    let roomy = config("bistro", 1, &["sc-i-12-10"]);
    let tight = Config { visible_cluster_capacity: 3, light_index_capacity: 5, ..roomy.clone() };
    let offsets = run(roomy);
    for store in [ListStore::Fixed(3), ListStore::Capped(1024)] {
        for compaction in [Compaction::Ranks, Compaction::Atomic] {
            let runs = run(Config { lists: vec![store], compaction: vec![compaction], ..tight.clone() });
            assert!(runs[0].result.growth.iter().any(|event| event.buffer == "visible_clusters"));
            assert_same(&runs[0], &offsets[0]);
        }
    }
}

fn stages(run: &Run) -> Vec<&str> {
    let paths = run.times[0].stages.iter().map(|stage| stage.stage.as_str());
    paths.filter_map(|path| path.strip_prefix("frame/cluster[0]/")).collect()
}

#[test]
fn passes_that_a_store_does_without_take_no_time() {
    let of = |store, assign| {
        let config = Config {
            lists: vec![store],
            assign: vec![assign],
            runs: 1.into(),
            exr: ExrFrames::List(vec![]),
            ..config("bistro", 1, &["sc-i-12-10"])
        };
        let runs = run(config);
        stages(&runs[0]).join(" ")
    };
    let seen = "depth[0] mark[0] compact";
    assert_eq!(
        of(ListStore::Offsets, Assign::Brute),
        format!("{seen} transform_lights count_lights light_offsets assign_lights")
    );
    for store in [ListStore::Fixed(64), ListStore::Capped(64)] {
        assert_eq!(of(store, Assign::Brute), format!("{seen} transform_lights assign_lights"));
        let scattered = format!("{seen} cull_lights count_lights assign_lights");
        assert_eq!(of(store, Assign::Scatter), scattered);
    }
}

#[test]
fn what_grows_and_what_is_dropped_is_told() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args(["replay", "--resolution", "64x40", "--frames", "300", "--runs", "0", "--lights", "200"]);
    command.args(["--method", "indi-persp-64", "--lists", "offsets,fixed-2,capped-3", "--out"]);
    let printed = succeed(command.arg(out.path()));
    let table = text(&printed.stdout);
    assert!(table.contains("dropped"), "{table}");
    let said = stderr(&printed);
    assert!(
        said.contains("indi-persp-64_fixed-2: lists of 2 entries each were too short and have"),
        "{said}"
    );
    assert!(said.contains("warning: indi-persp-64_capped-3: lists with room for 3 lights dropped"), "{said}");
    let manifest: serde_json::Value =
        serde_json::from_str(&read(out.path().join("indi-persp-64_fixed-2/run.json"))).unwrap();
    assert!(manifest["capacities"]["list_entries"].as_u64() > Some(2), "{manifest}");
    assert_eq!(manifest["growth"][0]["buffer"], "list_entries");
    assert_eq!(manifest["config"]["lists"], "fixed-2");
    let summary = read(out.path().join("summary.csv"));
    assert!(
        summary.starts_with("method,lighting,lists,frames,visible_clusters,light_indices,lights_dropped,")
    );
    let alone = tempfile::tempdir().unwrap();
    succeed(small(alone.path()).args(["--lists", "fixed-512"]));
    assert!(!read(alone.path().join("summary.csv")).contains("lights_dropped"));
}

#[test]
fn what_cannot_be_is_refused_in_one_line() {
    let out = tempfile::tempdir().unwrap();
    for (arguments, told) in [
        (&["--lists", "fixed-0"][..], "no whole number from 1"),
        (&["--lists", "capped-5000"], "no whole number from 1 to 1024"),
        (&["--lists", "linked"], "no store of lists"),
        (&["--lists", "linked-64"], "indi-persp-64 tests lights"),
        (&["--compaction", "sorted"], "sorted"),
        (&["--compaction", "atomic", "--assign", "scatter"], "no neighbours"),
        (&["--compaction", "atomic", "--clusters", "all"], "all clusters of"),
        (&["--lists", "capped-100", "--lights", "120001,0.01"], "up to 120000 lights"),
    ] {
        let message = refused(small(out.path()).args(arguments));
        assert!(message.contains(told), "{arguments:?}: {message}");
    }
    let huge = ["--lists", "fixed-1048576", "--method", "indi-ortho-1"];
    let message = refused(small(out.path()).args(huge));
    assert!(message.contains("buffer light_indices would") && message.contains("fewer entries"), "{message}");
}
