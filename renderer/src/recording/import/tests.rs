use super::*;
use crate::recording::load;
use glam::DVec3;
use proptest::prelude::*;
use serde::Deserialize;
use std::path::PathBuf;

/// The camera path of a recording as an independent decoder gives it.
#[derive(Deserialize)]
struct CameraPath {
    near: f64,
    far: f64,
    /// x, y, z, yaw, pitch, fov.
    frames: Vec<[f64; 6]>,
}

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data").join(name)
}

/// Yaw and pitch of a rotation rotY(yaw) * rotX(pitch).
fn angles(frame: &Frame) -> [f64; 2] {
    let forward = frame.head.rotation * DVec3::NEG_Z;
    [(-forward.x).atan2(-forward.z), forward.y.asin()]
}

#[test]
fn imports_follow_the_reference_paths_in_every_frame() {
    for name in ["bistro", "suntem"] {
        let text = std::fs::read_to_string(data(&format!("{name}_camera_path.json"))).unwrap();
        let path: CameraPath = serde_json::from_str(&text).unwrap();
        let recording = import_bin(data(&format!("replay_{name}.bin")), &ImportOptions::default()).unwrap();
        let file = recording.file();
        assert_eq!((file.near, file.far), (path.near, path.far));
        assert_eq!(file.frames.len(), path.frames.len());
        for (number, (frame, wanted)) in file.frames.iter().zip(&path.frames).enumerate() {
            let [yaw, pitch] = angles(frame);
            let turn = (yaw - wanted[3]).rem_euclid(std::f64::consts::TAU);
            let found = frame.head.position.to_array().into_iter().chain([pitch, frame.fov]);
            let wanted = wanted[..3].iter().chain(&wanted[4..]);
            let errors = found.zip(wanted).map(|(found, wanted)| (found - wanted).abs());
            let worst = errors.fold(turn.min(std::f64::consts::TAU - turn), f64::max);
            assert!(worst < 1e-4, "{name} frame {number}: {worst}");
        }
    }
}

#[test]
fn bundled_recordings_are_these_imports() {
    for name in ["bistro", "suntem"] {
        for (suffix, hmd) in [("", None), ("-vive", Some(Hmd::vive()))] {
            let recording = import_bin(data(&format!("replay_{name}.bin")), &ImportOptions { hmd }).unwrap();
            let bundled = load(&format!("{name}{suffix}")).unwrap();
            assert_eq!(bundled.file(), recording.file(), "{name}{suffix}");
            assert_eq!(bundled.sha256(), recording.sha256(), "{name}{suffix}: not as `save` writes it");
        }
    }
}

/// A file of one camera, twice, and the given frames of events.
fn bin(frames: &[&[Vec<u8>]]) -> Vec<u8> {
    let camera = [-100.0, -0.4, 9.0, 0.9, 0.5, 1.0, 2.0, 3.0, std::f32::consts::FRAC_PI_2, 0.25, 1.25_f32];
    let mut bytes: Vec<u8> = camera.iter().chain(&camera).flat_map(|value| value.to_le_bytes()).collect();
    for events in frames {
        bytes.extend((events.len() as u64).to_le_bytes());
        bytes.extend(events.iter().flatten());
    }
    bytes
}

fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn focus(on: bool) -> Vec<u8> {
    [words(&[0, 2]), vec![u8::from(on)]].concat()
}

fn key(code: u32, pressed: bool) -> Vec<u8> {
    [words(&[1, 99, u32::from(!pressed)]), vec![1], words(&[code]), vec![0; 4]].concat()
}

fn mouse(axis: u32, value: f64) -> Vec<u8> {
    [words(&[2, axis]), value.to_le_bytes().to_vec()].concat()
}

fn imported(frames: &[&[Vec<u8>]]) -> Vec<Frame> {
    let bytes = bin(frames);
    import(Path::new("made.bin"), &bytes, &ImportOptions::default()).unwrap().file().frames.clone()
}

#[test]
fn keys_and_mouse_move_the_camera_while_focused() {
    let (w, shift) = (32, 112);
    let unfocused = [key(w, true), mouse(0, 10.0)];
    let resized = [words(&[0, 3]), vec![0; 16]].concat();
    let nameless = [words(&[1, 99, 0]), vec![0; 5]].concat();
    let frames = imported(&[
        &unfocused,
        &[focus(true), resized, nameless, words(&[0, 0])],
        &[key(w, false), key(shift, true), key(13, true), mouse(0, 10.0), mouse(1, -20.0), mouse(3, 5.0)],
        &[focus(false)],
    ]);
    // Velocity 9 m/s is 0.1 m a frame; a fifth of the way is made in the frame itself.
    assert_eq!(frames[0].head.position, DVec3::new(1.0, 2.0, 3.0));
    let moved = frames[1].head.position - frames[0].head.position;
    assert!((moved - DVec3::new(-0.02, 0.0, 0.0)).length() < 2e-6, "W at yaw 90 degrees goes to -x: {moved}");
    // Four times as fast to the right, which is -z; the target is 0.1 m away in x, 0.02 m of that made.
    let moved = frames[2].head.position - frames[1].head.position;
    assert!((moved - DVec3::new(-0.016, 0.0, -0.08)).length() < 2e-6, "{moved}");
    // 10 units at 0.9 rad/s are 0.1 rad a frame.
    let [yaw, pitch] = angles(&frames[2]);
    assert!((yaw - (std::f64::consts::FRAC_PI_2 - 0.02)).abs() < 1e-6, "{yaw}");
    assert!((pitch - (0.25 + 0.04)).abs() < 1e-6, "{pitch}");
    // Unfocused, the camera goes on to its target.
    let moved = frames[3].head.position - frames[2].head.position;
    assert!((moved - DVec3::new(-0.0128, 0.0, -0.064)).length() < 2e-6, "{moved}");
}

#[test]
fn pitch_stops_at_the_zenith() {
    let up = [focus(true), mouse(1, -1e6)];
    let frames = imported(&[&up, &[], &[], &[], &[], &[], &[], &[], &[], &[], &[], &[], &[], &[], &[], &[]]);
    let [_, pitch] = angles(frames.last().unwrap());
    assert!(pitch < std::f64::consts::FRAC_PI_2 && pitch > 1.5, "{pitch}");
}

fn refusal(bytes: &[u8]) -> String {
    import(Path::new("made.bin"), bytes, &ImportOptions::default()).unwrap_err().to_string()
}

#[test]
fn foreign_and_broken_files_get_one_line_that_says_where() {
    assert!(refusal(b"").starts_with("made.bin: is cut short"));
    assert!(refusal(&bin(&[])).contains("without a frame"));
    assert!(
        refusal(&[0x7f; 200]).starts_with("made.bin: is no recording of the thesis's program: at byte 0, ")
    );
    let oversized = [bin(&[]), u64::MAX.to_le_bytes().to_vec()].concat();
    assert!(
        refusal(&oversized).contains("frame 0: ") && refusal(&oversized).contains("at byte 88, 18446744")
    );
    assert!(refusal(&bin(&[&[focus(true)], &[words(&[7, 0, 0])]])).contains("frame 1: "));
    assert!(refusal(&bin(&[&[words(&[7, 0, 0])]])).contains("an event of kind 7"));
    assert!(refusal(&bin(&[&[words(&[0, 9])]])).contains("a window event of kind 9"));
    assert!(refusal(&bin(&[&[[words(&[0, 2]), vec![2]].concat()]])).contains("a flag of 2"));
    assert!(refusal(&bin(&[&[mouse(0, f64::NAN)]])).contains("NaN"));
    let thrown = refusal(&bin(&[&[focus(true), mouse(0, 1e308)]]));
    assert!(thrown.starts_with("made.bin: ") && thrown.contains("frames[0]"), "{thrown}");
    for message in [refusal(&oversized), thrown] {
        assert_eq!(message.lines().count(), 1);
    }
}

#[test]
fn every_truncation_within_a_frame_is_refused() {
    let whole = bin(&[&[focus(true), key(32, true), mouse(0, 1.0)]]);
    let cuts = (0..whole.len())
        .filter(|&cut| import(Path::new("p"), &whole[..cut], &ImportOptions::default()).is_ok());
    assert_eq!(cuts.collect::<Vec<_>>(), Vec::<usize>::new());
}

proptest! {
    /// Whatever the bytes, the importer answers; what it accepts, the format accepts.
    #[test]
    fn random_bytes_are_imported_or_refused(
        tail in prop::collection::vec(prop_oneof![Just(0_u8), Just(1), Just(2), any::<u8>()], 0..200),
        cameras: bool,
    ) {
        let bytes = if cameras { [bin(&[]), tail].concat() } else { tail };
        if let Ok(recording) = import(Path::new("p"), &bytes, &ImportOptions::default()) {
            prop_assert!(recording.frame_count() > 0);
        }
    }
}
