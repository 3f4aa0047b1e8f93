use super::*;
use crate::recording::load;
use glam::DQuat;
use std::io::Write;

const HEAD: &str = r#""format": "manylight.waypoints/1", "fov": 1.5, "near": 0.5, "far": 80, "dt_s": 0.125"#;

const WAYPOINTS: &str = r#""waypoints": [
    {"position": [0, 2, 0], "target": [0, 2, -5], "time_s": 1},
    {"position": [4, 2, 1], "target": [9, 2, 1], "time_s": 1.5},
    {"position": [4, 3, 1], "target": [4, 9, 1], "time_s": 3.25},
    {"position": [0, 2, 0], "target": [0, 2, 7], "time_s": 4}]"#;

fn bake_text(text: &str) -> Result<Recording> {
    let mut file = tempfile::Builder::new().prefix("flight").suffix(".json").tempfile().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    bake(file.path())
}

fn refusal(text: &str) -> String {
    let message = bake_text(text).unwrap_err().to_string();
    message.split_once(".json: ").expect("the file's name comes first").1.to_owned()
}

#[test]
fn the_camera_passes_the_waypoints_at_their_times() {
    let recording = bake_text(&format!("{{{HEAD}, {WAYPOINTS}}}")).unwrap();
    assert_eq!(recording.frame_count(), 25);
    let views = |frame| recording.views(frame, [640, 480]).unwrap()[0];
    let at = [
        (0, [0.0, 2.0, 0.0], [0.0, 0.0, -1.0]),
        (4, [4.0, 2.0, 1.0], [1.0, 0.0, 0.0]),
        (18, [4.0, 3.0, 1.0], [0.0, 1.0, 0.0]),
        (24, [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]),
    ];
    for (frame, position, forward) in at {
        let pose = views(frame).pose;
        assert!((pose.position - DVec3::from(position)).length() < 1e-6, "{frame}: {pose:?}");
        let found = pose.rotation * DVec3::NEG_Z;
        assert!((found - DVec3::from(forward)).length() < 1e-6, "{frame}: {found}");
        let right = pose.rotation * DVec3::X;
        assert!(right.y.abs() < 1e-6, "the horizon stays level: {right}");
    }
    let frustum = views(0).frustum;
    assert_eq!((frustum.z0, frustum.z1), (-80.0, -0.5));
    assert!((frustum.x1 - 0.75_f64.tan()).abs() < 1e-9);
}

#[test]
fn bundled_flights_are_baked_from_their_waypoints() {
    for name in ["hall", "aisle", "street", "city"] {
        let path = format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../recordings/{}.waypoints.json"), name);
        let (baked, bundled) = (bake(path).unwrap(), load(name).unwrap());
        assert_eq!(baked.file().source, bundled.file().source);
        assert_eq!((baked.rain(), baked.frame_count()), (bundled.rain(), bundled.frame_count()));
        // Platforms' sines may differ in a last bit, and what is rounded by one step.
        for (a, b) in baked.file().frames.iter().zip(&bundled.file().frames) {
            assert!((a.head.position - b.head.position).length() < 2e-6, "{name}: {a:?} {b:?}");
            assert!((a.head.rotation - b.head.rotation).length() < 1e-9, "{name}: {a:?} {b:?}");
        }
    }
}

#[test]
fn the_camera_jumps_at_a_cut_and_stands_before_it() {
    let cut = r#""waypoints": [
        {"position": [0, 2, 0], "target": [0, 2, -5], "time_s": 0},
        {"position": [1, 2, 0], "target": [1, 2, -5], "time_s": 0.25},
        {"position": [9, 3, 0], "target": [9, 3, 5], "time_s": 0.5, "cut": true},
        {"position": [8, 1, 0], "target": [2, 1, 0], "time_s": 0.75, "cut": true},
        {"position": [7, 1, 0], "target": [2, 1, 0], "time_s": 1}]"#;
    let recording = bake_text(&format!("{{{HEAD}, {cut}}}")).unwrap();
    let places: Vec<[f64; 3]> =
        recording.file().frames.iter().map(|frame| frame.head.position.to_array()).collect();
    let x = [0.0, 0.5, 1.0, 1.0, 9.0, 9.0, 8.0, 7.5, 7.0];
    let y = [2.0, 2.0, 2.0, 2.0, 3.0, 3.0, 1.0, 1.0, 1.0];
    let expected: Vec<[f64; 3]> = x.into_iter().zip(y).map(|(x, y)| [x, y, 0.0]).collect();
    assert_eq!(places, expected);
    let ahead = |frame: usize| recording.file().frames[frame].head.rotation * DVec3::NEG_Z;
    assert!((ahead(3) - DVec3::NEG_Z).length() < 1e-6 && (ahead(4) - DVec3::Z).length() < 1e-6);
    let first = cut.replacen(r#""time_s": 0}"#, r#""time_s": 0, "cut": true}"#, 1);
    assert!(refusal(&format!("{{{HEAD}, {first}}}")).contains("waypoints[0].cut: there is nothing before"));
}

#[test]
fn eyes_and_rain_are_handed_on() {
    let extra = r#""hmd": {"name": "pair", "eyes": [
        {"name": "l", "rows": [[-1, 0, 0, 0, 0, 0, 1, -1, 1, -1, 1]]},
        {"name": "r", "rows": [[1, 0, 0, 0, 0, 0, 1, -1, 1, -1, 1]]}]},
        "rain": {"seed": 7, "box_min": [0, 0, 0], "box_max": [1, 1, 1], "velocity_min": [0, -1, 0],
        "velocity_max": [0, -1, 0], "tint": [1, 1], "gravity_step": [0, 0, 0], "damping": 1, "respawn_slab": 0.5}"#;
    let recording = bake_text(&format!("{{{HEAD}, {extra}, {WAYPOINTS}}}")).unwrap();
    assert_eq!(recording.view_names(), ["l", "r"]);
    assert_eq!(recording.rain().unwrap().seed, 7);
    let plain = bake_text(&format!("{{{HEAD}, {WAYPOINTS}}}")).unwrap();
    assert_eq!(plain.rain(), None);
}

#[test]
fn a_saved_recording_loads_with_the_same_bits() {
    let recording = bake_text(&format!("{{{HEAD}, {WAYPOINTS}}}")).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("flight.json");
    recording.save(&path).unwrap();
    let loaded = load(path.to_str().unwrap()).unwrap();
    assert_eq!((loaded.file(), loaded.sha256()), (recording.file(), recording.sha256()));
    assert_eq!(loaded.name(), "flight");
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1, "no temporary file stays");
    assert!(recording.save(path.join("below a file.json")).is_err());
}

#[test]
fn a_camera_that_looks_up_keeps_its_yaw() {
    let level = look_along(DVec3::new(-1.0, 0.0, 0.0), 0.0).unwrap();
    assert!((level[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    let up = look_along(DVec3::new(0.0, 3.0, 0.0), level[0]).unwrap();
    assert_eq!(up, [level[0], std::f64::consts::FRAC_PI_2]);
    assert_eq!(look_along(DVec3::ZERO, 0.0), None);
    let q = DQuat::from_rotation_y(level[0]);
    assert!((q * DVec3::NEG_Z - DVec3::NEG_X).length() < 1e-12);
}

#[test]
fn bad_waypoints_are_refused_with_line_and_field() {
    let with = |from: &str, to: &str| refusal(&format!("{{{HEAD}, {WAYPOINTS}}}").replace(from, to));
    let second = "line 3, column ";
    let message = with("\"time_s\": 1.5", "\"time_s\": 1");
    assert!(
        message.starts_with(second) && message.contains("waypoints[1].time_s: does not lie after 1"),
        "{message}"
    );
    let message = with("[9, 2, 1]", "[4, 2, 1]");
    assert!(message.starts_with(second) && message.contains("waypoints[1].target"), "{message}");
    let message = with("[9, 2, 1]", "[9, 2]");
    assert!(message.starts_with(second) && message.contains("waypoints[1].target"), "{message}");
    assert!(with("\"fov\": 1.5", "\"fov\": 3.2").contains("fov: 3.2"));
    assert!(with("\"fov\"", "\"fow\"").contains("unknown field `fow`"));
    assert!(with("\"near\": 0.5", "\"near\": 80").contains("far: 80"));
    assert!(with("0.125", "1e-9").contains("dt_s: makes "));
    assert!(with("0.125", "0").contains("dt_s: 0 is no time step"));
    assert!(with("manylight.waypoints/1", "manylight.waypoints/2").contains("`manylight.waypoints/1`"));
    let one = r#""waypoints": [{"position": [0, 2, 0], "target": [0, 2, -5], "time_s": 1}]"#;
    assert!(refusal(&format!("{{{HEAD}, {one}}}")).contains("waypoints: give at least two"));
}

#[test]
fn a_spline_through_its_own_target_is_refused() {
    let crossing = r#""waypoints": [
        {"position": [-1, 0, 0], "target": [1, 0, 0], "time_s": 0},
        {"position": [1, 0, 0], "target": [-1, 0, 0], "time_s": 1}]"#;
    assert!(refusal(&format!("{{{HEAD}, {crossing}}}")).contains("at 0.5 s (frame 4)"));
}
