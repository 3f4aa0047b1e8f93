//! What image files say of themselves.

use exr::prelude::{AnyChannels, FlatSamples, Layer, ReadChannels, ReadLayers, Vec2, read};
use manylight_tests::manylight;
use std::path::Path;
use std::process::Command;

/// Replays a frame of the street in stereo and gives the layers of its EXR, and what was noted.
fn stereo(out: &Path, more: &[&str]) -> (f32, Vec<Layer<AnyChannels<FlatSamples>>>, String) {
    let mut command = manylight();
    command.args(["replay", "--frames", "100", "--exr", "100", "--runs", "0", "--lights", "100", "--force"]);
    command.args(["--method", "indi-persp-64", "--resolution", "96x54", "--out"]).arg(out).args(more);
    let output = command.output().unwrap();
    let notes = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{notes}");
    let (aspect, layers) = read_back(&out.join(PICTURE));
    (aspect, layers, notes)
}

/// Where a run's image is.
const PICTURE: &str = "indi-persp-64/frames/000100.exr";

/// Pixel aspect and layers of an EXR.
fn read_back(path: &Path) -> (f32, Vec<Layer<AnyChannels<FlatSamples>>>) {
    let reader =
        read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = reader.from_file(path).unwrap();
    (image.attributes.pixel_aspect, image.layer_data.to_vec())
}

/// What one of OpenEXR's own programs prints.
fn openexr(program: &str, arguments: &[&Path]) -> String {
    let output = Command::new(program).args(arguments).output();
    let output = output.expect("install OpenEXR's programs: scripts/setup.sh --openexr");
    let printed = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    assert!(output.status.success(), "{program} {arguments:?}: {printed}");
    printed
}

fn floats(layer: &Layer<AnyChannels<FlatSamples>>, name: &str) -> Vec<f32> {
    let channel = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name).unwrap();
    channel.sample_data.values_as_f32().collect()
}

#[test]
fn the_header_tells_the_shape_of_each_eye() {
    let out = tempfile::tempdir().unwrap();
    let (aspect, layers, notes) = stereo(out.path(), &[]);
    // The left eye's tangents span 2.632 by 2.935, in pixels of 96 by 54.
    assert!((aspect - 0.5045).abs() < 1e-3, "{aspect}");
    assert!(notes.contains("96x54 does not fit the frustum of view left"), "{notes}");
    let windows = layers.iter().map(|layer| {
        let Vec2(x, y) = layer.attributes.screen_window_center;
        [x, y, layer.attributes.screen_window_width].map(|value| (value * 1e4).round() / 1e4)
    });
    assert_eq!(windows.collect::<Vec<_>>(), [[-0.0736, -0.0062, 2.6321], [0.0741, -0.0047, 2.6433]]);
    let (square, _, notes) = stereo(out.path(), &["--resolution", "96x107"]);
    assert!((square - 1.0).abs() < 0.01 && !notes.contains("does not fit"), "{square}, {notes}");
}

#[test]
fn nothing_is_covered_where_nothing_was_hit() {
    let out = tempfile::tempdir().unwrap();
    for layer in stereo(out.path(), &[]).1 {
        let (alpha, depth) = (floats(&layer, "A"), floats(&layer, "Z"));
        let hit = alpha.iter().zip(&depth).filter(|(_, depth)| depth.is_finite());
        assert!(hit.clone().count() > 1000 && hit.clone().all(|(alpha, _)| *alpha == 1.0));
        let sky: Vec<f32> = alpha
            .iter()
            .zip(&depth)
            .filter(|(_, depth)| depth.is_infinite())
            .map(|(alpha, _)| *alpha)
            .collect();
        // Glass in front of the sky covers in part.
        assert!(sky.len() > 100 && sky.iter().all(|alpha| *alpha < 1.0));
        assert!(sky.iter().filter(|alpha| **alpha == 0.0).count() * 10 > sky.len() * 9, "{sky:?}");
    }
    let multisampled = stereo(out.path(), &["--msaa", "4"]).1;
    let alpha = floats(&multisampled[0], "A");
    assert!([0.25, 0.5, 0.75].iter().all(|part| alpha.contains(part)), "edges are covered in part");
}

#[test]
fn colour_without_coverage_is_none() {
    let out = tempfile::tempdir().unwrap();
    for layer in stereo(out.path(), &["--msaa", "4"]).1 {
        let alpha = floats(&layer, "A");
        for channel in ["R", "G", "B"].map(|name| floats(&layer, name)) {
            assert!(channel.iter().zip(&alpha).all(|(value, alpha)| *alpha > 0.0 || *value == 0.0));
            assert!(channel.iter().any(|value| *value > 0.0));
        }
    }
}

#[test]
fn openexr_makes_of_the_views_in_one_part_the_same_parts_as_we_do() {
    let [parts, one] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (_, expected, _) = stereo(parts.path(), &[]);
    stereo(one.path(), &["--exr-layout", "multiview"]);
    let (picture, converted) = (one.path().join(PICTURE), one.path().join("converted.exr"));
    openexr("exrmultipart", &["-convert".as_ref(), "-i".as_ref(), &picture, "-o".as_ref(), &converted]);
    let (_, found) = read_back(&converted);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.attributes.view_name, expected.attributes.view_name);
        assert!(found.channel_data == expected.channel_data, "{:?}", found.attributes.view_name);
    }
}

#[test]
fn openexr_reads_headers_as_they_are_meant() {
    let out = tempfile::tempdir().unwrap();
    for (layout, views) in [("multipart", 2), ("multiview", 1)] {
        stereo(out.path(), &["--exr-layout", layout]);
        let header = openexr("exrheader", &[&out.path().join(PICTURE)]);
        let lines = |start: &str| header.lines().filter(|line| line.starts_with(start)).count();
        assert_eq!(lines("pixelAspectRatio (type float): 0.504471"), views, "{header}");
        assert_eq!(lines("screenWindowWidth (type float): 2.63212"), 1, "{header}");
        assert_eq!(lines("worldToCamera (type m44f)"), views, "{header}");
        assert_eq!(lines("    right.Z, 32-bit floating-point"), 2 - views, "{header}");
        assert_eq!(lines("multiView (type stringvector)"), 2 - views, "{header}");
    }
}
