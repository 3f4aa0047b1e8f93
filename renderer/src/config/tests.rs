use super::*;
use proptest::prelude::*;

/// The message for a configuration file with this text, without the file's name, which it must begin with.
fn refusal(text: &str) -> String {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("my.json");
    std::fs::write(&path, text).unwrap();
    let error = Config::resolve(Some(&path), Layer::default()).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    let message = error.to_string();
    assert!(!message.contains('\n'), "{message}");
    message.strip_prefix(&format!("{}: ", path.display())).expect("names the file").to_owned()
}

fn layer(text: &str) -> Layer {
    file::parse(text).unwrap()
}

fn resolved(layers: &[&str]) -> Result<Config> {
    let mut config = Config::default();
    for text in layers {
        config.apply(layer(text)).map_err(Error::Input)?;
    }
    config.check()?;
    Ok(config)
}

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(path)
}

#[test]
fn mistakes_in_files_are_named_with_line_column_and_nearest_name() {
    let cases = [
        (
            "{\n  \"runs\": 3,\n  \"mssa\": 4\n}",
            "line 3, column 3: unknown field `mssa`; did you mean `msaa`?",
        ),
        (
            "{\"displaced-volume\": \"own\"}",
            "line 1, column 2: unknown field `displaced-volume`; did you mean `displaced_volume`?",
        ),
        ("{\n  \"msaa\": 3\n}", "line 2, column 11: msaa: 3 samples a pixel: only 1 or 4"),
        (
            "{\"lights\": [{\"count\": 1},\n {\"count\": \"x\"}]}",
            "line 2, column 12: lights[1].count: invalid type: string \"x\", expected a whole number from 0 to 4294967295",
        ),
        (
            "{\"lights\": [{\"count\": 1},\n {\"counts\": 3}]}",
            "line 2, column 3: unknown field `counts`; did you mean `count`?",
        ),
        (
            "{\"lights\": [\n {\"count\": 0}]}",
            "line 2, column 2: lights[0]: 0 lights: the count is at least 1",
        ),
        (
            "{\"lights\": [{\"count\": 9, \"intensity\": 1e39}]}",
            "line 1, column 13: lights[0]: intensity inf: it must be a finite number above 0",
        ),
        (
            "{\"lights\": [{\"count\": 9, \"r0\": NaN}]}",
            "line 1, column 32: no JSON value starts here (JSON has neither NaN nor infinity)",
        ),
        (
            "{\"lights\": [{\"count\": 9, \"cutoff\": 40000}]}",
            "line 1, column 13: lights[0]: r0 0.1: it must be below the influence radius sqrt(I/I0) = 0.05",
        ),
        (
            "{\"scenes\": []}",
            "line 1, column 12: scenes: no scene: give at least one with its recording, or leave the field out",
        ),
        (
            "{\"exclude\": [{\"method\": \"encl-orto-4\"}]}",
            "exclude: the rule method=encl-orto-4 matches no run: mend its names, or leave it out",
        ),
        (
            "{\n\"methods\": []}",
            "line 2, column 12: methods: no method: name at least one, such as indi-persp-64",
        ),
        (
            "{\"methods\": [\"all-lights\", \"all-lights\"]}",
            "line 1, column 13: methods: method all-lights is named twice",
        ),
        (
            "{\"lights\": [{\"count\": 9}, {\"count\": 9}]}",
            "line 1, column 12: lights: lights 9,100,0.5,0.1 are given twice",
        ),
        (
            "{\"marking\": \"deph\"}",
            "line 1, column 13: marking: unknown value `deph`; did you mean `depth`?",
        ),
        (
            "{\"attenuation\": \"phy_red\"}",
            "line 1, column 17: attenuation: `phy_red` is no attenuation function; did you mean `phy_red_1`?",
        ),
        (
            "{\"resolution\": [0, 4]}",
            "line 1, column 16: resolution: 0x4 pixels: each side is from 1 to 16384",
        ),
        (
            "{\"resolution\": [320]}",
            "line 1, column 16: resolution: invalid length 1, expected an array of length 2",
        ),
        (
            "{\"frames\": \"9..9\"}",
            "line 1, column 12: frames: 9..9 holds no frame: the end is left out and must be above the start",
        ),
        ("{\"frames\": \"../0\"}", "line 1, column 12: frames: a step of 0 frames: the step is at least 1"),
        (
            "{\"exr\": 3}",
            "line 1, column 9: exr: invalid type: integer `3`, expected a list of frame numbers, \"all\" or \"none\"",
        ),
        (
            "{\"runs\": -1}",
            "line 1, column 10: runs: invalid value: integer `-1`, expected a whole number from 0 to 4294967295",
        ),
        ("{\"scene\": \" \"}", "line 1, column 11: scene: empty: it must name something"),
        (
            "{\"light_index_capacity\": 0}",
            "line 1, column 26: light_index_capacity: a capacity of 0: it is at least 1",
        ),
        ("{\"out\": \"\"}", "out: empty: it must name a file or directory"),
        ("{\"lights\": []}", "lights: no lighting: give at least one, such as 1000"),
        (
            "{\"scene_lights\": true, \"lights_file\": \"l.csv\"}",
            "lights, lights_file and scene_lights exclude each other: give one of them",
        ),
        ("[]", "line 1, column 1: a configuration is one JSON object, { \"field\": value, ... }"),
        ("{\n\"runs\": 1,\n}", "line 3, column 1: trailing comma"),
        ("", "line 1, column 0: EOF while parsing a value"),
    ];
    for (text, expected) in cases {
        assert_eq!(refusal(text), expected, "{text}");
    }
    assert!(refusal("{\n\"runs\": 1,\n\"runs\": 2}").starts_with("line 3, column "));
}

#[test]
fn mistakes_in_methods_are_placed() {
    assert!(
        refusal("{\"methods\": [\"indi-persp-64\",\n \"indi-perp-64\"]}")
            .starts_with("line 2, column 2: methods[1]: ")
    );
}

#[test]
fn a_missing_file_is_named() {
    let error = Config::resolve(Some(Path::new("/nowhere/my.json")), Layer::default()).unwrap_err();
    assert!(error.to_string().starts_with("/nowhere/my.json: the configuration cannot be read: "), "{error}");
    assert_eq!(error.exit_code(), 2);
}

#[test]
fn layers_replace_what_they_give_and_leave_the_rest() {
    let config = resolved(&[
        r#"{"scene": "temple", "runs": 4, "methods": ["all-lights"], "device": "llvmpipe"}"#,
        r#"{"runs": 0, "exr": [580, 300, 300], "lights": [{"count": 10000, "intensity": 20}]}"#,
    ])
    .unwrap();
    let expected = Config {
        scene: "temple".into(),
        runs: 0,
        methods: vec![MethodSpec::AllLights],
        device: Some("llvmpipe".into()),
        exr: ExrFrames::List(vec![300, 580]),
        lights: vec![Lighting { count: 10000, intensity: 20.0, cutoff: 0.5, r0: 0.1 }],
        ..Config::default()
    };
    assert_eq!(config, expected);
}

#[test]
fn sources_of_light_replace_each_other_as_one() {
    let sources = |layers: &[&str]| resolved(layers).unwrap().lights_from();
    let rain = vec![LightsFrom::Rain(Lighting::with_count(7))];
    assert_eq!(sources(&[r#"{"lights_file": "l.csv"}"#]), [LightsFrom::File("l.csv".into())]);
    assert_eq!(sources(&[r#"{"scene_lights": true}"#]), [LightsFrom::Scene]);
    assert_eq!(sources(&[r#"{"lights_file": "l.csv"}"#, r#"{"lights": [{"count": 7}]}"#]), rain);
    assert_eq!(sources(&[r#"{"lights_file": "l.csv"}"#, r#"{"scene_lights": true}"#]), [LightsFrom::Scene]);
    let default = Config::default().lights_from();
    assert_eq!(sources(&[r#"{"scene_lights": true}"#, r#"{"scene_lights": false}"#]), default);
    assert_eq!(sources(&[r#"{"scene_lights": false}"#]), default);
}

#[test]
fn a_resolved_configuration_is_a_configuration_file_again() {
    let configs = [
        Config::default(),
        Config { lights: Vec::new(), scene_lights: true, exr: ExrFrames::All, ..Config::default() },
        Config {
            scenes: vec!["street=bistro,8x4".parse().unwrap(), "temple=suntem,5..9".parse().unwrap()],
            exclude: vec!["scene=street|temple,lights=1000,method=indi-*".parse().unwrap()],
            ..Config::default()
        },
        Config { lights: Vec::new(), lights_file: Some("l.csv".into()), msaa: 4, ..Config::default() },
        Config {
            assign: vec![Assign::Auto, Assign::Brute],
            test: vec!["hs+sat-n".parse().unwrap(), Test::Auto],
            ..Config::default()
        },
        Config {
            shaders: Some("glsl".into()),
            device: Some("0".into()),
            scopes: Scopes::Frame,
            ..Config::default()
        },
    ];
    for config in configs {
        let text = serde_json::to_string(&config).unwrap();
        assert_eq!(resolved(&[&text]).unwrap(), config);
    }
}

#[test]
fn values_that_no_parser_saw_are_checked_too() {
    let wrong = [
        Config { msaa: 2, ..Config::default() },
        Config { resolution: [16385, 1], ..Config::default() },
        Config { frames: FrameRange { first: 0, end: None, step: 0 }, ..Config::default() },
        Config { lights: vec![Lighting { r0: f32::NAN, ..Lighting::with_count(1) }], ..Config::default() },
        Config {
            lights: vec![Lighting { cutoff: 1e-45, intensity: 3e38, ..Lighting::with_count(1) }],
            ..Config::default()
        },
        Config { visible_cluster_capacity: 0, ..Config::default() },
        Config { assign: vec![], ..Config::default() },
        Config { test: vec![Test::Auto, Test::Auto], ..Config::default() },
        Config { device: Some(String::new()), ..Config::default() },
        Config { shaders: Some(PathBuf::new()), ..Config::default() },
    ];
    for config in wrong {
        assert_eq!(config.check().unwrap_err().exit_code(), 2, "{config:?}");
    }
}

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
        runs: 4,
        out: "out/tuned".into(),
        ..Config::default()
    };
    assert_eq!(tuned, expected);
}

#[test]
fn ways_and_tests_are_one_or_several_and_serve_their_methods() {
    let ways = |text: &str| {
        let config = resolved(&[text]).unwrap();
        (config.assign, config.test.iter().map(ToString::to_string).collect::<Vec<_>>())
    };
    let brute = || vec![Assign::Brute];
    assert_eq!(ways("{}"), (brute(), vec!["auto".to_owned()]));
    assert_eq!(ways(r#"{"test": "exact"}"#), (brute(), vec!["exact".to_owned()]));
    let both = (vec![Assign::Scatter, Assign::Auto], vec!["hs".to_owned(), "sat-epv".to_owned()]);
    assert_eq!(ways(r#"{"assign": ["scatter", "auto"], "test": ["hs", "sat-vpe"]}"#), both);
    for (text, expected) in [
        (
            r#"{"test": "hs+satn"}"#,
            "line 1, column 10: test: `hs+satn` is no test of sphere against cluster; did",
        ),
        (r#"{"test": ["hs", 3]}"#, "line 1, column 17: test[1]: invalid type: integer `3`"),
        (r#"{"test": ["hs", "hs"]}"#, "line 1, column 10: test: hs is named twice"),
        (
            r#"{"assign": "brut"}"#,
            "line 1, column 12: assign: `brut` is no way of assignment; did you mean `brute`?",
        ),
        (r#"{"assign": []}"#, "line 1, column 12: assign: an empty list: name at least one"),
    ] {
        assert!(refusal(text).starts_with(expected), "{}", refusal(text));
    }
}

#[test]
fn the_bundled_sweep_of_tests_is_of_all_tuned_methods() {
    let config = Config::resolve(Some(&repository("configs/tests.json")), Layer::default()).unwrap();
    let parts = crate::sweep::parts(&config).unwrap();
    assert_eq!((parts.len(), parts[0].runs.len()), (1, 6 * 3 * 4));
    assert_eq!(parts[0].runs[3].name, "indi-persp-64_1000_exact");
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
            assert_eq!(part.config.runs, if file.ends_with("ci.json") { 2 } else { 4 });
        }
        let names = parts.iter().flat_map(|part| part.runs.iter().map(|run| part.full_name(run)));
        names.collect::<Vec<_>>()
    };
    for file in ["configs/thesis.json", "configs/thesis-street.json"] {
        let names = names(file);
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
fn scenes_replace_each_other_as_one() {
    let entries = |layers: &[&str]| resolved(layers).unwrap().scene_entries();
    let two = r#"{"scenes": [{"scene": "street", "recording": "bistro", "resolution": [8, 4], "frames": "5"},
        {"scene": "temple", "recording": "suntem"}]}"#;
    let read = |text: &str| text.parse::<SceneEntry>().unwrap();
    assert_eq!(entries(&[]), [read("street=bistro-vive")]);
    assert_eq!(entries(&[two]), [read("street=bistro,8x4,5"), read("temple=suntem")]);
    assert_eq!(entries(&[two, r#"{"frames": "9"}"#])[0], read("street=bistro,8x4"));
    assert_eq!(entries(&[two, r#"{"resolution": [2, 2]}"#])[0], read("street=bistro,5"));
    assert_eq!(entries(&[two, r#"{"recording": "bistro"}"#]), [read("street=bistro")]);
    let error = resolved(&[r#"{"scene": "a", "scenes": [{"scene": "b", "recording": "c"}]}"#]).unwrap_err();
    assert!(error.to_string().contains("exclude"), "{error}");
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

#[test]
fn frame_ranges_are_read_as_documented() {
    let range = |first, end, step| Ok(FrameRange { first, end, step });
    assert_eq!("300..600/40".parse(), range(300, Some(600), 40));
    assert_eq!("300..600".parse(), range(300, Some(600), 1));
    assert_eq!("300..".parse(), range(300, None, 1));
    assert_eq!("..600".parse(), range(0, Some(600), 1));
    assert_eq!("..".parse(), range(0, None, 1));
    assert_eq!("580".parse(), range(580, Some(581), 1));
    assert_eq!("/40".parse(), range(0, None, 40));
    for wrong in [
        "",
        "a",
        "..b",
        "1..2..3",
        "5/2",
        "4294967295",
        "4294967296",
        "1../",
        "-1..",
        "3..2",
        "2..2",
        "/0",
        "1 .. 2",
    ] {
        assert!(wrong.parse::<FrameRange>().is_err(), "{wrong}");
    }
}

#[test]
fn frame_ranges_leave_the_end_out_and_stay_within_the_recording() {
    let range = |text: &str| text.parse::<FrameRange>().unwrap();
    assert_eq!(range("300..600/100").frames(670).unwrap(), [300, 400, 500]);
    assert_eq!(range("/300").frames(601).unwrap(), [0, 300, 600]);
    assert_eq!(range("668..670").frames(670).unwrap(), [668, 669]);
    for (text, available) in [("668..671", 670), ("670..", 670), ("..", 0)] {
        assert!(range(text).frames(available).unwrap_err().to_string().contains("recording"), "{text}");
    }
}

#[test]
fn images_of_frames_that_are_not_rendered_are_refused() {
    let config = Config { exr: "40,300".parse().unwrap(), ..Config::default() };
    let error = config.frame_numbers(670).unwrap_err().to_string();
    assert_eq!(error, "exr: frame 300 is not among the frames rendered: widen frames, or leave it out");
    let config = Config { exr: "all".parse().unwrap(), ..Config::default() };
    assert_eq!(config.frame_numbers(670).unwrap().len(), 17);
    assert!(config.exr.contains(3));
}

#[test]
fn lightings_are_read_as_documented() {
    assert_eq!("1000".parse(), Ok(Lighting::with_count(1000)));
    assert_eq!("10000,20".parse(), Ok(Lighting { intensity: 20.0, ..Lighting::with_count(10_000) }));
    assert_eq!("5, 1, 0.25, 0.5".parse(), Ok(Lighting { count: 5, intensity: 1.0, cutoff: 0.25, r0: 0.5 }));
    for wrong in [
        "",
        "0",
        "-1",
        "1.5",
        "1,0",
        "1,nan",
        "1,inf",
        "1,1,-1",
        "1,1,1,1",
        "1,1,1,0",
        "1,100,0.5,0.1,9",
        "1,",
    ] {
        assert!(wrong.parse::<Lighting>().is_err(), "{wrong}");
    }
}

#[test]
fn resolutions_and_samples_are_read_as_documented() {
    assert_eq!(values::resolution("1280x720"), Ok([1280, 720]));
    for wrong in ["", "1280", "0x1", "1x0", "16385x1", "1x2x3", "axb", "1280X720"] {
        assert!(values::resolution(wrong).is_err(), "{wrong}");
    }
    assert_eq!((values::msaa("1"), values::msaa("4")), (Ok(1), Ok(4)));
    assert!(values::msaa("2").is_err() && values::msaa("x").is_err());
}

proptest! {
    #[test]
    fn frame_ranges_survive_being_written(first in 0..u32::MAX, length in 1..u32::MAX, step in 1..u32::MAX, open: bool) {
        let range = FrameRange { first, end: (!open).then(|| first.saturating_add(length)), step };
        prop_assert_eq!(range.to_string().parse(), Ok(range));
    }

    #[test]
    fn lightings_survive_being_written(count in 1..u32::MAX, cutoff in 1e-3_f32..1.0, r0 in 1e-3_f32..1.0) {
        let lighting = Lighting { count, intensity: 4.0, cutoff, r0 };
        prop_assert_eq!(lighting.to_string().parse(), Ok(lighting));
    }

    #[test]
    fn no_text_makes_the_parsers_panic(text in "\\PC*") {
        let _ = (text.parse::<FrameRange>(), text.parse::<Lighting>(), text.parse::<ExrFrames>(), file::parse(&text));
    }

    #[test]
    fn no_json_makes_the_reader_panic(key in "[a-z_$]{0,8}", value in "[\\[\\]{}0-9\",:a-z]{0,12}") {
        let _ = file::parse(&format!("{{\"{key}\": {value}}}"));
    }
}
