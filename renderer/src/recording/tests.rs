use super::*;
use glam::{DQuat, DVec3};
use proptest::prelude::*;

/// A recording of two frames with one eye, a line a field from line 2 on.
const SMALL: &str = r#"{
"format": "manylight.recording/1",
"source": {"text": "by hand"},
"dt_s": 0.5,
"near": 0.25,
"far": 64,
"rain": {"seed": 1, "box_min": [0, 0, 0], "box_max": [1, 1, 1], "velocity_min": [0, -2, 0], "velocity_max": [0, -1, 0], "tint": [0.5, 1], "gravity_step": [0, 0, 0], "damping": 1, "respawn_slab": 0.1},
"hmd": {"name": "h", "eyes": [{"name": "e", "rows": [[0, 0, -1, 0, 0, 0, 1, -1, 2, -3, 4], [0, 0, -2, 0, 0, 0, 1, -1, 1, -1, 1]]}]},
"frames": [
[1, 2, 3, 0, 0.6, 0, 0.8, 1.5],
[1, 2, 3, 0, 0, 0, 1, 1.5]
]
}
"#;

fn small(from: &str, to: &str) -> Result<Recording> {
    assert!(SMALL.contains(from), "{from}");
    parse("small", Path::new("small.json"), SMALL.replacen(from, to, 1).as_bytes())
}

fn refusal(from: &str, to: &str) -> String {
    small(from, to).unwrap_err().to_string()
}

#[test]
fn bundled_recordings_load_and_play() {
    for (name, frames, views) in [
        ("bistro", 670, 1),
        ("suntem", 885, 1),
        ("hall", 1200, 1),
        ("aisle", 91, 1),
        ("bistro-vive", 670, 2),
        ("bistro-mirror", 670, 3),
        ("suntem-vive", 885, 2),
        ("hall-vive", 1200, 2),
    ] {
        let recording = load(name).unwrap();
        assert_eq!((recording.name(), recording.frame_count()), (name, frames));
        assert_eq!(recording.view_names().len(), views);
        assert_eq!(recording.views(frames - 1, [640, 360]).unwrap().len(), views);
        assert!((recording.time(90) - 1.0).abs() < 1e-12);
        assert_eq!(recording.sha256().len(), 64);
    }
}

#[test]
fn the_field_of_view_spans_the_longer_axis() {
    let recording = load("bistro").unwrap();
    let half = (0.5_f64 * 1.261_062_145_2).tan();
    let wide = recording.views(0, [1280, 720]).unwrap()[0].frustum;
    let tall = recording.views(0, [720, 1280]).unwrap()[0].frustum;
    assert_eq!((wide.x0, wide.x1, wide.z0, wide.z1), (-half, half, -100.0, -0.4));
    assert_eq!((wide.y0, wide.y1), (-half * 0.5625, half * 0.5625));
    assert_eq!((tall.x0, tall.x1, tall.y0, tall.y1), (wide.y0, wide.y1, wide.x0, wide.x1));
}

#[test]
fn the_mirror_is_a_puddle_beside_the_eyes_of_the_vive() {
    let (vive, mirror) = (load("bistro-vive").unwrap(), load("bistro-mirror").unwrap());
    assert_eq!(mirror.view_names(), ["left", "right", "mirror"]);
    assert_eq!(mirror.view_set(), ViewSet { count: 3, mirrors: true });
    assert!(!vive.view_set().mirrors);
    for frame in [0, 300, 669] {
        let views = mirror.views(frame, [640, 720]).unwrap();
        assert_eq!(views[..2], vive.views(frame, [640, 720]).unwrap());
        let head = mirror.file().frames[frame as usize].head.position;
        let eye = views[2].eye();
        assert!((eye - DVec3::new(head.x, 0.04 - head.y, head.z)).length() < 1e-12, "{eye} below {head}");
        assert!(views[2].world_from_view().determinant() < 0.0);
        assert!(views[2].frustum.x0 <= views[0].frustum.x0 && views[2].frustum.x1 >= views[1].frustum.x1);
    }
}

#[test]
fn mirrors_move_frame_by_frame_and_broken_ones_are_refused() {
    let mirror = |rows: &str| {
        let eye = format!("\"name\": \"e\", \"mirror\": {rows}");
        small("\"name\": \"e\"", &eye).map(|recording| {
            let offset = |frame| recording.views(frame, [4, 4]).unwrap()[0].pose.mirror.unwrap().offset;
            (0..recording.frame_count()).map(offset).collect::<Vec<_>>()
        })
    };
    assert_eq!(mirror("[[0, 1, 0, 7]]").unwrap(), [7.0, 7.0]);
    assert_eq!(mirror("[[0, 1, 0, 7], [0, 0.6, -0.8, -9]]").unwrap(), [7.0, -9.0]);
    assert!(
        small("\"name\": \"e\"", "\"name\": \"e\", \"mirror\": []").unwrap().views(0, [4, 4]).unwrap()[0]
            .pose
            .mirror
            .is_none()
    );
    for (rows, words) in [
        ("[[0, 1, 1, 7]]", ": hmd.eyes[0].mirror[0]: the normal (elements 0 to 2) has length 1.414"),
        ("[[0, 1, 0, 1e7]]", ": hmd.eyes[0].mirror[0][3]: 10000000 is not within"),
        ("[[0, 1, 0, 1], [0, 1, 0, 2], [0, 1, 0, 3]]", "hmd.eyes[0].mirror: has 3 rows; give 1, or 2"),
        ("[[0, 1, 0]]", "hmd.eyes[0].mirror[0]"),
    ] {
        let message = mirror(rows).unwrap_err().to_string();
        assert!(message.contains(words), "'{message}' does not say '{words}'");
    }
}

#[test]
fn eyes_ride_on_the_head_with_their_own_tangents() {
    let (mono, vive) = (load("bistro").unwrap(), load("bistro-vive").unwrap());
    for frame in [0, 300, 580] {
        let head = mono.views(frame, [640, 720]).unwrap()[0].pose;
        let eyes = vive.views(frame, [640, 720]).unwrap();
        let apart = eyes[1].pose.position - eyes[0].pose.position;
        assert!((apart - head.rotation * DVec3::new(0.0614, 0.0, 0.0)).length() < 1e-12);
        let centre = 0.5 * (eyes[0].pose.position + eyes[1].pose.position);
        assert!((centre - head.position - head.rotation * DVec3::new(0.0, 0.0, 0.015)).length() < 1e-12);
        assert_eq!((eyes[0].frustum.x0, eyes[1].frustum.y1), (-1.3896277, 1.4637187));
        assert!(eyes[0].pose.rotation.angle_between(head.rotation) < 1e-7);
    }
}

#[test]
fn eyes_may_move_from_frame_to_frame() {
    let recording = small("\"far\"", "\"far\"").unwrap();
    let (first, second) = (recording.views(0, [4, 4]).unwrap()[0], recording.views(1, [4, 4]).unwrap()[0]);
    // Turned by 2*atan(0.6/0.8) about +Y, the head's -z is (-0.96, 0, -0.28).
    assert!((first.pose.position - DVec3::new(0.04, 2.0, 2.72)).length() < 1e-12, "{first:?}");
    assert!((second.pose.position - DVec3::new(1.0, 2.0, 1.0)).length() < 1e-12);
    assert_eq!((first.frustum.y1, second.frustum.y1), (4.0, 1.0));
    assert!(first.pose.rotation.is_normalized());
}

#[test]
fn frames_and_resolutions_that_are_none_are_refused() {
    let recording = load("bistro").unwrap();
    let message = recording.views(670, [4, 4]).unwrap_err().to_string();
    assert_eq!(message, "recording bistro has no frame 670; it has 0 to 669");
    assert!(recording.views(0, [4, 0]).unwrap_err().to_string().contains("4x0"));
}

#[test]
fn names_and_files_that_do_not_exist_are_refused() {
    let message = load("bistro-viv").unwrap_err().to_string();
    assert!(
        message.contains("bistro, suntem") && message.ends_with("did you mean `bistro-vive`?"),
        "{message}"
    );
    assert!(!load("zzz").unwrap_err().to_string().contains("mean"));
    assert!(load("no/such.json").unwrap_err().to_string().starts_with("no/such.json: "));
}

#[test]
fn every_broken_rule_is_named_with_line_and_field() {
    for (from, to, wanted) in [
        ("recording/1", "recording/2", "line 2, column "),
        ("recording/1", "recording/2", "expected `manylight.recording/1`"),
        ("\"dt_s\": 0.5", "\"dt_s\": 0", "line 4, column 9: dt_s: 0 "),
        ("\"near\": 0.25", "\"near\": -1", "line 5, column 9: near: -1 "),
        ("\"near\": 0.25", "\"near\": 1e-30", "line 5, column 9: near: 1e-30 m is nearer"),
        ("\"near\": 0.25", "\"near\": 1e-7", "give at least 1e-6 m"),
        ("-1, 2, -3, 4]", "1999, 2000, -3, 4]", "rows[0][7]: tangents 1999 and 2000 are not within +-1000"),
        ("-1, 2, -3, 4]", "-1, 2, 200, 200.01]", "rows[0][9]: tangents 200 and 200.01 lie too close"),
        ("0, 0, 1, 1.5]", "0, 0, 1, 3.1415]", "frames[1][7]: 3.1415 is beyond what single precision holds"),
        ("\"far\": 64", "\"far\": 0.25", "line 6, column 8: far: 0.25 must lie above near (0.25)"),
        ("\"far\": 64", "\"far\": \"x\"", "line 6, column 10: far: invalid type"),
        ("\"far\": 64,", "\"far\": 64, \"fur\": 1,", "fur: unknown field `fur`"),
        ("\"damping\": 1", "\"damping\": 2", "line 7, column 177: rain.damping: must lie within 0..1"),
        ("[1, 1, 1]", "[1, 0, 1]", ": rain.box_max: "),
        ("\"by hand\"", "\"by hand\", \"sha256\": \"12\"", "line 3, column "),
        ("0.6, 0, 0.8, 1.5", "0.6, 0, 0.9, 1.5", "line 10, column 1: frames[0]: the quaternion"),
        ("0, 0, 1, 1.5]", "0, 0, 1, 3.2]", "line 11, column 23: frames[1][7]: 3.2 is no field of view"),
        (
            "[1, 2, 3, 0, 0, 0, 1, 1.5]",
            "[1, 2, 1e7, 0, 0, 0, 1, 1.5]",
            "frames[1][2]: 10000000 is not within",
        ),
        ("[1, 2, 3, 0, 0, 0, 1, 1.5]", "[1, 2, 3, 0, 0, 0, 1]", "line 11, column "),
        ("-1, 2, -3, 4]", "2, -1, -3, 4]", ": hmd.eyes[0].rows[0][7]: tangents 2 and -1"),
        ("-1, 2, -3, 4]", "-1, 2, 4, 4]", ": hmd.eyes[0].rows[0][9]: tangents 4 and 4"),
        (
            ", [0, 0, -2, 0, 0, 0, 1, -1, 1, -1, 1]",
            ", [0, 0, -2, 0, 0, 0, 2, -1, 1, -1, 1]",
            "eyes[0].rows[1]: ",
        ),
        ("\"name\": \"e\"", "\"name\": \"e.1\"", "hmd.eyes[0].name: `e.1` is no name"),
        (
            "[{\"name\": \"e\"",
            "[{\"name\": \"f\", \"rows\": []}, {\"name\": \"e\"",
            "hmd.eyes[0].rows: has 0 rows",
        ),
    ] {
        let message = refusal(from, to);
        assert!(message.starts_with("small.json: line ") && message.contains(wanted), "{to}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
    let empty = SMALL.split_once("\"frames\"").unwrap().0.to_owned() + "\"frames\": []}";
    let message = parse("small", Path::new("small.json"), empty.as_bytes()).unwrap_err().to_string();
    assert!(message.contains("line 9, column 11: frames: a recording needs at least one frame"), "{message}");
    assert!(parse("x", Path::new("x"), b"\xff").unwrap_err().to_string().contains("UTF-8"));
}

#[test]
fn every_spelling_of_the_text_is_the_same_recording() {
    let expected = parse("small", Path::new("small.json"), SMALL.as_bytes()).unwrap();
    for bytes in crate::text::tests::spellings(SMALL) {
        assert_eq!(parse("small", Path::new("small.json"), &bytes).unwrap().file(), expected.file());
    }
    let cut = SMALL.split_once("\"frames\"").unwrap().0.replace('\n', "\r") + "\"frames\": []}";
    let message = parse("small", Path::new("small.json"), cut.as_bytes()).unwrap_err().to_string();
    assert!(message.contains("line 9, column 11: "), "lines that end with CR count: {message}");
}

#[test]
fn near_unit_quaternions_play_as_unit_ones() {
    let recording = small("0, 0.6, 0, 0.8, 1.5", "0, 0.6000001, 0, 0.8, 1.5").unwrap();
    assert!((recording.views(0, [4, 4]).unwrap()[0].pose.rotation.length() - 1.0).abs() < 1e-15);
}

proptest! {
    /// What is written reads back to the same bits and is written the same again.
    #[test]
    fn json_keeps_every_bit(
        rows in prop::collection::vec((-1e6_f64..1e6, any::<i32>(), -3.0_f64..3.0, 1e-9_f64..3.1), 1..20),
        dt_s in 1e-6_f64..1.0, seed: u64, damping in 0.0_f32..1.0, left in -2.0_f64..-1e-9,
    ) {
        let frames: Vec<_> = rows.iter().map(|&(x, y, angle, fov)| Frame {
            head: Pose {
                position: DVec3::new(x, f64::from(y) / 3e6, -x),
                rotation: DQuat::from_rotation_y(angle) * DQuat::from_rotation_x(0.5 * angle),
                mirror: None,
            },
            fov,
        }).collect();
        let mut hmd = Hmd::vive();
        hmd.eyes[0].rows[0].tangents[0] = left;
        let file = RecordingFile {
            format: Format::V1,
            source: Source { text: "\"quoted\" \u{e9}\n".to_owned(), sha256: None },
            dt_s,
            near: 0.1,
            far: 1.0 / 3.0,
            rain: Some(RainParameters { seed, damping, ..RainParameters::default() }),
            hmd: Some(hmd),
            frames,
        };
        let recording = Recording::new("r", file).unwrap();
        let text = write::to_json(recording.file()).unwrap();
        prop_assert_eq!(&parse("r", Path::new("r"), text.as_bytes()).unwrap(), &recording);
        prop_assert_eq!(text.lines().count(), 11 + rows.len());
    }

    /// No text makes the loader panic, and what it refuses, it refuses in one line.
    #[test]
    fn mangled_recordings_are_refused_in_one_line(at in 0_usize..SMALL.len(), byte: u8, cut: bool) {
        let mut bytes = SMALL.as_bytes().to_vec();
        bytes[at] = byte;
        if cut {
            bytes.truncate(at);
        }
        if let Err(error) = parse("m", Path::new("m.json"), &bytes) {
            prop_assert_eq!(error.to_string().lines().count(), 1);
        }
    }
}
