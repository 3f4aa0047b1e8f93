//! How files and flags go over one another.

use super::*;
use crate::lights::SpotShare;

#[test]
fn layers_replace_what_they_give_and_leave_the_rest() {
    let config = resolved(&[
        r#"{"scene": "temple", "runs": 4, "methods": ["all-lights"], "device": "llvmpipe"}"#,
        r#"{"runs": 0, "exr": [580, 300, 300], "lights": [{"count": 10000, "intensity": 20}]}"#,
    ])
    .unwrap();
    let expected = Config {
        scene: "temple".into(),
        runs: 0.into(),
        methods: vec![Method::AllLights],
        device: Some("llvmpipe".into()),
        exr: ExrFrames::List(vec![300, 580]),
        lights: vec![Lighting { count: 10000, intensity: 20.0, cutoff: 0.5, r0: 0.1 }],
        ..Config::default()
    };
    assert_eq!(config, expected);
}

#[test]
fn every_spelling_of_the_text_is_the_same_configuration() {
    let path = tempfile::NamedTempFile::new().unwrap().into_temp_path();
    for bytes in crate::text::tests::spellings("{\n\"runs\": 7,\n\"strict\": true\n}\n") {
        std::fs::write(&path, bytes).unwrap();
        let config = Config::resolve(Some(&path), Layer::default()).unwrap();
        assert_eq!((config.runs, config.strict), (7.into(), true));
    }
}

#[test]
fn sources_of_light_replace_each_other_as_one() {
    let sources = |layers: &[&str]| resolved(layers).unwrap().lights_from();
    let rain = vec![LightsFrom::Generated(Generator::Rain, Lighting::with_count(7), SpotShare::default())];
    assert_eq!(sources(&[r#"{"lights_file": "l.csv"}"#]), [LightsFrom::File("l.csv".into())]);
    assert_eq!(sources(&[r#"{"scene_lights": true}"#]), [LightsFrom::Scene]);
    assert_eq!(sources(&[r#"{"lights_file": "l.csv"}"#, r#"{"lights": [{"count": 7}]}"#]), rain);
    assert_eq!(sources(&[r#"{"lights_file": "l.csv"}"#, r#"{"scene_lights": true}"#]), [LightsFrom::Scene]);
    let default = Config::default().lights_from();
    assert_eq!(sources(&[r#"{"scene_lights": true}"#, r#"{"scene_lights": false}"#]), default);
    assert_eq!(sources(&[r#"{"scene_lights": false}"#]), default);
}

#[test]
fn a_generator_is_replaced_with_all_that_was_said_to_it() {
    let last = |layers: &[&str]| resolved(layers).unwrap().lights_from().remove(0);
    let generator = |layers: &[&str]| match last(layers) {
        LightsFrom::Generated(generator, ..) => generator,
        other => panic!("{other}"),
    };
    let gamma = r#"{"light_source": "gamma", "light_seed": 9, "light_radius_mean": 2, "light_box": "rain"}"#;
    let recipe = GammaRecipe {
        seed: 9,
        radii: GammaRadii { mode: 0.25, mean: 2.0 },
        motion: LightMotion::Static,
        moving: 1.0,
    };
    assert_eq!(generator(&[gamma]), Generator::Gamma(LightBox::Rain, recipe));
    let seeded = GammaRecipe { seed: 3, ..recipe };
    assert_eq!(generator(&[gamma, r#"{"light_seed": 3}"#]), Generator::Gamma(LightBox::Rain, seeded));
    assert_eq!(generator(&[gamma, r#"{"light_source": "gamma"}"#]), Generator::Gamma(LightBox::Rain, recipe));
    let usual = VolumeRecipe { seed: 1, volumes: vec![], set: None };
    assert_eq!(
        generator(&[gamma, r#"{"light_source": "volume"}"#]),
        Generator::Volume(LightBox::Scene, usual)
    );
    assert_eq!(generator(&[gamma, r#"{"light_source": "rain"}"#]), Generator::Rain);
    assert_eq!(last(&[gamma, r#"{"scene_lights": true}"#]), LightsFrom::Scene);
    assert_eq!(last(&[gamma, r#"{"lights_file": "l.csv"}"#]), LightsFrom::File("l.csv".into()));
    for elsewhere in [r#"{"scene_lights": true}"#, r#"{"lights_file": "l.csv"}"#] {
        assert_eq!(generator(&[elsewhere, gamma]), Generator::Gamma(LightBox::Rain, recipe));
        assert_eq!(generator(&[elsewhere, r#"{"light_source": "rain"}"#]), Generator::Rain);
    }
    let seven = last(&[gamma, r#"{"lights": [{"count": 7}]}"#]);
    assert_eq!(
        seven,
        LightsFrom::Generated(
            Generator::Gamma(LightBox::Rain, recipe),
            Lighting::with_count(7),
            SpotShare::default()
        )
    );
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
            light_source: GeneratorKind::Gamma,
            light_seed: Some(u64::MAX),
            light_box: Some("-1,0,-1,1,0.1,1".parse().unwrap()),
            light_motion: Some(LightMotion::Bounce),
            light_moving: Some(0.25),
            light_radius_mode: Some(0.1),
            light_radius_mean: Some(0.3),
            ..Config::default()
        },
        Config {
            light_source: GeneratorKind::Volume,
            light_box: Some(LightBox::Rain),
            light_volumes: vec!["10x5x10".parse().unwrap(), "scene:5x5x20:0,0,1,1:2.5".parse().unwrap()],
            light_set: Some("1x_1y_1z".parse().unwrap()),
            ..Config::default()
        },
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

#[test]
fn scenes_may_have_lights_of_their_own() {
    let own = r#"{"light_source": "volume", "lights": [{"count": 8}], "light_volumes": ["2x2x2"], "scenes": [
        {"scene": "hall", "recording": "hall", "lights": [{"count": 12}, {"count": 24}],
         "light_volumes": ["0,0,0,1,1,1:3x2x2:5"]}, {"scene": "street", "recording": "bistro"}]}"#;
    let lights = |layers: &[&str]| {
        let told = |config: &Config| {
            let counts: Vec<u32> = config.lights.iter().map(|lighting| lighting.count).collect();
            (counts, config.light_volumes.iter().map(ToString::to_string).collect::<Vec<_>>())
        };
        resolved(layers).map(|config| config.by_scene().iter().map(told).collect::<Vec<_>>())
    };
    let all = || (vec![8], vec!["2x2x2".to_owned()]);
    let hall = (vec![12, 24], vec!["0,0,0,1,1,1:3x2x2:5".to_owned()]);
    assert_eq!(lights(&[own]).unwrap(), [hall, all()]);
    let flags = r#"{"light_volumes": ["2x2x2"], "lights": [{"count": 8}]}"#;
    assert_eq!(lights(&[own, flags]).unwrap(), [all(), all()]);
    assert_eq!(lights(&[own, r#"{"light_source": "rain"}"#]).unwrap()[0], (vec![12, 24], vec![]));
    assert_eq!(lights(&[own, r#"{"scene_lights": true}"#]).unwrap(), [(vec![], vec![]), (vec![], vec![])]);
    // Of each scene, lights are checked by its own volumes.
    let wrong = own.replace(r#"{"count": 24}"#, r#"{"count": 25}"#);
    let error = lights(&[&wrong]).unwrap_err().to_string();
    assert!(error.contains("25 lights: no set of lattices with 12 in all"), "{error}");
}

#[test]
fn one_resolution_and_several_replace_each_other() {
    let sides = |layers: &[&str]| {
        let config = resolved(layers).unwrap();
        config.by_scene().iter().map(|scene| scene.resolution).collect::<Vec<_>>()
    };
    let (several, one) = (r#"{"resolutions": [[8, 8], [16, 8]]}"#, r#"{"resolution": [4, 2]}"#);
    assert_eq!(sides(&[several]), [[8, 8], [16, 8]]);
    assert_eq!(sides(&[several, one]), [[4, 2]]);
    assert_eq!(sides(&[one, several]), [[8, 8], [16, 8]]);
    let both = r#"{"resolution": [4, 2], "resolutions": [[8, 8]]}"#;
    assert!(refusal(both).contains("resolutions excludes resolution"), "{}", refusal(both));
    let twice = r#"{"resolutions": [[8, 8], [8, 8]]}"#;
    assert!(refusal(twice).contains("8x8 is named twice"), "{}", refusal(twice));
    let config = resolved(&[several]).unwrap();
    assert_eq!(resolved(&[&serde_json::to_string(&config).unwrap()]).unwrap(), config);
}
