//! The configurations and the schema that come along.

use super::*;
use crate::assign::ListStore;

#[test]
fn bundled_configurations_say_what_they_should() {
    let default = Config::resolve(Some(&repository("configs/default.json")), Layer::default()).unwrap();
    assert_eq!(default, Config::default());
    let tuned = Config::resolve(Some(&repository("configs/tuned.json")), Layer::default()).unwrap();
    let lighting = |count, intensity| Lighting { count, intensity, cutoff: 0.5, r0: 0.1 };
    let expected = Config {
        resolution: [640, 720],
        lights: vec![lighting(1000, 100.0), lighting(10_000, 20.0), lighting(100_000, 1.0)],
        frames: FrameRange { first: 0, end: None, step: 1 },
        runs: 4.into(),
        out: "out/tuned".into(),
        ..Config::default()
    };
    assert_eq!(tuned, expected);
}

#[test]
fn the_bundled_sweep_to_repeat_compares_with_indi_persp_64() {
    let config = Config::resolve(Some(&repository("configs/repeat.json")), Layer::default()).unwrap();
    let runs = &crate::sweep::parts(&config).unwrap()[0].runs;
    assert_eq!((runs.len(), runs[0].name.as_str()), (2 * 19, "indi-persp-64_1000"));
}

#[test]
fn the_bundled_sweep_of_tests_is_of_all_tuned_methods() {
    let config = Config::resolve(Some(&repository("configs/tests.json")), Layer::default()).unwrap();
    let parts = crate::sweep::parts(&config).unwrap();
    // Boxes of the world are seen in no rectangles.
    assert_eq!((parts.len(), parts[0].runs.len()), (1, (6 * 4 + 4) * 3));
    assert_eq!(parts[0].runs[3].name, "indi-persp-64_1000_exact");
    assert_eq!(parts[0].runs[4].name, "indi-persp-64_1000_mm");
    assert!(parts[0].runs.iter().all(|run| run.check().is_ok()));
}

#[test]
fn the_bundled_sweep_of_ortiz_compares_boxes_clusters_and_slices() {
    let config = Config::resolve(Some(&repository("configs/ortiz-ci.json")), Layer::default()).unwrap();
    let parts = crate::sweep::parts(&config).unwrap();
    assert_eq!(parts.iter().map(|part| part.runs.len()).collect::<Vec<_>>(), [27, 25]);
    let runs = || parts.iter().flat_map(|part| &part.runs);
    assert!(runs().all(|run| run.check().is_ok()));
    for value in ["box_all_geometric", "exact_visible_uniform-view", "100_box_visible_uniform-ndc"] {
        assert!(runs().any(|run| run.name.ends_with(value)), "{value}");
    }
}

#[test]
fn bundled_sweeps_are_the_experiments_of_the_thesis() {
    let names = |file: &str| {
        let config = Config::resolve(Some(&repository(file)), Layer::default()).unwrap();
        let parts = crate::sweep::parts(&config).unwrap();
        for part in &parts {
            let eye = part.config.recording.ends_with("-vive");
            let [width, height] = part.config.resolution;
            assert_eq!(
                (width, height),
                if eye { (height * 8 / 9, height) } else { (height * 16 / 9, height) }
            );
            assert_eq!(part.config.runs, if file.ends_with("ci.json") { 2.into() } else { 4.into() });
        }
        let names = parts.iter().flat_map(|part| part.runs.iter().map(|run| part.full_name(run)));
        names.collect::<Vec<_>>()
    };
    for file in ["configs/thesis.json", "configs/thesis-street.json"] {
        let names = names(file);
        // Figures 6.1 and 4.8 show two frames, C.1 and C.2 two of the temple.
        let config = Config::resolve(Some(&repository(file)), Layer::default()).unwrap();
        for part in crate::sweep::parts(&config).unwrap() {
            let temple = part.config.recording.starts_with("suntem");
            let shown = if temple { "250,300,580,680" } else { "250,300,580" };
            assert_eq!(part.config.exr, shown.parse().unwrap(), "{file}: {}", part.config.recording);
        }
        // Nineteen methods in mono and six in stereo, under three lightings, in two scenes.
        assert_eq!(names.len(), (19 + 6) * 3 * 2, "{file}");
        let count = |part: &str| names.iter().filter(|name| name.contains(part)).count();
        assert_eq!((count("vive/indi-"), count("vive/encl-"), count("encl-")), (18, 18, 18), "{file}");
    }
    let all = names("configs/thesis-street.json");
    let small = names("configs/thesis-ci.json");
    assert!(small.iter().all(|name| all.contains(name)));
}

#[test]
fn bundled_evaluations_are_the_steps_of_enhuber() {
    // A scene's sizes of tiles and clusters, and of boxes, under 10 000 lights; and how often there are fewer lights.
    for (file, frusta, boxes, fewer) in
        [("enhuber", 14 + 4 * 30, 7 + 1, 5), ("enhuber-ci", 6 + 4 * 4, 3 + 1, 2)]
    {
        let config = Config::resolve(Some(&repository(&format!("configs/{file}.json"))), Layer::default());
        let parts = crate::sweep::parts(&config.unwrap()).unwrap();
        assert_eq!(parts.len(), 3, "{file}: scenes");
        for part in &parts {
            let count = |of: &dyn Fn(&str) -> bool| part.runs.iter().filter(|run| of(&run.name)).count();
            // Two methods by 17 further tests, eight under fewer lights.
            assert_eq!(part.runs.len(), frusta + boxes + 2 * 17 + 8 * fewer, "{file}");
            assert_eq!(count(&|name| name.ends_with("_10000_hs+sat-n")), frusta, "{file}");
            assert_eq!(count(&|name| name.starts_with("g-") && !name.ends_with("_box")), 0, "{file}");
            assert_eq!(
                count(&|name| name.starts_with("m_") && name.ends_with("_exact")),
                fewer + 1,
                "{file}"
            );
            let tests: std::collections::BTreeSet<&str> =
                part.runs.iter().filter_map(|run| run.name.rsplit('_').next()).collect();
            assert_eq!(tests.len(), 18 + 2, "{file}: {tests:?}");
        }
    }
}

#[test]
fn the_bundled_sweep_of_moving_lights_has_every_slack_beside_octrees_that_are_rebuilt() {
    let file = repository("configs/tegelaers-dynamic.json");
    let parts = crate::sweep::parts(&Config::resolve(Some(&file), Layer::default()).unwrap()).unwrap();
    let ways = ["rebuild", "dynamic-1.1", "dynamic-1.25", "dynamic-1.5", "dynamic-2", "dynamic-3"];
    for part in &parts {
        let found = part.runs.iter().map(|run| run.config.octree[0].to_string());
        assert!(found.eq(ways), "{}", part.config.scene);
    }
    assert_eq!(parts.len(), 2, "scenes");
}

#[test]
fn bundled_sweeps_of_ortegren_have_his_grids_and_numbers_of_lights() {
    let part = |file: &str| {
        let config = Config::resolve(Some(&repository(&format!("configs/{file}.json"))), Layer::default());
        crate::sweep::parts(&config.unwrap()).unwrap().remove(0)
    };
    for (file, resolution) in [("ortegren", [1536, 768]), ("ortegren-ci", [384, 192])] {
        let part = part(file);
        assert_eq!(part.config.resolution, resolution);
        let of = |lists: &str| {
            let lists: ListStore = lists.parse().unwrap();
            part.runs.iter().filter(|run| run.config.lists == [lists]).count()
        };
        // Twelve grids under four numbers of lights; the deep one of few tiles with nodes of 32 bits too.
        assert_eq!([of("linked-64-unsorted"), of("linked-32-unsorted")], [12 * 4, 2 * 4], "{file}");
    }
    let tests = part("ortegren-tests");
    let count = |method: &str| tests.runs.iter().filter(|run| run.name.starts_with(method)).count();
    // Two laws by three ways under two numbers of lights.
    assert_eq!([count("ortiz-24-12-32"), count("ortiz-24-12-128"), count("tiled-16")], [12, 12, 2]);
}

#[test]
fn bundled_sweeps_of_tegelaers_have_his_sets_and_resolutions() {
    // Of three scenes, the sides of the squares; of each, the runs of all.
    for (file, sides, runs) in [("tegelaers", 7, 1356), ("tegelaers-ci", 3, 224), ("tegelaers-many", 1, 126)]
    {
        let config = Config::resolve(Some(&repository(&format!("configs/{file}.json"))), Layer::default());
        let parts = crate::sweep::parts(&config.unwrap()).unwrap();
        assert_eq!(parts.len(), 3 * sides, "{file}");
        assert_eq!(parts.iter().map(|part| part.runs.len()).sum::<usize>(), runs, "{file}");
        for part in &parts {
            let Config { resolution: [width, height], scene, lights, .. } = &part.config;
            assert_eq!(width, height, "{file}");
            let base = lights[0].count;
            assert!(
                file == "tegelaers-many"
                    || [("street", 58), ("hall", 70), ("city", 65)].contains(&(scene.as_str(), base))
            );
            assert!(lights.iter().all(|lighting| lighting.count.is_multiple_of(base)), "{file}: {scene}");
        }
    }
}

/// `MANYLIGHT_BLESS=1` rewrites the schema.
#[test]
fn the_schema_is_in_step() {
    let path = repository("configs/manylight.schema.json");
    let schema = serde_json::to_string_pretty(&json_schema()).unwrap() + "\n";
    if std::env::var_os("MANYLIGHT_BLESS").is_some_and(|value| value == "1") {
        std::fs::write(&path, &schema).unwrap();
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(stored == schema, "{} is out of step: run the tests with MANYLIGHT_BLESS=1", path.display());
}

#[test]
fn the_schema_has_the_defaults_and_refuses_unknown_fields() {
    let schema = json_schema();
    assert_eq!(schema["additionalProperties"], false);
    assert_eq!(schema.get("required"), None);
    assert_eq!(schema["properties"]["resolution"]["default"], serde_json::json!([320, 180]));
    assert_eq!(schema["properties"]["lights"]["default"][0]["r0"], 0.1);
    assert_eq!(schema["$defs"]["Lighting"]["properties"]["r0"]["default"], 0.1);
}
