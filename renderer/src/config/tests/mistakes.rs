//! What is refused, and in which words.

use super::*;

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
            "line 1, column 9: exr: invalid type: integer `3`, expected a list of frame numbers, \"all\", \"none\" or \"discontinuity\"",
        ),
        (
            "{\"runs\": -1}",
            "line 1, column 10: runs: invalid value: integer `-1`, expected a whole number from 0 to 4294967295 or \"auto\"",
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
        (
            "{\"scene_lights\": true, \"light_source\": \"gamma\"}",
            "light_source excludes lights_file and scene_lights: give one of them",
        ),
        (
            "{\"light_source\": \"gama\"}",
            "line 1, column 18: light_source: unknown value `gama`; did you mean `gamma`?",
        ),
        (
            "{\"light_box\": \"0,0,0,1,1,0\"}",
            "line 1, column 15: light_box: the box 0,0,0,1,1,0 is empty: X1, Y1 and Z1 must lie above X0, Y0 and Z0",
        ),
        (
            "{\"light_seed\": 3}",
            "light_seed: lights by rain have none: leave it out, or set light_source to gamma or volume",
        ),
        (
            "{\"light_source\": \"volume\", \"light_motion\": \"bounce\"}",
            "light_motion: lights by volume have none: leave it out, or set light_source to gamma",
        ),
        (
            "{\"light_source\": \"gamma\", \"light_moving\": 0.5}",
            "light_moving: static lights do not move: leave it out, or set light_motion to bounce",
        ),
        (
            "{\"light_source\": \"gamma\", \"light_motion\": \"bounce\", \"light_moving\": 1.5}",
            "light_moving: 1.5 is no part of the lights: give 0 to 1",
        ),
        (
            "{\"light_source\": \"gamma\", \"light_radius_mean\": 0.2}",
            "lights: a most frequent radius of 0.25 m: it is at least 0 and below the mean radius, 0.2 m",
        ),
        (
            "{\"light_source\": \"gamma\", \"lights\": [{\"count\": 5, \"intensity\": 20}]}",
            "lights: 5,20,0.5,0.1: each light's intensity is I0*R1^2 by its radius: leave I out, or at 100",
        ),
        (
            "{\"light_source\": \"volume\", \"light_set\": \"1x_3y_1z\"}",
            "lights: 1000 lights: the set 1x_3y_1z has a multiple of 3, such as 999",
        ),
        (
            "{\"light_source\": \"volume\", \"light_volumes\": [\"10x4\"]}",
            "line 1, column 46: light_volumes[0]: `10x4` is no volume of lights [BOX:]NXxNYxNZ[:QX,QY,QZ,QW][:R1] such as \
             -5,0,-5,5,4,5:10x4x10",
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
fn images_of_frames_that_are_not_rendered_are_refused() {
    let config = Config { exr: "40,300".parse().unwrap(), ..Config::default() };
    let error = config.frame_numbers(670).unwrap_err().to_string();
    assert_eq!(error, "exr: frame 300 is not among the frames rendered: widen frames, or leave it out");
    let config = Config { exr: "all".parse().unwrap(), ..Config::default() };
    assert_eq!(config.frame_numbers(670).unwrap().len(), 17);
    assert!(config.exr.contains(3));
}

#[test]
fn frames_that_counting_finds_are_for_images_alone() {
    let found = Config { exr: "discontinuity".parse().unwrap(), ..Config::default() };
    found.check().unwrap();
    assert_eq!(found.frame_numbers(670).unwrap().len(), 17);
    assert!(!found.exr.is_empty() && !found.exr.contains(40), "which they are is not known yet");
    let json = serde_json::to_value(&found).unwrap();
    assert_eq!(json["exr"], "discontinuity");
    assert_eq!(serde_json::from_value::<Config>(json).unwrap(), found);
    let traced = Config { trace: found.exr, ..Config::default() };
    let error = traced.check().unwrap_err().to_string();
    assert!(error.starts_with("trace: discontinuity finds frames for images alone"), "{error}");
}
